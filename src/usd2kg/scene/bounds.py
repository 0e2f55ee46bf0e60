"""World boxes, positions and rotations, converted to metres and z-up."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom

from usd2kg.scene.model import Box, Quaternion, StageFrame, Vector
from usd2kg.scene.outline import Node

__all__ = ["BoxReader", "is_measurable", "pose_of", "read_pose", "to_metres", "union"]

_PURPOSES = (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)
_EMPTY_EXTENT = 1e30
"""OpenUSD's empty ranges and infinite planes lie beyond any length a scene can have."""
_ALIGNED = 1e-6
_FEWEST_POINTS = 3

_Matrix = NDArray[np.float64]


class BoxReader:
    """Reads world boxes from one shared cache, of default and render purpose.

    A mesh that is turned against the world's axes is measured by its points: OpenUSD would box it first and turn
    the box, which makes a round table that is turned by 45° 1.4 times as wide as it is.
    """

    def __init__(self, frame: StageFrame, time: Usd.TimeCode) -> None:
        self._frame = frame
        self._time = time
        self._geometry = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=False)
        self._hints = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=True)
        self._xforms = UsdGeom.XformCache(time)
        self._read: dict[str, Box | None] = {}

    def read_below(self, node: Node) -> Box | None:
        """Return the box of all visible geometry at and below a node.

        Where nothing there can be measured, the authored `extentsHint` is taken; None if there is none either.
        """
        measured = [box for below in node.walk() if is_measurable(below) and (box := self.read_own(below))]
        return union(measured) or self._box(self._hints, node.prim)

    def read_own(self, node: Node) -> Box | None:
        """Return the box of one geometry prim or point instancer; None if it is empty or not finite."""
        if node.path not in self._read:
            self._read[node.path] = self._measure(node)
        return self._read[node.path]

    def _measure(self, node: Node) -> Box | None:
        if not node.prim.IsA(UsdGeom.PointBased):
            return self._box(self._geometry, node.prim)
        matrix = np.asarray(self._xforms.GetLocalToWorldTransform(node.prim))
        box = self._box_of_extent(node.prim, matrix) if _is_aligned(matrix) else self._box_of_points(node.prim, matrix)
        # An extent that is authored inside out reads as empty: the points know better.
        return box or self._box(self._geometry, node.prim) or self._box_of_points(node.prim, matrix)

    def _box_of_extent(self, prim: Any, matrix: _Matrix) -> Box | None:
        """Return the box of the authored extent; None if there is none, or it is empty or not finite."""
        extent = prim.GetAttribute(UsdGeom.Tokens.extent).Get(self._time)
        if extent is None or len(extent) != 2:
            return None
        corners = np.asarray(extent, dtype=float)
        if not (np.abs(corners) < _EMPTY_EXTENT).all() or (corners[0] > corners[1]).any():
            return None
        world = corners @ matrix[:3, :3] + matrix[3, :3]
        return _to_box(world.min(axis=0).tolist(), world.max(axis=0).tolist(), self._frame)

    def _box_of_points(self, prim: Any, matrix: _Matrix) -> Box | None:
        points = np.array(UsdGeom.PointBased(prim).GetPointsAttr().Get(self._time) or (), dtype=float).reshape(-1, 3)
        with np.errstate(invalid="ignore", over="ignore"):
            world: NDArray[np.float64] = points @ matrix[:3, :3] + matrix[3, :3]
        world = world[np.isfinite(world).all(axis=1) & (np.abs(world) < _EMPTY_EXTENT).all(axis=1)]
        if len(world) < min(len(points), _FEWEST_POINTS) or not len(world):
            # What is left of it says nothing of its size.
            return None
        return _to_box(world.min(axis=0).tolist(), world.max(axis=0).tolist(), self._frame)

    def _box(self, cache: Any, prim: Any) -> Box | None:
        aligned = cache.ComputeWorldBound(prim).ComputeAlignedRange()
        corners = (*aligned.GetMin(), *aligned.GetMax())
        if aligned.IsEmpty() or not all(abs(value) < _EMPTY_EXTENT for value in corners):
            return None
        return _to_box(corners[:3], corners[3:], self._frame)

    def read_local_corners(self, prim: Any) -> list[Any]:
        """Return the eight corners of the box of all below a prim, in the prim's own frame without its transform."""
        local = self._geometry.ComputeUntransformedBound(prim).ComputeAlignedRange()
        return [] if local.IsEmpty() else [local.GetCorner(corner) for corner in range(8)]

    def box_of_corners(self, corners: list[Any], matrix: Any) -> Box | None:
        """Return the world box around corners that `matrix` takes to the stage's world; None if there are none."""
        if not corners:
            return None
        world = np.array([tuple(matrix.Transform(corner)) for corner in corners])
        if not (np.abs(world) < _EMPTY_EXTENT).all():
            return None
        return _to_box(tuple(world.min(axis=0).tolist()), tuple(world.max(axis=0).tolist()), self._frame)

    def read_oriented_size(self, prim: Any) -> Vector | None:
        """Return the extent in metres along the prim's own axes, where they are turned against the world's."""
        matrix = self._xforms.GetLocalToWorldTransform(prim)
        if _is_aligned(np.asarray(matrix)):
            return None
        local = self._geometry.ComputeUntransformedBound(prim).ComputeAlignedRange()
        if local.IsEmpty():
            return None
        scales = [matrix.GetRow3(axis).GetLength() * self._frame.metres_per_unit for axis in range(3)]
        width, depth, height = (size * scale for size, scale in zip(local.GetSize(), scales, strict=True))
        return (width, depth, height) if all(map(math.isfinite, (width, depth, height))) else None


def is_measurable(node: Node) -> bool:
    """Return whether a node is itself something to be measured."""
    return (node.is_gprim or node.is_instancer) and not node.is_hidden


def _is_aligned(matrix: _Matrix) -> bool:
    """Return whether a matrix takes each axis to an axis, so that a turned box is as tight as what it holds."""
    sizes = np.abs(matrix[:3, :3])
    return bool(((sizes > _ALIGNED * sizes.max(axis=1, keepdims=True)).sum(axis=1) <= 1).all())


def _to_box(lower: Any, upper: Any, frame: StageFrame) -> Box:
    low = to_metres(lower, frame)
    high = to_metres(upper, frame)
    pairs = [(min(a, b), max(a, b)) for a, b in zip(low, high, strict=True)]
    (x0, x1), (y0, y1), (z0, z1) = pairs
    return Box((x0, y0, z0), (x1, y1, z1))


def to_metres(point: Any, frame: StageFrame) -> Vector:
    """Return a point of the stage in metres, z-up: (x, y, z) of a y-up stage becomes (x, -z, y)."""
    x, y, z = (value * frame.metres_per_unit for value in point)
    return (x, y, z) if frame.up_axis == "Z" else (x, -z + 0.0, y)


def union(boxes: Iterable[Box]) -> Box | None:
    """Return the smallest box around all of `boxes`; None if there are none."""
    known = list(boxes)
    if not known:
        return None
    lower = tuple(min(box.lower[axis] for box in known) for axis in range(3))
    upper = tuple(max(box.upper[axis] for box in known) for axis in range(3))
    return Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))


def read_pose(cache: UsdGeom.XformCache, prim: Any, frame: StageFrame) -> tuple[Vector | None, Quaternion | None]:
    """Return world position (metres) and rotation (x, y, z, w) of a prim's own frame, z-up.

    Scale and mirroring are taken out of the rotation. Either is None where the matrix has no such part.
    """
    return pose_of(_local_to_world(cache, prim), frame)


def pose_of(matrix: Any, frame: StageFrame) -> tuple[Vector | None, Quaternion | None]:
    """Return position (metres) and rotation (x, y, z, w) of a stage's 4 × 4 matrix, z-up."""
    if not np.isfinite(np.asarray(matrix)).all():
        return None, None
    position = to_metres(matrix.ExtractTranslation(), frame)
    if _is_flat(matrix):
        return position, None
    rotation = matrix.RemoveScaleShear()
    if not np.isfinite(np.asarray(rotation)).all():
        return position, None
    quaternion = rotation.ExtractRotationQuat()
    if frame.up_axis == "Y":
        half = math.sqrt(0.5)
        quaternion = Gf.Quatd(half, half, 0, 0) * quaternion
    return position, _canonical(quaternion)


def _local_to_world(cache: UsdGeom.XformCache, prim: Any) -> Any:
    if prim.GetTypeName() or not prim.HasAttribute(UsdGeom.Tokens.xformOpOrder):
        return cache.GetLocalToWorldTransform(prim)
    # `def "Chair"` leaves its type to the asset it references; where that is missing, OpenUSD takes the prim for one
    # without a transform, though it has one.
    local = UsdGeom.Xformable(prim).GetLocalTransformation(cache.GetTime())
    return local * cache.GetLocalToWorldTransform(prim.GetParent())


def _is_flat(matrix: Any) -> bool:
    """Return whether the matrix squeezes space to a plane, a line or a point, so that no rotation is left."""
    rows = [matrix.GetRow3(i) for i in range(3)]
    lengths = [row.GetLength() for row in rows]
    volume = abs(Gf.Dot(Gf.Cross(rows[0], rows[1]), rows[2]))
    return bool(min(lengths) < 1e-12 or volume < 1e-9 * math.prod(lengths))


def _canonical(quaternion: Any) -> Quaternion | None:
    length = quaternion.GetLength()
    if not math.isfinite(length) or length < 1e-9:
        return None
    parts = (quaternion.GetReal(), *quaternion.GetImaginary())
    # Noise around zero must not decide the sign of a half turn.
    w, x, y, z = (0.0 if abs(value) < 1e-12 * length else value / length for value in parts)
    # q and -q are the same rotation; one of them is written, always the same.
    sign = -1.0 if (w, x, y, z) < (0.0, 0.0, 0.0, 0.0) else 1.0
    return (sign * x + 0.0, sign * y + 0.0, sign * z + 0.0, sign * w + 0.0)
