"""Surfaces of objects with near neighbours, whose relations depend on more than their boxes."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from pxr import UsdGeom

from usd2kg.scene.bounds import BoxReader, is_measurable
from usd2kg.scene.model import Box, StageFrame, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.settings import MAX_COORDINATE, SURFACES
from usd2kg.scene.solids import solid_surface
from usd2kg.scene.stale_extents import StaleExtents
from usd2kg.scene.triangulation import Faces, read_faces, triangulate_faces
from usd2kg.shapes.box_pairs import overlapping_pairs
from usd2kg.shapes.shell import shell_boxes
from usd2kg.shapes.surface import Surface, SurfacePiece, is_box, turned_outward

__all__ = ["SurfaceReader", "are_near_others", "hold_middles", "read_shell"]

Array = NDArray[np.float64]
_Triangles = tuple[NDArray[np.float32], NDArray[np.int32]]

_UP_AXES = {
    "Z": np.eye(3),
    "Y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
}
"""Up axis → rotation of row vectors to z-up: (x, y, z) of a y-up stage becomes (x, -z, y)."""


def are_near_others(boxes: Sequence[Box | None]) -> list[bool]:
    """Return for each box whether another one overlaps it or is within the reach of the settings.

    Args:
        boxes: metres, z-up; None for objects without one.
    """
    found = np.zeros(len(boxes), np.bool_)
    known = np.array([index for index, box in enumerate(boxes) if box is not None], np.int64)
    lower = np.array([box.lower for box in boxes if box is not None]).reshape(-1, 3) - SURFACES.reach / 2
    upper = np.array([box.upper for box in boxes if box is not None]).reshape(-1, 3) + SURFACES.reach / 2
    for i, j in overlapping_pairs(lower[:, :2], upper[:, :2]):
        is_near = (lower[i, 2] <= upper[j, 2]) & (lower[j, 2] <= upper[i, 2])
        found[known[i[is_near]]] = True
        found[known[j[is_near]]] = True
    return [bool(value) for value in found]


def hold_middles(boxes: Sequence[Box | None]) -> list[bool]:
    """Return for each box whether it is large and the middle of another object is in it.

    Args:
        boxes: metres, z-up; None for objects without one.
    """
    found = np.zeros(len(boxes), np.bool_)
    known = np.array([index for index, box in enumerate(boxes) if box is not None], np.int64)
    lower = np.array([box.lower for box in boxes if box is not None]).reshape(-1, 3)
    upper = np.array([box.upper for box in boxes if box is not None]).reshape(-1, 3)
    middle = (lower + upper) / 2
    large = np.flatnonzero((upper - lower)[:, :2].min(axis=1, initial=np.inf) >= SURFACES.min_shell_side)
    for i, j in overlapping_pairs(middle[:, :2], middle[:, :2], (lower[large, :2], upper[large, :2])):
        holder = large[j]
        is_in = (middle[i, 2] >= lower[holder, 2]) & (middle[i, 2] <= upper[holder, 2]) & (i != holder)
        found[known[holder[is_in]]] = True
    return [bool(value) for value in found]


def read_shell(surface: Surface) -> tuple[Box, ...]:
    """Return the boxes of a surface that does not fill its own box; none if it does."""
    boxes = shell_boxes(surface)
    return tuple(Box(_vector(low), _vector(high)) for low, high in boxes) if len(boxes) > 1 else ()


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return (x, y, z)


class SurfaceReader:
    """Reads the surfaces of objects; prototypes are read once, and equal meshes are triangulated and stored once."""

    def __init__(self, boxes: BoxReader, frame: StageFrame, extents: StaleExtents) -> None:
        """Read at the time of `boxes`; `extents` are compared with the points that are read."""
        self._boxes = boxes
        self._extents = extents
        self._to_world = _UP_AXES[frame.up_axis] * frame.metres_per_unit
        self._shared: dict[int, _Triangles | None] = {}
        self._by_digest: dict[bytes, _Triangles | None] = {}
        self._points_left = SURFACES.max_total_points
        self._last: tuple[Array, Array] = (np.eye(4), np.eye(4))
        """The matrix to the stage that was read last, and that to the world."""

    def read(self, records: Sequence[PrimRecord]) -> Surface | None:
        """Return the surface of an object's visible gprims.

        None for an axis-aligned box, for an object with a point instancer or with too many points, and if one of its
        gprims is broken: its boxes are used instead.

        Args:
            records: the object's prim and the prims below it without nested objects.
        """
        gprims = [record for record in records if is_measurable(record)]
        if not gprims or any(record.is_instancer for record in gprims) or len(gprims) > SURFACES.max_gprims:
            return None
        pieces = []
        for record in gprims:
            triangles = self._triangles(record)
            if triangles is None:
                return None
            pieces.append(SurfacePiece(*triangles, self._matrix(record)))
        count = sum(len(piece.points) for piece in pieces)
        if count > min(SURFACES.max_points, self._points_left):
            return None
        surface = Surface(tuple(pieces))
        if len(pieces) == 1 and is_box(surface):
            return None
        if len(pieces) > 1 and not any(record.twin or record.is_instance for record in gprims):
            surface = Surface((_joined(pieces),))
        self._points_left -= count
        return surface

    def _matrix(self, record: PrimRecord) -> Array:
        world = self._boxes.read_matrix(record)
        # Most gprims of an object have its matrix, which the reader keeps.
        if world is not self._last[0]:
            matrix = np.eye(4)
            matrix[:3, :3], matrix[3, :3] = world[:3, :3] @ self._to_world, world[3, :3] @ self._to_world
            self._last = world, matrix
        return self._last[1]

    def _triangles(self, record: PrimRecord) -> _Triangles | None:
        source = record.source
        if id(source) not in self._shared:
            self._shared[id(source)] = self._read_triangles(source)
        return self._shared[id(source)]

    def _read_triangles(self, record: PrimRecord) -> _Triangles | None:
        prim, time = record.prim, self._boxes.time
        if not prim.IsA(UsdGeom.Mesh):
            surface = solid_surface(prim, time)
            if surface is None:
                return None
            self._extents.compare(record, surface[0])
            return _compact(*surface)
        # References that are not instances have equal meshes, too.
        faces = read_faces(UsdGeom.Mesh(prim), time)
        self._extents.compare(record, faces.points)
        digest = faces.digest()
        if digest not in self._by_digest:
            self._by_digest[digest] = _triangles_of(faces)
        return self._by_digest[digest]


def _joined(pieces: Sequence[SurfacePiece]) -> SurfacePiece:
    """Return pieces as one, which takes less memory; points are relative to their lower corner, for precision."""
    worlds = [piece.points @ piece.matrix[:3, :3] + piece.matrix[3, :3] for piece in pieces]
    starts = np.cumsum([0, *(len(world) for world in worlds[:-1])])
    triangles = [turned_outward(piece) + start for piece, start in zip(pieces, starts.tolist(), strict=True)]
    matrix = np.eye(4)
    matrix[3, :3] = np.min([world.min(axis=0) for world in worlds], axis=0)
    points = (np.concatenate(worlds) - matrix[3, :3]).astype(np.float32)
    return SurfacePiece(points, np.concatenate(triangles).astype(np.int32), matrix)


def _triangles_of(faces: Faces) -> _Triangles | None:
    mesh, _ = triangulate_faces(faces)
    return None if mesh is None else _compact(mesh.points, mesh.triangles)


def _compact(points: Array, triangles: NDArray[np.int32]) -> _Triangles | None:
    """Return points and triangles in single precision; None without triangles, or if a point is too far or NaN."""
    if not len(triangles) or not (np.abs(points) < MAX_COORDINATE).all():
        return None
    return points.astype(np.float32), triangles.astype(np.int32)
