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

__all__ = ["find_levels", "holds_others", "read_levels"]

Array = NDArray[np.float64]


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


def read_levels(records: Sequence[PrimRecord], own_box: Box, boxes: BoxReader, frame: StageFrame) -> tuple[Box, ...]:
    """Return the levels of all meshes of an object from the bottom up; see `find_levels`.

    Args:
        records: the object's prim and the prims below it without nested objects.
        own_box: the box of their geometry.
        boxes: reads their transforms.
        frame: units and up axis of the stage.
    """
    found = [level for record in records for level in _levels_of(record, own_box, boxes, frame)]
    largest = sorted(found, key=lambda level: (-level.size[0] * level.size[1], level.lower))[: LEVELS.max_levels]
    return tuple(sorted(largest, key=lambda level: (level.lower[2], level.lower)))


def _levels_of(record: PrimRecord, own_box: Box, boxes: BoxReader, frame: StageFrame) -> Iterator[Box]:
    if not is_measurable(record) or not record.prim.IsA(UsdGeom.Mesh):
        return
    mesh = read_mesh(record.prim, boxes.time)
    if mesh is None or len(mesh[0]) > LEVELS.max_points:
        return
    local, triangles = mesh
    matrix = boxes.read_matrix(record)
    points = points_to_metres(local @ matrix[:3, :3] + matrix[3, :3], frame)
    # Mirroring inverts the winding.
    triangles = triangles[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else triangles
    width, depth, _ = own_box.size
    yield from find_levels(points, triangles, width * depth)


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
