"""Things written by hand, and the mirror image of what changed."""

from dataclasses import replace

from usd2kg.diff import Change, Changes, Link, Move, ObjectMatch, ObjectState

Corner = tuple[float, float, float]
CUP = (0.1, 0.1, 0.1)


def item(path: str, place: Corner | None = (0, 0, 0), size: Corner | None = CUP, **known: object) -> ObjectState:
    """Return a thing of the class and asset that its name begins with: Cup_1 is a Cup."""
    kind = path.rpartition("/")[2].partition("_")[0]
    usual = {"center": place, "position": place, "orientation": (0.0, 0.0, 0.0, 1.0), "assets": frozenset({kind})}
    classes = known.pop("classes", (f"https://e.org/{kind}",))
    return ObjectState(path, f"https://e.org/k{path}", classes, size=size, **{**usual, **known})


def on(*anchors: str) -> frozenset[Link]:
    return frozenset(Link("on", anchor) for anchor in anchors)


def ways(changes: Changes) -> dict[str, int]:
    """Return the counts that are not 0."""
    return {name: count for name, count in changes.counts.items() if count}


def pairs(changes: Changes) -> set[tuple[str, str, str]]:
    """Return the matches as (old path, new path, round)."""
    return {(m.old.prim_path, m.new.prim_path, m.by) for m in changes.matches}


def mirrored(changes: Changes) -> Changes:
    """Return what changed if the new is the old."""
    return replace(
        changes,
        changed=tuple(sorted(map(_mirrored, changes.changed), key=lambda change: change.match.new.prim_path)),
        matches=tuple(sorted(map(_match, changes.matches), key=lambda match: match.new.prim_path)),
        added=changes.removed,
        removed=changes.added,
        old_count=changes.new_count,
        new_count=changes.old_count,
    )


def _match(match: ObjectMatch) -> ObjectMatch:
    return ObjectMatch(match.new, match.old, match.by)


def _mirrored(change: Change) -> Change:
    paths = {change.match.new.prim_path: change.match.old.prim_path}
    return replace(
        change,
        match=_match(change.match),
        move=change.move and Move(change.move.end, change.move.start, change.move.distance),
        carrier=change.carrier and paths.get(change.carrier, change.carrier),
        resized=change.resized and (change.resized[1], change.resized[0]),
        mass=change.mass and (change.mass[1], change.mass[0]),
        assets=change.assets and (change.assets[1], change.assets[0]),
        gained=change.lost,
        lost=change.gained,
    )
