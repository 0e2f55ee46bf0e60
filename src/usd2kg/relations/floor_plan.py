"""Floor plan: rooms where no prim is a room, from the walls around free floor, else from separate floor slabs."""

from collections import Counter
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.derived_room import DerivedRoom
from usd2kg.relations.storeys import Storey, find_storeys
from usd2kg.relations.thresholds import RoomPlanRule
from usd2kg.relations.wall_plan import WallPlan, draw_walls
from usd2kg.shapes.plan_grid import (
    PlanGrid,
    area_bounds,
    connected_areas,
    holds_square,
    outline_loops,
    rectangle_corners,
    with_neighbours,
)
from usd2kg.words import words_of

__all__ = ["FloorPlan", "draw_floor_plans"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class FloorPlan(NamedTuple):
    """The rooms of one storey."""

    storey: Storey
    grid: PlanGrid
    room: Indices
    """(x, y): index of the room of each cell among all rooms of the scene; -1 for walls and outdoors."""
    is_wall: Mask
    """(x, y): walls with their cavities, doors, windows and openings that were closed."""


def draw_floor_plans(
    boxed: BoxedObjects,
    classes: ClassMembership,
    openings: Indices,
    rule: RoomPlanRule,
    words: frozenset[str],
) -> tuple[list[FloorPlan], list[DerivedRoom]]:
    """Return the plans of the storeys that have rooms, and these rooms: storey by storey, from west to east.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        openings: doors and windows.
        rule: the thresholds.
        words: last words of names of rooms.
    """
    walls, floors = (np.flatnonzero(classes.are_in(name)[boxed.scene_index]) for name in ("room_walls", "grounds"))
    storeys = find_storeys(boxed, walls, floors, rule)
    if not storeys:
        return [], []
    plans: list[FloorPlan] = []
    rooms: list[DerivedRoom] = []
    for storey in storeys:
        plan = draw_walls(boxed, storey, openings, rule, rule.max_cells // len(storeys))
        named = _floor_names(boxed, storey, plan.grid, words)
        is_free = ~(plan.is_wall | plan.is_assumed)
        found = _rooms_between_walls(plan, is_free, named, rule)
        if not len(found.chosen):
            found = _rooms_on_floors(plan, is_free, named, rule)
        if len(found.chosen):
            plans.append(_number_rooms(storey, plan, found, len(rooms)))
            rooms += _describe(storey, plan, found, named)
    return plans, _with_unique_names(rooms)


class _FloorNames(NamedTuple):
    """The floors of a storey as cells."""

    name: Indices
    """(x, y): index of the name of the floor, 0 for floors without one, -1 without a floor."""
    names: list[str]


class _Areas(NamedTuple):
    """Connected areas of free floor, and those that are rooms."""

    areas: Indices
    chosen: Indices
    """From west to east, then from south to north."""
    is_outdoors: Mask
    rule: str


def _floor_names(boxed: BoxedObjects, storey: Storey, grid: PlanGrid, words: frozenset[str]) -> _FloorNames:
    names = [""]
    found = np.full(grid.shape, -1)
    for floor in storey.floors.tolist():
        name = _room_name(boxed.objects[floor].prim_path.rpartition("/")[2], words)
        if name not in names:
            names.append(name)
        cells, mask = _floor_cells(boxed, floor, grid)
        found[cells][mask] = names.index(name)
    return _FloorNames(found, names)


def _room_name(name: str, words: frozenset[str]) -> str:
    """Return the words of a name that mean a room; empty if there is none but `room`.

    >>> _room_name("Floor_LivingRoom_02", frozenset({"living", "room", "kitchen"}))
    'living room'
    """
    found = " ".join(word for word in words_of(name) if word in words)
    return "" if found in {"room", "rooms"} else found


def _floor_cells(boxed: BoxedObjects, floor: int, grid: PlanGrid) -> tuple[tuple[slice, slice], Mask]:
    """Return a window of the grid and its cells under the faces of a floor, else under its box."""
    surface = boxed.surfaces[floor]
    if surface is not None:
        faces = surface.corners[..., :2]
        window, cells = grid.window(faces.reshape(-1, 2))
        mask = np.zeros(window.shape, np.bool_)
        window.mark_triangles(mask, faces)
        return cells, mask
    some = slice(floor, floor + 1)
    middle, half, first = boxed.middle[some, :2], boxed.footprints.half_sides[some], boxed.footprints.direction[some]
    window, cells = grid.window(rectangle_corners(middle[0], half[0], first[0]))
    mask = np.zeros(window.shape, np.bool_)
    window.mark_rectangles(mask, middle, half, first)
    return cells, mask


def _rooms_between_walls(plan: WallPlan, is_free: Mask, named: _FloorNames, rule: RoomPlanRule) -> _Areas:
    """Return the areas of free floor that walls enclose; floors with different names are different rooms."""
    enclosed = connected_areas(np.where(is_free, 0, -1))
    is_outdoors = enclosed == enclosed[0, 0]
    kinds = np.where(is_free & ~is_outdoors, np.maximum(named.name, 0), -1)
    areas = connected_areas(kinds)
    return _Areas(areas, _large_areas(areas, plan.grid.cell, rule), is_outdoors, rule.rule)


def _rooms_on_floors(plan: WallPlan, is_free: Mask, named: _FloorNames, rule: RoomPlanRule) -> _Areas:
    """Return the separate floors if there are several, or if they have names of rooms."""
    areas = connected_areas(np.where(is_free, named.name, -1))
    chosen = _large_areas(areas, plan.grid.cell, rule)
    is_several = len(chosen) > 1 or bool((named.name > 0).any())
    return _Areas(areas, chosen[: None if is_several else 0], is_free & (areas < 0), rule.floor_rule)


def _large_areas(areas: Indices, cell: float, rule: RoomPlanRule) -> Indices:
    """Return the areas that are large enough for a room."""
    sizes = np.bincount(areas[areas >= 0])
    wide = holds_square(areas, max(int(rule.min_side / cell), 1))
    return np.asarray(wide[sizes[wide] * cell**2 >= rule.min_area])


def _number_rooms(storey: Storey, plan: WallPlan, found: _Areas, first: int) -> FloorPlan:
    number = np.full(int(found.areas.max(initial=-1)) + 2, -1)
    number[found.chosen] = first + np.arange(len(found.chosen))
    room = number[found.areas]
    return FloorPlan(storey, plan.grid, room, (room < 0) & ~found.is_outdoors)


def _describe(storey: Storey, plan: WallPlan, found: _Areas, named: _FloorNames) -> list[DerivedRoom]:
    """Return the chosen areas as rooms, each looked at in a window with a cell around it."""
    first, last = area_bounds(found.areas)
    rooms = []
    for area in found.chosen.tolist():
        corner = np.maximum(first[area] - 1, 0)
        window = tuple(slice(int(low), int(high) + 2) for low, high in zip(corner, last[area], strict=True))
        areas = found.areas[window]
        mask = areas == area
        names = np.bincount(np.maximum(named.name[window][mask], 0), minlength=len(named.names))
        loops = [plan.grid.world(loop + corner) for loop in outline_loops(mask)]
        # Cells around the room that are neither assumed to be closed nor in another room.
        around = with_neighbours(mask) & ~mask
        unsure = around & (plan.is_assumed[window] | (areas >= 0))
        rooms.append(
            DerivedRoom(
                name=named.names[int(names.argmax())],
                rule=found.rule,
                outline=tuple(tuple((float(a), float(b)) for a, b in loop) for loop in loops),
                area=float(mask.sum() * plan.grid.cell**2),
                height=storey.height,
                confidence=1.0 - float(unsure.sum() / max(around.sum(), 1)),
            )
        )
    return rooms


def _with_unique_names(rooms: list[DerivedRoom]) -> list[DerivedRoom]:
    """Return rooms with numbers after their names, except after a name that one room has."""
    totals = Counter(room.name for room in rooms)
    seen: Counter[str] = Counter()
    named = []
    for room in rooms:
        seen[room.name] += 1
        is_only = bool(room.name) and totals[room.name] == 1
        name = room.name if is_only else f"{room.name or 'room'} {seen[room.name]}"
        named.append(replace(room, name=name))
    return named
