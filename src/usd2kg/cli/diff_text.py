"""The changes between two versions of a scene as text."""

import posixpath
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from usd2kg.cli.limits import CHANGES_PER_KIND, MOVES_TO_GROUP
from usd2kg.cli.object_text import box_size_text, mass_text, numbers_text
from usd2kg.cli.output import count_noun, replace_controls, to_single_line

if TYPE_CHECKING:
    from usd2kg.diff import Change, Changes, Link, ObjectState, Tolerances

__all__ = ["changes_text"]

_RELATION_NAMES = {
    "part-of": "part of",
    "next-to": "next to",
    "room": "in the room",
    "left": "left of",
    "right": "right of",
}
_PLACE_KINDS = frozenset({"on", "inside", "part-of", "room"})
"""Relations that locate an added or removed object."""


def changes_text(changes: "Changes", tolerances: "Tolerances", title: str, *, is_complete: bool) -> str:
    """Return the changes by kind, and a last line that counts them.

    Args:
        changes: the changes.
        tolerances: those of the comparison, to explain matches.
        title: first line.
        is_complete: whether all changes are shown, or `CHANGES_PER_KIND` of each kind, moves by the same grouped.
    """
    limit = None if is_complete else CHANGES_PER_KIND
    changed = changes.changed
    shifted = [change for change in changed if change.move or change.turned_degrees]
    sections = {
        f"Added, {_count(changes.added)}": list(map(_thing_line, changes.added)),
        f"Removed, {_count(changes.removed)}": list(map(_thing_line, changes.removed)),
        f"Renamed, {_count([c for c in changed if c.is_renamed])}": list(_renamed_lines(changed, tolerances)),
        f"Moved or turned, {_count(shifted)}": list(_moved_lines(shifted, is_grouped=not is_complete)),
        f"Resized, {_count([c for c in changed if c.resized])}": list(_resized_lines(changed)),
        f"Reclassified, {_count([c for c in changed if c.reclassified])}": list(_reclassified_lines(changed)),
        f"Mass or asset changed, {_count([c for c in changed if c.mass or c.assets])}": list(_property_lines(changed)),
        f"Relations changed, {_count([c for c in changed if c.gained or c.lost])}": list(_relation_lines(changed)),
    }
    blocks = ["\n".join(_section(name, lines, limit)) for name, lines in sections.items() if lines]
    return "\n\n".join([replace_controls(title), *blocks, _summary_line(changes)]) + "\n"


def _count(found: "Sequence[ObjectState | Change]") -> str:
    return count_noun(len(found), "object")


def _section(name: str, lines: Sequence[str], limit: int | None) -> Iterator[str]:
    yield name
    yield from (f"  {to_single_line(line)}" for line in lines[:limit])
    hidden = len(lines) - len(lines[:limit])
    if hidden:
        yield f"  … {hidden} more (--all shows them)"


def _summary_line(changes: "Changes") -> str:
    if changes.is_empty:
        return f"no changes in {count_noun(changes.old_count, 'object')}"
    counts = ", ".join(f"{count} {name}" for name, count in changes.counts.items() if count)
    unchanged = len(changes.matches) - len(changes.changed)
    return (
        f"{count_noun(changes.old_count, 'object')} before, {changes.new_count} after: {counts}; {unchanged} unchanged"
    )


def _name(change: "Change") -> str:
    """Return the current path of a changed object with its class."""
    new = change.match.new
    return f"{new.prim_path} ({new.class_label})" if new.class_label else new.prim_path


def _thing_line(thing: "ObjectState") -> str:
    place = ", ".join(_link_text(link) for link in sorted(thing.links) if link.kind in _PLACE_KINDS)
    return "".join(
        [thing.prim_path, f" ({thing.class_label})" if thing.class_label else "", f": {place}" if place else ""]
    )


def _link_text(link: "Link") -> str:
    return f"{_RELATION_NAMES.get(link.kind, link.kind)} {link.anchor}"


def _renamed_lines(changed: "Iterable[Change]", tolerances: "Tolerances") -> Iterator[str]:
    """Yield a line for each renamed group with several objects, then one for each other renamed object."""
    from usd2kg.diff import describe_match  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.diff.paths import differing_prefixes  # noqa: PLC0415

    renamed = [(differing_prefixes(c.match.old.prim_path, c.match.new.prim_path), c) for c in changed if c.is_renamed]
    counts = Counter(stems for stems, _ in renamed)
    for (before, after), count in counts.items():
        if count > 1:
            yield f"{before or '/'} → {after or '/'}: {count} objects below keep their relative paths"
    for stems, change in renamed:
        if counts[stems] == 1:
            yield f"{change.match.old.prim_path} → {_name(change)}: {describe_match(change.match, tolerances)}"


def _moved_lines(shifted: "Iterable[Change]", *, is_grouped: bool) -> Iterator[str]:
    """Yield a line for each object that was not carried by another, with the number of objects it carried.

    If grouped, `MOVES_TO_GROUP` objects or more with the same displacement share a line.
    """
    by_path = {change.match.new.prim_path: change for change in shifted}
    carried = Counter(_first_carrier(change, by_path) for change in by_path.values() if change.carrier)
    movers = [change for change in by_path.values() if change.carrier is None]
    groups: dict[str, list[str]] = {}
    for change in movers:
        if is_grouped and (displacement := _displacement(change)) is not None:
            groups.setdefault(displacement, []).append(change.match.new.prim_path)
    groups = {displacement: paths for displacement, paths in groups.items() if len(paths) >= MOVES_TO_GROUP}
    for change in movers:
        paths = groups.get(displacement := _displacement(change) or "")
        path = change.match.new.prim_path
        if paths is None:
            others = f"; with {count_noun(carried[path], 'object')} on, in or below it" if carried[path] else ""
            yield f"{_name(change)}: {' and '.join(_motion(change))}{others}"
        elif path == paths[0]:
            count = len(paths) + sum(carried[path] for path in paths)
            yield f"{count} objects below {posixpath.commonpath(paths)}: all by {displacement} m (--all shows them)"


def _first_carrier(change: "Change", by_path: "dict[str, Change]") -> str:
    path, seen = change.match.new.prim_path, set[str]()
    while (carrier := by_path[path].carrier) is not None and path not in seen:
        seen.add(path)
        path = carrier
    return path


def _displacement(change: "Change") -> str | None:
    """Return the displacement of an object, rounded to centimetres; None if it was turned or did not move."""
    if change.move is None or change.turned_degrees:
        return None
    return numbers_text([b - a for a, b in zip(change.move.start, change.move.end, strict=True)])


def _motion(change: "Change") -> Iterator[str]:
    if change.move is not None:
        start, end = numbers_text(change.move.start), numbers_text(change.move.end)
        yield f"{change.move.distance:.2f} m, from {start} to {end}"
    if change.turned_degrees:
        yield f"turned by {change.turned_degrees:.1f}°"


def _reclassified_lines(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        if change.reclassified:
            before, after = (thing.class_label or "no class" for thing in (change.match.old, change.match.new))
            yield f"{change.match.new.prim_path}: {before} → {after}"


def _resized_lines(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        if change.resized is not None:
            before, after = map(box_size_text, change.resized)
            reason = "; its box includes objects below it that changed" if change.holds_changes else ""
            yield f"{_name(change)}: {before} m → {after} m{reason}"


def _property_lines(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        parts = []
        if change.mass is not None:
            parts.append("mass " + " → ".join("unknown" if m is None else f"{mass_text(m)} kg" for m in change.mass))
        if change.assets is not None:
            parts.append("asset " + " → ".join(", ".join(sorted(names)) or "none" for names in change.assets))
        if parts:
            yield f"{_name(change)}: {'; '.join(parts)}"


def _relation_lines(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        gained, lost = (", ".join(map(_link_text, links)) for links in (change.gained, change.lost))
        parts = [f"now {gained}" if gained else "", f"no longer {lost}" if lost else ""]
        if gained or lost:
            yield f"{_name(change)}: {'; '.join(filter(None, parts))}"
