"""describe_match: why an old and a new object are the same, in words."""

from collections.abc import Iterator

from usd2kg.diff.geometry import distance_between
from usd2kg.diff.match import ObjectMatch
from usd2kg.diff.paths import differing_prefixes
from usd2kg.diff.tolerances import DEFAULT_TOLERANCES, Tolerances

__all__ = ["describe_match"]


def describe_match(match: ObjectMatch, tolerances: Tolerances = DEFAULT_TOLERANCES) -> str:
    """Return the reason for a match, such as `renamed: same asset, same size, 0.02 m away`."""
    if match.by == "path":
        return "same path"
    return f"{_path_change(match)}: {', '.join(_evidence(match, tolerances))}"


def _path_change(match: ObjectMatch) -> str:
    old, new = match.old, match.new
    if match.by == "group":
        before, after = differing_prefixes(old.prim_path, new.prim_path)
        return f"below {after or '/'} instead of {before or '/'}"
    if old.parent == new.parent:
        return "renamed"
    return f"{'moved' if old.name == new.name else 'renamed and moved'} under {new.parent}"


def _evidence(match: ObjectMatch, tolerances: Tolerances) -> Iterator[str]:
    old, new = match.old, match.new
    if old.assets & new.assets:
        yield "same asset"
    if old.size is not None:
        yield "same size"
    if old.classes and old.classes == new.classes:
        yield "same class"
    if old.place is not None and new.place is not None:
        distance = distance_between(old.place, new.place)
        yield "in place" if distance <= tolerances.moved_m else f"{distance:.2f} m away"
