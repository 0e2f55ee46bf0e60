"""`on`: what a thing stands or lies on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.columns import closes_a_circle, first_of_each, joined, taken
from usd2kg.relations.model import Links, clearness, share_above, share_below
from usd2kg.relations.objects import Bodies, Classes, corners_of, overlap_areas
from usd2kg.relations.thresholds import On, Rules
from usd2kg.relations.tops import rise_over_tops
from usd2kg.scene import Box
from usd2kg.shapes import overlapping_pairs

__all__ = ["find_support"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


_SHEET = 0.01
"""Metres: thinner things are sheets: rugs, floors."""


class _Tops(NamedTuple):
    """What things may stand on: the tops of parts, and level faces."""

    owner: Indices
    lower: Array
    upper: Array
    thickness: Array
    """Height of the part; 0 for a face."""
    area: Array


class _Rests(NamedTuple):
    """Pairs of a target and a top about the height of its bottom."""

    target: Indices
    top: Indices
    gap: Array
    ratio: Array
    """Share of what the target stands on that is over the top."""
    allowed: Array
    """How large the gap may be, up or down, for the target to rest on the top."""


def find_support(bodies: Bodies, classes: Classes, is_loose: Mask, container: Indices, rules: Rules) -> list[Links]:
    """Return what rests on what: on one thing each, on several where none carries it alone, or close over something.

    Of all tops that can carry a target, the one that begins highest counts: a book on a tray on a table is on the tray.
    What is inside something is on nothing that is not inside with it: what lies in a bowl on a table is not on the
    table, and the bowl's own bottom adds nothing.

    Args:
        bodies: the objects.
        classes: what their classes allow.
        is_loose: for each body, whether it may rest on anything.
        container: for each, what it is inside of, or -1.
        rules: the thresholds.
    """
    may_rest = is_loose & ~(classes.are_in("not_placed") | classes.are_in("not_laid"))[bodies.number]
    tops = _tops_of(bodies, ~classes.are_in("not_supporting")[bodies.number], rules)
    near = _find_rests(bodies, np.flatnonzero(may_rest), tops, container, rules)
    rests = taken(near, np.abs(near.gap) <= near.allowed)
    single = _on_one(bodies, tops, rests, rules.on)
    bears = ~classes.are_in("not_bearing")[bodies.number]
    is_left = np.ones(len(bodies), np.bool_)
    is_left[single.target] = False
    several = _on_several(bodies, tops, taken(rests, is_left[rests.target] & bears[tops.owner[rests.top]]), rules)
    is_left[several.target] = False
    is_left &= container < 0
    # The box around the walls of a whole house tells nothing of where they are.
    is_wall = classes.are_in("walls")[bodies.number] & (_thickness(bodies) <= rules.hovering.max_wall_thickness)
    is_left[_at_walls(bodies, np.flatnonzero(is_left), is_wall, rules)] = False
    return [single, several, _close_over(bodies, tops, taken(near, is_left[near.target]), rules)]


def _tops_of(bodies: Bodies, can_support: Mask, rules: Rules) -> _Tops:
    owner: list[int] = []
    boxes: list[Box] = []
    is_level: list[bool] = []
    rises = rise_over_tops(bodies, rules)
    for index in np.flatnonzero(can_support).tolist():
        obj = bodies.objects[index]
        parts = obj.part_boxes or (() if rises[index] else (obj.own_box,))
        own = [*(box for box in parts if box is not None), *obj.support_levels]
        owner.extend([index] * len(own))
        boxes.extend(own)
        is_level.extend([False] * (len(own) - len(obj.support_levels)) + [True] * len(obj.support_levels))
    lower, upper = corners_of(boxes)
    number, level = np.array(owner, np.int64), np.array(is_level, np.bool_)
    thickness = upper[:, 2] - lower[:, 2]
    # A level may be of any thickness: what stands on it goes before, as it does before the whole object.
    lower[level, 2] = bodies.lower[number[level], 2]
    # And a thing may sink into a floor that has no thickness to speak of.
    is_sheet = ~level & (bodies.size[number, 2] < _SHEET)
    lower[is_sheet, 2] -= rules.on.min_gap
    return _Tops(number, lower, upper, np.where(level, 0, thickness), bodies.area[number])


def _find_rests(bodies: Bodies, targets: Indices, tops: _Tops, container: Indices, rules: Rules) -> _Rests:
    rule = rules.on
    gaps = np.clip(rule.gap_share * bodies.size[:, 2], rule.min_gap, rule.max_gap)
    highest = np.maximum(gaps, rules.hovering.max_gap)
    found = [_Rests(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0), np.zeros(0), np.zeros(0))]
    lower, upper = bodies.feet
    foot_area = (upper - lower)[:, :2].prod(axis=1)
    feet = lower[targets, :2], upper[targets, :2]
    for chosen, number in overlapping_pairs(*feet, (tops.lower[:, :2], tops.upper[:, :2])):
        target, owner = targets[chosen], tops.owner[number]
        gap = bodies.lower[target, 2] - tops.upper[number, 2]
        may_sink = np.maximum(gaps[target], np.minimum(rule.sink_share * tops.thickness[number], rule.max_sink))
        is_good = (
            (owner != target)
            & (gap <= highest[target])
            & (-gap <= may_sink)
            # What begins below the target's own bottom carries it; what hangs beside it does not.
            & (tops.lower[number, 2] < bodies.lower[target, 2])
            & (container[owner] == container[target])
        )
        allowed = np.where(gap < 0, may_sink, gaps[target])
        rests = taken(_Rests(target, number, gap, np.zeros(len(target)), allowed), is_good)
        shared = overlap_areas(lower[rests.target], upper[rests.target], tops.lower[rests.top], tops.upper[rests.top])
        ratio = np.minimum(shared / np.maximum(foot_area[rests.target], 1e-12), 1.0)
        found.append(rests._replace(ratio=ratio))
    return joined(found)


def _on_one(bodies: Bodies, tops: _Tops, rests: _Rests, rule: On) -> Links:
    fits = bodies.area[rests.target] < rule.max_area_ratio * tops.area[rests.top]
    best = _best(bodies, tops, taken(rests, (rests.ratio > rule.min_overlap_ratio) & fits))
    is_round = closes_a_circle(_pointers(bodies, tops, best), best.target)
    # Of two sheets at one height, each sunk into the other, the larger one carries.
    best = taken(best, ~is_round | (bodies.area[best.target] < tops.area[best.top]))
    best = taken(best, ~closes_a_circle(_pointers(bodies, tops, best), best.target))
    over = share_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, tops, best, clearness(share_below(best.gap, best.allowed), over))


def _pointers(bodies: Bodies, tops: _Tops, rests: _Rests) -> Indices:
    pointers = np.full(len(bodies), -1)
    pointers[rests.target] = tops.owner[rests.top]
    return pointers


def _best(bodies: Bodies, tops: _Tops, rests: _Rests) -> _Rests:
    """Return of each target the top that begins highest. Rounded, so that where a scene stands decides nothing."""
    owner, lowest = tops.owner[rests.top], tops.lower[rests.top, 2]
    keys = (bodies.rank[owner], -rests.ratio.round(6), np.abs(rests.gap).round(6), -lowest.round(6))
    return taken(rests, first_of_each(rests.target, keys))


def _links(rule: str, tops: _Tops, rests: _Rests, confidence: Array) -> Links:
    numbers = {"gap": rests.gap, "overlapRatio": rests.ratio}
    return Links("on", rule, rests.target, tops.owner[rests.top], numbers, confidence)


def _on_several(bodies: Bodies, tops: _Tops, rests: _Rests, rules: Rules) -> Links:
    rule = rules.on_several
    own = np.maximum((tops.upper - tops.lower)[rests.top, :2].prod(axis=1), 1e-12)
    lower, upper = bodies.feet
    foot_area = (upper - lower)[:, :2].prod(axis=1)
    share = np.minimum(rests.ratio * foot_area[rests.target] / own, 1.0)
    bears = share >= rule.min_anchor_ratio
    rests, share = taken(rests, bears), share[bears]
    # Of the parts of one anchor the one that carries most.
    anchors = rests.target * len(bodies) + tops.owner[rests.top]
    best = first_of_each(anchors, (rests.top, -rests.ratio.round(6)))
    rests, share = taken(rests, best), share[best]
    count = np.bincount(rests.target, minlength=len(bodies))
    is_good = (count >= rule.min_anchors)[rests.target] & _is_under_middle(bodies, tops, rests)[rests.target]
    rests, share = taken(rests, is_good), share[is_good]
    clear = share_above(share, rule.min_anchor_ratio)
    return _links(rule.rule, tops, rests, clearness(share_below(rests.gap, rests.allowed), clear))


def _is_under_middle(bodies: Bodies, tops: _Tops, rests: _Rests) -> Mask:
    """Return for each body whether the box around all that bears it covers its middle: else it would tip over."""
    low, high = np.full((len(bodies), 2), np.inf), np.full((len(bodies), 2), -np.inf)
    np.minimum.at(low, rests.target, tops.lower[rests.top, :2])
    np.maximum.at(high, rests.target, tops.upper[rests.top, :2])
    middle = bodies.middle[:, :2]
    return np.asarray(((low <= middle) & (high >= middle)).all(axis=1))


def _close_over(bodies: Bodies, tops: _Tops, near: _Rests, rules: Rules) -> Links:
    rule = rules.hovering
    fits = bodies.area[near.target] < rules.on.max_area_ratio * tops.area[near.top]
    is_good = fits & (near.gap >= 0) & (near.gap <= rule.max_gap) & (near.ratio >= rule.min_overlap_ratio)
    near = taken(near, is_good)
    keys = (bodies.rank[tops.owner[near.top]], -near.ratio.round(6), near.gap.round(6))
    best = taken(near, first_of_each(near.target, keys))
    over = share_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, tops, best, clearness(share_below(best.gap, rule.max_gap), over))


def _thickness(bodies: Bodies) -> Array:
    """Return the shorter side of each footprint, metres."""
    _, half, _ = bodies.turned
    return np.asarray(2 * half.min(axis=1))


def _at_walls(bodies: Bodies, chosen: Indices, is_wall: Mask, rules: Rules) -> Indices:
    """Return those of the chosen bodies that are so close to a wall that they may hang on it; some more than once."""
    reach = rules.hovering.max_wall_gap
    lower, upper = bodies.lower[chosen] - reach, bodies.upper[chosen] + reach
    walls = bodies.lower[is_wall], bodies.upper[is_wall]
    found = [np.zeros(0, np.int64)]
    for i, j in overlapping_pairs(lower[:, :2], upper[:, :2], (walls[0][:, :2], walls[1][:, :2])):
        found.append(chosen[i[(lower[i, 2] <= walls[1][j, 2]) & (upper[i, 2] >= walls[0][j, 2])]])
    return np.concatenate(found)
