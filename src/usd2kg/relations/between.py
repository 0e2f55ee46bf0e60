"""`between`: what stands between two other things."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.columns import first_of_each, joined, taken
from usd2kg.relations.footprints import box_gaps, distances
from usd2kg.relations.implied import Told
from usd2kg.relations.model import Links, clearness, share_above
from usd2kg.relations.neighbours import Pairs
from usd2kg.relations.objects import Bodies, overlap_areas
from usd2kg.relations.thresholds import Between
from usd2kg.shapes import overlapping_pairs

__all__ = ["find_between"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_POINTS = 10
"""Along each side of a footprint: of so many points it is asked whether they are between."""
_PORTION = 1 << 13


def find_between(bodies: Bodies, is_chosen: Mask, told: Told, rule: Between) -> Links:
    """Return which things are between which two others: for each the two that are closest, if any.

    More than half of its footprint is in the convex hull of theirs, as far as 10 × 10 points of it tell.
    """
    target, anchor, distance = _anchors(bodies, is_chosen, told, rule)
    starts = np.searchsorted(target, np.arange(len(bodies) + 1))
    one, other = _two_of_each(starts)
    reach = distance[one] + distance[other]
    ratio = _hull_ratios(bodies, target[one], anchor[one], anchor[other])
    is_good = np.flatnonzero(ratio > rule.min_hull_ratio)
    one, other, reach, ratio = one[is_good], other[is_good], reach[is_good], ratio[is_good]
    ranks = bodies.rank[anchor[one]], bodies.rank[anchor[other]]
    best = first_of_each(target[one], (*ranks, -ratio.round(6), reach.round(6)))
    clear = share_above(ratio[best], rule.min_hull_ratio)
    first, second = anchor[one[best]], anchor[other[best]]
    is_swapped = bodies.rank[first] > bodies.rank[second]
    first, second = np.where(is_swapped, second, first), np.where(is_swapped, first, second)
    numbers = {"betweenRatio": ratio[best]}
    return Links("between", rule.rule, target[one[best]], first, numbers, clearness(clear), second)


def _anchors(bodies: Bodies, is_chosen: Mask, told: Told, rule: Between) -> Pairs:
    """Return pairs of a target and something beside it, the nearest few of each, sorted by target."""
    reach = np.clip(rule.gap_share * bodies.size[:, :2].mean(axis=1), rule.min_gap, rule.max_gap)
    chosen = np.flatnonzero(is_chosen)
    grown = reach[chosen, None]
    wide = bodies.lower[chosen, :2] - grown, bodies.upper[chosen, :2] + grown
    found = [Pairs(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))]
    for i, j in overlapping_pairs(*wide, (bodies.lower[chosen, :2], bodies.upper[chosen, :2])):
        pairs = taken(Pairs(chosen[i], chosen[j], np.zeros(len(i))), i != j)
        pairs = told.unrelated(told.together(taken(pairs, _are_beside(bodies, pairs, rule))))
        pairs = pairs._replace(distance=distances(bodies, pairs.one, pairs.other))
        found.append(taken(pairs, pairs.distance <= reach[pairs.one]))
    pairs = joined(found)
    return taken(pairs, first_of_each(pairs.one, (bodies.rank[pairs.other], pairs.distance.round(6)), rule.most))


def _are_beside(bodies: Bodies, pairs: Pairs, rule: Between) -> Mask:
    target, anchor, _ = pairs
    beside = -box_gaps(bodies, target, anchor)[:, 2] / np.maximum(bodies.size[target, 2], 1e-12)
    shared = overlap_areas(bodies.lower[target], bodies.upper[target], bodies.lower[anchor], bodies.upper[anchor])
    is_apart = shared <= rule.max_overlap_ratio * bodies.area[target]
    return np.asarray((beside >= rule.min_height_share) & is_apart)


def _two_of_each(starts: Indices) -> tuple[Indices, Indices]:
    """Return all pairs of places within each group, whose first places are `starts`."""
    counts = np.diff(starts)
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64))]
    for count in np.unique(counts[counts > 1]).tolist():
        one, other = np.triu_indices(count, 1)
        group = starts[:-1][counts == count, None]
        found.append(((group + one).ravel(), (group + other).ravel()))
    first, second = (np.concatenate(column) for column in zip(*found, strict=True))
    return first, second


def _hull_ratios(bodies: Bodies, target: Indices, one: Indices, other: Indices) -> Array:
    """Return the share of each target's footprint that is in the convex hull of two others' footprints."""
    shares = (np.arange(_POINTS) + 0.5) / _POINTS
    found = np.zeros(len(target))
    for start in range(0, len(target), _PORTION):
        part = slice(start, start + _PORTION)
        low, size = bodies.lower[target[part]], bodies.size[target[part]]
        x = low[:, 0, None] + size[:, 0, None] * shares
        y = low[:, 1, None] + size[:, 1, None] * shares
        from_x, to_x = _ways(x, bodies, one[part], other[part], 0)
        from_y, to_y = _ways(y, bodies, one[part], other[part], 1)
        is_in = np.maximum(from_x[:, :, None], from_y[:, None]) <= np.minimum(to_x[:, :, None], to_y[:, None])
        found[part] = is_in.mean(axis=(1, 2))
    return found


def _ways(points: Array, bodies: Bodies, one: Indices, other: Indices, axis: int) -> tuple[Array, Array]:
    """Return from where to where, on the way t from 0 to 1 from one box to the other, points are between its sides.

    The hull of two boxes is all boxes (1 - t) A + t B: a point is in there where lower(t) <= p <= upper(t).
    """
    low_from, low_to = _solve(points, bodies.lower[one, axis], bodies.lower[other, axis], sign=1.0)
    high_from, high_to = _solve(points, bodies.upper[one, axis], bodies.upper[other, axis], sign=-1.0)
    return np.maximum(low_from, high_from), np.minimum(low_to, high_to)


def _solve(points: Array, start: Array, end: Array, *, sign: float) -> tuple[Array, Array]:
    """Return the range of t in 0 to 1 where sign · (start + t (end - start)) <= sign · p; an empty one is (1, 0)."""
    slope = sign * (end - start)[:, None]
    room = sign * (points - start[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        at = room / slope
    low = np.where(slope < 0, at, np.where((slope == 0) & (room < 0), 1.0, 0.0))
    high = np.where(slope > 0, at, np.where((slope == 0) & (room < 0), 0.0, 1.0))
    return np.clip(low, 0, 1 + 1e-9), np.clip(high, -1e-9, 1)
