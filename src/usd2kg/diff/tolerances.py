"""What counts as a change, and how far a thing may have gone to be known again."""

import math
from dataclasses import dataclass

from usd2kg.errors import GraphError

__all__ = ["Tolerances"]

_NOISE = 0.0001
"""Metres: coordinates in single precision differ by that much in a large scene."""


@dataclass(frozen=True, slots=True)
class Tolerances:
    """How much is no change.

    Raises:
        GraphError: one of them is negative or no number.
    """

    moved_m: float = 0.01
    """A thing that is farther than this from where it was has moved."""
    turned_degrees: float = 1.0
    """A thing whose frame is turned by more than this has turned."""
    resized_m: float = 0.01
    """A side that differs by more than this, or by more than `resized_percent`, is another size."""
    resized_percent: float = 1.0
    """Of the longer side; differences below 0.1 mm are noise."""
    match_within_m: float = 2.0
    """A thing with another path and another name is looked for within this distance."""

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise GraphError(f"{name.replace('_', ' ')} {value!r}: expected a number that is not negative")

    def side(self, length: float) -> float:
        """Return by how much a side of this length, in metres, may differ and still be the same."""
        return max(_NOISE, min(self.resized_m, self.resized_percent / 100 * length))
