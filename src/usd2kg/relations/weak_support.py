"""`on` of what nothing clearly supports: across a small gap, with few feet, or propped against something."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, rounded, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.foot_contacts import Contacts, are_balanced
from usd2kg.relations.model import Links, margin_above, margin_below, margin_score
from usd2kg.relations.support import support_links
from usd2kg.relations.thresholds import RelationRules

__all__ = ["are_unbalanced", "find_hovering", "find_propped"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def find_hovering(
    boxed: BoxedObjects, near: Contacts, is_left: Mask, container: Indices, rules: RelationRules
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
    return support_links(rule.rule, best, margin_score(margin_below(best.gap, rule.max_gap), over))


def _partly_supported(boxed: BoxedObjects, near: Contacts, rules: RelationRules) -> Contacts:
    """Return the contacts of contents that no single surface supports: a roll on several rolls, a can on a wire."""
    touching = select_rows(near, (np.abs(near.gap) <= near.allowed) & (near.ratio > 0))
    shared = np.bincount(touching.target, touching.ratio, minlength=len(boxed))
    is_good = are_balanced(boxed, touching) | (shared > rules.on.min_overlap_ratio)[touching.target]
    touching = select_rows(touching, is_good & (touching.ratio >= rules.hovering.min_touching_ratio))
    keys = (boxed.rank[touching.anchor], -rounded(touching.ratio))
    return select_rows(touching, first_of_each_group(touching.target, keys))


def are_unbalanced(boxed: BoxedObjects, links: Links) -> Mask:
    """Return for each `on` link whether the anchor is not below the centre of the target."""
    middle = boxed.middle[links.target, :2]
    lower, upper = boxed.lower[links.anchor, :2], boxed.upper[links.anchor, :2]
    return np.asarray(((middle < lower) | (middle > upper)).any(axis=1))


def find_propped(boxed: BoxedObjects, near: Contacts, attached: Links, rules: RelationRules) -> Links:
    """Return the `on` links of objects that touch something which is also below their centre and part of their feet.

    Args:
        boxed: the objects.
        near: the surfaces near the feet of objects.
        attached: `attached-to` links; each link found replaces one of these.
        rules: the thresholds.
    """
    pairs = attached.target * len(boxed) + attached.anchor
    is_above = boxed.lower[near.anchor, 2] >= boxed.middle[near.target, 2]
    is_good = np.isin(near.target * len(boxed) + near.anchor, pairs) & ~is_above & are_balanced(boxed, near)
    is_good &= (near.gap <= rules.hovering.max_gap) & (near.gap >= -near.allowed)
    near = select_rows(near, is_good)
    best = select_rows(near, first_of_each_group(near.target, (boxed.rank[near.anchor], -rounded(near.ratio))))
    return support_links(
        rules.hovering.rule, best, margin_score(margin_below(best.gap, rules.hovering.max_gap), best.ratio)
    )
