"""Why a thing with another prim path is taken for the same one, in words."""

from collections.abc import Iterator

from usd2kg.diff.geometry import moved_by
from usd2kg.diff.match import ObjectMatch
from usd2kg.diff.paths import differing_prefixes
from usd2kg.diff.tolerances import Tolerances

__all__ = ["describe_match"]


def describe_match(match: ObjectMatch, tolerances: Tolerances | None = None) -> str:
    """Return why an old and a new thing are one: `renamed: same asset, same size, 0.02 m away`."""
    if match.by == "path":
        return "same path"
    return f"{_tell_path(match)}: {', '.join(_evidence(match, tolerances or Tolerances()))}"


def _tell_path(match: ObjectMatch) -> str:
    old, new = match.old, match.new
    if match.by == "group":
        before, after = differing_prefixes(old.prim_path, new.prim_path)
        return f"below {after or '/'} in place of {before or '/'}"
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
        distance = moved_by(old.place, new.place)
        yield "in place" if distance <= tolerances.moved_m else f"{distance:.2f} m away"
