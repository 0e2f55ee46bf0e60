"""How far apart two things are: boxes upright in the world, or turned about the vertical."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects

__all__ = ["box_gaps", "distances"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_MAX_PART_PAIRS = 256
"""Things that have more parts, multiplied, are select_rows for their boxes."""
_BATCH = 1 << 20
_CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def box_gaps(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    """Return the gap between two boxes along x, y and z (n, 3), pair by pair; negative where they overlap."""
    return np.asarray(
        np.maximum(boxed.lower[one], boxed.lower[other]) - np.minimum(boxed.upper[one], boxed.upper[other])
    )


def distances(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    """Return the shortest distance between two things in metres, pair by pair; 0 where they overlap.

    It is that between their nearest parts; footprints that are known to be turned rectangles count as such, so that the
    distance is the same however the scene is turned.
    """
    gaps = np.clip(box_gaps(boxed, one, other), 0, None)
    level = np.hypot(gaps[:, 0], gaps[:, 1])
    is_turned = boxed.turned[0][one] | boxed.turned[0][other]
    some = np.flatnonzero(is_turned)
    if len(some):
        level[some] = _between_rectangles(boxed, one[some], other[some])
    found = np.hypot(level, gaps[:, 2])
    some = np.flatnonzero(~is_turned)
    found[some] = _between_parts(boxed, one[some], other[some], found[some])
    return np.asarray(found)


def _between_parts(boxed: BoxedObjects, one: Indices, other: Indices, between_boxes: Array) -> Array:
    """Return the distance between the nearest parts; that between the boxes where each is one, or parts are many."""
    starts, lower, upper = boxed.parts
    count = np.diff(starts)
    ways = count[one] * count[other]
    some = np.flatnonzero((ways > 1) & (ways <= _MAX_PART_PAIRS))
    found = between_boxes.copy()
    for portion in np.array_split(some, len(some) * _MAX_PART_PAIRS // _BATCH + 1):
        pair = np.repeat(portion, ways[portion])
        nth = np.arange(len(pair)) - np.repeat(np.cumsum(ways[portion]) - ways[portion], ways[portion])
        first = starts[one[pair]] + nth // count[other[pair]]
        second = starts[other[pair]] + nth % count[other[pair]]
        gaps = np.maximum(lower[first], lower[second]) - np.minimum(upper[first], upper[second])
        distance = np.sqrt((np.clip(gaps, 0, None) ** 2).sum(axis=1))
        found[portion] = np.inf
        np.minimum.at(found, pair, distance)
    return found


def _between_rectangles(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    """Return the distance between footprints: from a corner of one to the other, the nearest, or 0 if they overlap."""
    from_one, is_apart_one = _to_rectangle(boxed, one, other)
    from_other, is_apart_other = _to_rectangle(boxed, other, one)
    return np.where(is_apart_one | is_apart_other, np.minimum(from_one, from_other), 0.0)


def _to_rectangle(boxed: BoxedObjects, one: Indices, other: Indices) -> tuple[Array, NDArray[np.bool_]]:
    """Return the distance from the nearest corner of one to the other, and whether an axis of the other parts them."""
    _, half, along = boxed.turned
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    corners = (
        boxed.middle[one, None, :2]
        + _CORNERS[:, 0, None] * (half[one, 0, None] * along[one])[:, None]
        + _CORNERS[:, 1, None] * (half[one, 1, None] * across[one])[:, None]
    )
    away = corners - boxed.middle[other, None, :2]
    local = np.stack(
        [np.einsum("ijk,ik->ij", away, along[other]), np.einsum("ijk,ik->ij", away, across[other])], axis=2
    )
    beyond = np.clip(np.abs(local) - half[other][:, None], 0, None)
    nearest = np.hypot(beyond[..., 0], beyond[..., 1]).min(axis=1)
    is_apart = (local.min(axis=1) > half[other]) | (local.max(axis=1) < -half[other])
    return nearest, is_apart.any(axis=1)
