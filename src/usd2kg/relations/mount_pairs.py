"""Pairs of an object and what may hold it, because the two are close."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import are_reached, concatenate_rows, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.distances import box_gaps, exact_distances, surface_distances
from usd2kg.relations.holding import Mounts
from usd2kg.relations.interlock import are_interlocked, held_at
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes import overlapping_pairs

__all__ = ["are_held_by_target", "find_near_pairs", "find_touching_pairs", "measured_exactly"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def find_near_pairs(
    boxed: BoxedObjects, targets: Indices, holders: Indices, is_mount: Mask, reach: Array, rule: AttachedRule
) -> Mounts:
    """Return the pairs of a target and something near, without their gaps.

    Args:
        boxed: the objects.
        targets: the objects that may hang.
        holders: the objects that may hold them.
        is_mount: whether each object is a wall or ceiling.
        reach: metres within which walls and ceilings hold each object.
        rule: the thresholds.
    """
    widest = np.maximum(reach, rule.max_contact)[:, None]
    lower, upper = boxed.lower - widest, boxed.upper + widest
    none, no = np.zeros(0, np.int64), np.zeros(0, np.bool_)
    found = [Mounts(none, none, np.zeros(0), np.zeros(0), no, no, no)]
    is_target = np.zeros(len(boxed), np.bool_)
    is_target[targets] = True
    others = boxed.lower[holders], boxed.upper[holders]
    for i, j in overlapping_pairs(lower[targets], upper[targets], others):
        target, anchor = targets[i], holders[j]
        gaps = box_gaps(boxed, target, anchor)
        # A valve at the upper end of a radiator is beside it.
        is_beside = (gaps[:, 2] < 0) & (gaps[:, :2] > 0).any(axis=1)
        hangs = (boxed.lower[anchor, 2] >= boxed.middle[target, 2]) & ~is_beside
        limit = np.where(is_mount[anchor], reach[target], rule.max_contact)
        is_near = (lower[target, 2] <= boxed.upper[anchor, 2]) & (upper[target, 2] >= boxed.lower[anchor, 2])
        locks = ~is_mount[anchor] & are_interlocked(boxed, target, anchor, rule.min_interlock)
        hung = held_at(boxed, target, anchor)
        locks &= hung > np.where(is_target[anchor], held_at(boxed, anchor, target) + rule.min_hold, -rule.min_hold)
        is_larger = boxed.volume[anchor] > boxed.volume[target]
        is_near &= (target != anchor) & (is_mount[anchor] | hangs | locks | is_larger)
        no = np.zeros(len(target), np.bool_)
        found.append(select_rows(Mounts(target, anchor, no.astype(np.float64), limit, hangs, locks, no), is_near))
    return concatenate_rows(found)


def find_touching_pairs(boxed: BoxedObjects, targets: Indices, holders: Indices, rule: AttachedRule) -> Mounts:
    """Return the pairs of different objects that touch, measured exactly, as if they interlocked."""
    none, no = np.zeros(0, np.int64), np.zeros(0, np.bool_)
    found = [Mounts(none, none, np.zeros(0), np.zeros(0), no, no, no)]
    lower, upper = boxed.lower - rule.max_contact, boxed.upper + rule.max_contact
    for i, j in overlapping_pairs(lower[targets], upper[targets], (boxed.lower[holders], boxed.upper[holders])):
        target, anchor = targets[i], holders[j]
        no = np.zeros(len(target), np.bool_)
        limit = np.full(len(target), rule.max_contact)
        pairs = Mounts(target, anchor, np.zeros(len(target)), limit, no, ~no, no)
        found.append(select_rows(pairs, target != anchor))
    pairs = concatenate_rows(found)
    gap = surface_distances(boxed, pairs.target, pairs.anchor, pairs.limit)
    pairs = select_rows(pairs._replace(gap=gap), gap <= pairs.limit)
    return measured_exactly(boxed, pairs, np.zeros(len(boxed), np.bool_))


def measured_exactly(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask) -> Mounts:
    """Return the pairs within their limits by the exact distance of their surfaces: oblique ones may only seem to meet.

    Walls and ceilings hold what is near, so that the boxes of their triangles will do.
    """
    some = np.flatnonzero(~is_mount[pairs.anchor] & (boxed.has_surface[pairs.target] | boxed.has_surface[pairs.anchor]))
    gap = pairs.gap.copy()
    exact = exact_distances(boxed, pairs.target[some], pairs.anchor[some], pairs.limit[some])
    gap[some] = np.where(exact > 0, np.maximum(exact, gap[some]), gap[some])
    return select_rows(pairs._replace(gap=gap), gap <= pairs.limit)


def are_held_by_target(boxed: BoxedObjects, pairs: Mounts, holder: Indices) -> Mask:
    """Return for each pair whether the anchor is nested below the target, or held by it by way of other objects."""
    paths = [obj.prim_path for obj in boxed.objects]
    ends = zip(pairs.target.tolist(), pairs.anchor.tolist(), strict=True)
    nested = [paths[anchor].startswith(f"{paths[target]}/") for target, anchor in ends]
    return are_reached(pairs.target, pairs.anchor, holder) | np.array(nested, np.bool_)
