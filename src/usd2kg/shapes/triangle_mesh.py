"""TriangleMesh: the triangles of one object, centred and without unusable points."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.settings import MESH

__all__ = ["TriangleMesh", "area_vectors", "is_turned_copy", "make_triangle_mesh"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_FLOAT32_ERROR = 2.0**-22
"""Rounding error of a float32 coordinate, relative to the largest coordinate."""


class TriangleMesh(NamedTuple):
    """The triangles of one object."""

    points: Array
    """(n, 3), metres, relative to the centre of their AABB; each is used by a triangle."""
    triangles: Indices
    """(m, 3), indices into `points`."""
    noise: float
    """Rounding error of the points in metres, as they are stored in single precision."""

    @property
    def diagonal(self) -> float:
        """Diagonal of the AABB in metres."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))


def make_triangle_mesh(points: Array, triangles: Indices) -> TriangleMesh | None:
    """Return the triangles with finite corners, centred; None if there are none, or all corners coincide."""
    is_finite = np.asarray(np.isfinite(points).all(axis=1))
    used, corners = np.unique(triangles[is_finite[triangles].all(axis=1)], return_inverse=True)
    if not len(used):
        return None
    points = points[used]
    low, high = points.min(axis=0), points.max(axis=0)
    noise = _FLOAT32_ERROR * float(np.abs([low, high]).max())
    mesh = TriangleMesh(points - (low + high) / 2, corners.reshape(-1, 3), noise)
    return mesh if mesh.diagonal > MESH.min_diagonal else None


def is_turned_copy(known: Array, mesh: TriangleMesh) -> bool:
    """Return whether a mesh has the points `known` (n, 3) up to a translation and a rotation about z."""
    if known.shape != mesh.points.shape:
        return False
    here, there = known - known.mean(axis=0), mesh.points - mesh.points.mean(axis=0)
    tolerance = max(MESH.same_shape * mesh.diagonal, MESH.noise_factor * mesh.noise)
    plan, plan_there = here[:, 0] + 1j * here[:, 1], there[:, 0] + 1j * there[:, 1]
    # Least-squares rotation of complex numbers: the phase of their inner product.
    product = complex(np.vdot(plan, plan_there))
    turn = product / abs(product) if product else 1.0
    has_same_heights = np.abs(here[:, 2] - there[:, 2]).max() <= tolerance
    return bool(has_same_heights and np.abs(plan * turn - plan_there).max() <= tolerance)


def area_vectors(points: Array, triangles: Indices) -> Array:
    """Return the normals (m, 3) of triangles; the length is the area."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return np.asarray(np.cross(b - a, c - a) / 2)
