"""Wall plan: the walls of a storey as cells of a grid, with their door openings closed."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.storeys import Storey
from usd2kg.relations.thresholds import RoomPlanRule
from usd2kg.shapes.plan_grid import PlanGrid, area_bounds, connected_areas, cut_segments, touched_areas

__all__ = ["WallPlan", "draw_walls"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_PADDING = 3
"""Free cells around the walls, which are outdoors."""


class WallPlan(NamedTuple):
    """Cells of one storey that nobody can walk through."""

    grid: PlanGrid
    is_wall: Mask
    """(x, y): walls at the height of the cut, doors and windows."""
    is_assumed: Mask
    """(x, y): openings without a door that were closed: below a lintel, or between the ends of two walls."""


def draw_walls(boxed: BoxedObjects, storey: Storey, openings: Indices, rule: RoomPlanRule, max_cells: int) -> WallPlan:
    """Return the plan of a storey.

    Args:
        boxed: the objects.
        storey: its walls and floors.
        openings: indices of the doors and windows, which close the openings that they are in.
        rule: the thresholds.
        max_cells: largest number of cells; larger plans get larger cells.
    """
    cut = storey.height + rule.cut_height
    solid = _section(boxed, storey.walls, np.full(len(storey.walls), cut), rule)
    heights = [
        np.full(len(storey.walls), storey.height + rule.sill_height),
        np.full(len(storey.walls), storey.height + rule.lintel_height),
        np.minimum(boxed.upper[storey.walls, 2], storey.top) - rule.top_margin,
    ]
    crossing = [_section(boxed, storey.walls, at, rule) for at in heights]
    here = _on_storey(boxed, openings, storey)
    grid = _grid(boxed, storey.walls, np.concatenate([storey.floors, here]), solid, rule, max_cells)
    is_wall, is_crossed = np.zeros(grid.shape, np.bool_), np.zeros(grid.shape, np.bool_)
    _draw(grid, is_wall, solid)
    for section in crossing:
        _draw(grid, is_crossed, section)
    is_opening = np.zeros(grid.shape, np.bool_)
    shapes = boxed.footprints
    grid.mark_rectangles(is_opening, boxed.middle[here, :2], shapes.half_sides[here], shapes.direction[here])
    is_closed = _closed_below_lintels(is_crossed & ~is_wall, is_opening, grid.cell, rule)
    is_wall |= is_opening
    is_closed |= _closed_gaps(is_wall | is_closed, grid.cell, rule)
    return WallPlan(grid, is_wall, is_closed & ~is_wall)


class _Section(NamedTuple):
    """What a horizontal plane cuts of walls."""

    segments: Array
    """(m, 2, 2)."""
    lower: Array
    """(n, 2), corners of boxes."""
    upper: Array


def _section(boxed: BoxedObjects, walls: Indices, heights: Array, rule: RoomPlanRule) -> _Section:
    segments, lower, upper = [np.zeros((0, 2, 2))], [np.zeros((0, 3))], [np.zeros((0, 3))]
    starts, low, high = boxed.parts
    for wall, height in zip(walls.tolist(), heights.tolist(), strict=True):
        surface = boxed.surfaces[wall]
        if surface is not None:
            segments.append(cut_segments(surface.corners, height))
            continue
        part = slice(starts[wall], starts[wall + 1])
        # A thicker box is around several walls.
        is_cut = (low[part, 2] <= height) & (high[part, 2] > height)
        is_cut &= (high[part] - low[part])[:, :2].min(axis=1) <= rule.max_thickness
        lower.append(low[part][is_cut])
        upper.append(high[part][is_cut])
    return _Section(np.concatenate(segments), np.concatenate(lower)[:, :2], np.concatenate(upper)[:, :2])


def _draw(grid: PlanGrid, mask: Mask, section: _Section) -> None:
    grid.mark_segments(mask, section.segments)
    half = (section.upper - section.lower) / 2
    grid.mark_rectangles(mask, section.lower + half, half, np.tile([1.0, 0.0], (len(half), 1)))


def _grid(
    boxed: BoxedObjects, walls: Indices, others: Indices, solid: _Section, rule: RoomPlanRule, max_cells: int
) -> PlanGrid:
    """Return a grid along the walls, around walls and other objects."""
    turn = _turn(solid.segments)
    if not len(solid.segments) and not len(solid.lower):
        # No surface is at the height of the cut.
        others = np.concatenate([others, walls])
    boxes = [(solid.lower, solid.upper), (boxed.lower[others, :2], boxed.upper[others, :2])]
    corners = [np.stack([a[:, 0], b[:, 1]], axis=1) for low, high in boxes for a in (low, high) for b in (low, high)]
    points = np.concatenate([solid.segments.reshape(-1, 2), *corners]) @ turn
    low, high = points.min(axis=0), points.max(axis=0)
    cell = max(rule.cell, float(np.sqrt((high - low).prod() / max_cells)))
    x, y = _count_cells(high - low, cell)
    while x * y > max_cells:
        # The padding, and a long and narrow plan.
        cell *= 1.25
        x, y = _count_cells(high - low, cell)
    return PlanGrid(low - _PADDING * cell, cell, (x, y), turn)


def _count_cells(size: Array, cell: float) -> tuple[int, int]:
    x, y = (np.ceil(size / cell) + 2 * _PADDING).tolist()
    return int(x), int(y)


def _turn(segments: Array) -> Array:
    """Return the rotation (2, 2) of row vectors that lays most walls along the axes; none for walls that are."""
    along = segments[:, 1] - segments[:, 0]
    length = np.hypot(along[:, 0], along[:, 1])
    # Fourfold angles make the four directions of a rectangle one.
    angle = 4 * np.arctan2(along[:, 1], along[:, 0])
    turned = float(np.arctan2((length * np.sin(angle)).sum(), (length * np.cos(angle)).sum())) / 4
    if abs(turned) < 1e-3 or not len(segments):
        return np.eye(2)
    cos, sin = np.cos(turned), np.sin(turned)
    return np.array([[cos, -sin], [sin, cos]])


def _on_storey(boxed: BoxedObjects, openings: Indices, storey: Storey) -> Indices:
    middle = boxed.middle[openings, 2]
    return np.asarray(openings[(middle > storey.height) & (middle < storey.top)])


def _closed_below_lintels(is_crossed: Mask, is_opening: Mask, cell: float, rule: RoomPlanRule) -> Mask:
    """Return the cells below lintels and above sills of openings that are narrow, or have a door or a window."""
    grown = is_crossed.copy()
    # Cells of an oblique wall may meet at corners only.
    for axis in (0, 1):
        grown |= np.roll(grown, 1, axis) | np.roll(grown, -1, axis)
    areas = connected_areas(np.where(grown, 0, -1))
    # Of the crossed cells alone: an area also has cells around them.
    first, last = area_bounds(np.where(is_crossed, areas, -1))
    is_narrow = ((last - first + 1) * cell).max(axis=1, initial=0.0) <= rule.max_opening
    is_narrow[touched_areas(areas, is_opening)] = True
    return np.asarray(is_crossed & np.append(is_narrow, False)[areas])


def _closed_gaps(is_wall: Mask, cell: float, rule: RoomPlanRule) -> Mask:
    """Return the cells of door openings without a lintel: between the free end of a wall and the next wall."""
    along_y = _gaps_in_rows(is_wall, cell, rule)
    return np.asarray(along_y | _gaps_in_rows(is_wall.T, cell, rule).T)


def _gaps_in_rows(is_wall: Mask, cell: float, rule: RoomPlanRule) -> Mask:
    thickness = _run_lengths(is_wall.T).T
    closed = np.zeros(is_wall.shape, np.bool_)
    row, start = np.nonzero(is_wall & ~np.pad(is_wall, ((0, 0), (1, 0)))[:, :-1])
    _, end = np.nonzero(is_wall & ~np.pad(is_wall, ((0, 0), (0, 1)))[:, 1:])
    is_long = (end - start + 1) * cell >= rule.min_jamb_wall
    widest = rule.max_thickness / cell
    ends_freely = is_long & (thickness[row, end] <= widest)
    starts_freely = is_long & (thickness[row, start] <= widest)
    gap = start[1:] - end[:-1] - 1
    is_door = (row[1:] == row[:-1]) & (gap * cell <= rule.max_gap) & (ends_freely[:-1] | starts_freely[1:])
    for at in np.flatnonzero(is_door).tolist():
        closed[row[at], end[at] + 1 : start[at + 1]] = True
    return closed


def _run_lengths(mask: Mask) -> Indices:
    """Return for each set cell the length of the run along y that it is in; 0 for the others."""
    flat = np.pad(mask, ((0, 0), (0, 1))).ravel()
    is_start = flat & ~np.concatenate([[False], flat[:-1]])
    run = np.cumsum(is_start) - 1
    lengths = np.bincount(run[flat], minlength=int(is_start.sum()) + 1)
    return np.asarray(np.where(flat, lengths[run], 0).reshape(len(mask), -1)[:, :-1])
