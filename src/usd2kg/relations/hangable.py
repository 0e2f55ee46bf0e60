"""What may hang: objects without support above the ground."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes import overlapping_pairs

__all__ = ["are_loose_grounds", "find_hangable", "high_enough"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def find_hangable(
    boxed: BoxedObjects, classes: ClassMembership, stronger: StrongerRelations, rule: AttachedRule
) -> Indices:
    """Return the objects that are on, in and part of nothing so far, and too high above the ground to stand on it."""
    is_mount = classes.are_in("mounts")[boxed.scene_index]
    is_fixed = classes.are_in("not_attached") & ~classes.are_in("cases")
    may_hang = stronger.is_free & (is_mount | ~is_fixed[boxed.scene_index] | are_loose_grounds(boxed, classes, rule))
    return high_enough(boxed, classes, np.flatnonzero(may_hang), rule)


def are_loose_grounds(boxed: BoxedObjects, classes: ClassMembership, rule: AttachedRule) -> Mask:
    """Return for each object whether it is a floor by its class, but too small for one: a tile, a board for tiles."""
    return np.asarray(classes.are_in("grounds")[boxed.scene_index] & (boxed.size < rule.max_loose_floor).all(axis=1))


def high_enough(boxed: BoxedObjects, classes: ClassMembership, targets: Indices, rule: AttachedRule) -> Indices:
    """Return the targets that are too high above the ground to stand on it."""
    clearance = np.where(classes.are_in("standing")[boxed.scene_index], rule.max_plinth, rule.min_clearance)
    clearance[classes.are_in("hanging")[boxed.scene_index]] = 0.0
    return np.asarray(targets[boxed.lower[targets, 2] - _ground_below(boxed, targets, rule) >= clearance[targets]])


def _ground_below(boxed: BoxedObjects, targets: Indices, rule: AttachedRule) -> Array:
    """Return the lowest height of any object around each target, in metres: that of the floor or the foot of a wall.

    Large objects count if their box is within reach, small ones if their middle is in the same square or one beside it.
    """
    cell = rule.ground_reach
    lowest = boxed.lower[targets, 2].copy()
    is_large = boxed.size[:, :2].max(axis=1) > 2 * cell
    large, small = np.flatnonzero(is_large), np.flatnonzero(~is_large)
    lower, upper = boxed.lower[targets, :2] - cell, boxed.upper[targets, :2] + cell
    for i, j in overlapping_pairs(lower, upper, (boxed.lower[large, :2], boxed.upper[large, :2])):
        np.minimum.at(lowest, i, boxed.lower[large[j], 2])
    squares, which = np.unique(_squares(boxed, small, cell), axis=0, return_inverse=True)
    height = np.full(len(squares), np.inf)
    np.minimum.at(height, which.reshape(-1), boxed.lower[small, 2])
    known = dict(zip(map(tuple, squares.tolist()), height.tolist(), strict=True))
    for place, (x, y) in enumerate(_squares(boxed, targets, cell).tolist()):
        around = (known.get((x + dx, y + dy), np.inf) for dx in (-1, 0, 1) for dy in (-1, 0, 1))
        lowest[place] = min(lowest[place], *around)
    return np.asarray(lowest)


def _squares(boxed: BoxedObjects, chosen: Indices, side: float) -> Indices:
    return np.floor(boxed.middle[chosen, :2] / side).astype(np.int64)
