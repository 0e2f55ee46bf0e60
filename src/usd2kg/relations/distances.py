"""Gaps and distances between pairs of objects: axis-aligned boxes, or footprints rotated about z."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.settings import DISTANCE
from usd2kg.shapes.mesh_distance import Solid, exact_distance, mesh_distance

__all__ = ["box_gaps", "distances", "exact_distances", "surface_distances"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_BATCH = 1 << 20
"""Pairs of parts that are compared at a time."""
_CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def box_gaps(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    """Return the gaps between pairs of boxes along x, y and z (n, 3), in metres; negative for an overlap."""
    return np.asarray(
        np.maximum(boxed.lower[one], boxed.lower[other]) - np.minimum(boxed.upper[one], boxed.upper[other])
    )


def distances(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    """Return the distances between the nearest parts of pairs of objects in metres; 0 for an overlap.

    Rotated footprints are compared as rectangles, so that the distance does not depend on the orientation of the
    scene.
    """
    gaps = np.clip(box_gaps(boxed, one, other), 0, None)
    level = np.hypot(gaps[:, 0], gaps[:, 1])
    is_rotated = boxed.footprints.is_rotated[one] | boxed.footprints.is_rotated[other]
    some = np.flatnonzero(is_rotated)
    if len(some):
        level[some] = _between_rectangles(boxed, one[some], other[some])
    found = np.hypot(level, gaps[:, 2])
    some = np.flatnonzero(~is_rotated)
    found[some] = _between_parts(boxed, one[some], other[some], found[some])
    return np.asarray(found)


def _between_parts(boxed: BoxedObjects, one: Indices, other: Indices, box_distance: Array) -> Array:
    """Return the distances between the nearest parts; `box_distance` for single parts and for too many."""
    starts, lower, upper = boxed.parts
    count = np.diff(starts)
    pair_count = count[one] * count[other]
    some = np.flatnonzero((pair_count > 1) & (pair_count <= DISTANCE.max_part_pairs))
    found = box_distance.copy()
    for portion in np.array_split(some, len(some) * DISTANCE.max_part_pairs // _BATCH + 1):
        pair = np.repeat(portion, pair_count[portion])
        nth = np.arange(len(pair)) - np.repeat(
            np.cumsum(pair_count[portion]) - pair_count[portion], pair_count[portion]
        )
        first = starts[one[pair]] + nth // count[other[pair]]
        second = starts[other[pair]] + nth % count[other[pair]]
        gaps = np.maximum(lower[first], lower[second]) - np.minimum(upper[first], upper[second])
        distance = np.sqrt((np.clip(gaps, 0, None) ** 2).sum(axis=1))
        found[portion] = np.inf
        np.minimum.at(found, pair, distance)
    return found


def _between_rectangles(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    """Return the distances between footprints, from the nearest corner of either; 0 for an overlap."""
    from_one, is_apart_one = _to_rectangle(boxed, one, other)
    from_other, is_apart_other = _to_rectangle(boxed, other, one)
    return np.where(is_apart_one | is_apart_other, np.minimum(from_one, from_other), 0.0)


def _to_rectangle(boxed: BoxedObjects, one: Indices, other: Indices) -> tuple[Array, NDArray[np.bool_]]:
    """Return the distances from the corners of `one` to `other`, and whether an axis of `other` separates them."""
    _, half, along = boxed.footprints
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
    excess = np.clip(np.abs(local) - half[other][:, None], 0, None)
    nearest = np.hypot(excess[..., 0], excess[..., 1]).min(axis=1)
    is_apart = (local.min(axis=1) > half[other]) | (local.max(axis=1) < -half[other])
    return nearest, is_apart.any(axis=1)


def surface_distances(boxed: BoxedObjects, one: Indices, other: Indices, reach: Array) -> Array:
    """Return the distances between pairs of objects in metres, up to a reach per pair, else inf.

    Negative for penetration. Objects without a surface are boxes.
    """
    gaps = box_gaps(boxed, one, other)
    found = np.where((gaps > 0).any(axis=1), np.sqrt((np.clip(gaps, 0, None) ** 2).sum(axis=1)), gaps.max(axis=1))
    found = np.where(found <= reach, found, np.inf)
    is_mesh = (boxed.has_surface[one] | boxed.has_surface[other]) & np.isfinite(found)
    for pair in np.flatnonzero(is_mesh).tolist():
        found[pair] = mesh_distance(_solid(boxed, one[pair]), _solid(boxed, other[pair]), float(reach[pair]))
    return np.asarray(found)


def exact_distances(boxed: BoxedObjects, one: Indices, other: Indices, reach: Array) -> Array:
    """Return the distances between the surfaces of pairs of objects in metres, up to a reach per pair, else inf.

    0 where they meet. Objects without a surface are boxes.
    """
    ends = zip(one.tolist(), other.tolist(), reach.tolist(), strict=True)
    return np.array([exact_distance(_solid(boxed, i), _solid(boxed, j), limit) for i, j, limit in ends], np.float64)


def _solid(boxed: BoxedObjects, index: int) -> Solid:
    surface = boxed.surfaces[index]
    return Solid(boxed.lower[index], boxed.upper[index], surface)
