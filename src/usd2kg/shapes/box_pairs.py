"""Pairs of boxes that overlap seen from above, found with a hierarchical grid."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.ragged import ragged_indices

__all__ = ["overlapping_pairs"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_SMALLEST_CELL = 0.02
"""Side of the cells of level 0 in metres; affects speed only."""
_HIGHEST_LEVEL = 20
"""Largest level; each level doubles the side of the cells."""
_HEAP = 16
"""Boxes in each cell seen from above, beyond which the grid has layers; affects speed only."""
_BRUTE_FORCE_PAIRS = 200_000
"""Number of pairs up to which comparing all is faster than sorting."""
_CHUNK = 1 << 20
"""Pairs processed at a time, which bounds memory."""


def overlapping_pairs(
    lower: Array, upper: Array, others: tuple[Array, Array] | None = None
) -> Iterator[tuple[Indices, Indices]]:
    """Yield pairs (i, j) of boxes that overlap or touch along all given axes, each pair once, in chunks.

    Each box is stored in one square cell by its lower corner; the size of the cells depends on the size of the box
    (hierarchical grid, Ericson 2005, section 7.2). The smaller box of a pair searches for the larger one, so that each
    box searches few cells whatever the range of sizes. The time is linear in the number of boxes and pairs.

    Args:
        lower: (n, 2), smallest x and y of each box, finite, metres, for pairs whose footprints overlap; (n, 3) with z.
        upper: (n, 2), largest x and y; (n, 3) with z.
        others: corners of other boxes, indexed by j; by default pairs among the boxes themselves with i < j.
    """
    if len(lower) * len(lower if others is None else others[0]) <= _BRUTE_FORCE_PAIRS:
        yield _compare_all(lower, upper, *(others or (lower, upper)), is_symmetric=others is None)
        return
    these = _sort_by_level(lower, upper)
    if others is None:
        for i, j in _search(these, these, searches_own_level=True):
            # Two boxes of one level find each other.
            is_new = (these.level[i] < these.level[j]) | (i < j)
            yield np.minimum(i, j)[is_new], np.maximum(i, j)[is_new]
        return
    those = _sort_by_level(*others)
    yield from _search(these, those, searches_own_level=True)
    for j, i in _search(those, these, searches_own_level=False):
        yield i, j


def _compare_all(
    lower: Array, upper: Array, others_lower: Array, others_upper: Array, *, is_symmetric: bool
) -> tuple[Indices, Indices]:
    overlaps = np.ones((len(lower), len(others_lower)), np.bool_)
    for axis in range(lower.shape[1]):
        overlaps &= lower[:, axis, None] <= others_upper[None, :, axis]
        overlaps &= upper[:, axis, None] >= others_lower[None, :, axis]
    i, j = np.nonzero(np.triu(overlaps, 1) if is_symmetric else overlaps)
    return i, j


class _LeveledBoxes(NamedTuple):
    lower: Array
    upper: Array
    level: Indices
    """Number of times the smallest cell is doubled until it is as long as the box."""


def _sort_by_level(lower: Array, upper: Array) -> _LeveledBoxes:
    size = np.maximum((upper - lower).max(axis=1, initial=0), _SMALLEST_CELL)
    level = np.minimum(np.ceil(np.log2(size / _SMALLEST_CELL)), _HIGHEST_LEVEL)
    # Column-major, because the search reads one axis at a time.
    return _LeveledBoxes(np.asfortranarray(lower), np.asfortranarray(upper), np.asarray(level, np.int64))


def _search(
    queries: _LeveledBoxes, stored: _LeveledBoxes, *, searches_own_level: bool
) -> Iterator[tuple[Indices, Indices]]:
    """Yield overlapping pairs of a query and a stored box of a higher level or, on request, of the same level."""
    if not len(queries.level) or not len(stored.level):
        return
    origin = np.minimum(queries.lower.min(axis=0), stored.lower.min(axis=0))
    for level in np.unique(stored.level).tolist():
        chosen = np.flatnonzero(queries.level <= level if searches_own_level else queries.level < level)
        boxes = np.flatnonzero(stored.level == level)
        for query, box in _candidate_pairs(queries, stored, chosen, boxes, origin):
            for axis in range(queries.lower.shape[1]):
                overlaps = queries.lower[:, axis][query] <= stored.upper[:, axis][box]
                overlaps &= queries.upper[:, axis][query] >= stored.lower[:, axis][box]
                query, box = query[overlaps], box[overlaps]  # noqa: PLW2901
            yield query, box


def _candidate_pairs(
    queries: _LeveledBoxes, stored: _LeveledBoxes, chosen: Indices, boxes: Indices, origin: Array
) -> Iterator[tuple[Indices, Indices]]:
    """Yield pairs of the chosen queries and the boxes in the cells that an overlapping box may be stored in."""
    # Slightly more than the longest box, so that rounding moves no corner by two cells.
    side = max(_SMALLEST_CELL, float((stored.upper - stored.lower)[boxes].max())) * (1 + 1e-9)
    cell = ((stored.lower[boxes] - origin) // side).astype(np.int64)
    width, rows = (cell[:, :2].max(axis=0) + 1).tolist()
    key = cell[:, 1] * width + cell[:, 0]
    # Layers pay only where many boxes are above each other.
    has_layers = cell.shape[1] > 2 and len(boxes) > _HEAP * len(np.unique(key))
    if has_layers:
        key += cell[:, 2] * width * rows
    order = np.argsort(key, kind="stable")
    boxes, key = boxes[order], key[order]
    first = ((queries.lower[chosen] - origin) // side).astype(np.int64) - 1
    last = ((queries.upper[chosen] - origin) // side).astype(np.int64)
    left, right = np.maximum(first[:, 0], 0), np.minimum(last[:, 0], width - 1)
    axes = slice(1, 3 if has_layers else 2)
    for nth in np.ndindex(*((last - first)[:, axes].max(axis=0, initial=-1) + 1).tolist()):
        is_in = left <= right
        for axis, step in enumerate(nth, start=1):
            is_in &= (first[:, axis] + step >= 0) & (first[:, axis] + step <= last[:, axis])
        if has_layers:
            is_in &= first[:, 1] + nth[0] < rows
        some = np.flatnonzero(is_in)
        # Adjacent cells of a row have consecutive keys.
        place = first[some, 1] + nth[0]
        if has_layers:
            place += (first[some, 2] + nth[1]) * rows
        start = np.searchsorted(key, place * width + left[some], side="left")
        end = np.searchsorted(key, place * width + right[some], side="right")
        for query, found in _expand_ranges(chosen[some], start, end):
            yield query, boxes[found]


def _expand_ranges(owner: Indices, start: Indices, end: Indices) -> Iterator[tuple[Indices, Indices]]:
    """Yield each owner with each number in its half-open range, in chunks."""
    some = np.flatnonzero(end > start)
    owner, start, count = owner[some], start[some], (end - start)[some]
    portion = np.cumsum(count) // _CHUNK
    for part in np.split(np.arange(len(some)), np.flatnonzero(np.diff(portion)) + 1):
        number = count[part]
        row, nth = ragged_indices(number)
        yield owner[part][row], start[part][row] + nth
