"""`above` and `below`, with nothing in between."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import (
    are_reached,
    concatenate_rows,
    first_of_each_group,
    rank_in_group,
    ratios,
    rounded,
    select_rows,
)
from usd2kg.relations.boxed_objects import BoxedObjects, overlap_areas
from usd2kg.relations.model import Links, margin_above, margin_score
from usd2kg.relations.thresholds import AboveRule
from usd2kg.shapes import overlapping_pairs

__all__ = ["find_above", "reverse_links"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_MAX_PAIRS = 64
"""Pairs per object in one column above which they are found layer by layer; affects speed only."""
_LAYER = 0.25
"""Thickness in metres of the first layer below an object that is searched in a heap; affects speed only."""
_PREFIX = 4
"""Candidate anchors tested per anchor kept; intermediate objects are among the nearest candidates."""


class _StackedPairs(NamedTuple):
    """Pairs of an upper and a lower object, with gap and overlap as a share of the smaller footprint."""

    target: Indices
    anchor: Indices
    gap: Array
    ratio: Array


def find_above(boxed: BoxedObjects, is_chosen: Mask, frame: Indices, supporter: Indices, rule: AboveRule) -> Links:
    """Return the `above` links between objects with the same whole or container, or with neither.

    Pairs that follow from an intermediate object are omitted: a lamp above a tray on a table is not linked to the
    table, nor a book on a shelf to the objects below the shelf.

    Args:
        boxed: the objects.
        is_chosen: mask of the objects to relate.
        frame: index of the whole or container of each object, -1 for none.
        supporter: index of the supporter of each object, -1 for none.
        rule: the thresholds.
    """
    chosen = np.flatnonzero(is_chosen)
    pairs = _candidates(boxed, chosen, frame, supporter, rule)
    if pairs is None:
        pairs = _candidates_in_heap(boxed, chosen, frame, supporter, rule)
    pairs = _nearest(boxed, pairs, _PREFIX * rule.most)
    pairs = _nearest(boxed, select_rows(pairs, ~_has_intermediate(boxed, pairs, supporter, rule)), rule.most)
    clear = margin_above(pairs.ratio, rule.min_overlap_ratio)
    numbers = {"gap": pairs.gap, "overlapRatio": pairs.ratio}
    return Links("above", rule.rule, pairs.target, pairs.anchor, numbers, margin_score(clear))


def reverse_links(kind: str, links: Links) -> Links:
    """Return the inverse links."""
    return links._replace(kind=kind, target=links.anchor, anchor=links.target)


def _candidates(
    boxed: BoxedObjects, chosen: Indices, frame: Indices, supporter: Indices, rule: AboveRule
) -> _StackedPairs | None:
    """Return the pairs of which one object is above the other; None for a heap, with too many in one column."""
    found = [_no_pairs()]
    count = 0
    for i, j in overlapping_pairs(boxed.lower[chosen, :2], boxed.upper[chosen, :2]):
        count += len(i)
        if count > _MAX_PAIRS * len(chosen):
            return None
        one, other = chosen[i], chosen[j]
        is_upper, is_lower = _are_higher(boxed, one, other, rule), _are_higher(boxed, other, one, rule)
        # Neither of two flat objects at the same height is above the other.
        is_good = (is_upper != is_lower) & (frame[one] == frame[other])
        target, anchor = np.where(is_upper, one, other)[is_good], np.where(is_upper, other, one)[is_good]
        found.append(_overlapping(boxed, target, anchor, rule))
    pairs = concatenate_rows(found)
    return select_rows(pairs, ~are_reached(pairs.anchor, pairs.target, supporter))


def _candidates_in_heap(
    boxed: BoxedObjects, chosen: Indices, frame: Indices, supporter: Indices, rule: AboveRule
) -> _StackedPairs:
    """Return at least the nearest pairs of each target, which are looked for layer by layer below it.

    A layer is thin, so that few boxes of the heap are in it, and twice as thick as the one before if that was empty.
    """
    bottom, top = boxed.lower[chosen].copy(), boxed.upper[chosen].copy()
    bottom[:, 2] = top[:, 2]
    lowest = top[:, 2].min()
    # The gaps searched so far, and those of the next layer.
    searched, thickness = np.full(len(boxed), -np.inf), np.full(len(boxed), _LAYER)
    count = np.zeros(len(boxed), np.int64)
    left, kept = chosen, []
    while len(left):
        near = np.maximum(searched[left], rule.min_gap)
        far = near + thickness[left]
        lower, upper = boxed.lower[left].copy(), boxed.upper[left].copy()
        # A quarter of the layer more, so that rounding loses no pair.
        upper[:, 2] = lower[:, 2] - near + thickness[left] / 4
        lower[:, 2] -= far + thickness[left] / 4
        found = [_no_pairs()]
        for i, j in overlapping_pairs(lower, upper, (bottom, top)):
            target, anchor = left[i], chosen[j]
            gap = boxed.lower[target, 2] - boxed.upper[anchor, 2]
            is_new = (gap > searched[target]) & (gap <= far[i]) & (frame[target] == frame[anchor]) & (target != anchor)
            is_good = is_new & _are_higher(boxed, target, anchor, rule) & ~_are_higher(boxed, anchor, target, rule)
            found.append(_overlapping(boxed, target[is_good], anchor[is_good], rule))
        pairs = concatenate_rows(found)
        pairs = select_rows(pairs, ~are_reached(pairs.anchor, pairs.target, supporter))
        kept.append(pairs)
        new = np.bincount(pairs.target, minlength=len(boxed))
        count += new
        searched[left] = far
        thickness[new == 0] *= 2
        is_done = (count >= _PREFIX * rule.most) | (boxed.lower[:, 2] - searched < lowest)
        left = left[~is_done[left]]
    return concatenate_rows(kept)


def _no_pairs() -> _StackedPairs:
    return _StackedPairs(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0), np.zeros(0))


def _are_higher(boxed: BoxedObjects, one: Indices, other: Indices, rule: AboveRule) -> Mask:
    return np.asarray(boxed.lower[one, 2] >= boxed.upper[other, 2] + rule.min_gap)


def _overlapping(boxed: BoxedObjects, target: Indices, anchor: Indices, rule: AboveRule) -> _StackedPairs:
    """Return the pairs whose footprints overlap enough."""
    gap, ratio = boxed.lower[target, 2] - boxed.upper[anchor, 2], _overlap_ratio(boxed, target, anchor)
    return select_rows(_StackedPairs(target, anchor, gap, ratio), ratio > rule.min_overlap_ratio)


def _overlap_ratio(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    shared = overlap_areas(boxed.lower[one], boxed.upper[one], boxed.lower[other], boxed.upper[other])
    smaller = np.minimum(boxed.area[one], boxed.area[other])
    return np.asarray(np.minimum(ratios(shared, smaller), 1.0))


def _nearest(boxed: BoxedObjects, pairs: _StackedPairs, most: int) -> _StackedPairs:
    """Return the pairs with the smallest gaps of each target, nearest first."""
    return select_rows(pairs, first_of_each_group(pairs.target, (boxed.rank[pairs.anchor], rounded(pairs.gap)), most))


def _has_intermediate(boxed: BoxedObjects, pairs: _StackedPairs, supporter: Indices, rule: AboveRule) -> Mask:
    """Return for each pair whether the target is above or on a third object that is above or on the anchor.

    Pairs are sorted by target and gap, so that intermediate objects come first.
    """
    found = np.zeros(len(pairs.target), np.bool_)
    bearer = supporter[pairs.target]
    has_bearer = np.flatnonzero(bearer >= 0)
    found[has_bearer] = _is_over(boxed, bearer[has_bearer], pairs.anchor[has_bearer], supporter, rule)
    rank = rank_in_group(pairs.target)
    for step in range(1, int(rank.max(initial=0)) + 1):
        later = np.flatnonzero(rank >= step)
        found[later] |= _is_over(boxed, pairs.anchor[later - step], pairs.anchor[later], supporter, rule)
    return found


def _is_over(boxed: BoxedObjects, upper: Indices, lower: Indices, supporter: Indices, rule: AboveRule) -> Mask:
    overlaps = _overlap_ratio(boxed, upper, lower) > rule.min_overlap_ratio
    is_above = _are_higher(boxed, upper, lower, rule) & overlaps & (upper != lower)
    return np.asarray(is_above | (supporter[upper] == lower))
