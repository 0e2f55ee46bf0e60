"""Which of many boxes overlap seen from above, without comparing each with each."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["overlapping_pairs"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_SMALLEST_CELL = 0.02
"""Metres: what is smaller is sorted like this."""
_HIGHEST_LEVEL = 20
_FEW = 200_000
"""So many pairs are compared each with each sooner than they are sorted."""
_CHUNK = 1 << 20
"""The most pairs that are looked at together."""


def overlapping_pairs(
    lower: Array, upper: Array, others: tuple[Array, Array] | None = None
) -> Iterator[tuple[Indices, Indices]]:
    """Yield pairs (i, j) of boxes whose footprints overlap or touch, each pair once, in portions.

    Boxes are sorted into square cells by their lower corner, the large ones into large cells and the small ones into
    small cells. Of two boxes the one in smaller cells looks for the other: so each looks into few cells, however
    different the sizes are. The time grows with the boxes and the pairs.

    Args:
        lower: (n, 2), smallest x and y of each box, finite, metres.
        upper: (n, 2), largest x and y.
        others: the same of other boxes, where pairs of one and another are asked for; j counts these. Without them,
            pairs are those among the boxes themselves, and i < j.
    """
    if len(lower) * len(lower if others is None else others[0]) <= _FEW:
        yield _compared(lower, upper, *(others or (lower, upper)), only_once=others is None)
        return
    these = _boxes(lower, upper)
    if others is None:
        for i, j in _seek(these, these, seeks_own_level=True):
            # In the same level each finds the other.
            is_new = (these.level[i] < these.level[j]) | (i < j)
            yield np.minimum(i, j)[is_new], np.maximum(i, j)[is_new]
        return
    those = _boxes(*others)
    yield from _seek(these, those, seeks_own_level=True)
    for j, i in _seek(those, these, seeks_own_level=False):
        yield i, j


def _compared(
    lower: Array, upper: Array, others_lower: Array, others_upper: Array, *, only_once: bool
) -> tuple[Indices, Indices]:
    meets = np.ones((len(lower), len(others_lower)), np.bool_)
    for axis in range(2):
        meets &= lower[:, axis, None] <= others_upper[None, :, axis]
        meets &= upper[:, axis, None] >= others_lower[None, :, axis]
    i, j = np.nonzero(np.triu(meets, 1) if only_once else meets)
    return i, j


class _Boxes(NamedTuple):
    lower: Array
    upper: Array
    level: Indices


def _boxes(lower: Array, upper: Array) -> _Boxes:
    # Column by column, as they are looked up.
    return _Boxes(np.asfortranarray(lower), np.asfortranarray(upper), _levels(lower, upper))


def _levels(lower: Array, upper: Array) -> Indices:
    """Return for each box how often the smallest cell is doubled until the box is no longer than it."""
    size = np.maximum((upper - lower).max(axis=1, initial=0), _SMALLEST_CELL)
    return np.asarray(np.minimum(np.ceil(np.log2(size / _SMALLEST_CELL)), _HIGHEST_LEVEL), np.int64)


def _seek(seekers: _Boxes, sought: _Boxes, *, seeks_own_level: bool) -> Iterator[tuple[Indices, Indices]]:
    """Yield pairs of a seeker and a sought box that overlap, the box of a higher level or, if so asked, of the same."""
    if not len(seekers.level) or not len(sought.level):
        return
    origin = np.minimum(seekers.lower.min(axis=0), sought.lower.min(axis=0))
    for level in np.unique(sought.level).tolist():
        chosen = np.flatnonzero(seekers.level <= level if seeks_own_level else seekers.level < level)
        boxes = np.flatnonzero(sought.level == level)
        for found in _look_up(seekers, sought, chosen, boxes, origin):
            seeker, box = found
            for axis in range(2):
                reaches = seekers.lower[:, axis][seeker] <= sought.upper[:, axis][box]
                meets = reaches & (seekers.upper[:, axis][seeker] >= sought.lower[:, axis][box])
                seeker, box = seeker[meets], box[meets]
            yield seeker, box


def _look_up(
    seekers: _Boxes, sought: _Boxes, chosen: Indices, boxes: Indices, origin: Array
) -> Iterator[tuple[Indices, Indices]]:
    """Yield pairs of the chosen seekers and the boxes in the cells that a box which meets them may be sorted into."""
    # A hair more than the longest, so that rounding puts no corner two cells away.
    side = max(_SMALLEST_CELL, float((sought.upper - sought.lower)[boxes].max())) * (1 + 1e-9)
    cell = ((sought.lower[boxes] - origin) // side).astype(np.int64)
    width = int(cell[:, 0].max()) + 1
    key = cell[:, 1] * width + cell[:, 0]
    order = np.argsort(key, kind="stable")
    boxes, key = boxes[order], key[order]
    first = ((seekers.lower[chosen] - origin) // side).astype(np.int64) - 1
    last = ((seekers.upper[chosen] - origin) // side).astype(np.int64)
    left, right = np.maximum(first[:, 0], 0), np.minimum(last[:, 0], width - 1)
    for nth in range(int((last - first)[:, 1].max(initial=-1)) + 1):
        row = first[:, 1] + nth
        some = np.flatnonzero((row >= 0) & (row <= last[:, 1]) & (left <= right))
        # Cells beside each other in a row have numbers one after the other.
        start = np.searchsorted(key, row[some] * width + left[some], side="left")
        end = np.searchsorted(key, row[some] * width + right[some], side="right")
        for seeker, place in _spread(chosen[some], start, end):
            yield seeker, boxes[place]


def _spread(owner: Indices, start: Indices, end: Indices) -> Iterator[tuple[Indices, Indices]]:
    """Yield each owner with each number from its start to before its end, in portions."""
    some = np.flatnonzero(end > start)
    owner, start, count = owner[some], start[some], (end - start)[some]
    portion = np.cumsum(count) // _CHUNK
    for part in np.split(np.arange(len(some)), np.flatnonzero(np.diff(portion)) + 1):
        number = count[part]
        nth = np.arange(number.sum()) - np.repeat(np.cumsum(number) - number, number)
        yield np.repeat(owner[part], number), np.repeat(start[part], number) + nth
