"""Pairs of an object and something near that does not hold it."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import select_rows
from usd2kg.relations.backing import are_between
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.distances import box_gaps
from usd2kg.relations.holding import Mounts
from usd2kg.relations.interlock import are_interlocked, are_over
from usd2kg.relations.mount_pairs import find_touching_pairs
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes.ragged import ragged_indices

__all__ = ["are_backed", "are_rooted_elsewhere", "hover_below", "lie_on_much_larger", "meet_below_middle"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def meet_below_middle(boxed: BoxedObjects, pairs: Mounts, rule: AttachedRule) -> Mask:
    """Return for each pair whether two upright faces meet, all below the middle of the target, which would tip over."""
    gaps = box_gaps(boxed, pairs.target, pairs.anchor)
    meet = (gaps[:, :2].max(axis=1) >= -rule.max_contact) & (gaps[:, 2] < 0)
    return np.asarray(meet & (boxed.upper[pairs.anchor, 2] < boxed.middle[pairs.target, 2]))


def lie_on_much_larger(boxed: BoxedObjects, pairs: Mounts, rule: AttachedRule) -> Mask:
    """Return for each pair whether the target lies flat on a much larger anchor, within its face, as a panel on a wall.

    A partition meets its wall at an edge, and a lintel is within the thickness of its wall.
    """
    lower, upper = boxed.lower[pairs.target], boxed.upper[pairs.target]
    past = np.maximum(boxed.lower[pairs.anchor] - lower, upper - boxed.upper[pairs.anchor])
    middle = boxed.middle[pairs.target]
    is_off = (middle < boxed.lower[pairs.anchor]) | (middle > boxed.upper[pairs.anchor])
    is_thin = np.arange(past.shape[1]) == boxed.size[pairs.target].argmin(axis=1)[:, None]
    is_flat = np.where(is_thin, is_off, past <= rule.max_contact).all(axis=1)
    is_larger = boxed.volume[pairs.anchor] >= rule.min_bearing_ratio * boxed.volume[pairs.target]
    return np.asarray(is_flat & is_larger)


def are_backed(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask, rule: AttachedRule) -> Mask:
    """Return for each pair whether the anchor is a wall in front of which there is another anchor of the target."""
    is_apart = is_mount[pairs.anchor] & (pairs.gap > rule.max_contact)
    walls, others = np.flatnonzero(is_apart), np.flatnonzero(~is_mount[pairs.anchor])
    others = others[np.argsort(pairs.target[others], kind="stable")]
    begin, end = (np.searchsorted(pairs.target[others], pairs.target[walls], side) for side in ("left", "right"))
    row, nth = ragged_indices(end - begin)
    wall, other = walls[row], others[begin[row] + nth]
    is_behind = are_between(boxed, pairs.anchor[other], pairs.target[wall], pairs.anchor[wall], rule.min_backed)
    backed = np.zeros(len(pairs.target), np.bool_)
    backed[wall[is_behind]] = True
    return backed


def are_rooted_elsewhere(
    boxed: BoxedObjects, pairs: Mounts, holders: Indices, is_mount: Mask, hangs: Mask, rule: AttachedRule
) -> Mask:
    """Return for each pair whether the anchor is a wall apart from the target, which something else holds below.

    The target goes into something that is smaller, or the wall is hardly within reach and it only touches it: a plant
    in its soil, a lamp shade on its foot.
    """
    is_apart = is_mount[pairs.anchor] & (pairs.gap > rule.max_contact) & ~hangs[pairs.target]
    below = find_touching_pairs(boxed, np.unique(pairs.target[is_apart]), holders[~is_mount[holders]], rule)
    below = select_rows(below, boxed.upper[below.anchor, 2] <= boxed.middle[below.target, 2])
    below = select_rows(below, are_over(boxed, below.target, below.anchor))
    is_rooted, is_touched = np.zeros(len(boxed), np.bool_), np.zeros(len(boxed), np.bool_)
    enters = are_interlocked(boxed, below.target, below.anchor, rule.min_interlock) & (below.gap <= rule.max_touch)
    is_rooted[below.target[enters]] = True
    is_touched[below.target] = True
    is_weak = pairs.gap >= rule.min_weak_share * pairs.limit
    return np.asarray(is_apart & (is_rooted[pairs.target] | (is_weak & is_touched[pairs.target])))


def hover_below(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask, hangs: Mask, rule: AttachedRule) -> Mask:
    """Return for each pair whether the anchor is above the target without touching it, and another one is nearer.

    The door of a base cabinet is not hung from the worktop.
    """
    is_beside = ~pairs.hangs & ~is_mount[pairs.anchor]
    nearest = np.full(len(boxed), np.inf)
    np.minimum.at(nearest, pairs.target[is_beside], pairs.gap[is_beside])
    hovers = pairs.hangs & ~is_mount[pairs.anchor] & ~hangs[pairs.target] & (pairs.gap > rule.max_touch)
    return np.asarray(hovers & (nearest[pairs.target] < pairs.gap))
