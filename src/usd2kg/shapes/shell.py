"""Shell: boxes around the parts of a surface, such as the walls of a flat in one mesh."""

from collections.abc import Iterator
from itertools import permutations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.settings import SHELL
from usd2kg.shapes.surface import Surface

__all__ = ["shell_boxes"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
_SHIFT = 0.37
"""In cells: keeps faces at round multiples of a cell off the boundaries of cells, where rounding would tear them."""
_MAX_SHORT = 1 << 16
Corners = tuple[Array, Array]
"""Lower and upper corner (3,) of a box."""


class _Cells(NamedTuple):
    """A grid, and the box around the surface in each of its cells."""

    is_met: NDArray[np.bool_]
    """(x, y, z): whether the surface passes through a cell."""
    lower: Array
    """(x, y, z, 3), metres; infinite in the other cells."""
    upper: Array


def shell_boxes(surface: Surface) -> list[Corners]:
    """Return boxes that together cover a surface; one box if they hardly save volume.

    The cells of a grid that the surface passes through are joined to blocks (greedy meshing), and blocks are merged
    where their common box is hardly larger.
    """
    extent = np.ptp(surface.corners, axis=(0, 1))
    cell = max(float(extent.max()) / SHELL.cells, SHELL.min_cell)
    while True:
        cells = _sample_cells(surface, cell)
        blocks = min((list(_blocks(cells.is_met, order)) for order in permutations(range(3))), key=len)
        if len(blocks) <= SHELL.max_blocks:
            break
        # Merging takes cubic time.
        cell *= 2
    boxes = _merged([_box_of(cells, block) for block in blocks], cell)
    whole = _joined(boxes)
    is_saving = sum(_volume(box, cell) for box in boxes) <= (1 - SHELL.min_saving) * _volume(whole, cell)
    return sorted(boxes, key=lambda box: (*box[0].tolist(), *box[1].tolist())) if is_saving else [whole]


def _sample_cells(surface: Surface, cell: float) -> _Cells:
    # Two samples per cell leave no hole where a triangle crosses it obliquely.
    points = np.concatenate(list(_samples(surface.corners, cell / 2)))
    place = np.floor((points - points.min(axis=0)) / cell + _SHIFT).astype(np.int64)
    shape = tuple((place.max(axis=0) + 1).tolist())
    which = np.ravel_multi_index(tuple(place.T), shape)
    count = int(np.prod(shape))
    lower, upper = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    # Sorting is faster than the ufuncs' `at`, above all sorting short integers.
    order = np.argsort(which.astype(np.uint16) if count <= _MAX_SHORT else which, kind="stable")
    ordered = which[order]
    starts = np.flatnonzero(np.diff(ordered, prepend=-1))
    met = ordered[starts]
    for axis in range(3):
        column = points[order, axis]
        lower[met, axis] = np.minimum.reduceat(column, starts)
        upper[met, axis] = np.maximum.reduceat(column, starts)
    is_met = np.isfinite(lower[:, 0])
    return _Cells(is_met.reshape(shape), lower.reshape(*shape, 3), upper.reshape(*shape, 3))


def _samples(corners: Array, spacing: float) -> Iterator[Array]:
    """Yield points (n, 3) on triangles, no farther apart than a spacing, with all corners."""
    longest = np.sqrt(np.square(corners - np.roll(corners, 1, axis=1)).sum(axis=2)).max(axis=1)
    steps = np.clip(np.ceil(longest / spacing), 1, 4 * SHELL.cells).astype(np.int64)
    for count in np.unique(steps).tolist():
        some = corners[steps == count]
        i, j = np.meshgrid(np.arange(count + 1), np.arange(count + 1))
        i, j = i[i + j <= count] / count, j[i + j <= count] / count
        weights = np.stack([1 - i - j, i, j], axis=1)
        yield np.einsum("sk,mkd->msd", weights, some).reshape(-1, 3)


def _blocks(is_met: NDArray[np.bool_], order: tuple[int, ...]) -> Iterator[tuple[slice, ...]]:
    """Yield blocks of cells that together are the met ones, each grown along the axes in an order."""
    left = is_met.copy()
    for place in np.argwhere(is_met).tolist():
        if not left[tuple(place)]:
            continue
        block = [slice(at, at + 1) for at in place]
        for axis in order:
            end = block[axis].stop
            while end < left.shape[axis]:
                block[axis] = slice(end, end + 1)
                if not left[tuple(block)].all():
                    break
                end += 1
            block[axis] = slice(place[axis], end)
        left[tuple(block)] = False
        yield tuple(block)


def _box_of(cells: _Cells, block: tuple[slice, ...]) -> Corners:
    return cells.lower[block].min(axis=(0, 1, 2)), cells.upper[block].max(axis=(0, 1, 2))


def _merged(boxes: list[Corners], cell: float) -> list[Corners]:
    """Return boxes after merging those whose common box is hardly larger, and the cheapest ones beyond the limit."""
    lower, upper = np.array([box[0] for box in boxes]), np.array([box[1] for box in boxes])
    while len(lower) > 1:
        size = (upper - lower + cell).prod(axis=1)
        joined = np.maximum(upper[:, None], upper[None]) - np.minimum(lower[:, None], lower[None]) + cell
        growth = joined.prod(axis=2) / (size[:, None] + size[None])
        np.fill_diagonal(growth, np.inf)
        i, j = np.unravel_index(int(growth.argmin()), growth.shape)
        if growth[i, j] > 1 + SHELL.max_growth and len(lower) <= SHELL.max_boxes:
            break
        lower[i], upper[i] = np.minimum(lower[i], lower[j]), np.maximum(upper[i], upper[j])
        lower, upper = np.delete(lower, j, axis=0), np.delete(upper, j, axis=0)
    return list(zip(lower, upper, strict=True))


def _joined(boxes: list[Corners]) -> Corners:
    return np.array([box[0] for box in boxes]).min(axis=0), np.array([box[1] for box in boxes]).max(axis=0)


def _volume(box: Corners, cell: float) -> float:
    """Return the volume of a box, with a cell added to each side, so that sheets have one."""
    return float((box[1] - box[0] + cell).prod())
