"""The broad faces within an object that other things may stand on: the boards of a shelf that is one mesh."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import UsdGeom

from usd2kg.scene.bounds import BoxReader, is_measurable
from usd2kg.scene.meshes import read_mesh
from usd2kg.scene.model import Box, StageFrame
from usd2kg.scene.outline import PrimRecord
from usd2kg.shapes.box_pairs import overlapping_pairs

__all__ = ["find_levels", "holds_others", "read_levels"]

Array = NDArray[np.float64]

_MARGIN = 0.02
"""Metres: what begins so little above the bottom of another's box, or below its top, is told by the boxes."""
_OVER = 0.3
"""Share of a thing's footprint that is over another, for it to be looked for in there."""
_LEVEL = 0.98
"""The least a unit normal rises on a level face: within 11 degrees."""
_STEP = 0.005
"""Metres: faces whose heights differ by less are of one level."""
_BULGE = 0.02
"""Metres: what rises more than this without a step is round."""
_SHARE = 0.05
"""The least share of the object's footprint that a level has."""
_FILLED = 0.3
"""The least share of its own extent that a level fills: a rim is none."""
_MOST_POINTS = 300_000
_MOST_LEVELS = 32


def holds_others(boxes: Sequence[Box | None]) -> list[bool]:
    """Return for each box whether another one begins well within its height and over its footprint.

    Only what is within such objects' bounds may stand on a level inside them, and few objects are such.

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
            is_within = (bottom > lower[other, 2] + _MARGIN) & (bottom < upper[other, 2] - _MARGIN)
            thing, around = one[is_within], other[is_within]
            sides = np.minimum(upper[thing], upper[around])[:, :2] - np.maximum(lower[thing], lower[around])[:, :2]
            is_over = sides[:, 0] * sides[:, 1] >= _OVER * area[thing]
            found[np.array(known, np.int64)[around[is_over]]] = True
    return [bool(value) for value in found]


def read_levels(records: Sequence[PrimRecord], own_box: Box, boxes: BoxReader, frame: StageFrame) -> tuple[Box, ...]:
    """Return the levels of an object whose own records are `records`, see `find_levels`; those of its meshes together.

    Args:
        records: the object's prim and what is below it, without nested objects.
        own_box: the box around their geometry.
        boxes: reads where they stand.
        frame: the stage's measures.
    """
    found = [level for record in records for level in _levels_of(record, own_box, boxes, frame)]
    largest = sorted(found, key=lambda level: (-level.size[0] * level.size[1], level.lower))[:_MOST_LEVELS]
    return tuple(sorted(largest, key=lambda level: (level.lower[2], level.lower)))


def _levels_of(record: PrimRecord, own_box: Box, boxes: BoxReader, frame: StageFrame) -> Iterator[Box]:
    if not is_measurable(record) or not record.prim.IsA(UsdGeom.Mesh):
        return
    mesh = read_mesh(record.prim, boxes.time)
    if mesh is None or len(mesh[0]) > _MOST_POINTS:
        return
    local, triangles = mesh
    matrix = boxes.read_matrix(record)
    points = (local @ matrix[:3, :3] + matrix[3, :3]) * frame.metres_per_unit
    if frame.up_axis != "Z":
        points = np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)
    # A mirrored frame turns the faces inside out.
    triangles = triangles[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else triangles
    width, depth, _ = own_box.size
    yield from find_levels(points, triangles, width * depth)


def find_levels(points: Array, triangles: NDArray[Any], footprint: float) -> list[Box]:
    """Return the broad level faces of a mesh that look up, as flat boxes: their height and their extent.

    A level is at least 5 % of the footprint and fills at least 30 % of its own extent; a closed mesh whose faces all
    look inwards is read the other way round.

    Args:
        points: (n, 3), metres, z-up world frame.
        triangles: (m, 3), indices into `points`, counter-clockwise seen from outside.
        footprint: square metres that the object's box covers.
    """
    corners = points[triangles]
    centred = corners - points.mean(axis=0)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    volume = np.einsum("ij,ij->", centred[:, 0], np.cross(centred[:, 1], centred[:, 2]))
    up = normals[:, 2] if volume >= 0 else -normals[:, 2]
    length = np.sqrt(np.einsum("ij,ij->i", normals, normals))
    flat = np.flatnonzero(up > _LEVEL * length)
    area, height = length[flat] / 2, corners[flat, :, 2].mean(axis=1)
    order = np.argsort(height, kind="stable")
    steps = np.flatnonzero(np.diff(height[order]) > _STEP) + 1
    found = []
    for group in np.split(order, steps):
        if len(group) and area[group].sum() >= _SHARE * footprint and np.ptp(height[group]) <= _BULGE:
            level = _flat_box(corners[flat[group]], float(np.average(height[group], weights=area[group])))
            width, depth, _ = level.size
            if area[group].sum() >= _FILLED * width * depth:
                found.append(level)
    return found


def _flat_box(corners: Array, height: float) -> Box:
    x0, y0 = corners[..., :2].min(axis=(0, 1)).tolist()
    x1, y1 = corners[..., :2].max(axis=(0, 1)).tolist()
    return Box((x0, y0, height), (x1, y1, height))
