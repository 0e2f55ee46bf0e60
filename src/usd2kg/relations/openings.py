"""Openings: the doors and windows of rooms."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.thresholds import RoomPlanRule

__all__ = ["find_openings"]

Indices = NDArray[np.int64]


def find_openings(boxed: BoxedObjects, classes: ClassMembership, rule: RoomPlanRule) -> Indices:
    """Return the doors and windows that are high and thin enough to be in a wall."""
    is_door, is_window = (classes.are_in(name)[boxed.scene_index] for name in ("doors", "windows"))
    height = boxed.size[:, 2]
    is_high = (is_door & (height >= rule.min_door_height)) | (is_window & (height >= rule.min_window_height))
    sides = 2 * boxed.footprints.half_sides if is_high.any() else boxed.size[:, :2]
    return np.flatnonzero(is_high & (sides.min(axis=1) <= np.minimum(rule.max_thickness, sides.max(axis=1) / 2)))
