"""Distances between surfaces up to a limit, by the boxes of their triangles."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.surface import Surface
from usd2kg.shapes.triangle_distance import least_triangle_distance

__all__ = ["Solid", "exact_distance", "mesh_distance"]

Array = NDArray[np.float64]

_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
_BOX = np.concatenate([_QUADS[:, [0, 1, 2]], _QUADS[:, [0, 2, 3]]])
"""Corners of the triangles of a box; bit 2 of a corner is x, bit 1 is y, bit 0 is z."""
_SPREAD = np.sum([(np.arange(1024) >> bit & 1) << 3 * bit for bit in range(10)], axis=0)
"""10-bit number → its bits at a distance of three."""
_BLOCK = 64
"""Triangles that are compared at once."""
_CHUNK = 1 << 8
"""Pairs of triangles whose exact distance is measured first; then twice as many."""
_MAX_PAIRS = 1 << 22
"""Pairs of triangles beyond which their exact distance is not measured; bounds memory."""


class Solid(NamedTuple):
    """One object, in metres in a common frame."""

    lower: Array
    """(3,), of its box."""
    upper: Array
    surface: Surface | None
    """Its triangles; None for a box."""


def mesh_distance(one: Solid, other: Solid, reach: float) -> float:
    """Return the distance between two objects in metres; negative for penetration, inf beyond `reach`.

    Only the triangles within `reach` of the other object's box are compared, by their boxes, which are never farther
    apart than the triangles.
    The depth of a penetration is how far the box of either object reaches into the near triangles of the other, along
    the axis where that is least.
    """
    near = [_near_boxes(one, other, reach), _near_boxes(other, one, reach)]
    if not near[0].lower.size or not near[1].lower.size:
        return np.inf
    distance = _between_boxes(*near)
    if distance > reach:
        return np.inf
    return distance if distance > 0 else -_depth(one, other, near)


def exact_distance(one: Solid, other: Solid, reach: float) -> float:
    """Return the distance between the surfaces of two objects in metres, inf beyond `reach`; 0 where they meet.

    Triangles are compared in the order of the distance of their boxes. Of more than `_MAX_PAIRS` pairs within reach,
    the distance of the boxes of the nearest counts.
    """
    corners = _near_each_other(_near_triangles(one, other, reach), _near_triangles(other, one, reach), reach)
    (low, high), (other_low, other_high) = ((some.min(axis=1).T, some.max(axis=1).T) for some in corners)
    if len(corners[0]) * len(corners[1]) > _MAX_PAIRS:
        return mesh_distance(one, other, reach)
    bounds = _box_distances(low, high, other_low, other_high).ravel()
    order = np.flatnonzero(bounds <= reach)
    order = order[np.argsort(bounds[order], kind="stable")]
    nearest, start, count = np.inf, 0, _CHUNK
    while start < len(order) and bounds[order[start]] < nearest:
        some = order[start : start + count]
        start, count = start + count, 2 * count
        i, j = np.divmod(some, len(corners[1]))
        nearest = min(nearest, least_triangle_distance(corners[0][i], corners[1][j], min(nearest, reach)))
    return nearest if nearest <= reach else np.inf


def _near_triangles(solid: Solid, other: Solid, reach: float) -> Array:
    """Return the triangles (n, 3, 3) whose boxes are within reach of the other object's box."""
    if solid.surface is None:
        ends = np.stack([solid.lower, solid.upper])
        corners = np.array([[ends[i >> 2 & 1, 0], ends[i >> 1 & 1, 1], ends[i & 1, 2]] for i in range(8)])[_BOX]
    else:
        corners = solid.surface.corners
    low, high = corners.min(axis=1), corners.max(axis=1)
    return np.asarray(corners[((low <= other.upper + reach) & (high >= other.lower - reach)).all(axis=1)])


def _near_each_other(one: Array, other: Array, reach: float) -> tuple[Array, Array]:
    """Return the triangles of each that are within reach of the box around the triangles of the other."""
    if not len(one) or not len(other):
        return one[:0], other[:0]
    low, high = one.min(axis=(0, 1)) - reach, one.max(axis=(0, 1)) + reach
    other_low, other_high = other.min(axis=(0, 1)) - reach, other.max(axis=(0, 1)) + reach
    is_near = ((one.min(axis=1) <= other_high) & (one.max(axis=1) >= other_low)).all(axis=1)
    other_is_near = ((other.min(axis=1) <= high) & (other.max(axis=1) >= low)).all(axis=1)
    return one[is_near], other[other_is_near]


class _Boxes(NamedTuple):
    """The boxes of triangles, an axis in each row: numpy reduces rows of three coordinates five times as slowly."""

    lower: Array
    """(3, n)"""
    upper: Array


def _near_boxes(solid: Solid, other: Solid, reach: float) -> _Boxes:
    lower, upper = (
        _triangle_boxes_of_box(solid) if solid.surface is None else (solid.surface.lower.T, solid.surface.upper.T)
    )
    last, first = other.upper + reach, other.lower - reach
    is_near = np.logical_and.reduce([(lower[axis] <= last[axis]) & (upper[axis] >= first[axis]) for axis in range(3)])
    near = np.flatnonzero(is_near)
    return _Boxes(*(np.array([row[near] for row in corners]) for corners in (lower, upper)))


def _triangle_boxes_of_box(solid: Solid) -> _Boxes:
    ends = np.stack([solid.lower, solid.upper])
    corners = np.array([[ends[i >> 2 & 1, 0], ends[i >> 1 & 1, 1], ends[i & 1, 2]] for i in range(8)])[_BOX]
    return _Boxes(corners.min(axis=1).T, corners.max(axis=1).T)


class _Blocks(NamedTuple):
    """Boxes in blocks of `_BLOCK` neighbours, each with the box around it."""

    lower: Array
    """(3, blocks, `_BLOCK`)"""
    upper: Array
    outer_lower: Array
    """(3, blocks)"""
    outer_upper: Array


def _between_boxes(one: _Boxes, other: _Boxes) -> float:
    """Return the least distance between boxes; 0 if two overlap.

    Pairs of blocks are compared in the order of the distance of their boxes, which bounds that of what is in them.
    """
    first, second = _make_blocks(one), _make_blocks(other)
    bounds = _box_distances(first.outer_lower, first.outer_upper, second.outer_lower, second.outer_upper)
    nearest = np.inf
    for pair in np.argsort(bounds, axis=None, kind="stable"):
        i, j = divmod(int(pair), bounds.shape[1])
        if bounds[i, j] >= nearest:
            break
        found = _box_distances(first.lower[:, i], first.upper[:, i], second.lower[:, j], second.upper[:, j])
        nearest = min(nearest, float(found.min()))
    return nearest


def _box_distances(lower: Array, upper: Array, other_lower: Array, other_upper: Array) -> Array:
    """Return the distances (n, m) between boxes with corners (3, n) and (3, m)."""
    gaps = np.maximum(np.maximum(lower[..., None] - other_upper[:, None], other_lower[:, None] - upper[..., None]), 0)
    return np.asarray(np.sqrt((gaps**2).sum(axis=0)))


def _make_blocks(boxes: _Boxes) -> _Blocks:
    lower, upper = boxes
    order = np.argsort(_morton_codes((lower + upper) / 2), kind="stable")
    # The last block is filled up with its last box.
    order = np.pad(order, (0, -len(order) % _BLOCK), mode="edge").reshape(-1, _BLOCK)
    # Not `lower[:, order]`, whose memory has the axes last.
    lower, upper = lower.take(order, axis=1), upper.take(order, axis=1)
    return _Blocks(lower, upper, lower.min(axis=2), upper.max(axis=2))


def _morton_codes(points: Array) -> NDArray[np.int64]:
    """Return the positions of points (3, n) on a Z-order curve through their box, 10 bits an axis (Morton 1966)."""
    lowest = points.min(axis=1, keepdims=True)
    scale = np.maximum(points.max(axis=1, keepdims=True) - lowest, 1e-12)
    x, y, z = np.minimum((points - lowest) / scale * 1024, 1023).astype(np.int64)
    return np.asarray(_SPREAD[x] | _SPREAD[y] << 1 | _SPREAD[z] << 2)


def _depth(one: Solid, other: Solid, near: list[_Boxes]) -> float:
    depths = []
    for solid, boxes in ((one, near[1]), (other, near[0])):
        first = np.clip(boxes.lower.min(axis=1), solid.lower, solid.upper)
        last = np.clip(boxes.upper.max(axis=1), solid.lower, solid.upper)
        depths.append(float(np.minimum(solid.upper - first, last - solid.lower).min()))
    return max(min(depths), 0.0)
