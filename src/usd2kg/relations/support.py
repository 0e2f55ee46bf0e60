"""`on`: the surfaces that objects rest on."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import (
    concatenate_rows,
    first_of_each_group,
    is_on_cycle,
    ratios,
    rounded,
    select_rows,
)
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


class _Surfaces(NamedTuple):
    """Supporting surfaces: the tops of parts, and level faces of meshes."""

    owner: Indices
    lower: Array
    upper: Array
    thickness: Array
    """Height of the part; 0 for a level face."""
    area: Array


class _Contacts(NamedTuple):
    """Pairs of a target and a surface near the height of its bottom."""

    target: Indices
    surface: Indices
    gap: Array
    ratio: Array
    """Share of the target's feet that is over the surface."""
    allowed: Array
    """Tolerated gap or penetration in metres."""


def find_support(
    boxed: BoxedObjects, classes: ClassMembership, is_loose: Mask, container: Indices, rules: RelationRules
) -> list[Links]:
    """Return the `on` links: with one anchor, with several that bear the target jointly, or across a small gap.

    The surface with the highest underside wins: a book on a tray on a table is on the tray. An object inside a
    container only rests on objects in the same container, and not on the container itself.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        is_loose: for each object, whether it may rest on another.
        container: index of the container of each object, -1 for none.
        rules: the thresholds.
    """
    may_rest = is_loose & ~(classes.are_in("not_placed") | classes.are_in("not_laid"))[boxed.scene_index]
    surfaces = _support_surfaces(boxed, ~classes.are_in("not_supporting")[boxed.scene_index], rules)
    near = _find_contacts(boxed, np.flatnonzero(may_rest), surfaces, container, rules)
    contacts = select_rows(near, np.abs(near.gap) <= near.allowed)
    single = _on_single(boxed, surfaces, contacts, rules.on)
    bears = ~classes.are_in("not_bearing")[boxed.scene_index]
    is_left = np.ones(len(boxed), np.bool_)
    is_left[single.target] = False
    several = _on_several(
        boxed,
        surfaces,
        select_rows(contacts, is_left[contacts.target] & bears[surfaces.owner[contacts.surface]]),
        rules,
    )
    is_left[several.target] = False
    is_left &= container < 0
    # The box of a mesh of several walls does not locate the walls.
    is_wall = classes.are_in("walls")[boxed.scene_index] & (_thickness(boxed) <= rules.hovering.max_wall_thickness)
    is_left[_near_walls(boxed, np.flatnonzero(is_left), is_wall, rules)] = False
    return [single, several, _hovering(boxed, surfaces, select_rows(near, is_left[near.target]), rules)]


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
    # A level has no thickness of its own: its underside is that of the object, below whatever is on it.
    lower[level, 2] = boxed.lower[number[level], 2]
    # Objects may penetrate a sheet, such as a floor without thickness.
    is_sheet = ~level & (boxed.size[number, 2] < rules.geometry.sheet_thickness)
    lower[is_sheet, 2] -= rules.on.min_gap
    return _Surfaces(number, lower, upper, np.where(level, 0, thickness), boxed.area[number])


def _find_contacts(
    boxed: BoxedObjects, targets: Indices, surfaces: _Surfaces, container: Indices, rules: RelationRules
) -> _Contacts:
    rule = rules.on
    gaps = np.clip(rule.gap_share * boxed.size[:, 2], rule.min_gap, rule.max_gap)
    highest = np.maximum(gaps, rules.hovering.max_gap)
    found = [_Contacts(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0), np.zeros(0), np.zeros(0))]
    lower, upper = boxed.feet
    foot_area = (upper - lower)[:, :2].prod(axis=1)
    feet = lower[targets, :2], upper[targets, :2]
    for chosen, number in overlapping_pairs(*feet, (surfaces.lower[:, :2], surfaces.upper[:, :2])):
        target, owner = targets[chosen], surfaces.owner[number]
        gap = boxed.lower[target, 2] - surfaces.upper[number, 2]
        may_sink = np.maximum(gaps[target], np.minimum(rule.sink_share * surfaces.thickness[number], rule.max_sink))
        is_good = (
            (owner != target)
            & (gap <= highest[target])
            & (-gap <= may_sink)
            # The underside of a supporter is below the target's bottom; that of an object beside it is not.
            & (surfaces.lower[number, 2] < boxed.lower[target, 2])
            & (container[owner] == container[target])
        )
        allowed = np.where(gap < 0, may_sink, gaps[target])
        contacts = select_rows(_Contacts(target, number, gap, np.zeros(len(target)), allowed), is_good)
        shared = overlap_areas(
            lower[contacts.target],
            upper[contacts.target],
            surfaces.lower[contacts.surface],
            surfaces.upper[contacts.surface],
        )
        ratio = np.minimum(ratios(shared, foot_area[contacts.target]), 1.0)
        found.append(contacts._replace(ratio=ratio))
    return concatenate_rows(found)


def _on_single(boxed: BoxedObjects, surfaces: _Surfaces, contacts: _Contacts, rule: OnRule) -> Links:
    fits = boxed.area[contacts.target] < rule.max_area_ratio * surfaces.area[contacts.surface]
    best = _best(boxed, surfaces, select_rows(contacts, (contacts.ratio > rule.min_overlap_ratio) & fits))
    is_round = is_on_cycle(_pointers(boxed, surfaces, best), best.target)
    # If two sheets at the same height support each other, the larger one is the supporter.
    best = select_rows(best, ~is_round | (boxed.area[best.target] < surfaces.area[best.surface]))
    best = select_rows(best, ~is_on_cycle(_pointers(boxed, surfaces, best), best.target))
    over = margin_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, surfaces, best, margin_score(margin_below(best.gap, best.allowed), over))


def _pointers(boxed: BoxedObjects, surfaces: _Surfaces, contacts: _Contacts) -> Indices:
    pointers = np.full(len(boxed), -1)
    pointers[contacts.target] = surfaces.owner[contacts.surface]
    return pointers


def _best(boxed: BoxedObjects, surfaces: _Surfaces, contacts: _Contacts) -> _Contacts:
    """Return each target's contact with the surface whose underside is highest."""
    owner, lowest = surfaces.owner[contacts.surface], surfaces.lower[contacts.surface, 2]
    keys = (boxed.rank[owner], -rounded(contacts.ratio), rounded(np.abs(contacts.gap)), -rounded(lowest))
    return select_rows(contacts, first_of_each_group(contacts.target, keys))


def _links(rule: str, surfaces: _Surfaces, contacts: _Contacts, confidence: Array) -> Links:
    numbers = {"gap": contacts.gap, "overlapRatio": contacts.ratio}
    return Links("on", rule, contacts.target, surfaces.owner[contacts.surface], numbers, confidence)


def _on_several(boxed: BoxedObjects, surfaces: _Surfaces, contacts: _Contacts, rules: RelationRules) -> Links:
    rule = rules.on_several
    own = (surfaces.upper - surfaces.lower)[contacts.surface, :2].prod(axis=1)
    lower, upper = boxed.feet
    foot_area = (upper - lower)[:, :2].prod(axis=1)
    share = np.minimum(ratios(contacts.ratio * foot_area[contacts.target], own), 1.0)
    bears = share >= rule.min_anchor_ratio
    contacts, share = select_rows(contacts, bears), share[bears]
    # Keep the part of each anchor with the largest share.
    anchors = contacts.target * len(boxed) + surfaces.owner[contacts.surface]
    best = first_of_each_group(anchors, (contacts.surface, -rounded(contacts.ratio)))
    contacts, share = select_rows(contacts, best), share[best]
    count = np.bincount(contacts.target, minlength=len(boxed))
    is_good = (count >= rule.min_anchors)[contacts.target] & _supports_center(boxed, surfaces, contacts)[
        contacts.target
    ]
    contacts, share = select_rows(contacts, is_good), share[is_good]
    clear = margin_above(share, rule.min_anchor_ratio)
    return _links(rule.rule, surfaces, contacts, margin_score(margin_below(contacts.gap, contacts.allowed), clear))


def _supports_center(boxed: BoxedObjects, surfaces: _Surfaces, contacts: _Contacts) -> Mask:
    """Return whether the box around the supporters of each object covers its centre; else it would tip over."""
    low, high = np.full((len(boxed), 2), np.inf), np.full((len(boxed), 2), -np.inf)
    np.minimum.at(low, contacts.target, surfaces.lower[contacts.surface, :2])
    np.maximum.at(high, contacts.target, surfaces.upper[contacts.surface, :2])
    middle = boxed.middle[:, :2]
    return np.asarray(((low <= middle) & (high >= middle)).all(axis=1))


def _hovering(boxed: BoxedObjects, surfaces: _Surfaces, near: _Contacts, rules: RelationRules) -> Links:
    rule = rules.hovering
    fits = boxed.area[near.target] < rules.on.max_area_ratio * surfaces.area[near.surface]
    is_good = fits & (near.gap >= 0) & (near.gap <= rule.max_gap) & (near.ratio >= rule.min_overlap_ratio)
    near = select_rows(near, is_good)
    keys = (boxed.rank[surfaces.owner[near.surface]], -rounded(near.ratio), rounded(near.gap))
    best = select_rows(near, first_of_each_group(near.target, keys))
    over = margin_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, surfaces, best, margin_score(margin_below(best.gap, rule.max_gap), over))


def _thickness(boxed: BoxedObjects) -> Array:
    """Return the shorter side of each footprint in metres."""
    return np.asarray(2 * boxed.footprints.half_sides.min(axis=1))


def _near_walls(boxed: BoxedObjects, chosen: Indices, is_wall: Mask, rules: RelationRules) -> Indices:
    """Return the chosen objects that are close enough to a wall to hang on it, with repetitions."""
    reach = rules.hovering.max_wall_gap
    lower, upper = boxed.lower[chosen] - reach, boxed.upper[chosen] + reach
    walls = boxed.lower[is_wall], boxed.upper[is_wall]
    found = [np.zeros(0, np.int64)]
    for i, j in overlapping_pairs(lower[:, :2], upper[:, :2], (walls[0][:, :2], walls[1][:, :2])):
        found.append(chosen[i[(lower[i, 2] <= walls[1][j, 2]) & (upper[i, 2] >= walls[0][j, 2])]])
    return np.concatenate(found)
