"""Pairs of rows of two tables: those with equal keys, those that are close, and the best of them, each row once."""

from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Index", "Pairs", "Points", "close_pairs", "equal_pairs", "pick"]

Index = NDArray[np.int64]
Pairs = tuple[Index, Index]


class Points(NamedTuple):
    """Points, each with a number that parts them."""

    places: NDArray[np.float64]
    """(N, 3)."""
    colors: Index
    """(N,): only points with the same one are paired."""


_MOST = 2_000_000
"""Pairs that are in memory at a time."""
_FEW = 100_000
"""So many pairs are compared each with each sooner than they are sorted into cells."""
_FARTHEST = 2.0**52
"""Cells from the origin, beyond which their numbers would not be exact."""


def equal_pairs(left: Index, right: Index) -> Iterator[Pairs]:
    """Yield the pairs of rows whose keys are equal, in portions."""
    yield from _join([left], right)


def close_pairs(left: Points, right: Points, radius: float) -> Iterator[Pairs]:
    """Yield the pairs of points that are at most `radius` apart and of one colour, in portions.

    A point that is not a number is close to none.
    """
    for i, j in _candidates(left, right, radius):
        is_close = np.linalg.norm(left.places[i] - right.places[j], axis=1) <= radius
        is_close &= left.colors[i] == right.colors[j]
        yield i[is_close], j[is_close]


def _candidates(left: Points, right: Points, radius: float) -> Iterator[Pairs]:
    """Yield the pairs in neighbouring cells as wide as the radius; where there are few points, all pairs."""
    if len(left.places) * len(right.places) <= _FEW:
        rows, columns = np.indices((len(left.places), len(right.places))).reshape(2, -1)
        yield rows, columns
        return
    cells_left, cells_right = _cells(left.places, radius), _cells(right.places, radius)
    keys_right = _key(cells_right, right.colors)
    steps = (np.array(step, dtype=np.int64) for step in product((-1, 0, 1), repeat=3))
    yield from _join([_key(cells_left + step, left.colors) for step in steps], keys_right)


def pick(i: Index, j: Index, keys: tuple[NDArray[np.float64] | Index, ...]) -> list[int]:
    """Return the positions of the pairs to take, the smallest keys first, so that each row is in one at most."""
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
    bounded = np.clip(np.floor(points / radius), -_FARTHEST, _FARTHEST)
    cells: Index = np.nan_to_num(bounded, nan=0.0).astype(np.int64)
    return cells


def _key(cells: Index, colors: Index) -> Index:
    # Cells that share a key by chance give pairs that are not close; those are left out by their distance.
    x, y, z = cells.T
    key: Index = x * 73_856_093 + y * 19_349_663 + z * 83_492_791 + colors * 2_654_435_761
    return key


def _join(lefts: list[Index], right: Index) -> Iterator[Pairs]:
    """Yield the pairs in which any of the keys of the left row is the key of the right row."""
    order = np.argsort(right, kind="stable")
    ordered = right[order]
    starts = [np.searchsorted(ordered, left, "left") for left in lefts]
    counts = [np.searchsorted(ordered, left, "right") - start for left, start in zip(lefts, starts, strict=True)]
    for rows in _portions(np.sum(counts, axis=0)):
        found = [_spread(rows, start[rows], count[rows]) for start, count in zip(starts, counts, strict=True)]
        yield np.concatenate([i for i, _ in found]), order[np.concatenate([at for _, at in found])]


def _portions(counts: Index) -> Iterator[Index]:
    """Yield runs of rows, each with not too many pairs."""
    portion = np.cumsum(counts) // _MOST
    ends = np.flatnonzero(np.diff(portion)) + 1
    yield from (rows for rows in np.split(np.arange(len(counts)), ends) if counts[rows].any())


def _spread(rows: Index, starts: Index, counts: Index) -> Pairs:
    before = np.cumsum(counts) - counts
    steps = np.arange(counts.sum()) - np.repeat(before, counts)
    return np.repeat(rows, counts), np.repeat(starts, counts) + steps
