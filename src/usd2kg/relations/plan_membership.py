"""`room` where no prim is a room: the room of the floor plan that most of an object's footprint is in."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.derived_room import DerivedRoom
from usd2kg.relations.floor_plan import FloorPlan
from usd2kg.relations.model import Links, margin_above, margin_score
from usd2kg.relations.row_modes import row_modes
from usd2kg.relations.thresholds import RoomPlanRule

__all__ = ["find_plan_members"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def find_plan_members(
    boxed: BoxedObjects,
    plans: Sequence[FloorPlan],
    rooms: Sequence[DerivedRoom],
    placed: Indices,
    rule: RoomPlanRule,
) -> list[Links]:
    """Return the `room` links of the placed objects, a record per rule; anchors are len(boxed) + number of the room."""
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))]
    for plan in plans:
        middle = boxed.middle[placed, 2]
        here = placed[(middle >= plan.storey.height - rule.cell) & (middle < plan.storey.top)]
        found.append(_members(boxed, plan, here, rule))
    target, room, share = (np.concatenate(column) for column in zip(*found, strict=True))
    links = []
    for rule_id in dict.fromkeys(room.rule for room in rooms):
        by_rule = np.array([known.rule == rule_id for known in rooms], np.bool_)[room]
        clear = margin_score(margin_above(share[by_rule], rule.min_share))
        numbers = {"insideRatio": share[by_rule]}
        links.append(Links("room", rule_id, target[by_rule], len(boxed) + room[by_rule], numbers, clear))
    return links


def _members(boxed: BoxedObjects, plan: FloorPlan, here: Indices, rule: RoomPlanRule) -> tuple[Indices, Indices, Array]:
    """Return targets, rooms and shares of the footprint; walls do not count, so that what hangs there is in a room."""
    room, is_wall = _look_up(boxed, plan, here, rule.samples, 0.0)
    buried = np.flatnonzero(is_wall.all(axis=1))
    room[buried], _ = _look_up(boxed, plan, here[buried], rule.samples, rule.reach)
    in_plan = room >= 0
    most, count = row_modes(room, 0)
    known = in_plan.any(axis=1)
    outdoors = (~in_plan & ~is_wall).sum(axis=1)
    share = count / np.maximum(in_plan.sum(axis=1) + outdoors, 1)
    known &= share >= rule.min_share
    return here[known], most[known], share[known]


def _look_up(
    boxed: BoxedObjects, plan: FloorPlan, which: Indices, samples: int, reach: float
) -> tuple[Indices, NDArray[np.bool_]]:
    """Return the rooms of points in footprints, longer by `reach` at each end, and whether they are in walls."""
    points = _footprint_points(boxed, which, samples, reach)
    x, y = plan.grid.cells_of(points.reshape(-1, 2)).T
    return plan.room[x, y].reshape(points.shape[:2]), plan.is_wall[x, y].reshape(points.shape[:2])


def _footprint_points(boxed: BoxedObjects, which: Indices, count: int, reach: float = 0.0) -> Array:
    """Return count × count points (n, count², 2) in the footprints of objects, off their sides.

    Args:
        boxed: the objects.
        which: their indices.
        count: points along each side.
        reach: metres by which the footprints are longer at each end.
    """
    half, first = boxed.footprints.half_sides[which] + reach, boxed.footprints.direction[which]
    second = np.stack([-first[:, 1], first[:, 0]], axis=1)
    steps = (np.arange(count) + 0.5) / count * 2 - 1
    u, v = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    offset = u[:, None] * (half[:, :1] * first)[:, None] + v[:, None] * (half[:, 1:] * second)[:, None]
    return np.asarray(boxed.middle[which, None, :2] + offset)
