"""Holding: pairs of an object and what may hold it, and which of the two carries the other."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.holding_paths import HoldingPaths, find_holding_paths
from usd2kg.relations.interlock import are_interlocked
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes.ragged import ragged_indices

__all__ = ["Mounts", "are_carried_by_target", "are_closer_to_mounts", "are_farther_than_holder", "lead_to_mounts"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Mounts(NamedTuple):
    """Pairs of an object without support and one that may hold it."""

    target: Indices
    anchor: Indices
    gap: Array
    limit: Array
    """Largest gap, metres."""
    hangs: Mask
    """Whether the anchor is above the middle of the target."""
    locks: Mask
    """Whether the anchor goes through the target, which hangs from it rather than the other way round."""
    rests: Mask
    """Whether the target rests on the anchor, if nothing else holds it."""


def _paths(pairs: Mounts, is_free: Mask, is_mount: Mask, rule: AttachedRule) -> HoldingPaths:
    some = select_rows(pairs, is_mount[pairs.anchor] | (pairs.gap <= rule.max_contact))
    return find_holding_paths(some.target, some.anchor, some.gap, is_free)


def lead_to_mounts(pairs: Mounts, is_free: Mask, is_mount: Mask, rule: AttachedRule) -> Mask:
    """Return for each pair whether the target touches the anchor, which is held without it."""
    paths = _paths(pairs, is_free, is_mount, rule)
    leads = (pairs.gap <= rule.max_touch) & np.isfinite(paths.length[pairs.anchor])
    return np.asarray(leads & ~paths.lead_through(pairs.anchor, pairs.target))


def are_carried_by_target(pairs: Mounts, is_free: Mask, is_mount: Mask, rule: AttachedRule) -> Mask:
    """Return for each pair whether it is the target that carries the anchor: a pegboard its hooks.

    The target is held by the building, and the anchor only by way of the target, or less closely by the maximum of a
    contact.
    """
    paths = _paths(pairs, is_free, is_mount, rule)
    carried = ~is_mount[pairs.anchor] & is_free[pairs.anchor] & paths.lead_through(pairs.anchor, pairs.target)
    some = np.flatnonzero(carried)
    detour = _detours(pairs, paths, pairs.anchor[some], pairs.target[some])
    carried[some] = detour - paths.length[pairs.target[some]] >= rule.max_contact
    return np.asarray(carried)


def are_closer_to_mounts(pairs: Mounts, is_free: Mask, is_mount: Mask, rule: AttachedRule) -> Mask:
    """Return for each pair whether the target touches a wall or ceiling, but the anchor does not: a board its magnet.

    The anchor may touch it by way of what it hangs from, as a hanger does.
    """
    touches = is_mount[pairs.anchor] & (pairs.gap <= rule.max_touch)
    is_at_mount = np.zeros(len(is_free), np.bool_)
    is_at_mount[pairs.target[touches]] = True
    some = np.flatnonzero(is_at_mount[pairs.target] & is_free[pairs.anchor] & ~is_at_mount[pairs.anchor])
    paths = _paths(pairs, is_free, is_mount, rule)
    closer = np.zeros(len(pairs.target), np.bool_)
    closer[some] = _detours(pairs, paths, pairs.anchor[some], pairs.target[some]) > rule.max_contact
    return closer


def _detours(pairs: Mounts, paths: HoldingPaths, start: Indices, other: Indices) -> Array:
    """Return how far it is in metres from each start to what is held, without passing the other object; else inf."""
    order = np.argsort(pairs.target, kind="stable")
    begin, end = (np.searchsorted(pairs.target[order], start, side) for side in ("left", "right"))
    row, nth = ragged_indices(end - begin)
    step = order[begin[row] + nth]
    passes = (pairs.anchor[step] == other[row]) | paths.lead_through(pairs.anchor[step], other[row])
    length = np.clip(pairs.gap[step], 0, None) + paths.length[pairs.anchor[step]]
    found = np.full(len(start), np.inf)
    np.minimum.at(found, row, np.where(passes, np.inf, length))
    return found


def are_farther_than_holder(
    boxed: BoxedObjects, pairs: Mounts, is_free: Mask, is_mount: Mask, hangs: Mask, rule: AttachedRule
) -> Mask:
    """Return for each pair whether the anchor is a wall or ceiling to which another anchor of the target is closer.

    The other one touches the target: a board its hook. One that rests only counts if the two interlock, or if the wall
    is hardly within reach: a wall cupboard beside a fridge hangs at the wall. One that is much larger need not be that
    close: a valve is a fitting of its radiator.
    """
    locks = are_interlocked(boxed, pairs.target, pairs.anchor, rule.min_interlock) & (pairs.gap <= rule.max_touch)
    is_close = is_mount[pairs.anchor] | is_free[pairs.anchor] | locks
    paths = _paths(select_rows(pairs, is_close), is_free, is_mount, rule)
    touches = ~is_mount[pairs.anchor] & (pairs.gap <= rule.max_contact) & ~hangs[pairs.target]
    touches &= ~paths.lead_through(pairs.anchor, pairs.target)
    length = np.clip(pairs.gap, 0, None) + paths.length[pairs.anchor]
    near, far = np.full(len(boxed), np.inf), np.full(len(boxed), np.inf)
    counts = touches & (is_free[pairs.anchor] | locks)
    np.minimum.at(near, pairs.target[counts], length[counts])
    np.minimum.at(far, pairs.target[touches], length[touches])
    is_fitting = touches & is_free[pairs.anchor] & (pairs.gap <= rule.max_touch)
    is_fitting &= boxed.volume[pairs.anchor] >= rule.min_bearing_ratio * boxed.volume[pairs.target]
    carrier = np.full(len(boxed), np.inf)
    np.minimum.at(carrier, pairs.target[is_fitting], paths.length[pairs.anchor[is_fitting]])
    is_weak = pairs.gap >= rule.min_weak_share * pairs.limit
    nearest = np.where(is_weak, far[pairs.target], near[pairs.target])
    is_apart = is_mount[pairs.anchor] & (pairs.gap > rule.max_contact)
    is_farther = (nearest + rule.max_contact <= pairs.gap) | (carrier[pairs.target] <= pairs.gap)
    return np.asarray(is_apart & is_farther)
