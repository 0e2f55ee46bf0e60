"""Plan grid: a plan seen from above as square cells, with connected areas and their outlines; numpy only."""

from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["PlanGrid", "connected_areas", "cut_segments", "holds_square", "outline_loops", "touched_areas"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


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
            corners = np.array([at + i * half[0] * first + j * half[1] * second for i in (-1, 1) for j in (-1, 1)])
            place = self.cells_of(corners)
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
        for triangle in triangles:
            place = self.cells_of(triangle)
            low, high = place.min(axis=0), place.max(axis=0) + 1
            x, y = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]), indexing="ij")
            middles = self.world(np.stack([x, y], axis=-1) + 0.5)
            along = np.roll(triangle, -1, axis=0) - triangle
            offset = middles[..., None, :] - triangle
            side_of = along[:, 0] * offset[..., 1] - along[:, 1] * offset[..., 0]
            mask[low[0] : high[0], low[1] : high[1]] |= (side_of >= 0).all(axis=-1) | (side_of <= 0).all(axis=-1)


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
    areas[known] = np.unique(areas[known], return_inverse=True)[1].ravel()
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


def touched_areas(areas: Indices, mask: Mask) -> Indices:
    """Return the areas that have a cell in a mask or beside one, sorted."""
    grown = mask.copy()
    grown[1:] |= mask[:-1]
    grown[:-1] |= mask[1:]
    grown[:, 1:] |= mask[:, :-1]
    grown[:, :-1] |= mask[:, 1:]
    return np.unique(areas[grown & (areas >= 0)])


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
