"""World boxes, positions and rotations, converted to metres and z-up."""

import math
from typing import Any

from pxr import Gf, Usd, UsdGeom

from usd2kg.scene.model import Box, Quaternion, StageFrame, Vector

__all__ = ["BoxReader", "read_pose", "union"]

_PURPOSES = (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)
_EMPTY_EXTENT = 1e30
"""OpenUSD's empty ranges and infinite planes lie beyond any length a scene can have."""


class BoxReader:
    """Reads world boxes from one shared cache.

    Boxes are of default and render purpose. Where a prim has no geometry that can be measured, its
    authored `extentsHint` is taken.
    """

    def __init__(self, frame: StageFrame, time: Usd.TimeCode) -> None:
        self._frame = frame
        self._geometry = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=False)
        self._hints = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=True)

    def read(self, prim: Any) -> Box | None:
        """Return the world box of everything below `prim`; None if there is none or it is not finite."""
        return self._box(self._geometry, prim) or self._box(self._hints, prim)

    def _box(self, cache: Any, prim: Any) -> Box | None:
        aligned = cache.ComputeWorldBound(prim).ComputeAlignedRange()
        corners = (*aligned.GetMin(), *aligned.GetMax())
        if aligned.IsEmpty() or not all(abs(value) < _EMPTY_EXTENT for value in corners):
            return None
        return _to_metres(corners[:3], corners[3:], self._frame)


def _to_metres(lower: Vector, upper: Vector, frame: StageFrame) -> Box:
    low = _to_world(lower, frame)
    high = _to_world(upper, frame)
    pairs = [(min(a, b), max(a, b)) for a, b in zip(low, high, strict=True)]
    (x0, x1), (y0, y1), (z0, z1) = pairs
    return Box((x0, y0, z0), (x1, y1, z1))


def _to_world(point: Vector, frame: StageFrame) -> Vector:
    """Return a point of the stage in metres, z-up: (x, y, z) of a y-up stage becomes (x, -z, y)."""
    x, y, z = (value * frame.metres_per_unit for value in point)
    return (x, y, z) if frame.up_axis == "Z" else (x, -z + 0.0, y)


def union(boxes: list[Box]) -> Box | None:
    """Return the smallest box around all of `boxes`; None if there are none."""
    if not boxes:
        return None
    lower = tuple(min(box.lower[axis] for box in boxes) for axis in range(3))
    upper = tuple(max(box.upper[axis] for box in boxes) for axis in range(3))
    return Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))


def read_pose(cache: UsdGeom.XformCache, prim: Any, frame: StageFrame) -> tuple[Vector | None, Quaternion | None]:
    """Return world position (metres) and rotation (x, y, z, w) of a prim's own frame, z-up.

    Scale and mirroring are taken out of the rotation. Either is None where the matrix has no such part.
    """
    matrix = _local_to_world(cache, prim)
    translation = tuple(matrix.ExtractTranslation())
    if not all(math.isfinite(value) for row in matrix for value in row):
        return None, None
    position = _to_world((translation[0], translation[1], translation[2]), frame)
    if _is_flat(matrix):
        return position, None
    rotation = matrix.RemoveScaleShear()
    if not all(math.isfinite(value) for row in rotation for value in row):
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
    return bool(min(lengths) < 1e-12 or abs(Gf.Dot(Gf.Cross(rows[0], rows[1]), rows[2])) < 1e-9 * math.prod(lengths))


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
