"""Paths from objects to what holds them, outwards from the building."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import first_of_each_group

__all__ = ["HoldingPaths", "find_holding_paths"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_STEP = 1e-4
"""Metres added for each object on a path, so that of equal paths the shorter one wins."""


class HoldingPaths(NamedTuple):
    """The shortest way from each object to what is held for certain: a wall, a ceiling or an object that rests."""

    length: Array
    """Sum of the gaps on the way in metres; inf if there is none."""
    through: Indices
    """The next object on the way; -1 for an object that is held for certain, or by nothing."""

    def lead_through(self, starts: Indices, other: Indices) -> Mask:
        """Return for each start whether its way leads through the other object."""
        here, found = self.through[starts], np.zeros(len(starts), np.bool_)
        while (here >= 0).any():
            found |= here == other
            here = np.where(here >= 0, self.through[here], -1)
        return found


def find_holding_paths(target: Indices, anchor: Indices, gap: Array, is_free: Mask) -> HoldingPaths:
    """Return the paths from each object over pairs of objects that touch (Bellman and Ford).

    Args:
        target: one object of each pair.
        anchor: the object that may hold it.
        gap: metres between the two; penetration counts as 0.
        is_free: whether each object needs to be held.
    """
    cost = np.clip(gap, 0, None) + _STEP
    length = np.where(is_free, np.inf, 0.0)
    through = np.full(len(is_free), -1)
    some = np.flatnonzero(is_free[target])
    while len(some):
        total = cost[some] + length[anchor[some]]
        better = np.flatnonzero(total < length[target[some]])
        if not len(better):
            break
        best = better[first_of_each_group(target[some[better]], (anchor[some[better]], total[better]))]
        length[target[some[best]]] = total[best]
        through[target[some[best]]] = anchor[some[best]]
    return HoldingPaths(length, through)
