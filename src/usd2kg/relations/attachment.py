"""`attached-to`: what hangs from an object or is fixed to it, with nothing below."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, rounded, select_rows
from usd2kg.relations.backing import are_between
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.distances import box_gaps, surface_distances
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes import overlapping_pairs
from usd2kg.shapes.ragged import ragged_indices

__all__ = ["find_attached", "find_held_beside_support"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_NO_MOUNT = 1.0
"""Metres added to the gap of an object beside the target, so that every wall, ceiling or object above is nearer."""


class _Mounts(NamedTuple):
    """Pairs of an object without support and one that may hold it."""

    target: Indices
    anchor: Indices
    gap: Array
    limit: Array
    """Largest gap, metres."""
    hangs: Mask
    """Whether the anchor is above the middle of the target."""


def find_attached(
    boxed: BoxedObjects,
    classes: ClassMembership,
    stronger: StrongerRelations,
    rule: AttachedRule,
    *,
    needs_mount: bool,
) -> Links:
    """Return the `attached-to` links of objects that are on, in and part of nothing so far.

    Walls and ceilings hold whatever is within a few centimetres, other objects what touches them. What reaches down to
    the ground stands on it, and so does furniture on a plinth or legs, even where no floor is drawn. Walls and ceilings
    hold each other only where one lies on a much larger one, as a panel does.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        stronger: the relations found so far.
        rule: the thresholds.
        needs_mount: return only objects near a wall or ceiling.
    """
    is_mount = classes.are_in("mounts")[boxed.scene_index]
    may_hang = stronger.is_free & (is_mount | ~classes.are_in("not_attached")[boxed.scene_index])
    clearance = np.where(classes.are_in("standing")[boxed.scene_index], rule.max_plinth, rule.min_clearance)
    hangs = classes.are_in("hanging")[boxed.scene_index]
    clearance[hangs] = 0.0
    targets = np.flatnonzero(may_hang)
    targets = targets[boxed.lower[targets, 2] - _ground_below(boxed, targets, rule) >= clearance[targets]]
    # The box of a mesh of several walls does not locate the walls.
    is_located = boxed.has_surface | (boxed.size.min(axis=1) <= rule.max_wall_thickness) | ~is_mount
    may_hold = is_located & ~classes.are_in("not_mounts")[boxed.scene_index]
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
    pairs = select_rows(pairs, ~_are_backed(boxed, pairs, is_mount, rule))
    if needs_mount:
        pairs = select_rows(pairs, np.isin(pairs.target, pairs.target[is_mount[pairs.anchor]]))
    best = _nearest_held(boxed, pairs, is_mount, rule)
    best = select_rows(best, ~_are_beside_unheld(boxed, best, targets, is_mount, rule))
    confidence = margin_score(margin_below(np.clip(best.gap, 0, None), best.limit))
    return Links("attached-to", rule.rule, best.target, best.anchor, {"gap": best.gap}, confidence)


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
) -> _Mounts:
    widest = np.maximum(reach, rule.max_contact)[:, None]
    lower, upper = boxed.lower - widest, boxed.upper + widest
    none = np.zeros(0, np.int64)
    found = [_Mounts(none, none, np.zeros(0), np.zeros(0), np.zeros(0, np.bool_))]
    others = boxed.lower[holders], boxed.upper[holders]
    for i, j in overlapping_pairs(lower[targets], upper[targets], others):
        target, anchor = targets[i], holders[j]
        hangs = boxed.lower[anchor, 2] >= boxed.middle[target, 2]
        limit = np.where(is_mount[anchor], reach[target], rule.max_contact)
        is_near = (lower[target, 2] <= boxed.upper[anchor, 2]) & (upper[target, 2] >= boxed.lower[anchor, 2])
        is_near &= (target != anchor) & (is_mount[anchor] | hangs | (boxed.volume[anchor] > boxed.volume[target]))
        found.append(select_rows(_Mounts(target, anchor, np.zeros(len(target)), limit, hangs), is_near))
    return concatenate_rows(found)


def _are_held_by_target(boxed: BoxedObjects, pairs: _Mounts, holder: Indices) -> Mask:
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


def _meet_below_middle(boxed: BoxedObjects, pairs: _Mounts, rule: AttachedRule) -> Mask:
    """Return for each pair whether two upright faces meet, all below the middle of the target, which would tip over."""
    gaps = box_gaps(boxed, pairs.target, pairs.anchor)
    meet = (gaps[:, :2].max(axis=1) >= -rule.max_contact) & (gaps[:, 2] < 0)
    return np.asarray(meet & (boxed.upper[pairs.anchor, 2] < boxed.middle[pairs.target, 2]))


def _lie_on_much_larger(boxed: BoxedObjects, pairs: _Mounts, rule: AttachedRule) -> Mask:
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


def _are_backed(boxed: BoxedObjects, pairs: _Mounts, is_mount: Mask, rule: AttachedRule) -> Mask:
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


def _are_beside_unheld(
    boxed: BoxedObjects, pairs: _Mounts, targets: Indices, is_mount: Mask, rule: AttachedRule
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
    may_drop = ~pairs.hangs & ~is_mount[pairs.anchor] & is_comparable
    dropped = np.zeros(len(pairs.target), np.bool_)
    while (more := may_drop & ~dropped & is_unheld[pairs.anchor]).any():
        dropped |= more
        is_unheld[pairs.target[more]] = True
    return dropped


def _nearest_held(boxed: BoxedObjects, pairs: _Mounts, is_mount: Mask, rule: AttachedRule) -> _Mounts:
    """Return the best anchor of each target, from what is held to what hangs from it.

    A wall or ceiling takes precedence over an object beside the target, and over one above that is hardly nearer.
    """
    pending = np.zeros(len(boxed), np.bool_)
    pending[pairs.target] = True
    penalty = np.where(pairs.hangs, rule.mount_preference, _NO_MOUNT)
    distance = np.clip(pairs.gap, 0, None) + np.where(is_mount[pairs.anchor], 0.0, penalty)
    chosen = [np.zeros(0, np.int64)]
    while True:
        best = _best(boxed, pairs, np.flatnonzero(pending[pairs.target]), distance)
        best = best[~pending[pairs.anchor[best]]]
        if not len(best):
            # The rest hang from each other; begin with those that something else holds.
            is_held = pending[pairs.target] & ~pending[pairs.anchor]
            best = _best(boxed, pairs, np.flatnonzero(is_held), distance)
        if not len(best):
            break
        chosen.append(best)
        pending[pairs.target[best]] = False
    return select_rows(pairs, np.sort(np.concatenate(chosen)))


def _best(boxed: BoxedObjects, pairs: _Mounts, some: Indices, distance: Array) -> Indices:
    keys = (boxed.rank[pairs.anchor[some]], rounded(distance[some]))
    return np.asarray(some[first_of_each_group(pairs.target[some], keys)])
