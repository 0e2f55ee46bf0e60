"""Storeys: the floor heights of a scene, from its floors and the feet of its walls."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.thresholds import RoomPlanRule

__all__ = ["Storey", "find_storeys"]

Indices = NDArray[np.int64]


class Storey(NamedTuple):
    """The height at which people walk, with the walls and floors there."""

    height: float
    """Metres, z."""
    top: float
    """Metres, z: the height of the next storey, else the top of the walls; infinite without walls."""
    walls: Indices
    """The objects that are walls and reach the height at which the plan is cut."""
    floors: Indices


def find_storeys(boxed: BoxedObjects, walls: Indices, floors: Indices, rule: RoomPlanRule) -> list[Storey]:
    """Return the storeys from the lowest to the highest, without those that have neither walls nor floors.

    Args:
        boxed: the objects.
        walls: indices of the walls.
        floors: indices of the floors.
        rule: the thresholds.
    """
    floors = floors[boxed.size[floors, :2].min(axis=1, initial=np.inf) >= rule.min_side]
    walls = walls[boxed.size[walls, 2] >= rule.cut_height]
    members = np.concatenate([floors, walls])
    heights = np.concatenate([boxed.upper[floors, 2], boxed.lower[walls, 2]])
    is_floor = np.arange(len(members)) < len(floors)
    order = np.argsort(heights, kind="stable")
    levels = []
    while len(order):
        is_here = heights[order] < heights[order[0]] + rule.min_storey
        here, order = order[is_here], order[~is_here]
        laid = here[is_floor[here]]
        # The largest floor is the level; a wall may start below it.
        levels.append(heights[laid[np.argmax(boxed.area[members[laid]])]] if len(laid) else heights[here[0]])
    ends = [*levels[1:], np.inf][: len(levels)]
    storeys = [_storey(boxed, walls, floors, float(a), float(b), rule) for a, b in zip(levels, ends, strict=True)]
    return [storey for storey in storeys if len(storey.walls) or len(storey.floors)]


def _storey(
    boxed: BoxedObjects, walls: Indices, floors: Indices, height: float, above: float, rule: RoomPlanRule
) -> Storey:
    cut = height + rule.cut_height
    here = walls[(boxed.lower[walls, 2] < cut) & (boxed.upper[walls, 2] > cut)]
    laid = floors[np.abs(boxed.upper[floors, 2] - height) < rule.min_storey / 2]
    top = float(boxed.upper[here, 2].max()) if len(here) else np.inf
    return Storey(height, min(top, above), here, laid)
