"""What changed, as text for a person."""

import posixpath
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from usd2kg.cli.object_rows import numbers_text, size_text
from usd2kg.cli.output import printable

if TYPE_CHECKING:
    from usd2kg.diff import Change, Changes, Link, ObjectState, Tolerances

__all__ = ["report_text"]

_MANY = 5
"""So many things that moved by the same are told in one line."""
_WORDS = {"part-of": "part of", "next-to": "next to", "room": "in the room", "left": "left of", "right": "right of"}
_TELLING = ("on", "inside", "part-of", "room")


def report_text(changes: "Changes", tolerances: "Tolerances", title: str, most: int | None = None) -> str:
    """Return the changes in groups of lines, at most `most` of each, and a last line that counts them all."""
    changed = changes.changed
    shifted = [change for change in changed if change.move or change.turned_degrees]
    sections = {
        f"Added, {_count(changes.added)}": [_tell_thing(thing) for thing in changes.added],
        f"Removed, {_count(changes.removed)}": [_tell_thing(thing) for thing in changes.removed],
        f"Under another path, {_count([c for c in changed if c.is_renamed])}": list(_renamed(changed, tolerances)),
        f"Moved or turned, {_count(shifted)}": list(_moved(shifted, is_short=most is not None)),
        f"Resized, {_count([c for c in changed if c.resized])}": list(_resized(changed)),
        f"Of another class, {_count([c for c in changed if c.reclassified])}": list(_reclassified(changed)),
        f"Of another mass or asset, {_count([c for c in changed if c.mass or c.assets])}": list(_facts(changed)),
        f"With other relations, {_count([c for c in changed if c.gained or c.lost])}": list(_related(changed)),
    }
    blocks = ["\n".join(_section(name, lines, most)) for name, lines in sections.items() if lines]
    return "\n\n".join([printable(title), *blocks, _summary_text(changes)]) + "\n"


def _summary_text(changes: "Changes") -> str:
    """Return one line that counts what changed."""
    if changes.is_empty:
        return f"no thing differs: {changes.old_count} {_things(changes.old_count)}"
    counted = ", ".join(f"{count} {name}" for name, count in changes.counts.items() if count)
    same = len(changes.matches) - len(changes.changed)
    return (
        f"{changes.old_count} {_things(changes.old_count)} before, {changes.new_count} now: {counted}; {same} the same"
    )


def _things(count: int) -> str:
    return "thing" if count == 1 else "things"


def _count(found: "Sequence[ObjectState | Change]") -> str:
    return f"{len(found)} {_things(len(found))}"


def _section(name: str, lines: Sequence[str], most: int | None) -> Iterator[str]:
    yield name
    yield from (f"  {_line(line)}" for line in lines[:most])
    rest = len(lines) - len(lines[:most])
    if rest:
        yield f"  … {rest} more (--all shows them)"


def _line(text: str) -> str:
    return printable(" ".join(text.split()))


def _class(thing: "ObjectState") -> str:
    return thing.class_label or "no class"


def _who(change: "Change") -> str:
    new = change.match.new
    return f"{new.prim_path} ({new.class_label})" if new.class_label else new.prim_path


def _tell_thing(thing: "ObjectState") -> str:
    where = ", ".join(_tell_link(link) for link in sorted(thing.links) if link.kind in _TELLING)
    known = [f" ({thing.class_label})" if thing.class_label else "", f": {where}" if where else ""]
    return thing.prim_path + "".join(known)


def _tell_link(link: "Link") -> str:
    return f"{_WORDS.get(link.kind, link.kind)} {link.anchor}"


def _renamed(changed: "Iterable[Change]", tolerances: "Tolerances") -> Iterator[str]:
    """Yield a line for each thing, and one for all that only a group's path changed."""
    from usd2kg.diff import describe_match  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.diff.paths import differing_prefixes  # noqa: PLC0415

    renamed = [(differing_prefixes(c.match.old.prim_path, c.match.new.prim_path), c) for c in changed if c.is_renamed]
    counts = Counter(stems for stems, _ in renamed)
    for (before, after), count in counts.items():
        if count > 1:
            yield f"{before or '/'} → {after or '/'}: {count} things below it have the same names as before"
    for stems, change in renamed:
        if counts[stems] == 1:
            yield f"{change.match.old.prim_path} → {_who(change)}: {describe_match(change.match, tolerances)}"


def _moved(shifted: "Iterable[Change]", *, is_short: bool) -> Iterator[str]:
    """Yield a line for each thing that moved by itself, with the number of those that it took along."""
    by_path = {change.match.new.prim_path: change for change in shifted}
    taken = Counter(_first_carrier(change, by_path) for change in by_path.values() if change.carrier)
    alone = [change for change in by_path.values() if change.carrier is None]
    steps = Counter(map(_step, alone))
    told: set[str] = set()
    for change in alone:
        step = _step(change)
        if is_short and step is not None and steps[step] >= _MANY:
            if step not in told:
                told.add(step)
                paths = [c.match.new.prim_path for c in alone if _step(c) == step]
                count = len(paths) + sum(taken[path] for path in paths)
                yield f"{count} things below {posixpath.commonpath(paths)}: all by {step} m (--all shows them)"
            continue
        with_it = taken[change.match.new.prim_path]
        rest = f"; with it {with_it} {_things(with_it)} on, in or below it" if with_it else ""
        yield f"{_who(change)}: {' and '.join(_motion(change))}{rest}"


def _first_carrier(change: "Change", by_path: "dict[str, Change]") -> str:
    path, seen = change.match.new.prim_path, set[str]()
    while (carrier := by_path[path].carrier) is not None and path not in seen:
        seen.add(path)
        path = carrier
    return path


def _step(change: "Change") -> str | None:
    """Return by how much a thing moved without a turn, to the centimetre."""
    if change.move is None or change.turned_degrees:
        return None
    return numbers_text([b - a for a, b in zip(change.move.start, change.move.end, strict=True)])


def _motion(change: "Change") -> Iterator[str]:
    if change.move is not None:
        start, end = numbers_text(change.move.start), numbers_text(change.move.end)
        yield f"{change.move.distance:.2f} m, from {start} to {end}"
    if change.turned_degrees:
        yield f"turned by {change.turned_degrees:.1f}°"


def _reclassified(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        if change.reclassified:
            yield f"{change.match.new.prim_path}: {_class(change.match.old)} → {_class(change.match.new)}"


def _resized(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        if change.resized is not None:
            before, after = map(size_text, change.resized)
            why = "; things nested below it changed, which its box goes around" if change.holds_changes else ""
            yield f"{_who(change)}: {before} m → {after} m{why}"


def _facts(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        told = []
        if change.mass is not None:
            told.append("mass " + " → ".join("unknown" if m is None else f"{m:.3g} kg" for m in change.mass))
        if change.assets is not None:
            told.append("asset " + " → ".join(", ".join(sorted(names)) or "none" for names in change.assets))
        if told:
            yield f"{_who(change)}: {'; '.join(told)}"


def _related(changed: "Iterable[Change]") -> Iterator[str]:
    for change in changed:
        gained, lost = (", ".join(map(_tell_link, links)) for links in (change.gained, change.lost))
        told = [f"now {gained}" if gained else "", f"no longer {lost}" if lost else ""]
        if gained or lost:
            yield f"{_who(change)}: {'; '.join(filter(None, told))}"
