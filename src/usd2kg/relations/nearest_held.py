"""Of all that may hold an object, what does."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import first_of_each_group, rounded, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.holding import Mounts
from usd2kg.relations.thresholds import AttachedRule

__all__ = ["are_beside_unheld", "find_nearest_held"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_NO_MOUNT = 1.0
"""Metres added to the gap of an object beside the target, so that every wall, ceiling or object above is nearer."""
_HOOKED = -1.0
"""The same for an object that the target hangs from by a hook or a loop: nothing is nearer…"""
_RESTING = -2.0
"""…but what the target rests on."""


def find_nearest_held(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask, rule: AttachedRule) -> Mounts:
    """Return the best anchor of each target, from what is held to what hangs from it.

    What the target hangs from by a hook comes before the wall behind, at least if that does not touch the target. A
    wall or ceiling takes precedence over an object beside the target, and over one above that is hardly nearer.
    """
    pending = np.zeros(len(boxed), np.bool_)
    pending[pairs.target] = True
    penalty = np.where(pairs.hangs, rule.mount_preference, _NO_MOUNT)
    distance = np.clip(pairs.gap, 0, None) + np.where(is_mount[pairs.anchor], 0.0, penalty)
    distance = np.where(pairs.locks, np.where(pairs.hangs, _HOOKED, rule.max_touch), distance)
    distance[pairs.rests] = _RESTING
    chosen = [np.zeros(0, np.int64)]
    while True:
        first = _best(boxed, pairs, np.flatnonzero(pending[pairs.target]), distance)
        best = first[~pending[pairs.anchor[first]]]
        if not len(best):
            # The rest hang from each other; begin with those that something else holds more closely than their best.
            is_held = pending[pairs.target] & ~pending[pairs.anchor]
            best = _best(boxed, pairs, np.flatnonzero(is_held), distance)
            closer = _held_more_closely(boxed, pairs, first, best, distance, rule.max_touch)
            best = closer if len(closer) else best
            touching = best[distance[best] <= rule.max_contact]
            best = touching if len(touching) else best
        if not len(best):
            break
        chosen.append(best)
        pending[pairs.target[best]] = False
    return select_rows(pairs, np.sort(np.concatenate(chosen)))


def _held_more_closely(
    boxed: BoxedObjects, pairs: Mounts, first: Indices, held: Indices, distance: Array, margin: float
) -> Indices:
    """Return the pairs of `held` whose targets are closer to what is held than their best anchor, of `first`, is.

    Within the margin, what hangs on a hook waits for the hook.
    """
    nearest, slack = np.full(len(boxed), np.inf), np.full(len(boxed), margin)
    nearest[pairs.target[held]] = distance[held]
    desired = np.full(len(boxed), -1)
    desired[pairs.target[first]] = pairs.anchor[first]
    slack[pairs.target[first[pairs.locks[first]]]] = -margin
    target = pairs.target[held]
    return np.asarray(held[distance[held] <= nearest[desired[target]] + slack[target]])


def _best(boxed: BoxedObjects, pairs: Mounts, some: Indices, distance: Array) -> Indices:
    keys = (boxed.rank[pairs.anchor[some]], rounded(distance[some]))
    return np.asarray(some[first_of_each_group(pairs.target[some], keys)])


def are_beside_unheld(boxed: BoxedObjects, pairs: Mounts, targets: Indices, is_mount: Mask, rule: AttachedRule) -> Mask:
    """Return for each pair whether the target is beside an object that nothing holds and that is not much larger.

    Neither of two wall cupboards holds the other if their wall is not drawn.

    Args:
        boxed: the objects.
        pairs: the best pair of each target.
        targets: the objects that neither stand nor are on, in or part of anything.
        is_mount: whether each object is a wall or ceiling.
        rule: the thresholds.
    """
    is_unheld = np.zeros(len(boxed), np.bool_)
    is_unheld[targets] = True
    is_unheld[is_mount] = False
    is_unheld[pairs.target] = False
    is_comparable = boxed.volume[pairs.anchor] < rule.min_bearing_ratio * boxed.volume[pairs.target]
    may_drop = ~(pairs.hangs | pairs.locks) & ~is_mount[pairs.anchor] & is_comparable
    dropped = np.zeros(len(pairs.target), np.bool_)
    while (more := may_drop & ~dropped & is_unheld[pairs.anchor]).any():
        dropped |= more
        is_unheld[pairs.target[more]] = True
    return dropped
