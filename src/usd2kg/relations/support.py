"""`on`: the surfaces that objects rest on."""

from collections.abc import Iterator, Mapping
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
from usd2kg.relations.pair_blocks import measure_in_blocks
from usd2kg.relations.protrusions import has_protrusion
from usd2kg.relations.surface_contact import Standing, measure_contacts
from usd2kg.relations.thresholds import OnRule, RelationRules
from usd2kg.scene import Box
from usd2kg.shapes import overlapping_pairs

__all__ = ["Support", "are_unbalanced", "find_hovering", "find_propped", "find_support"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_ROUNDING = 1e-5
"""Metres: heights that differ by less are equal."""
_PIERCED = 2e-3
"""Metres by which an object may reach through all of what supports it."""


class _Contacts(NamedTuple):
    """Pairs of a target and an object that has a surface near the height of the target's feet."""

    target: Indices
    anchor: Indices
    gap: Array
    ratio: Array
    """Share of the target's feet that is over the surface."""
    area: Array
    """Square metres of the target's footprint that the surface supports."""
    allowed: Array
    """Tolerated gap or penetration in metres."""
    lower: Array
    """(n, 3): lower corner of what supports the target, a part or the anchor; z is that of its underside."""
    upper: Array
    """(n, 3): its upper corner."""


class _Tops(NamedTuple):
    """The tops of the boxes and parts of objects without a surface."""

    owner: Indices
    lower: Array
    upper: Array
    thickness: Array


class _Limits(NamedTuple):
    """How far each object may be from what supports it."""

    tolerance: Array
    """Gap in metres."""
    is_ground: Mask
    """Whether each object is the ground. Nothing is below it: an object whose upper half is above it stands on it."""
    hangs: Mask
    """Whether each object hangs by its nature, so that it is not on a ground that it reaches."""
    rules: RelationRules

    def sinks(self, boxed: BoxedObjects, target: Indices, anchor: Indices, thickness: Array) -> Array:
        """Return how deep the targets may sink into anchors of a thickness, in metres."""
        rule = self.rules.on
        usual = np.maximum(self.tolerance[target], np.minimum(rule.sink_share * thickness, rule.max_sink))
        return np.where(self.is_ground[anchor], boxed.size[target, 2] / 2, usual)


class Support(NamedTuple):
    """What supports the objects of a scene."""

    links: list[Links]
    """`on` with one anchor, and with several that support the target jointly."""
    near: _Contacts
    """All surfaces near the feet of an object, closer than what it may hover over."""
    at_floor: Mask
    """Whether each object rests on a surface of its container."""


def find_support(
    boxed: BoxedObjects,
    classes: ClassMembership,
    is_loose: Mask,
    container: Indices,
    wholes: Indices,
    rules: RelationRules,
) -> Support:
    """Return the `on` links of the objects that touch what supports them.

    The surface with the highest underside wins: a book on a tray on a table is on the tray. An object inside a
    container only rests on objects in the same container, and not on the container itself.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        is_loose: for each object, whether it may rest on another.
        container: index of the container of each object, -1 for none.
        wholes: index of the whole of each object, -1 for none.
        rules: the thresholds.
    """
    grounds = classes.are_in("grounds")[boxed.scene_index]
    # A floor too small for a room, such as a sheet of cardboard, lies on the floor.
    is_ground = grounds & (boxed.size[:, :2] >= rules.room.min_side).any(axis=1)
    may_rest = (classes.may_be_placed & ~classes.are_drawers)[boxed.scene_index] | (grounds & ~is_ground)
    may_rest &= is_loose
    can_support = ~classes.are_in("not_supporting")[boxed.scene_index]
    tolerance = np.clip(rules.on.gap_share * boxed.size[:, 2], rules.on.min_gap, rules.on.max_gap)
    hangs = classes.are_in("hanging")[boxed.scene_index]
    limits = _Limits(tolerance, is_ground, hangs, rules)
    around = _find_contacts(boxed, np.flatnonzero(may_rest), can_support, limits)
    meets = (np.abs(around.gap) <= around.allowed) & (around.ratio > rules.on.min_overlap_ratio)
    at_floor = np.zeros(len(boxed), np.bool_)
    at_floor[around.target[meets & (around.anchor == container[around.target])]] = True
    is_near = container[around.anchor] == container[around.target]
    # What is heaped above the rim of a container lies on its contents.
    is_held = at_floor.copy()
    is_held[around.target[meets & is_near]] = True
    is_within = (container[around.target] < 0) | _are_within(boxed, around.anchor, container[around.target])
    is_within &= container[around.anchor] != around.target
    near = select_rows(around, is_near | (meets & is_within & ~is_held[around.target]))
    contacts = select_rows(near, np.abs(near.gap) <= near.allowed)
    contacts = select_rows(contacts, ~_are_of_wholes(boxed, contacts, wholes))
    broad = contacts.ratio > rules.on.min_overlap_ratio
    fits = broad & (boxed.area[contacts.target] < rules.on.max_area_ratio * boxed.area[contacts.anchor])
    bears = ~classes.are_in("not_bearing")[boxed.scene_index][contacts.anchor]
    is_left = ~np.isin(contacts.target, contacts.target[fits])
    several = _on_several(boxed, select_rows(contacts, is_left & bears), rules)
    fits |= broad & bears & _are_balanced(boxed, contacts) & ~np.isin(contacts.target, several.target)
    return Support([_on_single(boxed, select_rows(contacts, fits), rules.on), several], near, at_floor)


def _are_of_wholes(boxed: BoxedObjects, contacts: _Contacts, wholes: Indices) -> Mask:
    """Return for each contact whether the anchor is a part of another anchor that reaches as high: a cabinet's door."""
    is_part = wholes[contacts.anchor] >= 0
    near = np.flatnonzero(np.isin(contacts.target, contacts.target[is_part]))
    keys = contacts.target[near] * len(boxed) + contacts.anchor[near]
    level = dict(zip(keys.tolist(), contacts.upper[near, 2].tolist(), strict=True))
    for row in np.flatnonzero(is_part).tolist():
        whole = int(contacts.target[row] * len(boxed) + wholes[contacts.anchor[row]])
        is_part[row] = level.get(whole, -np.inf) >= contacts.upper[row, 2] - _ROUNDING
    return np.asarray(is_part)


def _are_within(boxed: BoxedObjects, inner: Indices, outer: Indices) -> Mask:
    """Return for each pair whether the middle of the first is in the box of another one, which is smaller than that."""
    middle = boxed.middle[inner]
    is_in = ((middle >= boxed.lower[outer]) & (middle <= boxed.upper[outer])).all(axis=1)
    return np.asarray(is_in & (boxed.volume[inner] < boxed.volume[outer]) & (inner != outer))


def find_hovering(
    boxed: BoxedObjects, near: _Contacts, is_left: Mask, container: Indices, rules: RelationRules
) -> Links:
    """Return the `on` links across a small gap, or with few feet, of the objects of a mask."""
    rule, near = rules.hovering, select_rows(near, is_left[near.target])
    touched = _partly_supported(boxed, select_rows(near, container[near.target] >= 0), rules)
    near = select_rows(near, ~np.isin(near.target, touched.target))
    fits = boxed.area[near.target] < rules.on.max_area_ratio * boxed.area[near.anchor]
    is_good = fits & (near.gap >= 0) & (near.gap <= rule.max_gap) & (near.ratio >= rule.min_overlap_ratio)
    near = select_rows(near, is_good)
    keys = (boxed.rank[near.anchor], -rounded(near.ratio), rounded(near.gap))
    best = concatenate_rows([select_rows(near, first_of_each_group(near.target, keys)), touched])
    over = margin_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, best, margin_score(margin_below(best.gap, rule.max_gap), over))


def _partly_supported(boxed: BoxedObjects, near: _Contacts, rules: RelationRules) -> _Contacts:
    """Return the contacts of contents that no single surface supports: a roll on several rolls, a can on a wire."""
    touching = select_rows(near, (np.abs(near.gap) <= near.allowed) & (near.ratio > 0))
    shared = np.bincount(touching.target, touching.ratio, minlength=len(boxed))
    is_good = _are_balanced(boxed, touching) | (shared > rules.on.min_overlap_ratio)[touching.target]
    touching = select_rows(touching, is_good & (touching.ratio >= rules.hovering.min_touching_ratio))
    keys = (boxed.rank[touching.anchor], -rounded(touching.ratio))
    return select_rows(touching, first_of_each_group(touching.target, keys))


def are_unbalanced(boxed: BoxedObjects, links: Links) -> Mask:
    """Return for each `on` link whether the anchor is not below the centre of the target."""
    middle = boxed.middle[links.target, :2]
    lower, upper = boxed.lower[links.anchor, :2], boxed.upper[links.anchor, :2]
    return np.asarray(((middle < lower) | (middle > upper)).any(axis=1))


def find_propped(boxed: BoxedObjects, near: _Contacts, attached: Links, rules: RelationRules) -> Links:
    """Return the `on` links of objects that touch something which is also below their centre and part of their feet.

    Args:
        boxed: the objects.
        near: the surfaces near the feet of objects.
        attached: `attached-to` links; each link found replaces one of these.
        rules: the thresholds.
    """
    pairs = attached.target * len(boxed) + attached.anchor
    is_above = boxed.lower[near.anchor, 2] >= boxed.middle[near.target, 2]
    is_good = np.isin(near.target * len(boxed) + near.anchor, pairs) & ~is_above & _are_balanced(boxed, near)
    is_good &= (near.gap <= rules.hovering.max_gap) & (near.gap >= -near.allowed)
    near = select_rows(near, is_good)
    best = select_rows(near, first_of_each_group(near.target, (boxed.rank[near.anchor], -rounded(near.ratio))))
    return _links(rules.hovering.rule, best, margin_score(margin_below(best.gap, rules.hovering.max_gap), best.ratio))


def _find_contacts(boxed: BoxedObjects, targets: Indices, can_support: Mask, limits: _Limits) -> _Contacts:
    tops = _box_tops(boxed, can_support & ~boxed.has_surface, limits.rules)
    surfaces = _on_surfaces(boxed, targets, np.flatnonzero(can_support & boxed.has_surface), limits)
    found = concatenate_rows([*_on_boxes(boxed, targets, tops, limits), *surfaces])
    # The ground has no underside.
    found.lower[limits.is_ground[found.anchor], 2] = -np.inf
    is_good = (
        (found.anchor != found.target)
        # The underside of a supporter is below the target's bottom; that of an object beside it is not.
        & ((found.lower[:, 2] < boxed.lower[found.target, 2] - _ROUNDING) | _are_draped(boxed, found, limits.rules))
        & ~(limits.is_ground[found.anchor] & limits.hangs[found.target])
    )
    return select_rows(found, is_good)


def _are_draped(boxed: BoxedObjects, contacts: _Contacts, rules: RelationRules) -> Mask:
    """Return for each pair whether the target lies over the anchor like a cloth over a table or a helmet over a ball.

    What supports it is wider than it reaches down beside it; a towel over a rail hangs.
    """
    level = contacts.upper[:, 2] + contacts.gap
    depth = level - boxed.lower[contacts.target, 2]
    is_wide = (depth > rules.on.max_sink) & (contacts.area >= depth**2) & (contacts.lower[:, 2] < level - _ROUNDING)
    return np.asarray(is_wide & _are_balanced(boxed, contacts))


def _box_tops(boxed: BoxedObjects, can_support: Mask, rules: RelationRules) -> _Tops:
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
    thickness = np.where(level, 0, upper[:, 2] - lower[:, 2])
    # A level has no thickness of its own: its underside is that of the object, below whatever is on it.
    lower[level, 2] = boxed.lower[number[level], 2]
    # Objects may penetrate a sheet, such as a floor without thickness.
    is_sheet = ~level & (boxed.size[number, 2] < rules.geometry.sheet_thickness)
    lower[is_sheet, 2] -= rules.on.min_gap
    return _Tops(number, lower, upper, thickness)


def _on_boxes(boxed: BoxedObjects, targets: Indices, tops: _Tops, limits: _Limits) -> Iterator[_Contacts]:
    highest = np.maximum(limits.tolerance, limits.rules.hovering.max_gap)
    lower, upper = boxed.feet
    top = np.stack([tops.lower[:, 0], tops.lower[:, 1], tops.upper[:, 2]], axis=1)
    for chosen, number in overlapping_pairs(*_foot_space(boxed, targets, highest, limits), (top, tops.upper)):
        target = targets[chosen]
        gap = boxed.lower[target, 2] - tops.upper[number, 2]
        sinks = limits.sinks(boxed, target, tops.owner[number], tops.thickness[number])
        is_good = (gap <= highest[target]) & (-gap <= sinks)
        target, number, gap, sinks = target[is_good], number[is_good], gap[is_good], sinks[is_good]  # noqa: PLW2901
        shared = overlap_areas(lower[target], upper[target], tops.lower[number], tops.upper[number])
        ratio = np.minimum(ratios(shared, boxed.foot_area[target]), 1.0)
        allowed = np.where(gap < 0, sinks, limits.tolerance[target])
        yield _Contacts(target, tops.owner[number], gap, ratio, shared, allowed, tops.lower[number], tops.upper[number])


def _foot_space(boxed: BoxedObjects, targets: Indices, highest: Array, limits: _Limits) -> tuple[Array, Array]:
    """Return the corners (n, 3) of the space in which the surface that supports an object is: around its feet.

    Args:
        boxed: the objects.
        targets: their indices.
        highest: metres that each object may be above the surface.
        limits: how far it may sink into it.
    """
    lower, upper = (corners[targets].copy() for corners in boxed.feet)
    bottom = boxed.lower[targets, 2]
    lower[:, 2] = bottom - highest[targets] - _ROUNDING
    # Half its height in the ground.
    deepest = np.maximum(limits.tolerance[targets], limits.rules.on.max_sink)
    upper[:, 2] = bottom + np.maximum(deepest, boxed.size[targets, 2] / 2) + _ROUNDING
    return lower, upper


def _on_surfaces(boxed: BoxedObjects, targets: Indices, anchors: Indices, limits: _Limits) -> Iterator[_Contacts]:
    """Yield the contacts with meshes, measured from the feet down to the mesh.

    What meets nothing at its feet may rest on something under the rest of its underside: a worktop whose front edge
    reaches down, a tablet on a tilted plate.
    """
    target, anchor = _feet_over(boxed, targets, anchors, limits)
    at_feet = _measure(boxed, target, anchor, boxed.feet_of(np.unique(target)), limits)
    yield at_feet
    is_met = (np.abs(at_feet.gap) <= at_feet.allowed) & (at_feet.ratio > limits.rules.on.min_overlap_ratio)
    is_left = boxed.has_surface.copy()
    is_left[at_feet.target[is_met]] = False
    target, anchor = target[is_left[target]], anchor[is_left[target]]
    below = _measure(boxed, target, anchor, boxed.undersides_of(np.unique(target)), limits)
    yield select_rows(below, np.abs(below.gap) <= below.allowed)


def _measure(
    boxed: BoxedObjects, target: Indices, anchor: Indices, points: Mapping[int, Array], limits: _Limits
) -> _Contacts:
    return measure_in_blocks(lambda some: _measure_some(boxed, target[some], anchor[some], points, limits), len(target))


def _measure_some(
    boxed: BoxedObjects, target: Indices, anchor: Indices, points: Mapping[int, Array], limits: _Limits
) -> _Contacts:
    rules = limits.rules
    is_some = np.array([len(points[index]) > 0 for index in target.tolist()], np.bool_)
    target, anchor = target[is_some], anchor[is_some]
    standing = Standing(
        feet=[points[index] for index in target.tolist()],
        surfaces=[surface for index in anchor.tolist() if (surface := boxed.surfaces[index]) is not None],
        own_surfaces=[boxed.surfaces[index] for index in target.tolist()],
        lower=boxed.lower[target],
        upper=boxed.upper[target],
        foot_area=boxed.foot_area[target],
        tolerance=limits.tolerance[target],
        max_sink=np.where(limits.is_ground[anchor], boxed.size[target, 2] / 2, rules.on.max_sink),
        is_grounded=limits.is_ground[anchor],
    )
    found = measure_contacts(standing, rules)
    is_met = np.isfinite(found.gap)
    found, target, anchor = select_rows(found, is_met), target[is_met], anchor[is_met]
    # Objects may penetrate a sheet; what has no underside of its own reaches down to the bottom of the anchor.
    is_thick = found.height - boxed.lower[anchor, 2] > rules.geometry.sheet_thickness
    bottom = np.where(is_thick, boxed.lower[anchor, 2], found.height - rules.on.min_gap)
    underside = np.where(found.underside >= found.height, bottom, found.underside)
    # A chair may stand in a rug as deep as its underside.
    is_cover = ~is_thick & (boxed.area[anchor] > rules.on.cover_ratio * boxed.area[target])
    underside = np.where(is_cover, boxed.lower[anchor, 2] - rules.on.min_gap, underside)
    lower, upper = boxed.lower[anchor].copy(), boxed.upper[anchor].copy()
    lower[:, 2], upper[:, 2] = np.where(np.isfinite(underside), underside, boxed.lower[anchor, 2]), found.height
    return _Contacts(target, anchor, found.gap, found.ratio, found.area, found.allowed, lower, upper)


def _feet_over(boxed: BoxedObjects, targets: Indices, anchors: Indices, limits: _Limits) -> tuple[Indices, Indices]:
    """Return the pairs for which the feet of the target are over the anchor's box, at a height within it."""
    rules = limits.rules
    highest = max(rules.on.max_gap, rules.hovering.max_gap)
    space = _foot_space(boxed, targets, np.full(len(boxed), highest), limits)
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64))]
    for i, j in overlapping_pairs(*space, (boxed.lower[anchors], boxed.upper[anchors])):
        target, anchor = targets[i], anchors[j]
        bottom = boxed.lower[target, 2]
        sinks = np.where(limits.is_ground[anchor], boxed.size[target, 2] / 2, rules.on.max_sink)
        is_level = (bottom >= boxed.lower[anchor, 2] - sinks) & (bottom <= boxed.upper[anchor, 2] + highest)
        is_level &= target != anchor
        found.append((target[is_level], anchor[is_level]))
    target, anchor = (np.concatenate(column) for column in zip(*found, strict=True))
    # Each surface is used at once, and need not be kept.
    order = np.argsort(anchor, kind="stable")
    return target[order], anchor[order]


def _on_single(boxed: BoxedObjects, contacts: _Contacts, rule: OnRule) -> Links:
    best = _best(boxed, contacts)
    is_round = is_on_cycle(_pointers(boxed, best), best.target)
    # If two sheets at the same height support each other, the larger one is the supporter.
    best = select_rows(best, ~is_round | (boxed.area[best.target] < boxed.area[best.anchor]))
    best = select_rows(best, ~is_on_cycle(_pointers(boxed, best), best.target))
    over = margin_above(best.ratio, rule.min_overlap_ratio)
    return _links(rule.rule, best, margin_score(margin_below(best.gap, best.allowed), over))


def _are_balanced(boxed: BoxedObjects, contacts: _Contacts) -> Mask:
    """Return for each pair whether the supporter is below the centre of the target, as the stand of a basin is."""
    middle = boxed.middle[contacts.target, :2]
    return np.asarray(((contacts.lower[:, :2] <= middle) & (middle <= contacts.upper[:, :2])).all(axis=1))


def _pointers(boxed: BoxedObjects, contacts: _Contacts) -> Indices:
    pointers = np.full(len(boxed), -1)
    pointers[contacts.target] = contacts.anchor
    return pointers


def _best(boxed: BoxedObjects, contacts: _Contacts) -> _Contacts:
    """Return each target's contact with what is best to support it.

    That is the surface whose underside is highest, of those that the target does not pierce; but rather what rests on
    that itself, such as a tray pressed into a tablecloth.
    """
    best = _highest(boxed, contacts)
    support = _pointers(boxed, best)
    pairs = contacts.target * len(boxed) + contacts.anchor
    is_mutual = np.isin(contacts.anchor * len(boxed) + contacts.target, pairs)
    is_larger = boxed.area[contacts.anchor] > boxed.area[contacts.target]
    rests_there = (support[contacts.anchor] == support[contacts.target]) & (is_larger | ~is_mutual)
    level = np.full(len(boxed), -np.inf)
    level[best.target] = best.upper[:, 2]
    rests_there &= contacts.upper[:, 2] >= level[contacts.target] - _ROUNDING
    ratio = np.zeros(len(boxed))
    ratio[best.target] = best.ratio
    rests_there &= rounded(contacts.ratio) >= rounded(ratio[contacts.target])
    over = _highest(boxed, select_rows(contacts, rests_there))
    kept = select_rows(best, ~np.isin(best.target, over.target))
    return concatenate_rows([kept, over])


def _highest(boxed: BoxedObjects, contacts: _Contacts) -> _Contacts:
    owner, lowest = contacts.anchor, contacts.lower[:, 2]
    is_pierced = boxed.lower[owner, 2] > boxed.lower[contacts.target, 2] + _PIERCED
    keys = (boxed.rank[owner], -rounded(contacts.ratio), rounded(np.abs(contacts.gap)), -rounded(lowest), is_pierced)
    return select_rows(contacts, first_of_each_group(contacts.target, keys))


def _links(rule: str, contacts: _Contacts, confidence: Array) -> Links:
    numbers = {"gap": contacts.gap, "overlapRatio": contacts.ratio}
    return Links("on", rule, contacts.target, contacts.anchor, numbers, confidence)


def _on_several(boxed: BoxedObjects, contacts: _Contacts, rules: RelationRules) -> Links:
    rule = rules.on_several
    own = (contacts.upper - contacts.lower)[:, :2].prod(axis=1)
    share = np.minimum(ratios(contacts.area, own), 1.0)
    is_enough = share >= rule.min_anchor_ratio
    contacts, share = select_rows(contacts, is_enough), share[is_enough]
    # Keep the part of each anchor with the largest share.
    anchors = contacts.target * len(boxed) + contacts.anchor
    best = first_of_each_group(anchors, (np.arange(len(anchors)), -rounded(contacts.ratio)))
    contacts, share = select_rows(contacts, best), share[best]
    count = np.bincount(contacts.target, minlength=len(boxed))
    is_good = (count >= rule.min_anchors)[contacts.target] & _supports_center(boxed, contacts)[contacts.target]
    contacts, share = select_rows(contacts, is_good), share[is_good]
    clear = margin_above(share, rule.min_anchor_ratio)
    return _links(rule.rule, contacts, margin_score(margin_below(contacts.gap, contacts.allowed), clear))


def _supports_center(boxed: BoxedObjects, contacts: _Contacts) -> Mask:
    """Return whether the box around the supporters of each object covers its centre; else it would tip over."""
    low, high = np.full((len(boxed), 2), np.inf), np.full((len(boxed), 2), -np.inf)
    np.minimum.at(low, contacts.target, contacts.lower[:, :2])
    np.maximum.at(high, contacts.target, contacts.upper[:, :2])
    middle = boxed.middle[:, :2]
    return np.asarray(((low <= middle) & (high >= middle)).all(axis=1))
