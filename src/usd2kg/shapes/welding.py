"""Group points that coincide."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["WeldedPoints", "weld_points"]


class WeldedPoints(NamedTuple):
    """Groups of coincident points."""

    first: NDArray[np.int64]
    """(k,), index of the first point of each group of coincident points."""
    group: NDArray[np.int64]
    """(n,), number of the group of each point."""


def weld_points(points: NDArray[np.floating], step: float) -> WeldedPoints:
    """Return the groups of points (n, 3) that lie in the same cell of a grid.

    Args:
        points: finite numbers.
        step: side of the cells, at least 2⁻²¹ of the largest extent.
    """
    cells = np.round(points.astype(np.float64) / step).astype(np.int64)
    cells -= cells.min(axis=0)
    keys = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
    _, first, group = np.unique(keys, return_index=True, return_inverse=True)
    return WeldedPoints(first, group.reshape(-1))
