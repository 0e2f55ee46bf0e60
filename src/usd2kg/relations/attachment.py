"""`attached-to`: what hangs from an object or is fixed to it, with nothing below."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, rounded, select_rows
from usd2kg.relations.backing import are_between
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.distances import box_gaps, exact_distances, surface_distances
from usd2kg.relations.fixtures import are_in_front_of_fixtures
from usd2kg.relations.holding import (
    Mounts,
    are_carried_by_target,
    are_closer_to_mounts,
    are_farther_than_holder,
    lead_to_mounts,
)
from usd2kg.relations.interlock import are_interlocked, are_over, held_at
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes import overlapping_pairs
from usd2kg.shapes.ragged import ragged_indices

__all__ = [
    "Attached",
    "find_attached",
    "find_doubtful",
    "find_held_at_mounts",
    "find_held_beside_support",
    "find_stuck",
]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_NO_MOUNT = 1.0
"""Metres added to the gap of an object beside the target, so that every wall, ceiling or object above is nearer."""
_HOOKED = -1.0
"""The same for an object that the target hangs from by a hook or a loop: nothing is nearer…"""
_RESTING = -2.0
"""…but what the target rests on."""


class Attached(NamedTuple):
    """What holds the objects of a scene."""

    links: Links
    """`attached-to`."""
    at_fixture: Mask
    """Whether each link leads to what is between the target and a wall or ceiling."""


def find_attached(
    boxed: BoxedObjects,
    classes: ClassMembership,
    stronger: StrongerRelations,
    rule: AttachedRule,
    *,
    needs_mount: bool,
    doubtful: Sequence[Links] = (),
    hovering: Links | None = None,
) -> Attached:
    """Return the `attached-to` links of objects that are on, in and part of nothing so far.

    Walls and ceilings hold whatever is within a few centimetres, other objects what touches them. What reaches down to
    the ground stands on it, and so does furniture on a plinth or legs, even where no floor is drawn. Walls and ceilings
    hold each other only where one lies on a much larger one, as a panel does. What goes through a hook, a pin or a
    rail hangs from it rather than from the wall behind.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        stronger: the relations found so far.
        rule: the thresholds.
        needs_mount: return only objects near a wall or ceiling, or on a hook with nothing below.
        hovering: `on` links across a gap, which do not count as found so far.
        doubtful: `on` links that do not count as found so far, see `find_doubtful`.
    """
    is_mount = classes.are_in("mounts")[boxed.scene_index]
    hangs = classes.are_in("hanging")[boxed.scene_index]
    targets = _hanging(boxed, classes, stronger, rule)
    is_doubtful = np.zeros(len(boxed), np.bool_)
    is_doubtful[[index for links in doubtful for index in links.target.tolist()]] = True
    # The box of a mesh of several walls does not locate the walls.
    is_located = boxed.has_surface | (boxed.size.min(axis=1) <= rule.max_wall_thickness) | ~is_mount
    is_loose = _are_loose_grounds(boxed, classes, rule)
    may_hold = is_located & (is_loose | ~classes.are_in("not_mounts")[boxed.scene_index])
    reach = np.where(hangs, rule.max_hanging_gap, rule.max_gap)
    pairs = _near_pairs(boxed, targets, np.flatnonzero(may_hold), is_mount, reach, rule)
    pairs = select_rows(pairs, ~stronger.are_related(pairs.target, pairs.anchor))
    pairs = select_rows(pairs, ~_are_held_by_target(boxed, pairs, stronger.holder))
    is_panel = is_mount[pairs.anchor] & _lie_on_much_larger(boxed, pairs, rule)
    pairs = select_rows(pairs, is_panel | ~is_mount[pairs.target])
    is_beside = ~pairs.hangs & ~is_mount[pairs.anchor]
    pairs = select_rows(pairs, ~(is_beside & _meet_below_middle(boxed, pairs, rule)))
    gap = surface_distances(boxed, pairs.target, pairs.anchor, pairs.limit)
    pairs = select_rows(pairs._replace(gap=gap), gap <= pairs.limit)
    pairs = _measured_exactly(boxed, pairs, is_mount)
    touches = pairs.locks & (pairs.gap <= rule.max_touch)
    is_free = np.zeros(len(boxed), np.bool_)
    is_free[targets] = True
    is_free &= ~is_mount
    pairs = pairs._replace(locks=touches & ~are_closer_to_mounts(pairs, is_free, is_mount, rule))
    at_mount = pairs.target[is_mount[pairs.anchor]]
    may_be_fixed = targets[~(hangs | is_mount)[targets]]
    pairs, fixed = _with_fixtures(boxed, pairs, may_be_fixed, is_mount, stronger, rule)
    pairs = select_rows(pairs, ~_are_backed(boxed, pairs, is_mount, rule))
    pairs = select_rows(pairs, ~are_carried_by_target(pairs, is_free, is_mount, rule))
    pairs = select_rows(pairs, ~are_farther_than_holder(boxed, pairs, is_free, is_mount, hangs, rule))
    pairs = select_rows(pairs, ~_are_rooted_elsewhere(boxed, pairs, np.flatnonzero(may_hold), is_mount, hangs, rule))
    pairs = select_rows(pairs, ~_hover_below(boxed, pairs, is_mount, hangs, rule))
    if needs_mount:
        hovers = np.zeros(0, np.int64) if hovering is None else _target_of_unhooked(hovering, pairs, len(boxed))
        is_hooked = pairs.locks & ~np.isin(pairs.target, hovers)
        # What seems to rest, and what another object hooks on, hangs from what it touches.
        leads = lead_to_mounts(pairs, is_free, is_mount, rule)
        leads &= is_doubtful[pairs.target] | np.isin(pairs.target, pairs.anchor[pairs.locks])
        kept = np.isin(pairs.target, np.concatenate([at_mount, pairs.target[is_hooked | leads]]))
        kept |= _are_reversed(pairs, doubtful, len(boxed))
        pairs = select_rows(pairs, kept)
    # What rests on something, as far as known, hangs from a mount, a hook or what leads to a mount, or not at all, and
    # only a hook hangs on it.
    is_firm = is_mount[pairs.anchor] | lead_to_mounts(pairs, is_free, is_mount, rule)
    is_firm = pairs.locks | (is_firm & ~is_doubtful[pairs.anchor])
    is_firm |= pairs.hangs & _are_reversed(pairs, doubtful, len(boxed))
    pairs = select_rows(pairs, is_firm | ~(is_doubtful[pairs.target] | is_doubtful[pairs.anchor]))
    rests = [links.where(~hangs[links.target]) for links in doubtful]
    # A screw that only partly rests on what it is in front of is stuck in it.
    juts = [np.isin(links.target, fixed) & (links.numbers["overlapRatio"] < rule.min_borne) for links in rests]
    rests = [links.where(~is_jutting) for links, is_jutting in zip(rests, juts, strict=True)]
    pairs = concatenate_rows([pairs, *map(_resting, rests)])
    best = _nearest_held(boxed, pairs, is_mount, rule)
    best = select_rows(best, ~best.rests & ~_are_beside_unheld(boxed, best, targets, is_mount, rule))
    confidence = margin_score(margin_below(np.clip(best.gap, 0, None), best.limit))
    links = Links("attached-to", rule.rule, best.target, best.anchor, {"gap": best.gap}, confidence)
    return Attached(links, np.isin(best.target, fixed))


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
    dangles[_hanging(boxed, classes, stronger, rule)] = True
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
            doubtful[links.target[leads]] = True
        if doubtful.sum() == count:
            return doubtful


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
    hanging = _high_enough(boxed, classes, targets[~is_mount[targets]], rule)
    reach = np.where(is_mount, 0.0, rule.max_contact)
    pairs = _near_pairs(boxed, hanging, np.flatnonzero(is_mount), is_mount, reach, rule)
    gap = surface_distances(boxed, pairs.target, pairs.anchor, pairs.limit)
    found = np.zeros(len(boxed), np.bool_)
    found[pairs.target[gap <= rule.max_contact]] = True
    return found


def _hanging(boxed: BoxedObjects, classes: ClassMembership, stronger: StrongerRelations, rule: AttachedRule) -> Indices:
    """Return the objects that are on, in and part of nothing so far, and too high above the ground to stand on it."""
    is_mount = classes.are_in("mounts")[boxed.scene_index]
    is_fixed = classes.are_in("not_attached") & ~classes.are_in("cases")
    may_hang = stronger.is_free & (is_mount | ~is_fixed[boxed.scene_index] | _are_loose_grounds(boxed, classes, rule))
    return _high_enough(boxed, classes, np.flatnonzero(may_hang), rule)


def _are_loose_grounds(boxed: BoxedObjects, classes: ClassMembership, rule: AttachedRule) -> Mask:
    """Return for each object whether it is a floor by its class, but too small for one: a tile, a board for tiles."""
    return np.asarray(classes.are_in("grounds")[boxed.scene_index] & (boxed.size < rule.max_loose_floor).all(axis=1))


def _high_enough(boxed: BoxedObjects, classes: ClassMembership, targets: Indices, rule: AttachedRule) -> Indices:
    """Return the targets that are too high above the ground to stand on it."""
    clearance = np.where(classes.are_in("standing")[boxed.scene_index], rule.max_plinth, rule.min_clearance)
    clearance[classes.are_in("hanging")[boxed.scene_index]] = 0.0
    return np.asarray(targets[boxed.lower[targets, 2] - _ground_below(boxed, targets, rule) >= clearance[targets]])


def _with_fixtures(
    boxed: BoxedObjects,
    pairs: Mounts,
    targets: Indices,
    is_mount: Mask,
    stronger: StrongerRelations,
    rule: AttachedRule,
) -> tuple[Mounts, Indices]:
    """Return the pairs with fixtures in place of the walls and ceilings behind them, and the objects on fixtures.

    Args:
        boxed: the objects.
        pairs: pairs of an object and what may hold it.
        targets: the objects that fixtures may hold.
        is_mount: whether each object is a wall or ceiling.
        stronger: the relations found so far.
        rule: the thresholds.
    """
    at_wall = np.flatnonzero(is_mount[pairs.anchor] & (pairs.gap <= rule.max_contact))
    keys = (boxed.rank[pairs.anchor[at_wall]], rounded(pairs.gap[at_wall]))
    at_wall = at_wall[first_of_each_group(pairs.target[at_wall], keys)]
    place = np.full(len(boxed), -1)
    place[pairs.target[at_wall]] = at_wall
    found = _touching(boxed, targets, pairs.target[at_wall], rule)
    found = select_rows(found, ~stronger.are_related(found.target, found.anchor))
    found = select_rows(found, ~_are_held_by_target(boxed, found, stronger.holder))
    wall = pairs.anchor[place[found.anchor]]
    count = len(boxed)
    keys = pairs.target * count + pairs.anchor
    order = np.argsort(keys, kind="stable")
    to_wall = np.append(order, -1)[np.searchsorted(keys[order], found.target * count + wall)]
    is_known = np.append(keys, -1)[to_wall] == found.target * count + wall
    gap = np.where(is_known, np.append(pairs.gap, np.inf)[to_wall], np.inf)
    gaps = (found.gap, gap, pairs.gap[place[found.anchor]])
    holds = are_in_front_of_fixtures(boxed, found.target, found.anchor, wall, *gaps, rule)
    found, wall = select_rows(found, holds), wall[holds]
    replaced = np.concatenate([found.target * count + wall, found.anchor * count + found.target])
    is_left = pairs.hangs | is_mount[pairs.anchor] | ~np.isin(pairs.target, found.target)
    is_left &= ~np.isin(keys, np.concatenate([replaced, found.target * count + found.anchor]))
    return concatenate_rows([select_rows(pairs, is_left), found]), found.target


def _touching(boxed: BoxedObjects, targets: Indices, holders: Indices, rule: AttachedRule) -> Mounts:
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
    return _measured_exactly(boxed, pairs, np.zeros(len(boxed), np.bool_))


def _measured_exactly(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask) -> Mounts:
    """Return the pairs within their limits by the exact distance of their surfaces: oblique ones may only seem to meet.

    Walls and ceilings hold what is near, so that the boxes of their triangles will do.
    """
    some = np.flatnonzero(~is_mount[pairs.anchor] & (boxed.has_surface[pairs.target] | boxed.has_surface[pairs.anchor]))
    gap = pairs.gap.copy()
    exact = exact_distances(boxed, pairs.target[some], pairs.anchor[some], pairs.limit[some])
    gap[some] = np.where(exact > 0, np.maximum(exact, gap[some]), gap[some])
    return select_rows(pairs._replace(gap=gap), gap <= pairs.limit)


def _are_reversed(pairs: Mounts, links: Sequence[Links], count: int) -> Mask:
    """Return for each pair whether the anchor is linked to the target: it may hang from what seems to rest on it."""
    keys = np.concatenate([np.zeros(0, np.int64), *(found.anchor * count + found.target for found in links)])
    return np.isin(pairs.target * count + pairs.anchor, keys)


def _target_of_unhooked(hovering: Links, pairs: Mounts, count: int) -> Indices:
    """Return the targets of links whose anchors do not hang from them by a hook."""
    hooked = (pairs.anchor * count + pairs.target)[pairs.locks]
    return np.asarray(hovering.target[~np.isin(hovering.target * count + hovering.anchor, hooked)])


def _resting(links: Links) -> Mounts:
    count = len(links.target)
    no, yes = np.zeros(count, np.bool_), np.ones(count, np.bool_)
    return Mounts(links.target, links.anchor, np.zeros(count), np.full(count, np.inf), no, no, yes)


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


def _ground_below(boxed: BoxedObjects, targets: Indices, rule: AttachedRule) -> Array:
    """Return the lowest height of any object around each target, in metres: that of the floor or the foot of a wall.

    Large objects count if their box is within reach, small ones if their middle is in the same square or one beside it.
    """
    cell = rule.ground_reach
    lowest = boxed.lower[targets, 2].copy()
    is_large = boxed.size[:, :2].max(axis=1) > 2 * cell
    large, small = np.flatnonzero(is_large), np.flatnonzero(~is_large)
    lower, upper = boxed.lower[targets, :2] - cell, boxed.upper[targets, :2] + cell
    for i, j in overlapping_pairs(lower, upper, (boxed.lower[large, :2], boxed.upper[large, :2])):
        np.minimum.at(lowest, i, boxed.lower[large[j], 2])
    squares, which = np.unique(_squares(boxed, small, cell), axis=0, return_inverse=True)
    height = np.full(len(squares), np.inf)
    np.minimum.at(height, which.reshape(-1), boxed.lower[small, 2])
    known = dict(zip(map(tuple, squares.tolist()), height.tolist(), strict=True))
    for place, (x, y) in enumerate(_squares(boxed, targets, cell).tolist()):
        around = (known.get((x + dx, y + dy), np.inf) for dx in (-1, 0, 1) for dy in (-1, 0, 1))
        lowest[place] = min(lowest[place], *around)
    return np.asarray(lowest)


def _squares(boxed: BoxedObjects, chosen: Indices, side: float) -> Indices:
    return np.floor(boxed.middle[chosen, :2] / side).astype(np.int64)


def _near_pairs(
    boxed: BoxedObjects, targets: Indices, holders: Indices, is_mount: Mask, reach: Array, rule: AttachedRule
) -> Mounts:
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


def _are_held_by_target(boxed: BoxedObjects, pairs: Mounts, holder: Indices) -> Mask:
    """Return for each pair whether the anchor is nested below the target, or held by it by way of other objects."""
    here, found = holder[pairs.anchor], np.zeros(len(pairs.target), np.bool_)
    for _ in range(len(holder)):
        found |= here == pairs.target
        if not (here >= 0).any():
            break
        here = np.where((here >= 0) & ~found, holder[here], -1)
    paths = [obj.prim_path for obj in boxed.objects]
    ends = zip(pairs.target.tolist(), pairs.anchor.tolist(), strict=True)
    nested = [paths[anchor].startswith(f"{paths[target]}/") for target, anchor in ends]
    return np.asarray(found | np.array(nested, np.bool_))


def _meet_below_middle(boxed: BoxedObjects, pairs: Mounts, rule: AttachedRule) -> Mask:
    """Return for each pair whether two upright faces meet, all below the middle of the target, which would tip over."""
    gaps = box_gaps(boxed, pairs.target, pairs.anchor)
    meet = (gaps[:, :2].max(axis=1) >= -rule.max_contact) & (gaps[:, 2] < 0)
    return np.asarray(meet & (boxed.upper[pairs.anchor, 2] < boxed.middle[pairs.target, 2]))


def _lie_on_much_larger(boxed: BoxedObjects, pairs: Mounts, rule: AttachedRule) -> Mask:
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


def _are_backed(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask, rule: AttachedRule) -> Mask:
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


def _are_rooted_elsewhere(
    boxed: BoxedObjects, pairs: Mounts, holders: Indices, is_mount: Mask, hangs: Mask, rule: AttachedRule
) -> Mask:
    """Return for each pair whether the anchor is a wall apart from the target, which something else holds below.

    The target goes into something that is smaller, or the wall is hardly within reach and it only touches it: a plant
    in its soil, a lamp shade on its foot.
    """
    is_apart = is_mount[pairs.anchor] & (pairs.gap > rule.max_contact) & ~hangs[pairs.target]
    below = _touching(boxed, np.unique(pairs.target[is_apart]), holders[~is_mount[holders]], rule)
    below = select_rows(below, boxed.upper[below.anchor, 2] <= boxed.middle[below.target, 2])
    below = select_rows(below, are_over(boxed, below.target, below.anchor))
    is_rooted, is_touched = np.zeros(len(boxed), np.bool_), np.zeros(len(boxed), np.bool_)
    enters = are_interlocked(boxed, below.target, below.anchor, rule.min_interlock) & (below.gap <= rule.max_touch)
    is_rooted[below.target[enters]] = True
    is_touched[below.target] = True
    is_weak = pairs.gap >= rule.min_weak_share * pairs.limit
    return np.asarray(is_apart & (is_rooted[pairs.target] | (is_weak & is_touched[pairs.target])))


def _hover_below(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask, hangs: Mask, rule: AttachedRule) -> Mask:
    """Return for each pair whether the anchor is above the target without touching it, and another one is nearer.

    The door of a base cabinet is not hung from the worktop.
    """
    is_beside = ~pairs.hangs & ~is_mount[pairs.anchor]
    nearest = np.full(len(boxed), np.inf)
    np.minimum.at(nearest, pairs.target[is_beside], pairs.gap[is_beside])
    hovers = pairs.hangs & ~is_mount[pairs.anchor] & ~hangs[pairs.target] & (pairs.gap > rule.max_touch)
    return np.asarray(hovers & (nearest[pairs.target] < pairs.gap))


def _are_beside_unheld(
    boxed: BoxedObjects, pairs: Mounts, targets: Indices, is_mount: Mask, rule: AttachedRule
) -> Mask:
    """Return for each pair whether the target is beside an object that nothing holds and that is not much larger.

    Neither of two wall cupboards holds the other if their wall is not drawn.

    Args:
        boxed: the objects.
        pairs: the best pair of each target.
        targets: the objects that neither stand nor are on, in or part of anything.
        is_mount: whether each object is a wall or ceiling.
        rule: the thresholds.
    """
    is_unheld = np.zeros(len(boxed), np.bool_)
    is_unheld[targets] = True
    is_unheld[is_mount] = False
    is_unheld[pairs.target] = False
    is_comparable = boxed.volume[pairs.anchor] < rule.min_bearing_ratio * boxed.volume[pairs.target]
    may_drop = ~(pairs.hangs | pairs.locks) & ~is_mount[pairs.anchor] & is_comparable
    dropped = np.zeros(len(pairs.target), np.bool_)
    while (more := may_drop & ~dropped & is_unheld[pairs.anchor]).any():
        dropped |= more
        is_unheld[pairs.target[more]] = True
    return dropped


def _nearest_held(boxed: BoxedObjects, pairs: Mounts, is_mount: Mask, rule: AttachedRule) -> Mounts:
    """Return the best anchor of each target, from what is held to what hangs from it.

    What the target hangs from by a hook comes before the wall behind, at least if that does not touch the target. A
    wall or ceiling takes precedence over an object beside the target, and over one above that is hardly nearer.
    """
    pending = np.zeros(len(boxed), np.bool_)
    pending[pairs.target] = True
    penalty = np.where(pairs.hangs, rule.mount_preference, _NO_MOUNT)
    distance = np.clip(pairs.gap, 0, None) + np.where(is_mount[pairs.anchor], 0.0, penalty)
    distance = np.where(pairs.locks, np.where(pairs.hangs, _HOOKED, rule.max_touch), distance)
    distance[pairs.rests] = _RESTING
    chosen = [np.zeros(0, np.int64)]
    while True:
        first = _best(boxed, pairs, np.flatnonzero(pending[pairs.target]), distance)
        best = first[~pending[pairs.anchor[first]]]
        if not len(best):
            # The rest hang from each other; begin with those that something else holds more closely than their best.
            is_held = pending[pairs.target] & ~pending[pairs.anchor]
            best = _best(boxed, pairs, np.flatnonzero(is_held), distance)
            closer = _held_more_closely(boxed, pairs, first, best, distance, rule.max_touch)
            best = closer if len(closer) else best
            touching = best[distance[best] <= rule.max_contact]
            best = touching if len(touching) else best
        if not len(best):
            break
        chosen.append(best)
        pending[pairs.target[best]] = False
    return select_rows(pairs, np.sort(np.concatenate(chosen)))


def _held_more_closely(
    boxed: BoxedObjects, pairs: Mounts, first: Indices, held: Indices, distance: Array, margin: float
) -> Indices:
    """Return the pairs of `held` whose targets are closer to what is held than their best anchor, of `first`, is.

    Within the margin, what hangs on a hook waits for the hook.
    """
    nearest, slack = np.full(len(boxed), np.inf), np.full(len(boxed), margin)
    nearest[pairs.target[held]] = distance[held]
    desired = np.full(len(boxed), -1)
    desired[pairs.target[first]] = pairs.anchor[first]
    slack[pairs.target[first[pairs.locks[first]]]] = -margin
    target = pairs.target[held]
    return np.asarray(held[distance[held] <= nearest[desired[target]] + slack[target]])


def _best(boxed: BoxedObjects, pairs: Mounts, some: Indices, distance: Array) -> Indices:
    keys = (boxed.rank[pairs.anchor[some]], rounded(distance[some]))
    return np.asarray(some[first_of_each_group(pairs.target[some], keys)])
