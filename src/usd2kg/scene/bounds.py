"""World boxes, positions and rotations, converted to metres and z-up."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, Vt

from usd2kg.scene.model import Box, Quaternion, StageFrame, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.solids import ROUND_SOLIDS, solid_surface
from usd2kg.scene.stage import UNREADABLE, read_value

__all__ = ["BoxReader", "is_measurable", "pose_of", "to_metres", "union"]

_PURPOSES = (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)
_EMPTY_EXTENT = 1e30
"""OpenUSD's empty ranges and infinite planes lie beyond any length a scene can have."""
_ALIGNED = 1e-6
_FEWEST_POINTS = 3
_SEGMENTS = 128
"""Around a round solid: its box is right to 0.03 % of the radius."""
_RANGE = 2
"""An extent has a lower and an upper corner."""
_UNTURNED: dict[str, Quaternion] = {"Z": (0.0, 0.0, 0.0, 1.0), "Y": (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))}

_Matrix = NDArray[np.float64]


@dataclass(slots=True)
class _Shape:
    """The geometry that instances share, in the frame of the object's prim: what bounds each gprim."""

    corners: list[_Matrix]
    """(n, 3) for each: the corners of its extent where that is tight, else its points."""
    extents: list[_Matrix]
    """(8, 3) for each, or (0, 3): the corners of its extent, tight or not."""
    matrices: list[_Matrix]
    """(4, 4) for each: from its frame to that of the object's prim."""
    gprims: list[Any]
    """The gprims of the instance that the corners were read from."""
    points: list[_Matrix] | None = None
    """(n, 3) for each: its points, or its corners if it has none; read when first needed."""


class BoxReader:
    """Reads world boxes from one shared cache, of default and render purpose.

    A mesh that is turned against the world's axes is measured by its points: OpenUSD would box it first and turn
    the box, which makes a round table that is turned by 45° 1.4 times as wide as it is. What instances share is read
    once.
    """

    def __init__(self, frame: StageFrame, time: Usd.TimeCode, endless: frozenset[str] = frozenset()) -> None:
        """Make a reader; of the prims at the paths `endless` OpenUSD must not be asked for a box."""
        self._frame = frame
        self._endless = endless
        self.time = time
        self._geometry = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=False)
        self._hints = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=True)
        self._xforms = UsdGeom.XformCache(time)
        self._shapes: dict[tuple[int, ...], _Shape | None] = {}
        self._last_matrix: tuple[PrimRecord | None, _Matrix] = (None, np.eye(4))

    def read_parts(self, records: Sequence[PrimRecord]) -> list[Box]:
        """Return the boxes of the visible geometry of an object whose own records are `records`, its prim first.

        Geometry that is empty or not finite has none.
        """
        gprims = [record for record in records if is_measurable(record)]
        shape = self._shared_shape(records[0], gprims)
        boxes = [self._measure(record) for record in gprims] if shape is None else self._place(shape, records[0])
        return [box for box in boxes if box is not None]

    def read_below(self, record: PrimRecord) -> Box | None:
        """Return the box of all visible geometry at and below a record; None if there is none, or it cannot be read."""
        try:
            return union(self.read_parts(list(record.walk())))
        except UNREADABLE:
            return None

    def read_hint(self, record: PrimRecord) -> Box | None:
        """Return the box by the authored `extentsHint`, for a record whose geometry cannot be measured."""
        return self._box(self._hints, record)

    def _measure(self, record: PrimRecord) -> Box | None:
        if not record.has_points:
            return self._box(self._geometry, record)
        matrix = self.read_matrix(record)
        if not record.may_be_turned:
            box = self._box_of_extent(record, matrix)
        elif _is_aligned(matrix):
            box = self._box(self._geometry, record)
        else:
            return self._box_of_points(record.prim, matrix)
        # An extent that is authored inside out reads as empty: the points know better.
        return box or self._box_of_points(record.prim, matrix)

    def read_matrix(self, record: PrimRecord) -> _Matrix:
        """Return the (4, 4) matrix to the stage's world; what is not moved shares it with what it is below."""
        while record.parent is not None and not record.authored.moves:
            record = record.parent
        last, matrix = self._last_matrix
        if last is not record:
            matrix = np.array(self._xforms.GetLocalToWorldTransform(record.prim))
            self._last_matrix = (record, matrix)
        return matrix

    def _box_of_extent(self, record: PrimRecord, matrix: _Matrix) -> Box | None:
        """Return the box of a record that is moved and scaled, not turned: as OpenUSD's cache does, but sooner."""
        extent = None
        if UsdGeom.Tokens.extent in record.authored.names:
            extent = read_value(record.prim, UsdGeom.Tokens.extent, self.time, Vt.Vec3fArray)
        if extent is None or len(extent) != _RANGE:
            return self._box(self._geometry, record)
        (x0, y0, z0), (x1, y1, z1) = np.asarray(extent).tolist()
        (sx, *_), (_, sy, *_), (_, _, sz, _), (x, y, z, _) = matrix.tolist()
        if not (_is_range((x0, y0, z0), (x1, y1, z1)) and sx > 0 and sy > 0 and sz > 0):
            return self._box(self._geometry, record)
        return self._finite_box((x0 * sx + x, y0 * sy + y, z0 * sz + z), (x1 * sx + x, y1 * sy + y, z1 * sz + z))

    def _box_of_points(self, prim: Any, matrix: _Matrix) -> Box | None:
        return self._box_around(_points_of(prim, self.time) @ matrix[:3, :3] + matrix[3, :3])

    def _box_around(self, world: _Matrix) -> Box | None:
        found = world[_is_near(world).all(axis=1)]
        if len(found) < min(len(world), _FEWEST_POINTS) or not len(found):
            # What is left of it says nothing of its size.
            return None
        return _to_box(found.min(axis=0).tolist(), found.max(axis=0).tolist(), self._frame)

    def _box(self, cache: Any, record: PrimRecord) -> Box | None:
        if record.path in self._endless:
            return None
        aligned = cache.ComputeWorldBound(record.prim).ComputeAlignedRange()
        # Vectors of Gf are many times faster to take apart as an array.
        return self._finite_box(np.array(aligned.GetMin()).tolist(), np.array(aligned.GetMax()).tolist())

    def _finite_box(self, lower: Sequence[float], upper: Sequence[float]) -> Box | None:
        return _to_box(lower, upper, self._frame) if _is_range(lower, upper) else None

    def _shared_shape(self, root: PrimRecord, gprims: list[PrimRecord]) -> _Shape | None:
        """Return the shape of an object in an instance that is not the first of its prototype; None for others."""
        if root.twin is None or not gprims or (root.is_instance and gprims[0] is root):
            return None
        key = (id(root.twin), *(id(gprim.twin) for gprim in gprims))
        if key not in self._shapes:
            self._shapes[key] = self._read_shape(root, gprims)
        return self._shapes[key]

    def _read_shape(self, root: PrimRecord, gprims: list[PrimRecord]) -> _Shape | None:
        corners, extents, matrices = [], [], []
        for gprim in gprims:
            matrix, resets = self._relative(gprim, root)
            found = self.read_local_corners(gprim.prim)
            if resets or not (len(found) or gprim.has_points):
                return None
            is_tight = len(found) and (not gprim.has_points or _is_aligned(matrix))
            local = found if is_tight else _points_of(gprim.prim, self.time)
            corners.append(local @ matrix[:3, :3] + matrix[3, :3])
            extents.append(found @ matrix[:3, :3] + matrix[3, :3])
            matrices.append(matrix)
        is_sound = all(len(local) and _is_near(local).all() for local in corners)
        return _Shape(corners, extents, matrices, gprims) if is_sound else None

    def _relative(self, gprim: PrimRecord, root: PrimRecord) -> tuple[_Matrix, bool]:
        if gprim is root:
            return np.eye(4), False
        matrix, resets = self._xforms.ComputeRelativeTransform(gprim.prim, root.prim)
        return np.array(matrix), bool(resets)

    def _place(self, shape: _Shape, root: PrimRecord) -> list[Box | None]:
        matrix = np.array(self._xforms.GetLocalToWorldTransform(root.prim))
        clouds = shape.corners
        if root.may_be_turned and not _is_aligned(matrix):
            # What the instance turns back is as tight in its extent as a copy of it.
            clouds = [
                extent if len(extent) and _is_aligned(inner @ matrix) else points
                for extent, inner, points in zip(
                    shape.extents, shape.matrices, self._shape_points(shape, root), strict=True
                )
            ]
        world = np.concatenate(clouds) @ matrix[:3, :3] + matrix[3, :3]
        if not _is_near(world).all():
            return []
        starts = np.cumsum([0, *(len(cloud) for cloud in clouds[:-1])])
        lower = np.minimum.reduceat(world, starts).tolist()
        upper = np.maximum.reduceat(world, starts).tolist()
        return [_to_box(low, high, self._frame) for low, high in zip(lower, upper, strict=True)]

    def _shape_points(self, shape: _Shape, root: PrimRecord) -> list[_Matrix]:
        if shape.points is None:
            shape.points = []
            # Among twins of one prim any will do; the relative place is the same below each root.
            above = next(record for record in _upwards(shape.gprims[0]) if record.twin is root.twin)
            for gprim, corners in zip(shape.gprims, shape.corners, strict=True):
                matrix, _ = self._relative(gprim, above)
                local = _points_of(gprim.prim, self.time) if gprim.has_points else np.empty((0, 3))
                near = local[_is_near(local).all(axis=1)] @ matrix[:3, :3] + matrix[3, :3]
                is_enough = len(near) and len(near) >= min(len(local), _FEWEST_POINTS)
                shape.points.append(near if is_enough else corners)
        return shape.points

    def read_local_corners(self, prim: Any) -> _Matrix:
        """Return the corners, (8, 3) or (0, 3), of the box of all below a prim, in its frame without its transform."""
        if self._endless and prim.GetPath().pathString in self._endless:
            return np.empty((0, 3))
        local = self._geometry.ComputeUntransformedBound(prim).ComputeAlignedRange()
        found = [] if local.IsEmpty() else [np.array(local.GetCorner(corner)) for corner in range(8)]
        return np.array(found, dtype=float).reshape(-1, 3)

    def box_of_corners(self, corners: _Matrix, matrix: Any) -> Box | None:
        """Return the world box around corners that `matrix` takes to the stage's world; None if there are none."""
        if not len(corners):
            return None
        rows = np.array(matrix)
        world = corners @ rows[:3, :3] + rows[3, :3]
        if not _is_near(world).all():
            return None
        return _to_box(world.min(axis=0).tolist(), world.max(axis=0).tolist(), self._frame)

    def read_oriented_size(self, record: PrimRecord) -> Vector | None:
        """Return the extent in metres along the prim's own axes, where they are turned against the world's."""
        if not record.may_be_turned or record.path in self._endless:
            return None
        matrix = self._xforms.GetLocalToWorldTransform(record.prim)
        if _is_aligned(np.array(matrix)):
            return None
        # OpenUSD's untransformed bound is loose where boxes within it are turned: the parts are asked one by one.
        shape = self._read_shape(record, [below for below in record.walk() if is_measurable(below)])
        if shape is None or not shape.corners:
            return None
        local = np.concatenate(shape.corners)
        sizes: list[float] = (local.max(axis=0) - local.min(axis=0)).tolist()
        scales = [matrix.GetRow3(axis).GetLength() * self._frame.metres_per_unit for axis in range(3)]
        width, depth, height = (size * scale for size, scale in zip(sizes, scales, strict=True))
        return (width, depth, height) if all(map(math.isfinite, (width, depth, height))) else None

    def read_pose(self, record: PrimRecord) -> tuple[Vector | None, Quaternion | None]:
        """Return world position (metres) and rotation (x, y, z, w) of a prim's own frame, z-up.

        Scale and mirroring are taken out of the rotation. Either is None where the matrix has no such part.
        """
        matrix = self._local_to_world(record)
        if not record.may_be_turned:
            rows = np.array(matrix).tolist()
            if all(1e-9 < rows[axis][axis] < _EMPTY_EXTENT > abs(rows[3][axis]) for axis in range(3)):
                return to_metres(rows[3][:3], self._frame), _UNTURNED[self._frame.up_axis]
        return pose_of(matrix, self._frame)

    def read_point(self, record: PrimRecord, point: Any) -> Vector | None:
        """Return a point of a prim's own frame in the world, metres, z-up; None if it is nowhere."""
        world = np.array(self._local_to_world(record).Transform(Gf.Vec3d(point)))
        return to_metres(world.tolist(), self._frame) if _is_near(world).all() else None

    def _local_to_world(self, record: PrimRecord) -> Any:
        if record.type_name or not record.authored.moves:
            return self._xforms.GetLocalToWorldTransform(record.prim)
        # `def "Chair"` leaves its type to the asset it references; where that is missing, OpenUSD takes the prim for
        # one without a transform, though it has one.
        local = UsdGeom.Xformable(record.prim).GetLocalTransformation(self._xforms.GetTime())
        return local * self._xforms.GetLocalToWorldTransform(record.prim.GetParent())


def _upwards(record: PrimRecord) -> Iterable[PrimRecord]:
    above: PrimRecord | None = record
    while above is not None:
        yield above
        above = above.parent


def is_measurable(record: PrimRecord) -> bool:
    """Return whether a record is itself something to be measured."""
    return (record.is_gprim or record.is_instancer) and not record.is_hidden


def _points_of(prim: Any, time: Usd.TimeCode) -> _Matrix:
    """Return the points, (n, 3), in the prim's frame, of a solid those of its surface.

    There are none where they are authored as something else.
    """
    if prim.GetTypeName() in ROUND_SOLIDS:
        surface = solid_surface(prim, time, _SEGMENTS)
        return surface[0] if surface else np.empty((0, 3))
    points = read_value(prim, UsdGeom.Tokens.points, time, Vt.Vec3fArray, Vt.Vec3dArray, Vt.Vec3hArray)
    return np.array(() if points is None else points, dtype=float).reshape(-1, 3)


def _is_aligned(matrix: _Matrix) -> bool:
    """Return whether a matrix takes each axis to an axis, so that a turned box is as tight as what it holds."""
    sizes = np.abs(matrix[:3, :3])
    return bool(((sizes > _ALIGNED * sizes.max(axis=1, keepdims=True)).sum(axis=1) <= 1).all())


def _is_near(numbers: _Matrix) -> NDArray[np.bool_]:
    """Return for each number whether a scene can have such a length: neither NaN nor beyond `_EMPTY_EXTENT`."""
    return np.abs(numbers) < _EMPTY_EXTENT


def _is_range(lower: Sequence[float], upper: Sequence[float]) -> bool:
    """Return whether a range is neither empty nor beyond what a scene can have."""
    x0, y0, z0 = lower
    x1, y1, z1 = upper
    is_lower_near = -_EMPTY_EXTENT < x0 <= x1 and -_EMPTY_EXTENT < y0 <= y1 and -_EMPTY_EXTENT < z0 <= z1
    return is_lower_near and x1 < _EMPTY_EXTENT and y1 < _EMPTY_EXTENT and z1 < _EMPTY_EXTENT


def _to_box(lower: Sequence[float], upper: Sequence[float], frame: StageFrame) -> Box:
    scale = frame.metres_per_unit
    x0, y0, z0 = lower
    x1, y1, z1 = upper
    if frame.up_axis == "Z":
        return Box((x0 * scale, y0 * scale, z0 * scale), (x1 * scale, y1 * scale, z1 * scale))
    return Box((x0 * scale, -z1 * scale + 0.0, y0 * scale), (x1 * scale, -z0 * scale + 0.0, y1 * scale))


def to_metres(point: Any, frame: StageFrame) -> Vector:
    """Return a point of the stage in metres, z-up: (x, y, z) of a y-up stage becomes (x, -z, y)."""
    scale = frame.metres_per_unit
    x, y, z = point
    return (x * scale, y * scale, z * scale) if frame.up_axis == "Z" else (x * scale, -z * scale + 0.0, y * scale)


def union(boxes: Iterable[Box]) -> Box | None:
    """Return the smallest box around all of `boxes`; None if there are none."""
    known = list(boxes)
    if len(known) < 2:
        return known[0] if known else None
    x0, y0, z0 = map(min, *(box.lower for box in known))
    x1, y1, z1 = map(max, *(box.upper for box in known))
    return Box((x0, y0, z0), (x1, y1, z1))


def pose_of(matrix: Any, frame: StageFrame) -> tuple[Vector | None, Quaternion | None]:
    """Return position (metres) and rotation (x, y, z, w) of a stage's 4 × 4 matrix, z-up."""
    rows = np.array(matrix)
    if not (np.isfinite(rows).all() and _is_near(rows[3]).all()):
        return None, None
    position = to_metres(rows[3, :3].tolist(), frame)
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
