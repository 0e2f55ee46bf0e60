"""`connects`: a door or window and the rooms on its two sides."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.floor_plan import FloorPlan
from usd2kg.relations.model import Links, margin_above, margin_score
from usd2kg.relations.row_modes import row_modes
from usd2kg.relations.thresholds import ConnectsRule
from usd2kg.shapes import overlapping_pairs

__all__ = ["OUTSIDE", "UNKNOWN", "find_connections", "locate_in_boxes", "locate_in_plans", "openings_in_walls"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

OUTSIDE = -1
"""No room: outdoors."""
UNKNOWN = -2
"""Within a wall."""

Locate = Callable[[Array], Indices]
"""From points (n, 3) in metres, world frame, to the numbers of their rooms, `OUTSIDE` or `UNKNOWN`."""


class _Sides(NamedTuple):
    """What is most frequent on one side of each opening."""

    room: Indices
    share: Array
    """Share of the points beside the opening, without those in walls, that are there."""


def find_connections(boxed: BoxedObjects, openings: Indices, locate: Locate, rule: ConnectsRule) -> Links:
    """Return `connects` from openings to the rooms on both sides, or to one room if the other side is outside.

    An opening with the same room on both sides connects nothing: it stands open, or belongs to a cupboard.
    """
    one, other = (_look_beside(boxed, openings, sign, locate, rule) for sign in (-1.0, 1.0))
    known = (one.room > UNKNOWN) & (other.room > UNKNOWN) & (one.room != other.room)
    known &= np.minimum(one.share, other.share) > rule.min_share
    found = [(side.room >= 0) & known for side in (one, other)]
    share = np.concatenate([side.share[is_room] for side, is_room in zip((one, other), found, strict=True)])
    return Links(
        "connects",
        rule.rule,
        np.concatenate([openings[is_room] for is_room in found]),
        np.concatenate([side.room[is_room] for side, is_room in zip((one, other), found, strict=True)]),
        {"insideRatio": share},
        margin_score(margin_above(share, rule.min_share)),
    )


def _look_beside(boxed: BoxedObjects, openings: Indices, sign: float, locate: Locate, rule: ConnectsRule) -> _Sides:
    half, first = boxed.footprints.half_sides[openings], boxed.footprints.direction[openings]
    second = np.stack([-first[:, 1], first[:, 0]], axis=1)
    is_first_long = (half[:, 0] >= half[:, 1])[:, None]
    along = np.where(is_first_long, first, second) * half.max(axis=1)[:, None]
    across = np.where(is_first_long, second, first)
    # Off the jambs, which stand in the wall.
    widths = np.linspace(-0.6, 0.6, rule.samples)
    depths = np.linspace(0, rule.reach, rule.samples + 1)[1:]
    u, v = (grid.ravel()[None, :, None] for grid in np.meshgrid(widths, depths))
    offset = u * along[:, None] + sign * (v + half.min(axis=1)[:, None, None]) * across[:, None]
    points = np.repeat(boxed.middle[openings, None], offset.shape[1], axis=1)
    points[..., :2] += offset
    room = locate(points.reshape(-1, 3)).reshape(offset.shape[:2])
    most, count = row_modes(room, UNKNOWN + 1)
    is_known = (room > UNKNOWN).sum(axis=1)
    return _Sides(np.where(count > 0, most, UNKNOWN), count / np.maximum(is_known, 1))


def locate_in_plans(plans: Sequence[FloorPlan], first: int) -> Locate:
    """Return how to find the rooms of floor plans; room i has the number `first` + i."""

    def locate(points: Array) -> Indices:
        found = np.full(len(points), OUTSIDE)
        for plan in plans:
            here = np.flatnonzero((points[:, 2] >= plan.storey.height) & (points[:, 2] < plan.storey.top))
            x, y = plan.grid.cells_of(points[here, :2]).T
            room = plan.room[x, y]
            found[here] = np.where(room >= 0, room + first, np.where(plan.is_wall[x, y], UNKNOWN, OUTSIDE))
        return found

    return locate


def locate_in_boxes(number: Indices, lower: Array, upper: Array) -> Locate:
    """Return how to find the smallest of boxes with numbers, lower corners (n, 3) and upper corners (n, 3)."""
    largest_first = np.argsort(-(upper - lower).prod(axis=1), kind="stable")
    rank = np.empty_like(largest_first)
    rank[largest_first] = np.arange(len(rank))

    def locate(points: Array) -> Indices:
        best = np.full(len(points), -1)
        for point, box in overlapping_pairs(points, points, (lower, upper)):
            np.maximum.at(best, point, rank[box])
        return np.where(best >= 0, number[largest_first[best]], OUTSIDE)

    return locate


def openings_in_walls(boxed: BoxedObjects, openings: Indices, walls: Indices, rule: ConnectsRule) -> Indices:
    """Return the openings that are within reach of a wall; a cupboard has doors as well."""
    starts, lower, upper = boxed.parts
    part = np.concatenate([np.arange(starts[wall], starts[wall + 1]) for wall in walls.tolist()] or [walls])
    low, high = boxed.lower[openings] - rule.max_gap, boxed.upper[openings] + rule.max_gap
    is_near = np.zeros(len(openings), np.bool_)
    for i, j in overlapping_pairs(low[:, :2], high[:, :2], (lower[part, :2], upper[part, :2])):
        is_near[i[(low[i, 2] <= upper[part[j], 2]) & (high[i, 2] >= lower[part[j], 2])]] = True
    return np.asarray(openings[is_near])
