"""Tolerances: differences that are not reported, and the reach of the search for renamed objects."""

import math
from dataclasses import dataclass

from usd2kg.diff.settings import COMPARISON
from usd2kg.errors import GraphError
from usd2kg.knowledge import read_settings

__all__ = ["DEFAULT_TOLERANCES", "Tolerances"]


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Largest differences that do not count as changes.

    Raises:
        GraphError: a value is negative or not finite.
    """

    moved_m: float
    """Distance between the old and the new place, metres."""
    turned_degrees: float
    """Angle between the old and the new orientation, degrees."""
    resized_m: float
    """Difference of a side, metres."""
    resized_percent: float
    """Difference of a side, percent of the longer one. The smaller of both limits applies, but at least `noise_m`."""
    match_within_m: float
    """Distance within which objects with another path and name are matched, metres."""

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise GraphError(f"{name.replace('_', ' ')} {value!r}: expected a number that is not negative")

    def side_limit(self, length: float) -> float:
        """Return the tolerated difference of a side of this length, in metres."""
        return max(COMPARISON.noise_m, min(self.resized_m, self.resized_percent / 100 * length))


DEFAULT_TOLERANCES = read_settings("diff", "tolerances", Tolerances)
