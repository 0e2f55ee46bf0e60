"""Support levels: broad horizontal faces within a mesh, such as the boards of a shelf."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import UsdGeom

from usd2kg.scene.bounds import BoxReader, is_measurable
from usd2kg.scene.meshes import points_to_metres
from usd2kg.scene.model import Box, StageFrame
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.settings import LEVELS
from usd2kg.scene.triangulation import read_mesh
from usd2kg.shapes.box_pairs import overlapping_pairs

__all__ = ["LevelReader", "find_levels", "holds_others"]

Array = NDArray[np.float64]
_Mesh = tuple[Array, NDArray[np.int32]]
"""Points and triangles."""


def holds_others(boxes: Sequence[Box | None]) -> list[bool]:
    """Return for each box whether the bottom of another box is within its height and over its footprint.

    Only these few objects can have others on an inner level; reading the levels of all would be slow.

    Args:
        boxes: metres, z-up; None for objects without one.
    """
    found = np.zeros(len(boxes), np.bool_)
    known = [index for index, box in enumerate(boxes) if box is not None]
    lower = np.array([box.lower for box in boxes if box is not None]).reshape(-1, 3)
    upper = np.array([box.upper for box in boxes if box is not None]).reshape(-1, 3)
    area = (upper - lower)[:, 0] * (upper - lower)[:, 1]
    for i, j in overlapping_pairs(lower[:, :2], upper[:, :2]):
        for one, other in ((i, j), (j, i)):
            bottom = lower[one, 2]
            is_within = (bottom > lower[other, 2] + LEVELS.margin) & (bottom < upper[other, 2] - LEVELS.margin)
            inner, outer = one[is_within], other[is_within]
            sides = np.minimum(upper[inner], upper[outer])[:, :2] - np.maximum(lower[inner], lower[outer])[:, :2]
            is_over = sides[:, 0] * sides[:, 1] >= LEVELS.min_overlap_ratio * area[inner]
            found[np.array(known, np.int64)[outer[is_over]]] = True
    return [bool(value) for value in found]


class LevelReader:
    """Reads the levels of objects; equal meshes are read once."""

    def __init__(self, boxes: BoxReader, frame: StageFrame) -> None:
        """Create a reader.

        Args:
            boxes: reads transforms.
            frame: units and up axis of the stage.
        """
        self._boxes = boxes
        self._frame = frame
        self._meshes: dict[int, _Mesh | None] = {}
        """id of a record with copies → its mesh."""

    def read(self, records: Sequence[PrimRecord], own_box: Box) -> tuple[Box, ...]:
        """Return the levels of all meshes of an object from the bottom up; see `find_levels`.

        Args:
            records: the object's prim and the prims below it without nested objects.
            own_box: the box of their geometry.
        """
        found = [level for record in records for level in self._levels_of(record, own_box)]
        largest = sorted(found, key=lambda level: (-level.size[0] * level.size[1], level.lower))[: LEVELS.max_levels]
        return tuple(sorted(largest, key=lambda level: (level.lower[2], level.lower)))

    def _levels_of(self, record: PrimRecord, own_box: Box) -> Iterator[Box]:
        mesh = self._mesh(record) if is_measurable(record) else None
        if mesh is None:
            return
        local, triangles = mesh
        matrix = self._boxes.read_matrix(record)
        points = points_to_metres(local @ matrix[:3, :3] + matrix[3, :3], self._frame)
        # Mirroring inverts the winding.
        triangles = triangles[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else triangles
        width, depth, _ = own_box.size
        yield from find_levels(points, triangles, width * depth)

    def _mesh(self, record: PrimRecord) -> _Mesh | None:
        """Return the mesh of a record; None if it has none, or too many points."""
        source = record.source
        if source is record:
            # Kept only for copies, since the meshes of a stage may not fit into memory.
            return self._read_mesh(record)
        if id(source) not in self._meshes:
            self._meshes[id(source)] = self._read_mesh(source)
        return self._meshes[id(source)]

    def _read_mesh(self, record: PrimRecord) -> _Mesh | None:
        mesh = read_mesh(record.prim, self._boxes.time) if record.prim.IsA(UsdGeom.Mesh) else None
        return mesh if mesh is not None and len(mesh[0]) <= LEVELS.max_points else None


def find_levels(points: Array, triangles: NDArray[Any], footprint: float) -> list[Box]:
    """Return the broad horizontal faces of a mesh that face up, as boxes without height, from the bottom up.

    A level covers at least 5 % of the footprint and at least 30 % of its own bounding rectangle. Inverted winding of a
    closed mesh is detected.

    Args:
        points: (n, 3), metres, z-up world frame.
        triangles: (m, 3), indices into `points`, counter-clockwise seen from outside.
        footprint: area of the object's box seen from above, in square metres.
    """
    corners = points[triangles]
    centred = corners - points.mean(axis=0)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    volume = np.einsum("ij,ij->", centred[:, 0], np.cross(centred[:, 1], centred[:, 2]))
    up = normals[:, 2] if volume >= 0 else -normals[:, 2]
    length = np.sqrt(np.einsum("ij,ij->i", normals, normals))
    flat = np.flatnonzero(up > LEVELS.min_normal_z * length)
    area, height = length[flat] / 2, corners[flat, :, 2].mean(axis=1)
    order = np.argsort(height, kind="stable")
    steps = np.flatnonzero(np.diff(height[order]) > LEVELS.max_step) + 1
    found = []
    for group in np.split(order, steps):
        is_broad = len(group) and area[group].sum() >= LEVELS.min_footprint_share * footprint
        if is_broad and np.ptp(height[group]) <= LEVELS.max_bulge:
            level = _flat_box(corners[flat[group]], float(np.average(height[group], weights=area[group])))
            width, depth, _ = level.size
            if area[group].sum() >= LEVELS.min_filled_share * width * depth:
                found.append(level)
    return found


def _flat_box(corners: Array, height: float) -> Box:
    x0, y0 = corners[..., :2].min(axis=(0, 1)).tolist()
    x1, y1 = corners[..., :2].max(axis=(0, 1)).tolist()
    return Box((x0, y0, height), (x1, y1, height))
