"""Extent: the size of an object as the matching of its name sees it."""

from typing import NamedTuple

from usd2kg.grounding.lexical.concepts.sizes import Size, round_size
from usd2kg.grounding.lexical.settings import HEAD_NOUN

__all__ = ["Extent", "extent_of"]


class Extent(NamedTuple):
    """The size of an object, equal for copies that differ by rounding errors."""

    size: Size
    """Rounded extents in metres, in any order."""
    is_below_places: bool
    """Whether it is too small for a place."""


def extent_of(size: Size | None) -> Extent | None:
    """Return the extent of an object by its extents in metres, in any order; None if they are unknown."""
    return None if size is None else Extent(round_size(size), max(size) < HEAD_NOUN.min_place_size)
