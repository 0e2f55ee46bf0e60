"""Polygon meshes as arrays, and what can be done to them without knowing their shape."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Vec3 = tuple[float, float, float]


class Mesh(NamedTuple):
    """A polygon mesh, right-handed, faces counter-clockwise seen from outside."""

    points: Floats
    """(N, 3), centimetres, y up."""
    normals: Floats
    """(N, 3), unit, one per point; a hard edge has its points twice."""
    counts: Ints
    """(F,), corners per face."""
    indices: Ints
    """(sum of counts,), into `points`."""


def mesh_from_faces(points: ArrayLike, normals: ArrayLike, faces: Sequence[Sequence[int]]) -> Mesh:
    """A mesh from point, normal and face lists; lengths in centimetres."""
    counts = np.array([len(face) for face in faces], dtype=np.int64)
    indices = np.array([corner for face in faces for corner in face], dtype=np.int64)
    return Mesh(np.asarray(points, dtype=float), np.asarray(normals, dtype=float), counts, indices)


def merge(*meshes: Mesh) -> Mesh:
    """One mesh holding all the given ones, unconnected."""
    offsets = np.cumsum([0, *(len(m.points) for m in meshes[:-1])])
    return Mesh(
        np.concatenate([m.points for m in meshes]),
        np.concatenate([m.normals for m in meshes]),
        np.concatenate([m.counts for m in meshes]),
        np.concatenate([m.indices + offset for m, offset in zip(meshes, offsets, strict=True)]),
    )


def rotation(degrees: Vec3) -> Floats:
    """(3, 3) matrix for column vectors: turn about x, then y, then z (USD's rotateXYZ)."""
    (cx, cy, cz), (sx, sy, sz) = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x, dtype=float)


def moved(mesh: Mesh, by: Vec3 = (0, 0, 0), turn: Vec3 = (0, 0, 0), scale: Vec3 = (1, 1, 1)) -> Mesh:
    """The mesh scaled, then turned (degrees, rotateXYZ), then shifted (centimetres); scale stays positive."""
    matrix = rotation(turn)
    points = (mesh.points * scale) @ matrix.T + by
    normals = (mesh.normals / scale) @ matrix.T
    return mesh._replace(points=points, normals=normals / np.linalg.norm(normals, axis=1, keepdims=True))


def copies(mesh: Mesh, offsets: Sequence[Vec3]) -> Mesh:
    """The mesh repeated at each offset (centimetres)."""
    return merge(*(moved(mesh, by=offset) for offset in offsets))


def is_flat(mesh: Mesh) -> bool:
    """Whether every face is shaded flat, so that its normals need not be stored."""
    face = np.repeat(np.arange(len(mesh.counts)), mesh.counts)
    first = np.concatenate([[0], np.cumsum(mesh.counts)[:-1]])
    normals = mesh.normals[mesh.indices]
    return bool(np.allclose(normals, normals[first][face], atol=1e-6))
