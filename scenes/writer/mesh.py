"""Polygon meshes as arrays, and operations on meshes of any shape."""

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
    """(N, 3), unit, one per point, so a hard edge has its points twice; (0, 3) if all faces are flat-shaded."""
    counts: Ints
    """(F,), corners per face."""
    indices: Ints
    """(sum of counts,), into `points`."""


def mesh_from_faces(points: ArrayLike, normals: ArrayLike, faces: Sequence[Sequence[int]]) -> Mesh:
    """Return a mesh from point, normal and face lists."""
    counts = np.array([len(face) for face in faces], dtype=np.int64)
    indices = np.array([corner for face in faces for corner in face], dtype=np.int64)
    return Mesh(np.asarray(points, dtype=float), np.asarray(normals, dtype=float), counts, indices)


def merge(*meshes: Mesh) -> Mesh:
    """Return one mesh with the faces of all, unconnected."""
    offsets = np.cumsum([0, *(len(m.points) for m in meshes[:-1])])
    return Mesh(
        np.concatenate([m.points for m in meshes]),
        np.concatenate([m.normals for m in meshes]),
        np.concatenate([m.counts for m in meshes]),
        np.concatenate([m.indices + offset for m, offset in zip(meshes, offsets, strict=True)]),
    )


def rotation(degrees: Vec3, order: str = "XYZ") -> Floats:
    """Return the (3, 3) matrix for column vectors of turns about x, y and z, applied in `order`."""
    (cx, cy, cz), (sx, sy, sz) = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    about = {
        "X": np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]),
        "Y": np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]),
        "Z": np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]),
    }
    first, second, third = (about[axis] for axis in order)
    return np.asarray(third @ second @ first, dtype=float)


def moved(mesh: Mesh, by: Vec3 = (0, 0, 0), turn: Vec3 = (0, 0, 0), scale: Vec3 = (1, 1, 1)) -> Mesh:
    """Return the mesh scaled by positive factors, then turned (degrees, rotateXYZ), then shifted."""
    matrix = rotation(turn)
    points = (mesh.points * scale) @ matrix.T + by
    normals = (mesh.normals / scale) @ matrix.T
    return mesh._replace(points=points, normals=normals / np.linalg.norm(normals, axis=1, keepdims=True))


def copies(mesh: Mesh, offsets: Sequence[Vec3]) -> Mesh:
    """Return one mesh with a copy at each offset."""
    return merge(*(moved(mesh, by=offset) for offset in offsets))


def is_flat(mesh: Mesh) -> bool:
    """Return whether every face is flat-shaded, so that normals need not be stored."""
    if not len(mesh.normals):
        return True
    face = np.repeat(np.arange(len(mesh.counts)), mesh.counts)
    first = np.concatenate([[0], np.cumsum(mesh.counts)[:-1]])
    normals = mesh.normals[mesh.indices]
    return bool(np.allclose(normals, normals[first][face], atol=1e-6))
