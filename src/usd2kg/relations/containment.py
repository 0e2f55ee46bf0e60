"""`inside`: what a thing is in, enclosed by it or standing in it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.columns import closes_a_circle, first_of_each, joined, taken
from usd2kg.relations.model import Links, clearness, share_above
from usd2kg.relations.objects import Bodies, Classes, corners_of, overlap_areas
from usd2kg.relations.thresholds import Inside, Rules, StandingIn
from usd2kg.shapes import overlapping_pairs

__all__ = ["Containment", "find_containment"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Containment(NamedTuple):
    """What is inside what."""

    links: list[Links]
    container: Indices
    """For each body the one it is inside of, -1 for none."""


class _Found(NamedTuple):
    """Pairs of a target and what may contain it."""

    target: Indices
    anchor: Indices
    ratio: Array
    confidence: Array
    sticks_out: Mask


def find_containment(bodies: Bodies, classes: Classes, wholes: Indices, rules: Rules) -> Containment:
    """Return what is inside what: each thing in one container at most, the smallest that encloses it or it stands in.

    A container is a thing whose class can hold others: a chair under a table is in the table's box, and no more. What
    has drawers holds them, whatever its class.

    Args:
        bodies: the objects.
        classes: what their classes allow.
        wholes: for each body the one that it is a part of, -1 for none.
        rules: the thresholds.
    """
    can_contain = classes.can_contain[bodies.number]
    is_drawer = classes.are_in("not_laid")[bodies.number]
    may_be_in = ~(classes.are_in("not_placed") | classes.are_in("not_contained"))[bodies.number]
    has_parts = bool((wholes >= 0).any())
    is_open = can_contain & ~classes.are_in("closed")[bodies.number]
    found = [_no_pairs()]
    for i, j in overlapping_pairs(bodies.lower[:, :2], bodies.upper[:, :2]):
        for target, anchor in ((i, j), (j, i)):
            may = may_be_in[target] & can_contain[anchor]
            if has_parts:
                may |= may_be_in[target] & is_drawer[target] & (wholes[target] == anchor)
                may &= ~_run_in_each_other(target, anchor, wholes, is_drawer)
            may &= _begins_within(bodies, target, anchor)
            found.append(_enclosed(bodies, target[may], anchor[may], rules.inside))
            may &= is_open[anchor]
            found.append(_standing(bodies, target[may], anchor[may], rules.standing_in))
    pairs = joined(found)
    return _smallest(bodies, taken(pairs, ~_are_on_top(bodies, pairs, ~is_open, rules)), rules)


def _no_pairs() -> _Found:
    nothing, no_number = np.zeros(0, np.int64), np.zeros(0)
    return _Found(nothing, nothing, no_number, no_number, np.zeros(0, np.bool_))


def _run_in_each_other(target: Indices, anchor: Indices, wholes: Indices, is_drawer: Mask) -> Mask:
    """Return where boxes overlap as parts do: a cabinet in its drawer, a drawer behind the tall front of another."""
    are_beside = is_drawer[target] & is_drawer[anchor] & (wholes[target] >= 0) & (wholes[target] == wholes[anchor])
    return np.asarray((wholes[anchor] == target) | are_beside)


def _begins_within(bodies: Bodies, target: Indices, anchor: Indices) -> Mask:
    return np.asarray(
        (bodies.lower[target, 2] < bodies.upper[anchor, 2]) & (bodies.upper[target, 2] > bodies.lower[anchor, 2])
    )


def _shares(bodies: Bodies, target: Indices, anchor: Indices) -> Array:
    """Return which share of the target's extent along each axis lies in the anchor's box (n, 3)."""
    low = np.maximum(bodies.lower[target], bodies.lower[anchor])
    high = np.minimum(bodies.upper[target], bodies.upper[anchor])
    size = bodies.size[target]
    # Along an axis in which it is flat a thing is in there or not, so that a napkin can lie in a drawer.
    share = np.where(size > 0, np.clip(high - low, 0, None) / np.where(size > 0, size, 1.0), high >= low)
    return np.asarray(share, np.float64)


def _enclosed(bodies: Bodies, target: Indices, anchor: Indices, rule: Inside) -> _Found:
    ratio = np.minimum(_shares(bodies, target, anchor).prod(axis=1), 1.0)
    middle = bodies.middle[target]
    is_good = (
        (ratio >= rule.min_volume_ratio)
        & (bodies.volume[target] < bodies.volume[anchor])
        & ((middle >= bodies.lower[anchor]) & (middle <= bodies.upper[anchor])).all(axis=1)
    )
    clear = clearness(share_above(ratio, rule.min_volume_ratio))
    return taken(_Found(target, anchor, ratio, clear, np.zeros(len(target), np.bool_)), is_good)


def _standing(bodies: Bodies, target: Indices, anchor: Indices, rule: StandingIn) -> _Found:
    shares = _shares(bodies, target, anchor)
    over, depth = shares[:, 0] * shares[:, 1], shares[:, 2]
    above_floor = bodies.lower[target, 2] - bodies.lower[anchor, 2]
    least = np.where(above_floor > rule.same_level, rule.min_overlap_ratio, rule.min_level_overlap_ratio)
    is_good = (
        (bodies.upper[target, 2] > bodies.upper[anchor, 2])
        & (above_floor >= -rule.same_level)
        & (depth >= rule.min_depth_share)
        & (over >= least)
        & (bodies.area[target] <= rule.max_area_ratio * bodies.area[anchor])
    )
    clear = clearness(share_above(over, least), share_above(depth, rule.min_depth_share))
    return taken(_Found(target, anchor, over * depth, clear, np.ones(len(target), np.bool_)), is_good)


def _are_on_top(bodies: Bodies, pairs: _Found, is_closed: Mask, rules: Rules) -> Mask:
    """Return for each pair whether the target stands on top of the anchor, and is not in it.

    It does on the highest broad level, high up: a worktop with an upstand is lower than its box, and what stands on it
    is not inside the unit. And it does beside the top of something closed: on the ledge of a sideboard.
    """
    over = np.full(len(pairs.target), -np.inf)
    top = np.full(len(pairs.target), -np.inf)
    has_levels = np.array([bool(obj.support_levels) for obj in bodies.objects], np.bool_)
    for pair in np.flatnonzero(has_levels[pairs.anchor]).tolist():
        target, anchor = pairs.target[pair], pairs.anchor[pair]
        lower, upper = corners_of(bodies.objects[anchor].support_levels)
        shared = overlap_areas(bodies.lower[[target]], bodies.upper[[target]], lower, upper)
        is_over = shared > rules.on.min_overlap_ratio * bodies.area[target]
        over[pair], top[pair] = max(upper[is_over, 2], default=-np.inf), upper[:, 2].max()
    stands = bodies.lower[pairs.target, 2] > over - rules.on.max_sink
    highest = np.where(is_closed[pairs.anchor], top, over)
    share = (highest - bodies.lower[pairs.anchor, 2]) / np.maximum(bodies.size[pairs.anchor, 2], 1e-12)
    return np.asarray(stands & (share > rules.inside.max_floor_share))


def _smallest(bodies: Bodies, pairs: _Found, rules: Rules) -> Containment:
    keys = (bodies.rank[pairs.anchor], pairs.sticks_out, bodies.volume[pairs.anchor])
    best = first_of_each(pairs.target, keys)
    is_round = closes_a_circle(_pointers(bodies, pairs, best), pairs.target[best])
    best = best[~is_round]
    links = []
    for sticks_out, rule in ((False, rules.inside.rule), (True, rules.standing_in.rule)):
        chosen = best[pairs.sticks_out[best] == sticks_out]
        numbers = {"insideRatio": pairs.ratio[chosen]}
        target, anchor = pairs.target[chosen], pairs.anchor[chosen]
        links.append(Links("inside", rule, target, anchor, numbers, pairs.confidence[chosen]))
    return Containment(links, _pointers(bodies, pairs, best))


def _pointers(bodies: Bodies, pairs: _Found, chosen: Indices) -> Indices:
    pointers = np.full(len(bodies), -1)
    pointers[pairs.target[chosen]] = pairs.anchor[chosen]
    return pointers
