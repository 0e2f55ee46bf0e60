"""Contacts: the surfaces near the feet of objects, by boxes and by meshes."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, ratios, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects, corners_of, overlap_areas
from usd2kg.relations.pair_blocks import measure_in_blocks
from usd2kg.relations.protrusions import has_protrusion
from usd2kg.relations.surface_contact import Standing, measure_contacts
from usd2kg.relations.thresholds import RelationRules
from usd2kg.scene import Box
from usd2kg.shapes import overlapping_pairs

__all__ = ["ROUNDING", "Contacts", "Limits", "are_balanced", "find_contacts"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

ROUNDING = 1e-5
"""Metres: heights that differ by less are equal."""


class Contacts(NamedTuple):
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


class Limits(NamedTuple):
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


def find_contacts(boxed: BoxedObjects, targets: Indices, can_support: Mask, limits: Limits) -> Contacts:
    """Return the surfaces near the feet of objects, and how they meet.

    Args:
        boxed: the objects.
        targets: indices of those that may rest on others.
        can_support: whether each object may support others.
        limits: how far the feet may be off.
    """
    tops = _box_tops(boxed, can_support & ~boxed.has_surface, limits.rules)
    surfaces = _on_surfaces(boxed, targets, np.flatnonzero(can_support & boxed.has_surface), limits)
    found = concatenate_rows([*_on_boxes(boxed, targets, tops, limits), *surfaces])
    # The ground has no underside.
    found.lower[limits.is_ground[found.anchor], 2] = -np.inf
    is_good = (
        (found.anchor != found.target)
        # The underside of a supporter is below the target's bottom; that of an object beside it is not.
        & ((found.lower[:, 2] < boxed.lower[found.target, 2] - ROUNDING) | _are_draped(boxed, found, limits.rules))
        & ~(limits.is_ground[found.anchor] & limits.hangs[found.target])
    )
    return select_rows(found, is_good)


def are_balanced(boxed: BoxedObjects, contacts: Contacts) -> Mask:
    """Return for each pair whether the supporter is below the centre of the target, as the stand of a basin is."""
    middle = boxed.middle[contacts.target, :2]
    return np.asarray(((contacts.lower[:, :2] <= middle) & (middle <= contacts.upper[:, :2])).all(axis=1))


def _are_draped(boxed: BoxedObjects, contacts: Contacts, rules: RelationRules) -> Mask:
    """Return for each pair whether the target lies over the anchor like a cloth over a table or a helmet over a ball.

    What supports it is wider than it reaches down beside it; a towel over a rail hangs.
    """
    level = contacts.upper[:, 2] + contacts.gap
    depth = level - boxed.lower[contacts.target, 2]
    is_wide = (depth > rules.on.max_sink) & (contacts.area >= depth**2) & (contacts.lower[:, 2] < level - ROUNDING)
    return np.asarray(is_wide & are_balanced(boxed, contacts))


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


def _on_boxes(boxed: BoxedObjects, targets: Indices, tops: _Tops, limits: Limits) -> Iterator[Contacts]:
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
        yield Contacts(target, tops.owner[number], gap, ratio, shared, allowed, tops.lower[number], tops.upper[number])


def _foot_space(boxed: BoxedObjects, targets: Indices, highest: Array, limits: Limits) -> tuple[Array, Array]:
    """Return the corners (n, 3) of the space in which the surface that supports an object is: around its feet.

    Args:
        boxed: the objects.
        targets: their indices.
        highest: metres that each object may be above the surface.
        limits: how far it may sink into it.
    """
    lower, upper = (corners[targets].copy() for corners in boxed.feet)
    bottom = boxed.lower[targets, 2]
    lower[:, 2] = bottom - highest[targets] - ROUNDING
    # Half its height in the ground.
    deepest = np.maximum(limits.tolerance[targets], limits.rules.on.max_sink)
    upper[:, 2] = bottom + np.maximum(deepest, boxed.size[targets, 2] / 2) + ROUNDING
    return lower, upper


def _on_surfaces(boxed: BoxedObjects, targets: Indices, anchors: Indices, limits: Limits) -> Iterator[Contacts]:
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
    boxed: BoxedObjects, target: Indices, anchor: Indices, points: Mapping[int, Array], limits: Limits
) -> Contacts:
    return measure_in_blocks(lambda some: _measure_some(boxed, target[some], anchor[some], points, limits), len(target))


def _measure_some(
    boxed: BoxedObjects, target: Indices, anchor: Indices, points: Mapping[int, Array], limits: Limits
) -> Contacts:
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
    return Contacts(target, anchor, found.gap, found.ratio, found.area, found.allowed, lower, upper)


def _feet_over(boxed: BoxedObjects, targets: Indices, anchors: Indices, limits: Limits) -> tuple[Indices, Indices]:
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
