"""Measure many pairs of objects block by block."""

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows
from usd2kg.two_processes import compute_in_halves

__all__ = ["measure_in_blocks"]

Indices = NDArray[np.int64]
_Columns = TypeVar("_Columns", bound=tuple[Any, ...])
"""A NamedTuple of arrays of the same length."""

_BLOCK = 1 << 9
"""Pairs measured at a time, which bounds memory."""
_MANY_BLOCKS = 40
"""Blocks from which a second process saves time."""


def measure_in_blocks(measure: Callable[[Indices], _Columns], count: int) -> _Columns:
    """Return what `measure` returns for some of the pairs, for all of them.

    Args:
        measure: indices of pairs, ascending → one row each.
        count: number of pairs.
    """

    def measure_some(blocks: Sequence[Indices]) -> list[_Columns]:
        return [measure(block) for block in blocks]

    blocks = np.array_split(np.arange(count), count // _BLOCK + 1)
    halves = compute_in_halves(measure_some, blocks, least=_MANY_BLOCKS)
    return concatenate_rows([found for half in halves for found in half])
