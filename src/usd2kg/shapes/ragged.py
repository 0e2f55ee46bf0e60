"""Index arithmetic for ragged arrays, whose rows have different lengths."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["RaggedIndices", "ragged_indices"]


class RaggedIndices(NamedTuple):
    """Row and column of each element of a ragged array, row by row."""

    row: NDArray[np.int64]
    column: NDArray[np.int64]


def ragged_indices(lengths: NDArray[Any]) -> RaggedIndices:
    """Return the row and column of each element, (Σ lengths,).

    >>> import numpy as np
    >>> row, column = ragged_indices(np.array([2, 0, 3]))
    >>> row.tolist(), column.tolist()
    ([0, 0, 2, 2, 2], [0, 1, 0, 1, 2])
    """
    row = np.repeat(np.arange(len(lengths)), lengths)
    return RaggedIndices(row, np.arange(len(row)) - np.repeat(np.cumsum(lengths) - lengths, lengths))
