"""`on`: what a thing stands or lies on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, is_on_cycle, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership, corners_of, overlap_areas
from usd2kg.relations.model import Links, margin_above, margin_below, margin_score
from usd2kg.relations.protrusions import has_protrusion
from usd2kg.relations.thresholds import OnRule, RelationRules
from usd2kg.scene import Box
from usd2kg.shapes import overlapping_pairs

__all__ = ["find_support"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


_SHEET = 0.01
"""Metres: thinner things are sheets: rugs, floors."""


class _Surfaces(NamedTuple):
    """What things may stand on: the tops of parts, and level faces."""

    owner: Indices
    lower: Array
    upper: Array
    thickness: Array
    """Height of the part; 0 for a face."""
    area: Array


class _Contacts(NamedTuple):
    """Pairs of a target and a top about the height of its bottom."""

    target: Indices
    top: Indices
    gap: Array
    ratio: Array
    """Share of what the target stands on that is over the top."""
    allowed: Array
    """How large the gap may be, up or down, for the target to rest on the top."""


def find_support(
    boxed: BoxedObjects, classes: ClassMembership, is_loose: Mask, container: Indices, rules: RelationRules
) -> list[Links]:
    """Return what rests on what: on one thing each, on several where none carries it alone, or close over something.

    Of all tops that can carry a target, the one that begins highest counts: a book on a tray on a table is on the tray.
    What is inside something is on nothing that is not inside with it: what lies in a bowl on a table is not on the
    table, and the bowl's own bottom adds nothing.

    Args:
        boxed: the objects.
        classes: what their classes allow.
        is_loose: for each body, whether it may rest on anything.
        container: for each, what it is inside of, or -1.
        rules: the thresholds.
    """
    may_rest = is_loose & ~(classes.are_in("not_placed") | classes.are_in("not_laid"))[boxed.number]
    tops = _support_surfaces(boxed, ~classes.are_in("not_supporting")[boxed.number], rules)
    near = _find_contacts(boxed, np.flatnonzero(may_rest), tops, container, rules)
    rests = select_rows(near, np.abs(near.gap) <= near.allowed)
    single = _on_single(boxed, tops, rests, rules.on)
    bears = ~classes.are_in("not_bearing")[boxed.number]
    is_left = np.ones(len(boxed), np.bool_)
    is_left[single.target] = False
    several = _on_several(boxed, tops, select_rows(rests, is_left[rests.target] & bears[tops.owner[rests.top]]), rules)
    is_left[several.target] = False
    is_left &= container < 0
    # The box around the walls of a whole house tells nothing of where they are.
    is_wall = classes.are_in("walls")[boxed.number] & (_thickness(boxed) <= rules.hovering.max_wall_thickness)
    is_left[_near_walls(boxed, np.flatnonzero(is_left), is_wall, rules)] = False
    return [single, several, _hovering(boxed, tops, select_rows(near, is_left[near.target]), rules)]


def _support_surfaces(boxed: BoxedObjects, can_support: Mask, rules: RelationRules) -> _Surfaces:
    owner: list[int] = []
    boxes: list[Box] = []
    is_level: list[bool] = []
    rises = has_protrusion(boxed, rules)
    for index in np.flatnonzero(can_support).tolist():
        obj = boxed.objects[index]
        parts = obj.part_boxes or (() if rises[index] else (obj.own_box,))
        own = [*(box for box in parts if box is not None), *obj.support_levels]
        owner.extend([index] * len(own))
        boxes.extend(own)
        is_level.extend([False] * (len(own) - len(obj.support_levels)) + [True] * len(obj.support_levels))
    lower, upper = corners_of(boxes)
    number, level = np.array(owner, np.int64), np.array(is_level, np.bool_)
    thickness = upper[:, 2] - lower[:, 2]
    # A level may be of any thickness: what stands on it goes before, as it does before the whole object.
    lower[level, 2] = boxed.lower[number[level], 2]
    # And a thing may sink into a floor that has no thickness to speak of.
    is_sheet = ~level & (boxed.size[number, 2] < _SHEET)
    lower[is_sheet, 2] -= rules.on.min_gap
    return _Surfaces(number, lower, upper, np.where(level, 0, thickness), boxed.area[number])


def _find_contacts(
    boxed: BoxedObjects, targets: Indices, tops: _Surfaces, container: Indices, rules: RelationRules
) -> _Contacts:
    rule = rules.on
    gaps = np.clip(rule.gap_share * boxed.size[:, 2], rule.min_gap, rule.max_gap)
    highest = np.maximum(gaps, rules.hovering.max_gap)
    found = [_Contacts(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0), np.zeros(0), np.zeros(0))]
    lower, upper = boxed.feet
    foot_area = (upper - lower)[:, :2].prod(axis=1)
    feet = lower[targets, :2], upper[targets, :2]
    for chosen, number in overlapping_pairs(*feet, (tops.lower[:, :2], tops.upper[:, :2])):
        target, owner = targets[chosen], tops.owner[number]
        gap = boxed.lower[target, 2] - tops.upper[number, 2]
        may_sink = np.maximum(gaps[target], np.minimum(rule.sink_share * tops.thickness[number], rule.max_sink))
        is_good = (
            (owner != target)
            & (gap <= highest[target])
            & (-gap <= may_sink)
            # What begins below the target's own bottom carries it; what hangs beside it does not.
            & (tops.lower[number, 2] < boxed.lower[target, 2])
            & (container[owner] == container[target])
        )
        allowed = np.where(gap < 0, may_sink, gaps[target])
        rests = select_rows(_Contacts(target, number, gap, np.zeros(len(target)), allowed), is_good)
        shared = overlap_areas(lower[rests.target], upper[rests.target], tops.lower[rests.top], tops.upper[rests.top])
        ratio = np.minimum(shared / np.maximum(foot_area[rests.target], 1e-12), 1.0)
        found.append(rests._replace(ratio=ratio))
    return concatenate_rows(found)


def _on_single(boxed: BoxedObjects, tops: _Surfaces, rests: _Contacts, rule: OnRule) -> Links:
    fits = boxed.area[rests.target] < rule.max_area_ratio * tops.area[rests.top]
    best = _best(boxed, tops, select_rows(rests, (rests.ratio > rule.min_overlap_ratio) & fits))
    is_round = is_on_cycle(_pointers(boxed, tops, best), best.target)
    # Of two sheets at one height, each sunk into the other, the larger one carries.
    best = select_rows(best, ~is_round | (boxed.area[best.target] < tops.area[best.top]))
    best = select_rows(best, ~is_on_cycle(_pointers(boxed, tops, best), best.target))
    over = margin_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, tops, best, margin_score(margin_below(best.gap, best.allowed), over))


def _pointers(boxed: BoxedObjects, tops: _Surfaces, rests: _Contacts) -> Indices:
    pointers = np.full(len(boxed), -1)
    pointers[rests.target] = tops.owner[rests.top]
    return pointers


def _best(boxed: BoxedObjects, tops: _Surfaces, rests: _Contacts) -> _Contacts:
    """Return of each target the top that begins highest. Rounded, so that where a scene stands decides nothing."""
    owner, lowest = tops.owner[rests.top], tops.lower[rests.top, 2]
    keys = (boxed.rank[owner], -rests.ratio.round(6), np.abs(rests.gap).round(6), -lowest.round(6))
    return select_rows(rests, first_of_each_group(rests.target, keys))


def _links(rule: str, tops: _Surfaces, rests: _Contacts, confidence: Array) -> Links:
    numbers = {"gap": rests.gap, "overlapRatio": rests.ratio}
    return Links("on", rule, rests.target, tops.owner[rests.top], numbers, confidence)


def _on_several(boxed: BoxedObjects, tops: _Surfaces, rests: _Contacts, rules: RelationRules) -> Links:
    rule = rules.on_several
    own = np.maximum((tops.upper - tops.lower)[rests.top, :2].prod(axis=1), 1e-12)
    lower, upper = boxed.feet
    foot_area = (upper - lower)[:, :2].prod(axis=1)
    share = np.minimum(rests.ratio * foot_area[rests.target] / own, 1.0)
    bears = share >= rule.min_anchor_ratio
    rests, share = select_rows(rests, bears), share[bears]
    # Of the parts of one anchor the one that carries most.
    anchors = rests.target * len(boxed) + tops.owner[rests.top]
    best = first_of_each_group(anchors, (rests.top, -rests.ratio.round(6)))
    rests, share = select_rows(rests, best), share[best]
    count = np.bincount(rests.target, minlength=len(boxed))
    is_good = (count >= rule.min_anchors)[rests.target] & _supports_center(boxed, tops, rests)[rests.target]
    rests, share = select_rows(rests, is_good), share[is_good]
    clear = margin_above(share, rule.min_anchor_ratio)
    return _links(rule.rule, tops, rests, margin_score(margin_below(rests.gap, rests.allowed), clear))


def _supports_center(boxed: BoxedObjects, tops: _Surfaces, rests: _Contacts) -> Mask:
    """Return for each body whether the box around all that bears it covers its middle: else it would tip over."""
    low, high = np.full((len(boxed), 2), np.inf), np.full((len(boxed), 2), -np.inf)
    np.minimum.at(low, rests.target, tops.lower[rests.top, :2])
    np.maximum.at(high, rests.target, tops.upper[rests.top, :2])
    middle = boxed.middle[:, :2]
    return np.asarray(((low <= middle) & (high >= middle)).all(axis=1))


def _hovering(boxed: BoxedObjects, tops: _Surfaces, near: _Contacts, rules: RelationRules) -> Links:
    rule = rules.hovering
    fits = boxed.area[near.target] < rules.on.max_area_ratio * tops.area[near.top]
    is_good = fits & (near.gap >= 0) & (near.gap <= rule.max_gap) & (near.ratio >= rule.min_overlap_ratio)
    near = select_rows(near, is_good)
    keys = (boxed.rank[tops.owner[near.top]], -near.ratio.round(6), near.gap.round(6))
    best = select_rows(near, first_of_each_group(near.target, keys))
    over = margin_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, tops, best, margin_score(margin_below(best.gap, rule.max_gap), over))


def _thickness(boxed: BoxedObjects) -> Array:
    """Return the shorter side of each footprint, metres."""
    _, half, _ = boxed.turned
    return np.asarray(2 * half.min(axis=1))


def _near_walls(boxed: BoxedObjects, chosen: Indices, is_wall: Mask, rules: RelationRules) -> Indices:
    """Return those of the chosen boxed that are so close to a wall that they may hang on it; some more than once."""
    reach = rules.hovering.max_wall_gap
    lower, upper = boxed.lower[chosen] - reach, boxed.upper[chosen] + reach
    walls = boxed.lower[is_wall], boxed.upper[is_wall]
    found = [np.zeros(0, np.int64)]
    for i, j in overlapping_pairs(lower[:, :2], upper[:, :2], (walls[0][:, :2], walls[1][:, :2])):
        found.append(chosen[i[(lower[i, 2] <= walls[1][j, 2]) & (upper[i, 2] >= walls[0][j, 2])]])
    return np.concatenate(found)
