"""Convex hulls in space and in the plane, by Qhull (scipy, extra `shapes`)."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.errors import SceneError

__all__ = ["Hull", "convex_hull", "hull_area", "hull_corners"]

Array = NDArray[np.float64]


class Hull(NamedTuple):
    """The convex hull of points in space."""

    vertices: Array
    """(k, 3), some of the points."""
    normals: Array
    """(m, 3), outward normals of the triangles; the length is the area of the triangle."""
    volume: float
    """In cubed units of the points."""
    surface: float
    """In squared units of the points."""


def convex_hull(points: Array, tolerance: float) -> Hull | None:
    """Return the convex hull of finite points (n, 3); None if they lie in a plane, on a line or in one place.

    Args:
        points: finite numbers; may hold duplicates.
        tolerance: points closer than this to a plane are coplanar, in units of the points.

    Raises:
        SceneError: scipy is not installed.
    """
    centred = points - points.mean(axis=0)
    principal = np.linalg.eigh(np.cov(centred.T, ddof=0))[1].T
    if np.ptp(centred @ principal[0]) <= tolerance:
        return None
    scale = _scale(centred)
    found = _quickhull(centred / scale)
    if found is None:
        return None
    a, b, c = np.moveaxis(found.points[found.simplices], 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2 * scale**2
    normals = found.equations[:, :3] * areas[:, None]
    return Hull(points[found.vertices], normals, float(found.volume) * scale**3, float(found.area) * scale**2)


def hull_corners(points: Array) -> Array:
    """Return the corners of the convex hull of points in the plane (n, 2), counter-clockwise.

    Collinear points give the two ends.

    Raises:
        SceneError: scipy is not installed.
    """
    found = _quickhull((points - points.mean(axis=0)) / _scale(points))
    if found is not None:
        return np.asarray(points[found.vertices])
    along = points[:, int(np.ptp(points, axis=0).argmax())]
    return points[[int(along.argmin()), int(along.argmax())]]


def hull_area(points: Array) -> float:
    """Return the area of the convex hull of points in the plane (n, 2); 0 for collinear points."""
    x, y = hull_corners(points).T
    return abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))) / 2


def _scale(points: Array) -> float:
    """Return the largest extent, or 1 if all points coincide; Qhull's tolerances assume coordinates near 1."""
    return float(np.ptp(points, axis=0).max()) or 1.0


def _quickhull(points: Array) -> Any:
    """Return scipy's hull of points; None if they are degenerate."""
    try:
        from scipy.spatial import ConvexHull, QhullError  # noqa: PLC0415
    except ImportError as error:
        raise SceneError(
            f"shape descriptors need scipy, which cannot be imported ({error}); pip install 'usd2kg[shapes]'"
        ) from error
    try:
        return ConvexHull(points)
    except QhullError:
        return None
