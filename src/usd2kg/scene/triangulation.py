"""Triangles of meshes and solids in their own frame."""

import hashlib
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from usd2kg.scene.solids import solid_surface

__all__ = [
    "Faces",
    "LocalMesh",
    "as_array",
    "read_faces",
    "read_mesh",
    "tessellate",
    "triangulate",
    "triangulate_faces",
]

_FACE_ATTRIBUTES = (
    UsdGeom.Tokens.points,
    UsdGeom.Tokens.faceVertexCounts,
    UsdGeom.Tokens.faceVertexIndices,
    UsdGeom.Tokens.orientation,
)

Points = NDArray[np.float64]
Triangles = NDArray[np.int32]


class LocalMesh(NamedTuple):
    """The triangles of a gprim in its own frame and stage units."""

    points: Points
    triangles: Triangles
    face_of: NDArray[np.int64]
    """Index of the mesh face of each triangle."""
    corners: NDArray[np.int64] | None = None
    """(m, 3): the face vertex at each corner of a triangle; None for a solid."""


class Faces(NamedTuple):
    """The faces of a mesh as they are authored, possibly broken."""

    points: Points
    counts: NDArray[np.int64]
    """Corners of each face."""
    indices: NDArray[np.int64]
    """Index into `points` of each corner."""
    is_left_handed: bool

    def digest(self) -> bytes:
        """Return a hash that equal faces share."""
        arrays = (self.points, self.counts, self.indices)
        digest = hashlib.blake2b(repr((self.is_left_handed, *(array.shape for array in arrays))).encode())
        for array in arrays:
            digest.update(np.ascontiguousarray(array).data)
        return digest.digest()


def read_mesh(prim: Any, time: Usd.TimeCode) -> tuple[Points, Triangles] | None:
    """Return points (n, 3) of a mesh in its frame, in stage units, and triangles (m, 3); None if empty or broken."""
    mesh, _ = triangulate(UsdGeom.Mesh(prim), time)
    return (mesh.points, mesh.triangles) if mesh is not None and np.isfinite(mesh.points).all() else None


def tessellate(prim: Any, time: Usd.TimeCode) -> tuple[LocalMesh | None, str]:
    """Return the triangles of a solid, or None and the problem."""
    surface = solid_surface(prim, time)
    if surface is None:
        return None, f"a {prim.GetTypeName() or 'prim without type'} has no triangles"
    points, triangles = surface
    return LocalMesh(points, triangles, np.zeros(len(triangles), np.int64)), ""


def triangulate(mesh: Any, time: Usd.TimeCode) -> tuple[LocalMesh | None, str]:
    """Return the triangles of a mesh, or None and the problem."""
    return triangulate_faces(read_faces(mesh, time))


def read_faces(mesh: Any, time: Usd.TimeCode) -> Faces:
    """Return the faces of a mesh; arrays are empty for missing and mistyped attributes."""
    # Attributes by name are faster than the methods of the schema.
    points, counts, indices, orientation = map(mesh.GetPrim().GetAttribute, _FACE_ATTRIBUTES)
    return Faces(
        as_array(points.Get(time), np.float64),
        as_array(counts.Get(time), np.int64),
        as_array(indices.Get(time), np.int64),
        orientation.Get() == UsdGeom.Tokens.leftHanded,
    )


def triangulate_faces(faces: Faces) -> tuple[LocalMesh | None, str]:
    """Return the triangles of faces, or None and the problem.

    Triangles are counter-clockwise seen from outside; polygons are triangulated as fans.
    """
    points, counts, indices, is_left_handed = faces
    if not len(points) or not len(counts):
        return None, ""
    if points.shape[1:] != (3,) or counts.ndim != 1 or indices.ndim != 1:
        return None, "its points or faces are not of the type that OpenUSD specifies"
    if counts.min() < 0 or counts.sum() != len(indices):
        return None, f"faceVertexCounts add up to {int(counts.sum())}, but faceVertexIndices has {len(indices)} values"
    if len(indices) and (indices.min() < 0 or indices.max() >= len(points)):
        return None, f"faceVertexIndices has values outside 0 … {len(points) - 1}"
    corners, face_of = _fans(counts)
    if is_left_handed:
        corners = corners[:, ::-1]
    return LocalMesh(points, indices[corners].astype(np.int32), face_of, corners), ""


def _fans(counts: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the corners (m, 3) of the triangles of polygons with `counts` corners each, and the polygon of each."""
    size = int(counts[0])
    if size >= 3 and (counts == size).all():
        nth = np.arange(size - 2)
        fan = np.stack([np.zeros_like(nth), nth + 1, nth + 2], axis=1)
        corners = (np.arange(len(counts)) * size)[:, None, None] + fan
        return corners.reshape(-1, 3), np.repeat(np.arange(len(counts)), size - 2)
    fans = np.maximum(counts - 2, 0)
    face_of = np.repeat(np.arange(len(counts)), fans)
    first = np.repeat(np.cumsum(counts) - counts, fans)
    nth = np.arange(len(face_of)) - np.repeat(np.cumsum(fans) - fans, fans)
    return np.stack([first, first + nth + 1, first + nth + 2], axis=1), face_of


def as_array(values: Any, dtype: Any) -> NDArray[Any]:
    """Return values as an array; an empty array for None or for values that are not numbers (mistyped attributes)."""
    try:
        array = np.asarray(values if values is not None else (), dtype=dtype)
    except (TypeError, ValueError):
        array = np.zeros(0, dtype)
    return array if array.ndim else np.zeros(0, dtype)
