"""Pairs of rows of two tables with equal keys or nearby points, and selection of the best pairs."""

from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.diff.settings import MEMORY
from usd2kg.shapes.ragged import ragged_indices

__all__ = ["GroupedPoints", "Index", "Pairs", "close_pairs", "equal_pairs", "pick_pairs"]

Index = NDArray[np.int64]
Pairs = tuple[Index, Index]
"""Row of the left and row of the right table of each pair."""


class GroupedPoints(NamedTuple):
    """Points in groups; only points of equal groups form pairs."""

    places: NDArray[np.float64]
    """(N, 3); NaN for an unknown place."""
    groups: Index
    """(N,)."""


_MAX_CELL = 2.0**52
"""Cell coordinates beyond this are not exact in float64."""
_HASH_PRIMES = (73_856_093, 19_349_663, 83_492_791)
"""Spatial hash of Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects, 2003."""
_GROUP_PRIME = 2_654_435_761
"""Knuth's multiplicative hash."""


def equal_pairs(left: Index, right: Index) -> Iterator[Pairs]:
    """Yield the pairs of rows with equal keys, in chunks."""
    yield from _join([left], right)


def close_pairs(left: GroupedPoints, right: GroupedPoints, radius: float) -> Iterator[Pairs]:
    """Yield the pairs of points of the same group within `radius`, in chunks."""
    for i, j in _candidates(left, right, radius):
        is_close = np.linalg.norm(left.places[i] - right.places[j], axis=1) <= radius
        is_close &= left.groups[i] == right.groups[j]
        yield i[is_close], j[is_close]


def _candidates(left: GroupedPoints, right: GroupedPoints, radius: float) -> Iterator[Pairs]:
    """Yield the pairs in neighbouring cells of edge `radius`, or all pairs if they are few."""
    if len(left.places) * len(right.places) <= MEMORY.max_exhaustive_pairs:
        rows, columns = np.indices((len(left.places), len(right.places))).reshape(2, -1)
        yield rows, columns
        return
    cells_left, cells_right = _cells(left.places, radius), _cells(right.places, radius)
    keys_right = _hash_cells(cells_right, right.groups)
    offsets = (np.array(offset, dtype=np.int64) for offset in product((-1, 0, 1), repeat=3))
    yield from _join([_hash_cells(cells_left + offset, left.groups) for offset in offsets], keys_right)


def pick_pairs(i: Index, j: Index, keys: tuple[NDArray[np.float64] | Index, ...]) -> list[int]:
    """Return the positions of the pairs chosen by a greedy one-to-one assignment, smallest keys first."""
    taken: list[int] = []
    left: set[int] = set()
    right: set[int] = set()
    rows, columns = i.tolist(), j.tolist()
    for at in np.lexsort(keys[::-1]).tolist():
        if rows[at] not in left and columns[at] not in right:
            left.add(rows[at])
            right.add(columns[at])
            taken.append(at)
    return taken


def _cells(points: NDArray[np.float64], radius: float) -> Index:
    bounded = np.clip(np.floor(points / radius), -_MAX_CELL, _MAX_CELL)
    cells: Index = np.nan_to_num(bounded, nan=0.0).astype(np.int64)
    return cells


def _hash_cells(cells: Index, groups: Index) -> Index:
    """Return a hash of each cell and group; `close_pairs` removes the pairs of collisions by their distance."""
    key: Index = cells @ np.array(_HASH_PRIMES) + groups * _GROUP_PRIME
    return key


def _join(lefts: list[Index], right: Index) -> Iterator[Pairs]:
    """Yield the pairs in which any key of the left row equals the key of the right row, in chunks."""
    order = np.argsort(right, kind="stable")
    ordered = right[order]
    starts = [np.searchsorted(ordered, left, "left") for left in lefts]
    counts = [np.searchsorted(ordered, left, "right") - start for left, start in zip(lefts, starts, strict=True)]
    for rows in _chunks(np.sum(counts, axis=0)):
        found = [_expand(rows, start[rows], count[rows]) for start, count in zip(starts, counts, strict=True)]
        yield np.concatenate([i for i, _ in found]), order[np.concatenate([at for _, at in found])]


def _chunks(counts: Index) -> Iterator[Index]:
    """Yield runs of rows with a bounded total number of pairs, given the number of each row."""
    chunk = np.cumsum(counts) // MEMORY.pairs_per_chunk
    ends = np.flatnonzero(np.diff(chunk)) + 1
    yield from (rows for rows in np.split(np.arange(len(counts)), ends) if counts[rows].any())


def _expand(rows: Index, starts: Index, counts: Index) -> Pairs:
    """Return each row with each of the `counts` positions from its start."""
    row, step = ragged_indices(counts)
    return rows[row], starts[row] + step
