"""Plan grid: a plan seen from above as square cells, with connected areas and their outlines; numpy only."""

from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "PlanGrid",
    "area_bounds",
    "connected_areas",
    "cut_segments",
    "holds_square",
    "outline_loops",
    "rectangle_corners",
    "touched_areas",
    "with_neighbours",
]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_TRIANGLES_AT_ONCE = 512
"""Bounds the memory of large triangles on a large grid."""


class PlanGrid(NamedTuple):
    """A grid of square cells over a plan, which may be turned about z."""

    origin: Array
    """(2,), metres, plan frame: the lower corner of cell (0, 0)."""
    cell: float
    """Side of a cell in metres."""
    shape: tuple[int, int]
    """Number of cells along the x and y axes of the plan."""
    turn: Array
    """(2, 2): row vectors in the world frame times this are in the plan frame."""

    def cells_of(self, points: Array) -> Indices:
        """Return the cells (n, 2) of points (n, 2) in the world frame; points outside get the cells at the border."""
        place = np.floor((points @ self.turn - self.origin) / self.cell)
        return np.clip(place, 0, np.array(self.shape) - 1).astype(np.int64)

    def world(self, corners: Array) -> Array:
        """Return grid corners (n, 2), counted in cells, as points in the world frame."""
        return np.asarray((self.origin + corners * self.cell) @ self.turn.T)

    def mark_segments(self, mask: Mask, segments: Array) -> None:
        """Set the cells along segments (m, 2, 2) in the world frame; the cells of one segment touch each other."""
        if not len(segments):
            return
        along = segments[:, 1] - segments[:, 0]
        # Half a cell apart, so that no cell diagonal is skipped.
        steps = np.maximum(np.ceil(np.hypot(along[:, 0], along[:, 1]) / (self.cell / 2)), 1).astype(np.int64)
        which = np.repeat(np.arange(len(segments)), steps + 1)
        step = np.arange(len(which)) - np.repeat(np.cumsum(steps + 1) - steps - 1, steps + 1)
        points = segments[which, 0] + along[which] * (step / steps[which])[:, None]
        x, y = self.cells_of(points).T
        mask[x, y] = True

    def mark_rectangles(self, mask: Mask, middle: Array, half_sides: Array, direction: Array) -> None:
        """Set the cells under rectangles: middles (n, 2), half sides (n, 2), unit vectors (n, 2) of the first sides."""
        for at, half, first in zip(middle, half_sides, direction, strict=True):
            second = np.array([-first[1], first[0]])
            place = self.cells_of(rectangle_corners(at, half, first))
            low, high = place.min(axis=0), place.max(axis=0) + 1
            x, y = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]), indexing="ij")
            offset = self.world(np.stack([x, y], axis=-1) + 0.5) - at
            # Half a cell wider, so that thin rectangles are not lost between the middles of cells.
            slack = self.cell / 2
            is_in = (np.abs(offset @ first) <= half[0] + slack) & (np.abs(offset @ second) <= half[1] + slack)
            mask[low[0] : high[0], low[1] : high[1]] |= is_in

    def mark_triangles(self, mask: Mask, triangles: Array) -> None:
        """Set the cells whose middles are in triangles (n, 3, 2) in the world frame, and those along their sides."""
        for side in range(3):
            self.mark_segments(mask, triangles[:, [side, (side + 1) % 3]])
        placed = (triangles @ self.turn - self.origin) / self.cell
        # +1 where a run of cells along y starts, -1 behind its end.
        changes = np.zeros((self.shape[0], self.shape[1] + 1), np.int32)
        for start in range(0, len(placed), _TRIANGLES_AT_ONCE):
            _add_runs(changes, placed[start : start + _TRIANGLES_AT_ONCE])
        mask |= changes[:, :-1].cumsum(axis=1) > 0

    def window(self, points: Array) -> tuple["PlanGrid", tuple[slice, slice]]:
        """Return the part of the grid around points (n, 2) in the world frame, and its cells in this grid."""
        place = self.cells_of(points)
        low, high = place.min(axis=0), place.max(axis=0) + 1
        shape = (int(high[0] - low[0]), int(high[1] - low[1]))
        cells = (slice(int(low[0]), int(high[0])), slice(int(low[1]), int(high[1])))
        return PlanGrid(self.origin + low * self.cell, self.cell, shape, self.turn), cells


def rectangle_corners(middle: Array, half_sides: Array, direction: Array) -> Array:
    """Return the corners (4, 2) of a rectangle with a middle (2,), half sides (2,) and the direction of the first."""
    first, second = half_sides[0] * direction, half_sides[1] * np.array([-direction[1], direction[0]])
    return np.array([middle + i * first + j * second for i in (-1, 1) for j in (-1, 1)])


def _add_runs(changes: NDArray[np.int32], corners: Array) -> None:
    """Add the runs of cells along y whose middles are in triangles (n, 3, 2), in cells; see `mark_triangles`."""
    columns, rows = changes.shape[0], changes.shape[1] - 1
    first = np.clip(np.ceil(corners[..., 0].min(axis=1) - 0.5), 0, columns).astype(np.int64)
    last = np.clip(np.floor(corners[..., 0].max(axis=1) - 0.5), -1, columns - 1).astype(np.int64)
    count = np.maximum(last - first + 1, 0)
    which = np.repeat(np.arange(len(corners)), count)
    column = np.arange(len(which)) - np.repeat(np.cumsum(count) - count - first, count)
    middle = (column + 0.5)[:, None]
    start, end = corners[which], np.roll(corners, -1, axis=1)[which]
    is_crossed = (start[..., 0] <= middle) != (end[..., 0] <= middle)
    width = np.where(is_crossed, end[..., 0] - start[..., 0], 1.0)
    y = start[..., 1] + (middle - start[..., 0]) / width * (end[..., 1] - start[..., 1])
    low = np.ceil(np.where(is_crossed, y, np.inf).min(axis=1, initial=np.inf) - 0.5)
    high = np.floor(np.where(is_crossed, y, -np.inf).max(axis=1, initial=-np.inf) - 0.5) + 1
    low, high = (np.clip(end, 0, rows).astype(np.int64) for end in (low, high))
    is_run = high > low
    np.add.at(changes, (column[is_run], low[is_run]), 1)
    np.add.at(changes, (column[is_run], high[is_run]), -1)


def cut_segments(corners: Array, height: float) -> Array:
    """Return the segments (m, 2, 2) in which the horizontal plane at a height cuts triangles (n, 3, 3)."""
    above = corners[..., 2] > height
    crossed = corners[above.any(axis=1) & ~above.all(axis=1)]
    if not len(crossed):
        return np.zeros((0, 2, 2))
    start, end = crossed, np.roll(crossed, -1, axis=1)
    rise = end[..., 2] - start[..., 2]
    is_cut = (start[..., 2] > height) != (end[..., 2] > height)
    share = (height - start[..., 2]) / np.where(is_cut, rise, 1.0)
    points = start[..., :2] + share[..., None] * (end - start)[..., :2]
    # Each crossed triangle has exactly two cut sides.
    return np.asarray(points[is_cut].reshape(-1, 2, 2))


def connected_areas(kinds: Indices) -> Indices:
    """Return the connected area of each cell (x, y), numbered from 0; cells are joined across sides, not corners.

    Args:
        kinds: (x, y); only cells of the same kind are joined; negative cells are in no area and get -1.

    >>> connected_areas(np.array([[0, -1, 0], [0, -1, -1], [0, 0, 1]])).tolist()
    [[0, -1, 1], [0, -1, -1], [0, 0, 2]]
    """
    flat = kinds.ravel()
    is_start = np.ones(flat.shape, np.bool_)
    is_start[1:] = flat[1:] != flat[:-1]
    is_start[:: kinds.shape[1]] = True
    run = (np.cumsum(is_start) - 1).reshape(kinds.shape)
    # Runs along y are joined with those of the same kind in the next column.
    meet = (kinds[1:] == kinds[:-1]) & (kinds[1:] >= 0)
    one, other = run[:-1][meet], run[1:][meet]
    is_new = np.ones(len(one), np.bool_)
    is_new[1:] = (one[1:] != one[:-1]) | (other[1:] != other[:-1])
    root = _joined(int(run.max()) + 1, one[is_new], other[is_new])
    areas = np.where(kinds >= 0, root[run], -1)
    known = areas >= 0
    # Numbers without gaps.
    is_used = np.zeros(len(root), np.bool_)
    is_used[areas[known]] = True
    areas[known] = (np.cumsum(is_used) - 1)[areas[known]]
    return np.asarray(areas, np.int64)


def _joined(count: int, one: Indices, other: Indices) -> Indices:
    """Return the smallest item of the group of each item, where pairs join items."""
    root = np.arange(count)
    while len(one):
        a, b = root[one], root[other]
        is_apart = a != b
        if not is_apart.any():
            break
        one, other, a, b = one[is_apart], other[is_apart], a[is_apart], b[is_apart]
        np.minimum.at(root, np.maximum(a, b), np.minimum(a, b))
        while True:
            above = root[root]
            if np.array_equal(above, root):
                break
            root = above
    return root


def holds_square(areas: Indices, side: int) -> Indices:
    """Return the areas that a square of `side` cells fits into with all four corners, sorted."""
    if side > min(areas.shape):
        return np.zeros(0, np.int64)
    blocked = np.zeros((areas.shape[0] + 1, areas.shape[1] + 1), np.int64)
    blocked[1:, 1:] = (areas < 0).cumsum(axis=0).cumsum(axis=1)
    is_free = blocked[side:, side:] - blocked[:-side, side:] - blocked[side:, :-side] + blocked[:-side, :-side] == 0
    x, y = is_free.shape
    first = areas[:x, :y]
    for i, j in ((side - 1, 0), (0, side - 1), (side - 1, side - 1)):
        is_free &= areas[i : i + x, j : j + y] == first
    return np.unique(first[is_free])


def area_bounds(areas: Indices) -> tuple[Indices, Indices]:
    """Return the first and the last cell (n, 2) of each area, as `connected_areas` numbers them."""
    count = int(areas.max(initial=-1)) + 1
    first, last = np.full((count, 2), np.iinfo(np.int64).max), np.full((count, 2), -1)
    cells = np.nonzero(areas >= 0)
    for axis, place in enumerate(cells):
        np.minimum.at(first[:, axis], areas[cells], place)
        np.maximum.at(last[:, axis], areas[cells], place)
    return first, last


def with_neighbours(mask: Mask) -> Mask:
    """Return the cells of a mask and those that share a side with one."""
    grown = mask.copy()
    grown[1:] |= mask[:-1]
    grown[:-1] |= mask[1:]
    grown[:, 1:] |= mask[:, :-1]
    grown[:, :-1] |= mask[:, 1:]
    return grown


def touched_areas(areas: Indices, mask: Mask) -> Indices:
    """Return the areas that have a cell in a mask or beside one, sorted."""
    return np.unique(areas[with_neighbours(mask) & (areas >= 0)])


def outline_loops(mask: Mask) -> list[Array]:
    """Return the outlines of an area as closed loops of corners (n, 2) in cells, the outer one first.

    The outer loop is counter-clockwise, holes are clockwise; the first corner is not repeated. Corners on a straight
    side are left out.
    """
    padded = np.pad(mask, 1)
    following: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for start, end in _border_sides(padded):
        following.setdefault(start, []).append(end)
    loops = []
    while following:
        loops.append(_without_straight(np.array(_walk(following))) - 1)
    return sorted(loops, key=lambda loop: -_signed_area(loop))


def _border_sides(mask: Mask) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """Yield the sides of cells on the border as (start, end), with the area on their left."""
    for x, y in np.argwhere(mask[:, 1:] & ~mask[:, :-1]).tolist():
        yield (x, y + 1), (x + 1, y + 1)
    for x, y in np.argwhere(mask[:, :-1] & ~mask[:, 1:]).tolist():
        yield (x + 1, y + 1), (x, y + 1)
    for x, y in np.argwhere(mask[:-1] & ~mask[1:]).tolist():
        yield (x + 1, y), (x + 1, y + 1)
    for x, y in np.argwhere(mask[1:] & ~mask[:-1]).tolist():
        yield (x + 1, y + 1), (x + 1, y)


def _walk(following: dict[tuple[int, int], list[tuple[int, int]]]) -> list[tuple[int, int]]:
    """Take one loop out of the sides that are left and return its corners."""
    start = at = min(following)
    before = at
    loop = []
    while True:
        loop.append(at)
        ends = following[at]
        # Where two cells meet at a corner only, the left turn stays at the same cell.
        end = min(ends, key=partial(_turn, before, at))
        ends.remove(end)
        if not ends:
            del following[at]
        before, at = at, end
        if at == start:
            return loop


def _turn(before: tuple[int, int], at: tuple[int, int], to: tuple[int, int]) -> int:
    """Return -1 for a left turn and 1 for a right turn."""
    ahead = (at[0] - before[0], at[1] - before[1])
    return -1 if ahead[0] * (to[1] - at[1]) - ahead[1] * (to[0] - at[0]) > 0 else 1


def _without_straight(loop: Array) -> Array:
    before, after = loop - np.roll(loop, 1, axis=0), np.roll(loop, -1, axis=0) - loop
    is_corner = before[:, 0] * after[:, 1] != before[:, 1] * after[:, 0]
    return np.asarray(loop[is_corner], np.float64)


def _signed_area(loop: Array) -> float:
    x, y = loop.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)
