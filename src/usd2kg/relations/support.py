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
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.foot_contacts import ROUNDING, Contacts, Limits, are_balanced, find_contacts
from usd2kg.relations.model import Links, margin_above, margin_below, margin_score
from usd2kg.relations.thresholds import OnRule, RelationRules

__all__ = ["Support", "find_support", "support_links"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_PIERCED = 2e-3
"""Metres by which an object may reach through all of what supports it."""


class Support(NamedTuple):
    """What supports the objects of a scene."""

    links: list[Links]
    """`on` with one anchor, and with several that support the target jointly."""
    near: Contacts
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
    limits = Limits(tolerance, is_ground, hangs, rules)
    around = find_contacts(boxed, np.flatnonzero(may_rest), can_support, limits)
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
    fits |= broad & bears & are_balanced(boxed, contacts) & ~np.isin(contacts.target, several.target)
    return Support([_on_single(boxed, select_rows(contacts, fits), rules.on), several], near, at_floor)


def _are_of_wholes(boxed: BoxedObjects, contacts: Contacts, wholes: Indices) -> Mask:
    """Return for each contact whether the anchor is a part of another anchor that reaches as high: a cabinet's door."""
    is_part, is_low = wholes[contacts.anchor] >= 0, np.zeros(len(contacts.anchor), np.bool_)
    near = np.flatnonzero(np.isin(contacts.target, contacts.target[is_part]))
    keys = contacts.target[near] * len(boxed) + contacts.anchor[near]
    level = dict(zip(keys.tolist(), contacts.upper[near, 2].tolist(), strict=True))
    for row in np.flatnonzero(is_part).tolist():
        whole = int(contacts.target[row] * len(boxed) + wholes[contacts.anchor[row]])
        is_low[row] = level.get(whole, -np.inf) >= contacts.upper[row, 2] - ROUNDING
    return is_low


def _are_within(boxed: BoxedObjects, inner: Indices, outer: Indices) -> Mask:
    """Return for each pair whether the middle of the first is in the box of another one, which is smaller than that."""
    middle = boxed.middle[inner]
    is_in = ((middle >= boxed.lower[outer]) & (middle <= boxed.upper[outer])).all(axis=1)
    return np.asarray(is_in & (boxed.volume[inner] < boxed.volume[outer]) & (inner != outer))


def _on_single(boxed: BoxedObjects, contacts: Contacts, rule: OnRule) -> Links:
    best = _best(boxed, contacts)
    is_round = is_on_cycle(_pointers(boxed, best), best.target)
    # If two sheets at the same height support each other, the larger one is the supporter.
    best = select_rows(best, ~is_round | (boxed.area[best.target] < boxed.area[best.anchor]))
    best = select_rows(best, ~is_on_cycle(_pointers(boxed, best), best.target))
    over = margin_above(best.ratio, rule.min_overlap_ratio)
    return support_links(rule.rule, best, margin_score(margin_below(best.gap, best.allowed), over))


def _pointers(boxed: BoxedObjects, contacts: Contacts) -> Indices:
    pointers = np.full(len(boxed), -1)
    pointers[contacts.target] = contacts.anchor
    return pointers


def _best(boxed: BoxedObjects, contacts: Contacts) -> Contacts:
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
    rests_there &= contacts.upper[:, 2] >= level[contacts.target] - ROUNDING
    ratio = np.zeros(len(boxed))
    ratio[best.target] = best.ratio
    rests_there &= rounded(contacts.ratio) >= rounded(ratio[contacts.target])
    over = _highest(boxed, select_rows(contacts, rests_there))
    kept = select_rows(best, ~np.isin(best.target, over.target))
    return concatenate_rows([kept, over])


def _highest(boxed: BoxedObjects, contacts: Contacts) -> Contacts:
    owner, lowest = contacts.anchor, contacts.lower[:, 2]
    is_pierced = boxed.lower[owner, 2] > boxed.lower[contacts.target, 2] + _PIERCED
    keys = (boxed.rank[owner], -rounded(contacts.ratio), rounded(np.abs(contacts.gap)), -rounded(lowest), is_pierced)
    return select_rows(contacts, first_of_each_group(contacts.target, keys))


def support_links(rule: str, contacts: Contacts, confidence: Array) -> Links:
    """Return `on` links of contacts by a rule, with their gaps in metres and their ratios."""
    numbers = {"gap": contacts.gap, "overlapRatio": contacts.ratio}
    return Links("on", rule, contacts.target, contacts.anchor, numbers, confidence)


def _on_several(boxed: BoxedObjects, contacts: Contacts, rules: RelationRules) -> Links:
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
    return support_links(rule.rule, contacts, margin_score(margin_below(contacts.gap, contacts.allowed), clear))


def _supports_center(boxed: BoxedObjects, contacts: Contacts) -> Mask:
    """Return whether the box around the supporters of each object covers its centre; else it would tip over."""
    low, high = np.full((len(boxed), 2), np.inf), np.full((len(boxed), 2), -np.inf)
    np.minimum.at(low, contacts.target, contacts.lower[:, :2])
    np.maximum.at(high, contacts.target, contacts.upper[:, :2])
    middle = boxed.middle[:, :2]
    return np.asarray(((low <= middle) & (high >= middle)).all(axis=1))
