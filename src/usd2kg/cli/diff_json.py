"""The changes between two versions of a scene as JSON data."""

from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from usd2kg.diff import Change, Changes, ObjectState, Tolerances

__all__ = ["changes_json"]


def changes_json(changes: "Changes", tolerances: "Tolerances", old: str, new: str) -> dict[str, Any]:
    """Return all changes between the versions from the files `old` and `new`."""
    from usd2kg.relations import ALL_KINDS  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    pairs = ((match.old.iri, match.new.iri) for match in changes.matches)
    return {
        "old": {"source": old, "things": changes.old_count},
        "new": {"source": new, "things": changes.new_count},
        "tolerances": asdict(tolerances),
        "relations": [kind for kind in ALL_KINDS if kind in changes.kinds],
        "counts": {name.replace(" ", "_"): count for name, count in changes.counts.items()},
        "added": [_thing(thing) for thing in changes.added],
        "removed": [_thing(thing) for thing in changes.removed],
        "changed": [dict(_change(change, tolerances)) for change in changes.changed],
        "same_as": [{"old": before, "new": after} for before, after in pairs if before != after],
    }


def _thing(thing: "ObjectState") -> dict[str, Any]:
    return {
        "path": thing.prim_path,
        "iri": thing.iri,
        "classes": thing.classes,
        "class_label": thing.class_label,
        "size_m": thing.size,
        "center_m": thing.center,
        "mass_kg": thing.mass_kg,
        "assets": sorted(thing.assets),
        "relations": [link._asdict() for link in sorted(thing.links)],
    }


def _change(change: "Change", tolerances: "Tolerances") -> "Iterator[tuple[str, Any]]":
    """Yield the keys of a changed object; those of unchanged properties are left out."""
    from usd2kg.diff import describe_match  # noqa: PLC0415

    old, new = change.match.old, change.match.new
    yield "path", {"old": old.prim_path, "new": new.prim_path}
    yield "iri", {"old": old.iri, "new": new.iri}
    yield "class_label", new.class_label
    yield "match", {"by": change.match.by, "reason": describe_match(change.match, tolerances)}
    if change.move is not None:
        yield "moved", {"from_m": change.move.start, "to_m": change.move.end, "distance_m": change.move.distance}
    if change.turned_degrees:
        yield "turned_degrees", change.turned_degrees
    if change.carrier is not None:
        yield "carried_by", change.carrier
    if change.resized is not None:
        before, after = change.resized
        yield "resized", {"from_m": before, "to_m": after, "with_nested_changes": change.holds_changes}
    if change.reclassified:
        ends = {"old": old, "new": new}
        yield "reclassified", {name: {"classes": t.classes, "label": t.class_label} for name, t in ends.items()}
    if change.mass is not None:
        yield "mass_kg", {"old": change.mass[0], "new": change.mass[1]}
    if change.assets is not None:
        yield "assets", {"old": sorted(change.assets[0]), "new": sorted(change.assets[1])}
    if change.gained or change.lost:
        gained, lost = ([link._asdict() for link in links] for links in (change.gained, change.lost))
        yield "relations", {"gained": gained, "lost": lost}
