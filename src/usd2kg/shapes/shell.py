"""Shell: boxes around the parts of a surface, such as the walls of a flat in one mesh."""

import math
from collections.abc import Iterator
from itertools import permutations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.extent import extent_of
from usd2kg.shapes.settings import SHELL
from usd2kg.shapes.surface import Surface

__all__ = ["shell_boxes"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
_SHIFT = 0.37
"""In cells: keeps faces at round multiples of a cell off the boundaries of cells, where rounding would tear them."""
_OTHER_AXES = ((1, 2), (0, 2), (0, 1))
Corners = tuple[Array, Array]
"""Lower and upper corner (3,) of a box."""


class _Cells(NamedTuple):
    """A grid, and the box around the surface in each of its cells."""

    is_met: NDArray[np.bool_]
    """(x, y, z): whether the surface passes through a cell."""
    lower: Array
    """(3, x, y, z), metres; infinite in the other cells."""
    upper: Array


def shell_boxes(surface: Surface) -> list[Corners]:
    """Return boxes that together cover a surface; one box if they hardly save volume.

    The cells of a grid that the surface passes through are joined to blocks (greedy meshing), and blocks are merged
    where their common box is hardly larger.
    """
    corners = surface.corners
    lower, upper = extent_of(corners)
    cell = max(float((upper - lower).max()) / SHELL.cells, SHELL.min_cell)
    while True:
        cells = _sample_cells(corners, cell)
        blocks = min((list(_blocks(cells.is_met, order)) for order in permutations(range(3))), key=len)
        if len(blocks) <= SHELL.max_blocks:
            break
        # Merging takes cubic time.
        cell *= 2
    boxes = _merged([_box_of(cells, block) for block in blocks], cell)
    whole = _joined(boxes)
    is_saving = sum(_volume(box, cell) for box in boxes) <= (1 - SHELL.min_saving) * _volume(whole, cell)
    return sorted(boxes, key=lambda box: (*box[0].tolist(), *box[1].tolist())) if is_saving else [whole]


def _sample_cells(corners: Array, cell: float) -> _Cells:
    start, end = extent_of(corners)
    shape = (((end - start) / cell + _SHIFT).astype(np.int64) + 1).tolist()
    lower, upper = np.full((3, math.prod(shape)), np.inf), np.full((3, math.prod(shape)), -np.inf)
    # Two samples per cell leave no hole where a triangle crosses it obliquely.
    for points in _samples(corners, cell / 2):
        places = ((points - start[:, None]) / cell + _SHIFT).astype(np.int64)
        # A sample may be outside the corners by a rounding error.
        which = np.ravel_multi_index(tuple(places), shape, mode="clip")
        for axis, column in enumerate(points):
            np.minimum.at(lower[axis], which, column)
            np.maximum.at(upper[axis], which, column)
    return _Cells(np.isfinite(lower[0]).reshape(shape), lower.reshape(3, *shape), upper.reshape(3, *shape))


def _samples(corners: Array, spacing: float) -> Iterator[Array]:
    """Yield points (3, n) on some triangles after others, no farther apart than a spacing, with all corners."""
    longest = np.sqrt(np.square(corners - np.roll(corners, 1, axis=1)).sum(axis=2)).max(axis=1)
    steps = np.clip(np.ceil(longest / spacing), 1, 4 * SHELL.cells).astype(np.int64)
    for count in np.flatnonzero(np.bincount(steps)).tolist():
        # The points of one triangle are contiguous, which numpy's inner loops need.
        a, b, c = corners[steps == count].transpose(1, 2, 0)[..., None]
        steps_b, steps_c = np.meshgrid(np.arange(count + 1), np.arange(count + 1))
        is_in = steps_b + steps_c <= count
        i, j = steps_b[is_in] / count, steps_c[is_in] / count
        yield ((1 - i - j) * a + i * b + j * c).reshape(3, -1)


def _blocks(is_met: NDArray[np.bool_], order: tuple[int, ...]) -> Iterator[tuple[slice, ...]]:
    """Yield blocks of cells that together are the met ones, each grown along the axes in an order."""
    left = is_met.copy()
    flat = left.reshape(-1)
    first = int(flat.argmax())
    while flat[first]:
        place = [int(at) for at in np.unravel_index(first, left.shape)]
        block = [slice(at, at + 1) for at in place]
        for axis in order:
            block[axis] = slice(place[axis], None)
            is_full = left[tuple(block)].all(axis=_OTHER_AXES[axis])
            length = is_full.size if is_full.all() else int(is_full.argmin())
            block[axis] = slice(place[axis], place[axis] + length)
        left[tuple(block)] = False
        yield tuple(block)
        first += int(flat[first:].argmax())


def _box_of(cells: _Cells, block: tuple[slice, ...]) -> Corners:
    return cells.lower[:, *block].min(axis=(1, 2, 3)), cells.upper[:, *block].max(axis=(1, 2, 3))


def _merged(boxes: list[Corners], cell: float) -> list[Corners]:
    """Return boxes after merging those whose common box is hardly larger, and the cheapest ones beyond the limit."""
    lower, upper = np.array([box[0] for box in boxes]), np.array([box[1] for box in boxes])
    is_left = np.ones(len(boxes), np.bool_)
    growth = np.array([_growth_with(index, lower, upper, is_left, cell) for index in range(len(boxes))])
    for left in range(len(boxes), 1, -1):
        i, j = np.unravel_index(int(growth.argmin()), growth.shape)
        if growth[i, j] > 1 + SHELL.max_growth and left <= SHELL.max_boxes:
            break
        lower[i], upper[i] = np.minimum(lower[i], lower[j]), np.maximum(upper[i], upper[j])
        is_left[j] = False
        growth[j] = growth[:, j] = np.inf
        growth[i] = growth[:, i] = _growth_with(int(i), lower, upper, is_left, cell)
    return list(zip(lower[is_left], upper[is_left], strict=True))


def _growth_with(index: int, lower: Array, upper: Array, is_left: NDArray[np.bool_], cell: float) -> Array:
    """Return the volume of the common box of one box and each other, relative to the sum of both."""
    size = (upper - lower + cell).prod(axis=1)
    joined = (np.maximum(upper[index], upper) - np.minimum(lower[index], lower) + cell).prod(axis=1)
    growth = np.where(is_left, joined / (size[index] + size), np.inf)
    growth[index] = np.inf
    return growth


def _joined(boxes: list[Corners]) -> Corners:
    return np.array([box[0] for box in boxes]).min(axis=0), np.array([box[1] for box in boxes]).max(axis=0)


def _volume(box: Corners, cell: float) -> float:
    """Return the volume of a box, with a cell added to each side, so that sheets have one."""
    return float((box[1] - box[0] + cell).prod())
