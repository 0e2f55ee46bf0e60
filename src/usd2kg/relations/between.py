"""`between`: an object between two others."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.adjacency import NearbyPairs
from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, ratios, rounded, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects, overlap_areas
from usd2kg.relations.distances import box_gaps, distances
from usd2kg.relations.model import Links, margin_above, margin_score
from usd2kg.relations.settings import BETWEEN
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import BetweenRule
from usd2kg.shapes import overlapping_pairs

__all__ = ["find_between"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_BATCH = 1 << 13
"""Pairs of anchors whose samples are tested at a time."""
_ROUNDING = 1e-9


def find_between(boxed: BoxedObjects, is_chosen: Mask, stronger: StrongerRelations, rule: BetweenRule) -> Links:
    """Return for each object the closest pair of anchors that it is between, if any.

    Most of its footprint, sampled on a grid, is in the convex hull of their footprints.
    """
    target, anchor, distance = _anchors(boxed, is_chosen, stronger, rule)
    starts = np.searchsorted(target, np.arange(len(boxed) + 1))
    one, other = _pairs_in_groups(starts)
    reach = distance[one] + distance[other]
    ratio = _hull_ratios(boxed, target[one], anchor[one], anchor[other])
    is_good = np.flatnonzero(ratio > rule.min_hull_ratio)
    one, other, reach, ratio = one[is_good], other[is_good], reach[is_good], ratio[is_good]
    ranks = boxed.rank[anchor[one]], boxed.rank[anchor[other]]
    best = first_of_each_group(target[one], (*ranks, -rounded(ratio), rounded(reach)))
    clear = margin_above(ratio[best], rule.min_hull_ratio)
    first, second = anchor[one[best]], anchor[other[best]]
    is_swapped = boxed.rank[first] > boxed.rank[second]
    first, second = np.where(is_swapped, second, first), np.where(is_swapped, first, second)
    numbers = {"betweenRatio": ratio[best]}
    return Links("between", rule.rule, target[one[best]], first, numbers, margin_score(clear), second)


def _anchors(boxed: BoxedObjects, is_chosen: Mask, stronger: StrongerRelations, rule: BetweenRule) -> NearbyPairs:
    """Return pairs of a target and an object beside it, the nearest of each target, sorted by target."""
    reach = np.clip(rule.gap_share * boxed.size[:, :2].mean(axis=1), rule.min_gap, rule.max_gap)
    chosen = np.flatnonzero(is_chosen)
    grown = reach[chosen, None]
    wide = boxed.lower[chosen, :2] - grown, boxed.upper[chosen, :2] + grown
    found = [NearbyPairs(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))]
    for i, j in overlapping_pairs(*wide, (boxed.lower[chosen, :2], boxed.upper[chosen, :2])):
        pairs = select_rows(NearbyPairs(chosen[i], chosen[j], np.zeros(len(i))), i != j)
        pairs = stronger.drop_related(stronger.in_same_frame(select_rows(pairs, _are_beside(boxed, pairs, rule))))
        pairs = pairs._replace(distance=distances(boxed, pairs.one, pairs.other))
        found.append(select_rows(pairs, pairs.distance <= reach[pairs.one]))
    pairs = concatenate_rows(found)
    return select_rows(
        pairs, first_of_each_group(pairs.one, (boxed.rank[pairs.other], rounded(pairs.distance)), rule.most)
    )


def _are_beside(boxed: BoxedObjects, pairs: NearbyPairs, rule: BetweenRule) -> Mask:
    target, anchor, _ = pairs
    beside = ratios(-box_gaps(boxed, target, anchor)[:, 2], boxed.size[target, 2])
    shared = overlap_areas(boxed.lower[target], boxed.upper[target], boxed.lower[anchor], boxed.upper[anchor])
    is_apart = shared <= rule.max_overlap_ratio * boxed.area[target]
    return np.asarray((beside >= rule.min_height_share) & is_apart)


def _pairs_in_groups(starts: Indices) -> tuple[Indices, Indices]:
    """Return all pairs of row indices within each group; `starts` are the first rows of the groups."""
    counts = np.diff(starts)
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64))]
    for count in np.unique(counts[counts > 1]).tolist():
        one, other = np.triu_indices(count, 1)
        group = starts[:-1][counts == count, None]
        found.append(((group + one).ravel(), (group + other).ravel()))
    first, second = (np.concatenate(column) for column in zip(*found, strict=True))
    return first, second


def _hull_ratios(boxed: BoxedObjects, target: Indices, one: Indices, other: Indices) -> Array:
    """Return the share of each target's footprint in the convex hull of two other footprints."""
    shares = (np.arange(BETWEEN.samples) + 0.5) / BETWEEN.samples
    found = np.zeros(len(target))
    for start in range(0, len(target), _BATCH):
        part = slice(start, start + _BATCH)
        low, size = boxed.lower[target[part]], boxed.size[target[part]]
        x = low[:, 0, None] + size[:, 0, None] * shares
        y = low[:, 1, None] + size[:, 1, None] * shares
        from_x, to_x = _hull_range(x, boxed, one[part], other[part], 0)
        from_y, to_y = _hull_range(y, boxed, one[part], other[part], 1)
        first, last = np.maximum(from_x[:, :, None], from_y[:, None]), np.minimum(to_x[:, :, None], to_y[:, None])
        # A sample on the boundary of the hull counts, whichever way its coordinates are rounded.
        is_in = first <= last + _ROUNDING
        found[part] = is_in.mean(axis=(1, 2))
    return found


def _hull_range(points: Array, boxed: BoxedObjects, one: Indices, other: Indices, axis: int) -> tuple[Array, Array]:
    """Return the range of t in [0, 1] for which points lie in the interpolated box (1 - t) A + t B, along an axis.

    The convex hull of two boxes A and B is the union of these boxes.
    """
    low_from, low_to = _solve(points, boxed.lower[one, axis], boxed.lower[other, axis], sign=1.0)
    high_from, high_to = _solve(points, boxed.upper[one, axis], boxed.upper[other, axis], sign=-1.0)
    return np.maximum(low_from, high_from), np.minimum(low_to, high_to)


def _solve(points: Array, start: Array, end: Array, *, sign: float) -> tuple[Array, Array]:
    """Return the range of t in [0, 1] with sign · (start + t (end - start)) <= sign · p; (1, 0) if empty."""
    slope = sign * (end - start)[:, None]
    room = sign * (points - start[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        at = room / slope
    low = np.where(slope < 0, at, np.where((slope == 0) & (room < 0), 1.0, 0.0))
    high = np.where(slope > 0, at, np.where((slope == 0) & (room < 0), 0.0, 1.0))
    return np.clip(low, 0, 1 + _ROUNDING), np.clip(high, -_ROUNDING, 1)
