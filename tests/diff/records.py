"""Object states written by hand, and the mirror image of changes."""

from dataclasses import replace

from usd2kg.diff import Change, Changes, Link, Move, ObjectMatch, ObjectState

Corner = tuple[float, float, float]
CUP = (0.1, 0.1, 0.1)


def item(path: str, place: Corner | None = (0, 0, 0), size: Corner | None = CUP, **known: object) -> ObjectState:
    """Return an object whose class and asset are the first part of its name: Cup_1 is a Cup."""
    kind = path.rpartition("/")[2].partition("_")[0]
    usual = {"center": place, "position": place, "orientation": (0.0, 0.0, 0.0, 1.0), "assets": frozenset({kind})}
    classes = known.pop("classes", (f"https://e.org/{kind}",))
    return ObjectState(path, f"https://e.org/k{path}", classes, size=size, **{**usual, **known})


def rename(state: ObjectState, path: str) -> ObjectState:
    return replace(state, prim_path=path)


def on(*anchors: str) -> frozenset[Link]:
    return frozenset(Link("on", anchor) for anchor in anchors)


def nonzero_counts(changes: Changes) -> dict[str, int]:
    return {name: count for name, count in changes.counts.items() if count}


def pairs(changes: Changes) -> set[tuple[str, str, str]]:
    """Return the matches as (old path, new path, round)."""
    return {(m.old.prim_path, m.new.prim_path, m.by) for m in changes.matches}


def mirrored(changes: Changes) -> Changes:
    """Return the changes with old and new exchanged."""
    return replace(
        changes,
        changed=tuple(sorted(map(_mirror_change, changes.changed), key=lambda change: change.match.new.prim_path)),
        matches=tuple(sorted(map(_mirror_match, changes.matches), key=lambda match: match.new.prim_path)),
        added=changes.removed,
        removed=changes.added,
        old_count=changes.new_count,
        new_count=changes.old_count,
    )


def _mirror_match(match: ObjectMatch) -> ObjectMatch:
    return ObjectMatch(match.new, match.old, match.by)


def _mirror_change(change: Change) -> Change:
    return replace(
        change,
        match=_mirror_match(change.match),
        move=change.move and Move(change.move.end, change.move.start, change.move.distance),
        resized=change.resized and (change.resized[1], change.resized[0]),
        mass=change.mass and (change.mass[1], change.mass[0]),
        assets=change.assets and (change.assets[1], change.assets[0]),
        gained=change.lost,
        lost=change.gained,
    )
