"""Distances between surfaces up to a limit, by the boxes of their triangles."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.surface import Surface

__all__ = ["Solid", "mesh_distance"]

Array = NDArray[np.float64]

_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
_BOX = np.concatenate([_QUADS[:, [0, 1, 2]], _QUADS[:, [0, 2, 3]]])
"""Corners of the triangles of a box; bit 2 of a corner is x, bit 1 is y, bit 0 is z."""


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
    The depth of a penetration is that of the box of either object in the near triangles of the other, along the axis
    where it is least.
    """
    near = [_near_corners(one, other, reach), _near_corners(other, one, reach)]
    if not len(near[0]) or not len(near[1]):
        return np.inf
    distance = _between_boxes(*near)
    if distance > reach:
        return np.inf
    return distance if distance > 0 else -_depth(one, other, near)


def _near_corners(solid: Solid, other: Solid, reach: float) -> Array:
    lower, upper = other.lower - reach, other.upper + reach
    if solid.surface is None:
        corners = _corners_of_box(solid)
        is_near = (corners.min(axis=1) <= upper) & (corners.max(axis=1) >= lower)
    else:
        corners = solid.surface.corners
        is_near = (solid.surface.lower <= upper) & (solid.surface.upper >= lower)
    return np.asarray(corners[is_near.all(axis=1)])


def _corners_of_box(solid: Solid) -> Array:
    ends = np.stack([solid.lower, solid.upper])
    corners = np.array([[ends[i >> 2 & 1, 0], ends[i >> 1 & 1, 1], ends[i & 1, 2]] for i in range(8)])
    return np.asarray(corners[_BOX])


def _between_boxes(one: Array, other: Array) -> float:
    lower, upper = other.min(axis=1), other.max(axis=1)
    nearest = np.inf
    for triangle in one:
        gaps = np.maximum(np.maximum(triangle.min(axis=0) - upper, lower - triangle.max(axis=0)), 0)
        nearest = min(nearest, float(np.sqrt((gaps**2).sum(axis=1)).min()))
    return nearest


def _depth(one: Solid, other: Solid, near: list[Array]) -> float:
    depths = []
    for solid, corners in ((one, near[1]), (other, near[0])):
        first = np.clip(corners.min(axis=(0, 1)), solid.lower, solid.upper)
        last = np.clip(corners.max(axis=(0, 1)), solid.lower, solid.upper)
        depths.append(float(np.minimum(solid.upper - first, last - solid.lower).min()))
    return max(min(depths), 0.0)
