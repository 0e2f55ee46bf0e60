"""`on` links that may not hold: of what hangs beside, is stuck in or holds what seems to support it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.distances import surface_distances
from usd2kg.relations.hangable import find_hangable, high_enough
from usd2kg.relations.interlock import are_interlocked
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.mount_pairs import find_near_pairs
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import AttachedRule

__all__ = ["find_doubtful", "find_held_at_mounts", "find_held_beside_support", "find_stuck", "without_unheld"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def find_doubtful(
    boxed: BoxedObjects,
    classes: ClassMembership,
    stronger: StrongerRelations,
    support: Sequence[Links],
    rule: AttachedRule,
) -> Mask:
    """Return for each object whether what it is on may hang from it instead: a hanger on the coat that it carries.

    Nothing holds such a supporter so far. What hangs by its nature is on nothing for certain.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        stronger: the relations found so far.
        support: the `on` links found so far.
        rule: the thresholds.
    """
    dangles = np.zeros(len(boxed), np.bool_)
    dangles[find_hangable(boxed, classes, stronger, rule)] = True
    is_mount = classes.are_in("mounts")[boxed.scene_index]
    dangles &= ~is_mount
    hangs = classes.are_in("hanging")[boxed.scene_index]
    doubtful = np.zeros(len(boxed), np.bool_)
    while True:
        count = doubtful.sum()
        for links in support:
            is_hooked = are_interlocked(boxed, links.target, links.anchor, rule.min_interlock)
            is_hooked &= ~is_mount[links.target]
            leads = dangles[links.anchor] | (is_hooked & doubtful[links.anchor]) | hangs[links.target]
            # The plate at the ceiling carries the arms of the lamp on which it seems to stand.
            is_over = doubtful[links.anchor] & ~leads
            leads |= is_over & find_held_at_mounts(boxed, classes, links.target[is_over], rule)[links.target]
            doubtful[links.target[leads]] = True
        if doubtful.sum() == count:
            return doubtful


def without_unheld(
    boxed: BoxedObjects, classes: ClassMembership, frame: Indices, support: Sequence[Links], rule: AttachedRule
) -> list[Links]:
    """Return `on` links without those to what nothing holds, if something else supports the target: hooks of a shelf.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        frame: the whole or the container of each object, -1 for none.
        support: the `on` links found so far.
        rule: the thresholds.
    """
    is_held = frame >= 0
    for links in support:
        is_held[links.target] = True
    anchors = np.unique(np.concatenate([links.anchor for links in support]))
    dangles = np.zeros(len(boxed), np.bool_)
    dangles[high_enough(boxed, classes, anchors[~is_held[anchors]], rule)] = True
    is_firm = np.zeros(len(boxed), np.bool_)
    for links in support:
        is_firm[links.target[~dangles[links.anchor]]] = True
    return [links.where(~(dangles[links.anchor] & is_firm[links.target])) for links in support]


def find_stuck(boxed: BoxedObjects, classes: ClassMembership, on: Links, rule: AttachedRule) -> Mask:
    """Return for each object whether it is stuck in the side of what it is on: a screw hook in the edge of a table.

    It sinks in with all of its height and sticks out at a side. The ground has no side.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        on: the `on` links found so far, with one anchor each.
        rule: the thresholds.
    """
    is_sunk = -on.numbers["gap"] >= np.maximum(boxed.size[on.target, 2], rule.max_contact)
    is_sunk &= ~classes.are_in("grounds")[boxed.scene_index[on.anchor]]
    is_sunk &= ~classes.are_in("not_attached")[boxed.scene_index[on.target]]
    lower, upper = boxed.lower[on.anchor, :2], boxed.upper[on.anchor, :2]
    sticks_out = ((boxed.lower[on.target, :2] < lower) | (boxed.upper[on.target, :2] > upper)).any(axis=1)
    found = np.zeros(len(boxed), np.bool_)
    found[on.target[is_sunk & sticks_out]] = True
    return found


def find_held_at_mounts(boxed: BoxedObjects, classes: ClassMembership, targets: Indices, rule: AttachedRule) -> Mask:
    """Return for each object whether it is one of the targets, not near the ground, and at a wall or ceiling."""
    is_mount = classes.are_in("mounts")[boxed.scene_index] & ~classes.are_in("not_mounts")[boxed.scene_index]
    hanging = high_enough(boxed, classes, targets[~is_mount[targets]], rule)
    reach = np.where(is_mount, 0.0, rule.max_contact)
    pairs = find_near_pairs(boxed, hanging, np.flatnonzero(is_mount), is_mount, reach, rule)
    gap = surface_distances(boxed, pairs.target, pairs.anchor, pairs.limit)
    found = np.zeros(len(boxed), np.bool_)
    found[pairs.target[gap <= rule.max_contact]] = True
    return found


def find_held_beside_support(
    boxed: BoxedObjects, classes: ClassMembership, on: Links, attached: Links, rule: AttachedRule
) -> Links:
    """Return the `attached-to` links of objects that a wall or ceiling holds rather than the object below.

    These objects overhang a supporter that hangs itself, and are as near as it to the wall or ceiling that holds it: a
    wall cupboard that meets a cooker hood hangs beside it, but a book lies on a wall shelf.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        on: the `on` links found so far, with one anchor each.
        attached: the `attached-to` links found so far.
        rule: the thresholds.
    """
    mount = np.full(len(boxed), -1)
    is_mount = classes.are_in("mounts")[boxed.scene_index[attached.anchor]]
    mount[attached.target[is_mount]] = attached.anchor[is_mount]
    some = np.flatnonzero((on.numbers["overlapRatio"] < rule.min_borne) & (mount[on.anchor] >= 0))
    target, anchor = on.target[some], mount[on.anchor[some]]
    limit = np.full(len(some), rule.max_gap)
    gap = surface_distances(boxed, target, anchor, limit)
    confidence = margin_score(margin_below(np.clip(gap, 0, None), limit))
    return Links("attached-to", rule.rule, target, anchor, {"gap": gap}, confidence).where(gap <= limit)
