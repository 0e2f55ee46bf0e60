"""Mode of each row of a table of numbers."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["row_modes"]

Indices = NDArray[np.int64]


def row_modes(values: Indices, least: int) -> tuple[Indices, Indices]:
    """Return the most frequent value of each row (n, k) and how often it occurs; the smallest wins a tie.

    Values below `least` do not count. A row without others has any value of its own, 0 times.

    >>> row_modes(np.array([[3, 1, 3], [2, 1, -1], [-1, -1, -1]]), 0)
    (array([ 3,  1, -1]), array([2, 1, 0]))
    """
    ordered = np.sort(values, axis=1)
    counts = (ordered[:, :, None] == ordered[:, None, :]).sum(axis=2) * (ordered >= least)
    best, rows = counts.argmax(axis=1), np.arange(len(values))
    return ordered[rows, best], counts[rows, best]
