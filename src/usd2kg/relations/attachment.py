"""`attached-to`: what hangs from an object or is fixed to it, with nothing below."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.distances import surface_distances
from usd2kg.relations.fixtures import put_fixtures_before_walls
from usd2kg.relations.hangable import are_loose_grounds, find_hangable
from usd2kg.relations.holding import (
    Mounts,
    are_carried_by_target,
    are_closer_to_mounts,
    are_farther_than_holder,
    lead_to_mounts,
)
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.mount_pairs import are_held_by_target, find_near_pairs, measured_exactly
from usd2kg.relations.nearest_held import are_beside_unheld, find_nearest_held
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.relations.unlikely_mounts import (
    are_backed,
    are_rooted_elsewhere,
    hover_below,
    lie_on_much_larger,
    meet_below_middle,
)

__all__ = ["Attached", "find_attached"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


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
    targets = find_hangable(boxed, classes, stronger, rule)
    is_doubtful = np.zeros(len(boxed), np.bool_)
    is_doubtful[[index for links in doubtful for index in links.target.tolist()]] = True
    holders = _find_holders(boxed, classes, is_mount, rule)
    pairs = _measure_pairs(boxed, stronger, targets, holders, is_mount, hangs, rule)
    touches = pairs.locks & (pairs.gap <= rule.max_touch)
    is_free = np.zeros(len(boxed), np.bool_)
    is_free[targets] = True
    is_free &= ~is_mount
    pairs = pairs._replace(locks=touches & ~are_closer_to_mounts(pairs, is_free, is_mount, rule))
    at_mount = pairs.target[is_mount[pairs.anchor]]
    may_be_fixed = targets[~(hangs | is_mount)[targets]]
    pairs, fixed = put_fixtures_before_walls(boxed, pairs, may_be_fixed, is_mount, stronger, rule)
    pairs = select_rows(pairs, ~are_backed(boxed, pairs, is_mount, rule))
    pairs = select_rows(pairs, ~are_carried_by_target(pairs, is_free, is_mount, rule))
    pairs = select_rows(pairs, ~are_farther_than_holder(boxed, pairs, is_free, is_mount, hangs, rule))
    pairs = select_rows(pairs, ~are_rooted_elsewhere(boxed, pairs, holders, is_mount, hangs, rule))
    pairs = select_rows(pairs, ~hover_below(boxed, pairs, is_mount, hangs, rule))
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
    pairs = concatenate_rows([pairs, *_resting_pairs(doubtful, hangs, fixed, rule)])
    best = find_nearest_held(boxed, pairs, is_mount, rule)
    best = select_rows(best, ~best.rests & ~are_beside_unheld(boxed, best, targets, is_mount, rule))
    confidence = margin_score(margin_below(np.clip(best.gap, 0, None), best.limit))
    links = Links("attached-to", rule.rule, best.target, best.anchor, {"gap": best.gap}, confidence)
    return Attached(links, np.isin(best.target, fixed))


def _are_reversed(pairs: Mounts, links: Sequence[Links], count: int) -> Mask:
    """Return for each pair whether the anchor is linked to the target: it may hang from what seems to rest on it."""
    keys = np.concatenate([np.zeros(0, np.int64), *(found.anchor * count + found.target for found in links)])
    return np.isin(pairs.target * count + pairs.anchor, keys)


def _target_of_unhooked(hovering: Links, pairs: Mounts, count: int) -> Indices:
    """Return the targets of links whose anchors do not hang from them by a hook."""
    hooked = (pairs.anchor * count + pairs.target)[pairs.locks]
    return np.asarray(hovering.target[~np.isin(hovering.target * count + hovering.anchor, hooked)])


def _resting_pairs(doubtful: Sequence[Links], hangs: Mask, fixed: Indices, rule: AttachedRule) -> Iterator[Mounts]:
    """Yield the pairs of targets and what they seem to rest on.

    A screw that only partly rests on what it is in front of is stuck in it.
    """
    for links in doubtful:
        is_stuck = np.isin(links.target, fixed) & (links.numbers["overlapRatio"] < rule.min_borne)
        rests = links.where(~hangs[links.target] & ~is_stuck)
        count = len(rests.target)
        no, yes = np.zeros(count, np.bool_), np.ones(count, np.bool_)
        yield Mounts(rests.target, rests.anchor, np.zeros(count), np.full(count, np.inf), no, no, yes)


def _find_holders(boxed: BoxedObjects, classes: ClassMembership, is_mount: Mask, rule: AttachedRule) -> Indices:
    """Return the objects that others may be attached to."""
    # The box of a mesh of several walls does not locate the walls.
    is_located = boxed.has_surface | (boxed.size.min(axis=1) <= rule.max_wall_thickness) | ~is_mount
    is_loose = are_loose_grounds(boxed, classes, rule)
    return np.flatnonzero(is_located & (is_loose | ~classes.are_in("not_mounts")[boxed.scene_index]))


def _measure_pairs(
    boxed: BoxedObjects,
    stronger: StrongerRelations,
    targets: Indices,
    holders: Indices,
    is_mount: Mask,
    hangs: Mask,
    rule: AttachedRule,
) -> Mounts:
    """Return the pairs of a target and a holder within reach, whose gaps are measured."""
    reach = np.where(hangs, rule.max_hanging_gap, rule.max_gap)
    pairs = find_near_pairs(boxed, targets, holders, is_mount, reach, rule)
    pairs = select_rows(pairs, ~stronger.are_related(pairs.target, pairs.anchor))
    pairs = select_rows(pairs, ~are_held_by_target(boxed, pairs, stronger.holder))
    is_panel = is_mount[pairs.anchor] & lie_on_much_larger(boxed, pairs, rule)
    pairs = select_rows(pairs, is_panel | ~is_mount[pairs.target])
    is_beside = ~pairs.hangs & ~is_mount[pairs.anchor]
    pairs = select_rows(pairs, ~(is_beside & meet_below_middle(boxed, pairs, rule)))
    gap = surface_distances(boxed, pairs.target, pairs.anchor, pairs.limit)
    return measured_exactly(boxed, select_rows(pairs._replace(gap=gap), gap <= pairs.limit), is_mount)
