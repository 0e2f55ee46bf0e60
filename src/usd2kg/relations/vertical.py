"""`above` and `below`: what is over what, with nothing between."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.columns import first_of_each, joined, place_in_group, taken
from usd2kg.relations.model import Links, clearness, share_above
from usd2kg.relations.objects import Bodies, overlap_areas
from usd2kg.relations.thresholds import Above
from usd2kg.shapes import overlapping_pairs

__all__ = ["find_above", "reversed_links"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_PREFIX = 4
"""Of each target, this many times as many as are kept are looked at, the nearest: what is between is among them."""


class _Pairs(NamedTuple):
    """An upper thing, a lower one, the height between them, and the share of the smaller footprint that is shared."""

    target: Indices
    anchor: Indices
    gap: Array
    ratio: Array


def find_above(bodies: Bodies, is_chosen: Mask, frame: Indices, supporter: Indices, rule: Above) -> Links:
    """Return what is above what.

    Left out is what something between says already: of a target above a tray on a table, that it is above the table;
    of a book on a shelf, what the shelf is above. Both things are parts of the same whole or in the same container, or
    neither is.

    Args:
        bodies: the objects.
        is_chosen: which of them take part.
        frame: what each is a part of or inside of, -1 for nothing.
        supporter: what each is on, -1 for nothing.
        rule: the thresholds.
    """
    pairs = _candidates(bodies, np.flatnonzero(is_chosen), frame, rule)
    pairs = taken(pairs, ~_is_carried(pairs, supporter))
    pairs = _nearest(bodies, pairs, _PREFIX * rule.most)
    pairs = _nearest(bodies, taken(pairs, ~_is_told(bodies, pairs, supporter, rule)), rule.most)
    clear = share_above(pairs.ratio, rule.min_overlap_ratio)
    numbers = {"gap": pairs.gap, "overlapRatio": pairs.ratio}
    return Links("above", rule.rule, pairs.target, pairs.anchor, numbers, clearness(clear))


def reversed_links(kind: str, links: Links) -> Links:
    """Return the same relations, told from the anchors."""
    return links._replace(kind=kind, target=links.anchor, anchor=links.target)


def _candidates(bodies: Bodies, chosen: Indices, frame: Indices, rule: Above) -> _Pairs:
    found = [_Pairs(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0), np.zeros(0))]
    for i, j in overlapping_pairs(bodies.lower[chosen, :2], bodies.upper[chosen, :2]):
        one, other = chosen[i], chosen[j]
        is_upper = bodies.lower[one, 2] >= bodies.upper[other, 2] + rule.min_gap
        is_lower = bodies.lower[other, 2] >= bodies.upper[one, 2] + rule.min_gap
        # Of two flat things at one height, neither is above the other.
        is_good = (is_upper != is_lower) & (frame[one] == frame[other])
        target, anchor = np.where(is_upper, one, other)[is_good], np.where(is_upper, other, one)[is_good]
        gap, ratio = bodies.lower[target, 2] - bodies.upper[anchor, 2], _overlap_ratio(bodies, target, anchor)
        found.append(taken(_Pairs(target, anchor, gap, ratio), ratio > rule.min_overlap_ratio))
    return joined(found)


def _overlap_ratio(bodies: Bodies, one: Indices, other: Indices) -> Array:
    shared = overlap_areas(bodies.lower[one], bodies.upper[one], bodies.lower[other], bodies.upper[other])
    smaller = np.minimum(bodies.area[one], bodies.area[other])
    return np.asarray(np.minimum(shared / np.maximum(smaller, 1e-12), 1.0))


def _is_carried(pairs: _Pairs, supporter: Indices) -> Mask:
    """Return for each pair whether the target rests on the anchor, at first or at last."""
    here, found = supporter[pairs.target], np.zeros(len(pairs.target), np.bool_)
    for _ in range(len(supporter)):
        found |= here == pairs.anchor
        if not (here >= 0).any():
            break
        here = np.where(here >= 0, supporter[here], -1)
    return found


def _nearest(bodies: Bodies, pairs: _Pairs, most: int) -> _Pairs:
    """Return of each target the pairs with the smallest gap, nearest first."""
    return taken(pairs, first_of_each(pairs.target, (bodies.rank[pairs.anchor], pairs.gap.round(6)), most))


def _is_told(bodies: Bodies, pairs: _Pairs, supporter: Indices, rule: Above) -> Mask:
    """Return for each pair whether a third thing lies between: the target is above or on it, and it so to the anchor.

    Pairs are sorted by target and gap, so that what is between comes before.
    """
    told = np.zeros(len(pairs.target), np.bool_)
    carrier = supporter[pairs.target]
    has_carrier = np.flatnonzero(carrier >= 0)
    told[has_carrier] = _is_over(bodies, carrier[has_carrier], pairs.anchor[has_carrier], supporter, rule)
    place = place_in_group(pairs.target)
    for step in range(1, int(place.max(initial=0)) + 1):
        later = np.flatnonzero(place >= step)
        told[later] |= _is_over(bodies, pairs.anchor[later - step], pairs.anchor[later], supporter, rule)
    return told


def _is_over(bodies: Bodies, upper: Indices, lower: Indices, supporter: Indices, rule: Above) -> Mask:
    is_higher = bodies.lower[upper, 2] >= bodies.upper[lower, 2] + rule.min_gap
    is_above = is_higher & (_overlap_ratio(bodies, upper, lower) > rule.min_overlap_ratio) & (upper != lower)
    return np.asarray(is_above | (supporter[upper] == lower))
