"""TriangleSoup: the triangles of several meshes in one set of arrays, and their smooth normals."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.settings import PICTURE
from usd2kg.scene.meshes import ObjectMesh
from usd2kg.shapes.welding import weld_points

__all__ = ["TriangleSoup", "corner_normals", "gather"]

Array = NDArray[np.float64]

_SMOOTH_COSINE = math.cos(math.radians(PICTURE.smooth_angle))
_GRID_CELLS = 1 << 20
"""Cells along the longest side of the grid on which points are merged."""
_MIN_STEP = 1e-9
"""Metres: smallest cell of that grid."""


@dataclass(frozen=True)
class TriangleSoup:
    """Triangles of several meshes."""

    points: NDArray[np.float32]
    """(n, 3), metres, z-up world."""
    triangles: NDArray[np.int64]
    """(m, 3), indices into `points`."""
    colors: NDArray[np.float32]
    """(m, 3), linear RGB."""
    opacity: NDArray[np.float32]
    """(m,), 1 for solid."""
    mesh: NDArray[np.int32]
    """(m,), mesh number of each triangle, ascending."""

    def used_points(self) -> NDArray[np.float32]:
        """Return the points that a triangle uses, (k, 3)."""
        is_used = np.zeros(len(self.points), np.bool_)
        is_used[self.triangles] = True
        return self.points[is_used]

    def part(self, chosen: NDArray[np.bool_]) -> "TriangleSoup":
        """Return the triangles where `chosen` is true."""
        return TriangleSoup(
            self.points, self.triangles[chosen], self.colors[chosen], self.opacity[chosen], self.mesh[chosen]
        )

    def recolored(self, colors: NDArray[np.floating]) -> "TriangleSoup":
        """Return the same triangles with other colours (m, 3)."""
        return TriangleSoup(self.points, self.triangles, colors.astype(np.float32), self.opacity, self.mesh)


def gather(meshes: Iterable[ObjectMesh]) -> TriangleSoup:
    """Return the triangles of all meshes, numbered in the order of the meshes."""
    known = list(meshes)
    counts = [len(mesh.triangles) for mesh in known]
    starts = np.cumsum([0, *(len(mesh.points) for mesh in known)])
    triangles = [mesh.triangles.astype(np.int64) + start for mesh, start in zip(known, starts, strict=False)]
    return TriangleSoup(
        points=np.concatenate([np.zeros((0, 3), np.float32), *(mesh.points for mesh in known)]),
        triangles=np.concatenate([np.zeros((0, 3), np.int64), *triangles]),
        colors=np.repeat(np.array([mesh.color for mesh in known], np.float32).reshape(-1, 3), counts, axis=0),
        opacity=np.repeat(np.array([mesh.opacity for mesh in known], np.float32), counts),
        mesh=np.repeat(np.arange(len(known), dtype=np.int32), counts),
    )


def corner_normals(points: NDArray[np.float32], triangles: NDArray[np.int64], wanted: NDArray[np.integer]) -> Array:
    """Return the unit normals (k, 3, 3) at the corners of the wanted triangles.

    A corner normal is the area-weighted mean over the adjacent faces that meet at less than `smooth_angle`. Points with
    equal positions are merged, because exporters split them.
    """
    corners = points[triangles].astype(np.float64)
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    faces = areas / np.maximum(np.linalg.norm(areas, axis=1, keepdims=True), 1e-30)
    extent = float(np.ptp(points.astype(np.float64), axis=0).max())
    place = weld_points(points, max(extent / _GRID_CELLS, _MIN_STEP)).group[triangles]
    around = np.argsort(place, axis=None, kind="stable")
    count = np.bincount(place.reshape(-1), minlength=1)
    start = np.cumsum(count) - count
    asked = place[wanted].reshape(-1)
    counts = np.where(count[asked] <= PICTURE.max_faces_at_point, count[asked], 0)
    of = np.repeat(np.arange(len(asked)), counts)
    ends = np.cumsum(counts)
    nth = np.arange(len(of)) - np.repeat(ends - counts, counts)
    other = around[start[asked[of]] + nth] // 3
    own = wanted[of // 3]
    # Meshes with inconsistent winding are common: compare face planes, not their orientation.
    cosine = np.einsum("ij,ij->i", faces[own], faces[other])
    weight = np.where(np.abs(cosine) > _SMOOTH_COSINE, np.sign(cosine), 0.0)
    sums = [np.bincount(of, weight * areas[other, axis], minlength=len(asked)) for axis in range(3)]
    normals = np.stack(sums, axis=1)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    flat = np.repeat(faces[wanted], 3, axis=0)
    units: Array = np.where(length > 1e-30, normals / np.maximum(length, 1e-30), flat)
    return units.reshape(-1, 3, 3)
