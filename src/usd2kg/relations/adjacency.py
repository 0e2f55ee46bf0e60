"""`touching`, `next-to` and `near`; each pair is found once."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, ratios, rounded, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.distances import box_gaps, distances, surface_distances
from usd2kg.relations.model import Links, margin_above, margin_below, margin_score
from usd2kg.relations.protrusions import has_protrusion
from usd2kg.relations.thresholds import BlockingRule, NearRule, NextToRule, RelationRules
from usd2kg.shapes import overlapping_pairs
from usd2kg.shapes.ragged import ragged_indices

__all__ = [
    "NearbyPairs",
    "are_nearest",
    "find_near",
    "find_nearby_pairs",
    "find_next_to",
    "find_touching",
    "height_overlaps",
    "measure_surface_distances",
]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_PREFIX = 4
"""Nearest pairs of each object tested for blockers, per pair kept; bounds the running time in heaps."""
_UP = 2
"""Index of the vertical axis."""


class NearbyPairs(NamedTuple):
    """Pairs of objects and their distances in metres."""

    one: Indices
    other: Indices
    distance: Array


def find_nearby_pairs(boxed: BoxedObjects, is_chosen: Mask, rules: RelationRules) -> NearbyPairs:
    """Return the pairs of chosen objects within the widest limit of the rules, each once."""
    near = np.maximum(_limits(boxed, rules.near), _limits(boxed, rules.next_to))
    reach = np.maximum(near, rules.touching.max_gap)
    chosen = np.flatnonzero(is_chosen)
    found = [NearbyPairs(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))]
    grown = reach[chosen, None] / 2
    lower, upper = boxed.lower[chosen] - grown, boxed.upper[chosen] + grown
    for i, j in overlapping_pairs(lower, upper):
        one, other = chosen[i], chosen[j]
        limit = np.minimum(reach[one], reach[other])
        gaps = box_gaps(boxed, one, other)
        is_close = (gaps <= limit[:, None]).all(axis=1)
        one, other, limit = one[is_close], other[is_close], limit[is_close]
        distance = distances(boxed, one, other)
        found.append(select_rows(NearbyPairs(one, other, distance), distance <= limit))
    return concatenate_rows(found)


def measure_surface_distances(boxed: BoxedObjects, pairs: NearbyPairs, rules: RelationRules) -> NearbyPairs:
    """Return the pairs with the distance between their surfaces where their boxes touch or overlap.

    A pair is left out if its surfaces are farther apart than the widest limit of the rules: a chair under a table.
    """
    is_met = pairs.distance <= rules.touching.max_gap
    is_met &= boxed.has_surface[pairs.one] | boxed.has_surface[pairs.other]
    reach = np.maximum(_limits(boxed, rules.near), _limits(boxed, rules.next_to))
    limit = np.maximum(np.minimum(reach[pairs.one], reach[pairs.other]), rules.touching.max_gap)[is_met]
    distance = pairs.distance.copy()
    distance[is_met] = np.clip(surface_distances(boxed, pairs.one[is_met], pairs.other[is_met], limit), 0, None)
    return select_rows(pairs._replace(distance=distance), np.isfinite(distance))


def _limits(boxed: BoxedObjects, rule: NearRule | NextToRule) -> Array:
    """Return the distance limit of each object by its size; the smaller object of a pair decides."""
    half = boxed.footprints.half_sides
    size = 2 * half.mean(axis=1) if isinstance(rule, NextToRule) else (2 * half.sum(axis=1) + boxed.size[:, 2]) / 3
    return np.asarray(np.clip(rule.gap_share * size, rule.min_gap, rule.max_gap))


def are_nearest(boxed: BoxedObjects, pairs: NearbyPairs, most: int) -> Mask:
    """Return for each pair whether it is among the `most` nearest of either object."""
    count = len(pairs.one)
    is_kept = np.zeros(2 * count, np.bool_)
    is_kept[_nearest_of_each(boxed, pairs, most)] = True
    return np.asarray(is_kept[:count] | is_kept[count:])


def height_overlaps(boxed: BoxedObjects, pairs: NearbyPairs) -> Array:
    """Return for each pair the vertical overlap as a share of the shorter object's height."""
    shorter = np.minimum(boxed.size[pairs.one, 2], boxed.size[pairs.other, 2])
    shared = -box_gaps(boxed, pairs.one, pairs.other)[:, 2]
    return np.asarray(np.clip(ratios(shared, shorter), 0, 1))


def find_touching(boxed: BoxedObjects, pairs: NearbyPairs, rules: RelationRules) -> tuple[Links, Mask]:
    """Return the pairs whose boxes meet in a face, as links and as a mask of the given pairs."""
    rule = rules.touching
    gaps = box_gaps(boxed, pairs.one, pairs.other)
    smaller = np.minimum(boxed.size[pairs.one], boxed.size[pairs.other])
    shares = ratios(-gaps, smaller)
    # Along this axis the boxes are apart or overlap least; along the others their faces overlap.
    axis = gaps.argmax(axis=1)
    rows = np.arange(len(axis))
    gap = gaps[rows, axis]
    shares[rows, axis] = 1.0
    face = shares.min(axis=1, initial=1.0)
    is_good = (gap <= rule.max_gap) & (gap >= -rule.max_sink) & (face >= rule.min_face_share)
    is_good &= pairs.distance <= rule.max_gap
    is_good &= ~((axis == _UP) & _meets_protrusion(boxed, pairs, rules))
    is_good[is_good] = are_nearest(boxed, select_rows(pairs, is_good), rule.most)
    slack = np.where(gap[is_good] >= 0, rule.max_gap, rule.max_sink)
    # Up to half the tolerated penetration costs no confidence.
    clear = margin_score(2 * margin_below(gap[is_good], slack), margin_above(face[is_good], rule.min_face_share))
    return _links(boxed, "touching", rule.rule, select_rows(pairs, is_good), {"gap": gap[is_good]}, clear), is_good


def _meets_protrusion(boxed: BoxedObjects, pairs: NearbyPairs, rules: RelationRules) -> Mask:
    is_lower = boxed.lower[pairs.one, 2] < boxed.lower[pairs.other, 2]
    below = np.where(is_lower, pairs.one, pairs.other)
    return np.asarray(has_protrusion(boxed, rules)[below])


def find_next_to(
    boxed: BoxedObjects, pairs: NearbyPairs, around: NearbyPairs, rules: RelationRules
) -> tuple[Links, Mask]:
    """Return the unblocked pairs that are side by side, as links and as a mask of the given pairs."""
    rule = rules.next_to
    limit = np.minimum(*(_limits(boxed, rule)[side] for side in (pairs.one, pairs.other)))
    gaps = box_gaps(boxed, pairs.one, pairs.other)
    beside = height_overlaps(boxed, pairs)
    # With a larger overlap of footprints, one object is over or in the other.
    smaller = np.minimum(boxed.size[pairs.one], boxed.size[pairs.other])
    is_rotated = boxed.footprints.is_rotated[pairs.one] | boxed.footprints.is_rotated[pairs.other]
    is_apart = (is_rotated & (pairs.distance > 0)) | (gaps >= -rule.max_overlap_ratio * smaller)[:, :2].any(axis=1)
    is_good = (pairs.distance <= limit) & (beside >= rule.min_height_share) & is_apart
    is_good[is_good] = are_nearest(boxed, select_rows(pairs, is_good), _PREFIX * rule.most)
    is_good[is_good] = ~_is_blocked(boxed, select_rows(pairs, is_good), around, rules.blocking)
    is_good[is_good] = are_nearest(boxed, select_rows(pairs, is_good), rule.most)
    near = margin_below(pairs.distance[is_good], limit[is_good])
    clear = margin_score(near, margin_above(beside[is_good], rule.min_height_share))
    kept = select_rows(pairs, is_good)
    return _links(boxed, "next-to", rule.rule, kept, {"distance": kept.distance}, clear), is_good


def find_near(boxed: BoxedObjects, pairs: NearbyPairs, around: NearbyPairs, rules: RelationRules) -> Links:
    """Return the unblocked pairs that are close in any direction."""
    rule = rules.near
    limit = np.minimum(*(_limits(boxed, rule)[side] for side in (pairs.one, pairs.other)))
    is_good = pairs.distance <= limit
    is_good[is_good] = are_nearest(boxed, select_rows(pairs, is_good), _PREFIX * rule.most)
    is_good[is_good] = ~_is_blocked(boxed, select_rows(pairs, is_good), around, rules.blocking)
    is_good[is_good] = are_nearest(boxed, select_rows(pairs, is_good), rule.most)
    kept = select_rows(pairs, is_good)
    clear = margin_score(margin_below(kept.distance, limit[is_good]))
    return _links(boxed, "near", rule.rule, kept, {"distance": kept.distance}, clear)


def _links(
    boxed: BoxedObjects, kind: str, rule: str, pairs: NearbyPairs, numbers: dict[str, Array], confidence: Array
) -> Links:
    one, other = np.minimum(pairs.one, pairs.other), np.maximum(pairs.one, pairs.other)
    return Links(kind, rule, one, other, numbers, confidence)


def _is_blocked(boxed: BoxedObjects, pairs: NearbyPairs, around: NearbyPairs, rule: BlockingRule) -> Mask:
    """Return for each pair whether a third object is between the two."""
    found = np.zeros(len(pairs.one), np.bool_)
    wide = np.flatnonzero(pairs.distance > rule.min_distance)
    near = _nearest_of_each(boxed, around, rule.most)
    neighbour = np.concatenate([around.other, around.one])[near]
    starts = np.searchsorted(np.concatenate([around.one, around.other])[near], np.arange(len(boxed) + 1))
    # The neighbours of both ends are tried, since the list of either may be cut before the blocker.
    ends = np.concatenate([pairs.one[wide], pairs.other[wide]])
    row, nth = ragged_indices(starts[ends + 1] - starts[ends])
    pair, third = np.concatenate([wide, wide])[row], neighbour[starts[ends[row]] + nth]
    is_other = (third != pairs.one[pair]) & (third != pairs.other[pair])
    pair, (lowest, highest) = _pieces(boxed, pair[is_other], third[is_other])
    one, other = pairs.one[pair], pairs.other[pair]
    # Along each axis: the gap between the two, or their overlap.
    edges = np.stack(
        [np.maximum(boxed.lower[one], boxed.lower[other]), np.minimum(boxed.upper[one], boxed.upper[other])]
    )
    low, high = edges.min(axis=0), edges.max(axis=0)
    filled = np.minimum(highest, high) - np.maximum(lowest, low)
    shares = ratios(np.clip(filled, 0, None), high - low)
    is_gap = edges[0] > edges[1]
    # A blocker reaches into the gap along the axes that have one, and fills a share of the overlap along the others.
    blocks = np.where(is_gap, filled > 0, shares >= rule.min_fill_ratio).all(axis=1)
    # The box of a mesh of several walls may contain both objects; it is not between them.
    for index in (one, other):
        middle = boxed.middle[index]
        blocks &= ~((middle > lowest) & (middle < highest)).all(axis=1)
    found[pair[blocks]] = True
    return found


def _pieces(boxed: BoxedObjects, pair: Indices, third: Indices) -> tuple[Indices, tuple[Array, Array]]:
    """Return the boxes between pairs of objects: those of the walls of a hollow object, else the object's own."""
    starts, lower, upper = boxed.parts
    is_hollow = np.array([bool(obj.shell_boxes) for obj in boxed.objects], np.bool_)[third]
    row, nth = ragged_indices(np.where(is_hollow, starts[third + 1] - starts[third], 1))
    part, third, is_hollow = starts[third[row]] + nth, third[row], is_hollow[row, None]
    corners = np.where(is_hollow, lower[part], boxed.lower[third]), np.where(is_hollow, upper[part], boxed.upper[third])
    return pair[row], corners


def _nearest_of_each(boxed: BoxedObjects, pairs: NearbyPairs, most: int) -> Indices:
    """Return the indices of the nearest pairs of each object; from n on, index i is pair i - n seen from its second."""
    from_, to = np.concatenate([pairs.one, pairs.other]), np.concatenate([pairs.other, pairs.one])
    return first_of_each_group(from_, (boxed.rank[to], np.tile(rounded(pairs.distance), 2)), most)
