"""Minimum bounding rectangles and boxes in any orientation."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.hull import Hull, hull_corners
from usd2kg.shapes.settings import BOUNDING_BOX

__all__ = ["face_normals", "minimum_box", "minimum_rectangle"]

Array = NDArray[np.float64]
Size = tuple[float, float, float]

_TIE_DIGITS = 9
"""Decimals to which sizes are compared, so that rounding does not choose among equal boxes."""


def face_normals(hull: Hull) -> Array:
    """Return the normals (k, 3) of the large faces of a hull, largest first; coplanar triangles are one face."""
    area = np.linalg.norm(hull.normals, axis=1)
    normals, area = hull.normals[area > 0], area[area > 0]
    keys = np.round(normals / area[:, None] * BOUNDING_BOX.normal_steps).astype(np.int64)
    _, first, face = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    share = np.bincount(face.reshape(-1), area, minlength=len(first)) / hull.surface
    order = np.argsort(-share.round(_TIE_DIGITS), kind="stable")[: BOUNDING_BOX.max_faces]
    return np.asarray(normals[first[order[share[order] > BOUNDING_BOX.min_face_share]]])


def minimum_rectangle(points: Array, height: float = 0.0) -> tuple[Array, tuple[float, float]]:
    """Return axes (2, 2) and extents of the minimum bounding rectangle of points (n, 2), the longer side first.

    One side lies along an edge of the convex hull (Freeman & Shapira 1975).

    Args:
        points: finite numbers.
        height: minimise the surface of the box of this height over the rectangle; default: the area.
    """
    corners = hull_corners(points)
    edges = np.roll(corners, -1, axis=0) - corners
    length = np.linalg.norm(edges, axis=1)
    along = edges[length > 0] / length[length > 0, None] if (length > 0).any() else np.array([[1.0, 0.0]])
    across = np.column_stack([-along[:, 1], along[:, 0]])
    width, depth = np.ptp(corners @ along.T, axis=0), np.ptp(corners @ across.T, axis=0)
    best = _first_minimum(width * depth + height * (width + depth))
    axes, extents = np.stack([along[best], across[best]]), (float(width[best]), float(depth[best]))
    return (axes, extents) if extents[0] >= extents[1] else (axes[::-1] * [[1], [-1]], extents[::-1])


def minimum_box(points: Array, normals: Array) -> Size:
    """Return the sides, longest first, of the box of least surface around points (n, 3) on one of the given planes.

    Least surface instead of volume, because all boxes around a flat object have volume 0.

    Args:
        points: finite numbers.
        normals: (m, 3), non-zero normals of the planes.
    """
    boxes = [_box_on(points, normal) for normal in normals]
    return boxes[
        _first_minimum(np.array([long * middle + middle * short + short * long for long, middle, short in boxes]))
    ]


def _box_on(points: Array, normal: Array) -> Size:
    up = normal / np.linalg.norm(normal)
    first = np.cross(np.eye(3)[int(np.abs(up).argmin())], up)
    first /= np.linalg.norm(first)
    height = float(np.ptp(points @ up))
    _, extents = minimum_rectangle(points @ np.stack([first, np.cross(up, first)]).T, height)
    short, middle, long = sorted((*extents, height))
    return long, middle, short


def _first_minimum(values: Array) -> int:
    largest = float(values.max())
    return int((values / largest).round(_TIE_DIGITS).argmin()) if largest > 0 else 0
