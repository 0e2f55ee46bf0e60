"""World boxes and poses of prims, converted to metres and z-up."""

import math
from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass
from itertools import product
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, Vt

from usd2kg.scene.model import Box, Quaternion, StageFrame, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.settings import MAX_COORDINATE, SOLIDS
from usd2kg.scene.solids import ROUND_SOLIDS, solid_surface
from usd2kg.scene.stage import UNREADABLE, read_value
from usd2kg.shapes.extent import extent_of

__all__ = ["BoxReader", "is_measurable", "points_of", "pose_of", "to_metres", "union"]

_PURPOSES = (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)
_MAX_SINE = 1e-6
"""Smaller off-axis components of a matrix are rounding errors."""
_MIN_SCALE = 1e-9
"""Smaller scales, relative volumes and quaternion lengths have no usable rotation."""
_ROUNDING = 1e-12
"""Smaller lengths and relative quaternion components are rounding errors."""
_MIN_POINTS = 3
"""Finite points that a mesh needs to be measured; all of them if it has fewer."""
_UP_ROTATIONS: dict[str, Quaternion] = {"Z": (0.0, 0.0, 0.0, 1.0), "Y": (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))}
"""Up axis → rotation (x, y, z, w) of the stage's frame in the z-up world."""

_Matrix = NDArray[np.float64]


@dataclass(slots=True)
class _SharedGeometry:
    """Bounds of the gprims that instances of one prototype share, in the frame of the object's prim."""

    corners: list[_Matrix]
    """(n, 3) per gprim: the corners of its extent if that is tight, else its points."""
    extents: list[_Matrix]
    """(8, 3) per gprim, or (0, 3): the corners of its extent, tight or not."""
    matrices: list[_Matrix]
    """(4, 4) per gprim: from its frame to that of the object's prim."""
    gprims: list[PrimRecord]
    """The gprims of the instance that the corners were read from."""
    points: list[_Matrix] | None = None
    """(n, 3) per gprim: its points, or its corners if it has none; read when first needed."""


class BoxReader:
    """Reads world AABBs of geometry with default or render purpose.

    Meshes that are rotated against the world axes are measured by their points: OpenUSD's bounding box cache rotates
    the local box, which makes a round table rotated by 45° 1.4 times too wide. Shared geometry is read once.
    """

    def __init__(
        self,
        frame: StageFrame,
        time: Usd.TimeCode,
        endless: frozenset[str] = frozenset(),
        stale: Container[PrimRecord] = (),
    ) -> None:
        """Create a reader.

        Args:
            frame: units and up axis of the stage.
            time: time code at which geometry and transforms are read.
            endless: paths of prims whose bounds OpenUSD is never asked for; see `paths_above_endless`.
            stale: meshes that are measured by their points, since their extents are wrong; it may grow, see `forget`.
        """
        self._frame = frame
        self._stale = stale
        self._endless = endless
        self.time = time
        self._geometry = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=False)
        self._hints = UsdGeom.BBoxCache(time, _PURPOSES, useExtentsHint=True)
        self._xforms = UsdGeom.XformCache(time)
        self._shared: dict[tuple[int, ...], _SharedGeometry | None] = {}
        self._extents: dict[int, list[list[float]] | None] = {}
        """id of a record → its authored extent."""
        self._last_matrix: tuple[PrimRecord | None, _Matrix] = (None, np.eye(4))

    def read_parts(self, records: Sequence[PrimRecord]) -> list[Box]:
        """Return the boxes of an object's visible gprims; empty or non-finite gprims have none.

        Args:
            records: the object's prim, then the prims below it without nested objects.
        """
        gprims = [record for record in records if is_measurable(record)]
        shared = self._shared_geometry(records[0], gprims)
        boxes = [self._measure(record) for record in gprims] if shared is None else self._place(shared, records[0])
        return [box for box in boxes if box is not None]

    def read_below(self, record: PrimRecord) -> Box | None:
        """Return the box of all visible geometry at and below a prim; None if there is none, or it is unreadable."""
        try:
            return union(self.read_parts(list(record.walk())))
        except UNREADABLE:
            return None

    def read_hint(self, record: PrimRecord) -> Box | None:
        """Return the box of the authored `extentsHint`, for a prim whose geometry cannot be measured; None if none."""
        return self._box(self._hints, record)

    def _measure(self, record: PrimRecord) -> Box | None:
        if not record.has_points:
            return self._box(self._geometry, record)
        matrix = self.read_matrix(record)
        if record in self._stale:
            return self._box_of_points(record.prim, matrix)
        if not record.may_be_turned:
            box = self._box_of_extent(record, matrix)
        elif _is_aligned(matrix):
            box = self._box(self._geometry, record)
        else:
            return self._box_of_points(record.prim, matrix)
        # An inverted authored extent reads as empty; fall back to the points.
        return box or self._box_of_points(record.prim, matrix)

    def read_matrix(self, record: PrimRecord) -> _Matrix:
        """Return the (4, 4) local-to-world matrix in stage units."""
        while record.parent is not None and not record.authored.moves:
            record = record.parent
        last, matrix = self._last_matrix
        if last is not record:
            matrix = np.array(self._xforms.GetLocalToWorldTransform(record.prim))
            self._last_matrix = (record, matrix)
        return matrix

    def _box_of_extent(self, record: PrimRecord, matrix: _Matrix) -> Box | None:
        """Return the box of a gprim without rotation, from its authored extent: what OpenUSD returns, but faster."""
        extent = self._extent_of(record.source)
        if extent is None:
            return self._box(self._geometry, record)
        (x0, y0, z0), (x1, y1, z1) = extent
        (sx, *_), (_, sy, *_), (_, _, sz, _), (x, y, z, _) = matrix.tolist()
        if not (_is_range((x0, y0, z0), (x1, y1, z1)) and sx > 0 and sy > 0 and sz > 0):
            return self._box(self._geometry, record)
        return self._finite_box((x0 * sx + x, y0 * sy + y, z0 * sz + z), (x1 * sx + x, y1 * sy + y, z1 * sz + z))

    def _extent_of(self, record: PrimRecord) -> list[list[float]] | None:
        """Return the smallest and the largest coordinates of the authored extent; None if it has none."""
        if id(record) not in self._extents:
            extent = None
            if UsdGeom.Tokens.extent in record.authored.names:
                extent = read_value(record.prim, UsdGeom.Tokens.extent, self.time, Vt.Vec3fArray)
            self._extents[id(record)] = None if extent is None or len(extent) != 2 else np.asarray(extent).tolist()
        return self._extents[id(record)]

    def _box_of_points(self, prim: Any, matrix: _Matrix) -> Box | None:
        return self._box_around(points_of(prim, self.time) @ matrix[:3, :3] + matrix[3, :3])

    def _box_around(self, world: _Matrix) -> Box | None:
        is_near = _is_near(world)
        found = world if is_near.all() else world[is_near.all(axis=1)]
        if len(found) < min(len(world), _MIN_POINTS) or not len(found):
            return None
        lower, upper = extent_of(found)
        return _to_box(lower.tolist(), upper.tolist(), self._frame)

    def _box(self, cache: Any, record: PrimRecord) -> Box | None:
        if record.path in self._endless:
            return None
        aligned = cache.ComputeWorldBound(record.prim).ComputeAlignedRange()
        # Converting a Gf vector by way of numpy is many times faster than indexing it.
        return self._finite_box(np.array(aligned.GetMin()).tolist(), np.array(aligned.GetMax()).tolist())

    def _finite_box(self, lower: Sequence[float], upper: Sequence[float]) -> Box | None:
        return _to_box(lower, upper, self._frame) if _is_range(lower, upper) else None

    def _shared_geometry(self, root: PrimRecord, gprims: list[PrimRecord]) -> _SharedGeometry | None:
        """Return the geometry of an object in any but the first instance of a prototype; None for other objects."""
        if root.twin is None or not gprims or (root.is_instance and gprims[0] is root):
            return None
        key = (id(root.twin), *(id(gprim.twin) for gprim in gprims))
        if key not in self._shared:
            self._shared[key] = self._read_geometry(root, gprims)
        return self._shared[key]

    def _read_geometry(self, root: PrimRecord, gprims: list[PrimRecord]) -> _SharedGeometry | None:
        corners, extents, matrices = [], [], []
        for gprim in gprims:
            matrix, resets = self._relative(gprim, root)
            found = self._corners_of(gprim)
            if resets or not (len(found) or gprim.has_points):
                return None
            is_tight = len(found) and (not gprim.has_points or _is_aligned(matrix))
            local = found if is_tight else points_of(gprim.prim, self.time)
            corners.append(local @ matrix[:3, :3] + matrix[3, :3])
            extents.append(found @ matrix[:3, :3] + matrix[3, :3])
            matrices.append(matrix)
        is_finite = all(len(local) and _is_near(local).all() for local in corners)
        return _SharedGeometry(corners, extents, matrices, gprims) if is_finite else None

    def _relative(self, gprim: PrimRecord, root: PrimRecord) -> tuple[_Matrix, bool]:
        if gprim is root:
            return np.eye(4), False
        matrix, resets = self._xforms.ComputeRelativeTransform(gprim.prim, root.prim)
        return np.array(matrix), bool(resets)

    def _place(self, shared: _SharedGeometry, root: PrimRecord) -> list[Box | None]:
        """Return the world box of each gprim of an instance."""
        matrix = np.array(self._xforms.GetLocalToWorldTransform(root.prim))
        clouds = shared.corners
        if root.may_be_turned and not _is_aligned(matrix):
            # The extent is tight if the rotations of the gprim and the instance cancel.
            clouds = [
                extent if len(extent) and _is_aligned(inner @ matrix) else points
                for extent, inner, points in zip(
                    shared.extents, shared.matrices, self._shared_points(shared, root), strict=True
                )
            ]
        world = np.concatenate(clouds) @ matrix[:3, :3] + matrix[3, :3]
        if not _is_near(world).all():
            return []
        starts = np.cumsum([0, *(len(cloud) for cloud in clouds[:-1])])
        lower = np.minimum.reduceat(world, starts).tolist()
        upper = np.maximum.reduceat(world, starts).tolist()
        return [_to_box(low, high, self._frame) for low, high in zip(lower, upper, strict=True)]

    def _shared_points(self, shared: _SharedGeometry, root: PrimRecord) -> list[_Matrix]:
        if shared.points is None:
            shared.points = []
            # All twins of the root have the same relative transforms.
            above = next(record for record in _upwards(shared.gprims[0]) if record.twin is root.twin)
            for gprim, corners in zip(shared.gprims, shared.corners, strict=True):
                matrix, _ = self._relative(gprim, above)
                local = points_of(gprim.prim, self.time) if gprim.has_points else np.empty((0, 3))
                near = local[_is_near(local).all(axis=1)] @ matrix[:3, :3] + matrix[3, :3]
                is_enough = len(near) and len(near) >= min(len(local), _MIN_POINTS)
                shared.points.append(near if is_enough else corners)
        return shared.points

    def _corners_of(self, gprim: PrimRecord) -> _Matrix:
        """Return the corners, (8, 3) or (0, 3), of the extent of a gprim in its own frame, or of its points."""
        if gprim not in self._stale:
            return self.read_local_corners(gprim.prim)
        lower, upper = extent_of(points_of(gprim.prim, self.time))
        return np.array(list(product(*zip(lower.tolist(), upper.tolist(), strict=True))))

    def forget(self) -> None:
        """Forget shared geometry that was read before an extent was known to be stale."""
        self._shared.clear()

    def read_local_corners(self, prim: Any) -> _Matrix:
        """Return the corners, (8, 3) or (0, 3), of the bounds at and below a prim, without the prim's transform."""
        if self._endless and prim.GetPath().pathString in self._endless:
            return np.empty((0, 3))
        local = self._geometry.ComputeUntransformedBound(prim).ComputeAlignedRange()
        found = [] if local.IsEmpty() else [np.array(local.GetCorner(corner)) for corner in range(8)]
        return np.array(found, dtype=float).reshape(-1, 3)

    def box_of_corners(self, corners: _Matrix, matrix: Any) -> Box | None:
        """Return the world box of corners (n, 3), transformed to the stage by `matrix`; None without corners."""
        if not len(corners):
            return None
        rows = np.array(matrix)
        world = corners @ rows[:3, :3] + rows[3, :3]
        if not _is_near(world).all():
            return None
        return _to_box(world.min(axis=0).tolist(), world.max(axis=0).tolist(), self._frame)

    def read_oriented_size(self, record: PrimRecord) -> Vector | None:
        """Return the extent in metres along the prim's own axes; None if they are parallel to the world axes."""
        if not record.may_be_turned or record.path in self._endless:
            return None
        matrix = self._xforms.GetLocalToWorldTransform(record.prim)
        if _is_aligned(np.array(matrix)):
            return None
        # Not OpenUSD's untransformed bound, which is loose if gprims are rotated within it.
        geometry = self._read_geometry(record, [below for below in record.walk() if is_measurable(below)])
        if geometry is None or not geometry.corners:
            return None
        local = np.concatenate(geometry.corners)
        sizes: list[float] = (local.max(axis=0) - local.min(axis=0)).tolist()
        scales = [matrix.GetRow3(axis).GetLength() * self._frame.metres_per_unit for axis in range(3)]
        width, depth, height = (size * scale for size, scale in zip(sizes, scales, strict=True))
        return (width, depth, height) if all(map(math.isfinite, (width, depth, height))) else None

    def read_pose(self, record: PrimRecord) -> tuple[Vector | None, Quaternion | None]:
        """Return world position (metres) and rotation (x, y, z, w) of a prim's own frame, z-up.

        The rotation excludes scale and mirroring, see `pose_of`. Either is None if it is not finite or not defined.
        """
        matrix = self._local_to_world(record)
        if not record.may_be_turned:
            rows = np.array(matrix).tolist()
            if all(_MIN_SCALE < rows[axis][axis] < MAX_COORDINATE > abs(rows[3][axis]) for axis in range(3)):
                return to_metres(rows[3][:3], self._frame), _UP_ROTATIONS[self._frame.up_axis]
        return pose_of(matrix, self._frame)

    def read_point(self, record: PrimRecord, point: Any) -> Vector | None:
        """Return a point of a prim's own frame in the world, metres, z-up; None if it is not finite."""
        world = np.array(self._local_to_world(record).Transform(Gf.Vec3d(point)))
        return to_metres(world.tolist(), self._frame) if _is_near(world).all() else None

    def read_point_below(self, root: PrimRecord, record: PrimRecord, point: Any) -> Vector | None:
        """Return a point of a prim's own frame in that of a prim above it, in stage units; None if it is not finite."""
        matrix, _ = self._relative(record, root)
        x, y, z = (np.array(point, dtype=float) @ matrix[:3, :3] + matrix[3, :3]).tolist()
        return (x, y, z) if math.isfinite(x + y + z) else None

    def _local_to_world(self, record: PrimRecord) -> Any:
        if record.type_name or not record.authored.moves:
            return self._xforms.GetLocalToWorldTransform(record.prim)
        # `def "Chair"` gets its type from the referenced asset. If that is missing, XformCache ignores the authored
        # transform of the untyped prim.
        local = UsdGeom.Xformable(record.prim).GetLocalTransformation(self._xforms.GetTime())
        return local * self._xforms.GetLocalToWorldTransform(record.prim.GetParent())


def _upwards(record: PrimRecord) -> Iterable[PrimRecord]:
    above: PrimRecord | None = record
    while above is not None:
        yield above
        above = above.parent


def is_measurable(record: PrimRecord) -> bool:
    """Return whether a prim is itself a gprim or point instancer with default or render purpose."""
    return (record.is_gprim or record.is_instancer) and not record.is_hidden


def points_of(prim: Any, time: Usd.TimeCode) -> _Matrix:
    """Return the points (n, 3) of a mesh or of the surface of a solid, in the prim's frame; empty if mistyped."""
    if prim.GetTypeName() in ROUND_SOLIDS:
        surface = solid_surface(prim, time, SOLIDS.box_segments)
        return surface[0] if surface else np.empty((0, 3))
    points = read_value(prim, UsdGeom.Tokens.points, time, Vt.Vec3fArray, Vt.Vec3dArray, Vt.Vec3hArray)
    return np.array(() if points is None else points, dtype=float).reshape(-1, 3)


def _is_aligned(matrix: _Matrix) -> bool:
    """Return whether a matrix maps each axis to an axis, so that the transformed box stays tight."""
    sizes = np.abs(matrix[:3, :3])
    return bool(((sizes > _MAX_SINE * sizes.max(axis=1, keepdims=True)).sum(axis=1) <= 1).all())


def _is_near(numbers: _Matrix) -> NDArray[np.bool_]:
    """Return for each number whether its magnitude is below `MAX_COORDINATE`; False for NaN."""
    return np.abs(numbers) < MAX_COORDINATE


def _is_range(lower: Sequence[float], upper: Sequence[float]) -> bool:
    """Return whether a range is not empty and its coordinates are below `MAX_COORDINATE` in magnitude."""
    return all(-MAX_COORDINATE < low <= high < MAX_COORDINATE for low, high in zip(lower, upper, strict=True))


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
    """Return the smallest box around `boxes`; None if there are none."""
    known = list(boxes)
    if len(known) < 2:
        return known[0] if known else None
    x0, y0, z0 = map(min, *(box.lower for box in known))
    x1, y1, z1 = map(max, *(box.upper for box in known))
    return Box((x0, y0, z0), (x1, y1, z1))


def pose_of(matrix: Any, frame: StageFrame) -> tuple[Vector | None, Quaternion | None]:
    """Return position (metres) and rotation (x, y, z, w) of a stage's 4 × 4 matrix, z-up.

    The rotation is the orthogonal factor of the polar decomposition (Shoemake and Duff, Matrix Animation and Polar
    Decomposition, 1992). That of a mirroring matrix is a reflection; see `_unmirrored`.
    """
    rows = np.array(matrix)
    if not (np.isfinite(rows).all() and _is_near(rows[3]).all()):
        return None, None
    position = to_metres(rows[3, :3].tolist(), frame)
    if _is_singular(matrix):
        return position, None
    rotation = (_unmirrored(matrix, frame) if matrix.GetDeterminant3() < 0 else matrix).RemoveScaleShear()
    if not np.isfinite(np.asarray(rotation)).all():
        return position, None
    quaternion = rotation.ExtractRotationQuat()
    if frame.up_axis == "Y":
        half = math.sqrt(0.5)
        quaternion = Gf.Quatd(half, half, 0, 0) * quaternion
    return position, _canonical(quaternion)


def _unmirrored(matrix: Any, frame: StageFrame) -> Any:
    """Return a mirroring matrix without the mirroring of the prim's own axes.

    A reflection is a rotation after mirroring one axis, whichever: the matrix does not tell which axis was mirrored.
    The prim's up axis keeps its direction, so that only what is turned over has an up axis that points down. Of the two
    others, that axis is inverted which leaves the smaller rotation: the larger trace, which is 1 + 2 cos of the angle.
    So a scale of (-1, 1, 1) or (1, -1, 1) is no rotation. Gf's own factor would invert all three axes.
    """
    candidates = []
    for axis in (0, 1) if frame.up_axis == "Z" else (0, 2):
        candidate = Gf.Matrix4d(matrix)
        candidate.SetRow3(axis, -matrix.GetRow3(axis))
        # A rounding error must not decide between equal rotations.
        trace = round(float(np.trace(np.array(candidate.RemoveScaleShear()))), 6)
        candidates.append((trace, candidate))
    return max(candidates, key=itemgetter(0))[1]


def _is_singular(matrix: Any) -> bool:
    """Return whether the linear part of a matrix is singular, so that its rotation is undefined."""
    rows = [matrix.GetRow3(i) for i in range(3)]
    lengths = [row.GetLength() for row in rows]
    volume = abs(Gf.Dot(Gf.Cross(rows[0], rows[1]), rows[2]))
    return bool(min(lengths) < _ROUNDING or volume < _MIN_SCALE * math.prod(lengths))


def _canonical(quaternion: Any) -> Quaternion | None:
    """Return the unit quaternion whose first non-zero component of w, x, y, z is positive; None if its length is 0."""
    length = quaternion.GetLength()
    if not math.isfinite(length) or length < _MIN_SCALE:
        return None
    parts = (quaternion.GetReal(), *quaternion.GetImaginary())
    # A rounding error must not decide the sign of a half turn, where w is 0.
    w, x, y, z = (0.0 if abs(value) < _ROUNDING * length else value / length for value in parts)
    # q and -q are the same rotation.
    sign = -1.0 if (w, x, y, z) < (0.0, 0.0, 0.0, 0.0) else 1.0
    return (sign * x + 0.0, sign * y + 0.0, sign * z + 0.0, sign * w + 0.0)
