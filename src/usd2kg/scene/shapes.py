"""What the triangles of an object say about its form: volume, sizes, roundness, and how much water it would hold."""

import hashlib
import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom

from usd2kg.scene.meshes import ObjectMesh, iterate_meshes
from usd2kg.scene.model import Diagnostic, Scene
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import OpenedStage, captured_diagnostics, open_stage
from usd2kg.shapes.hull import (
    ConvexHull,
    convex_hull,
    convex_polygon,
    largest_normals,
    smallest_box,
    smallest_rectangle,
)
from usd2kg.shapes.vessels import NO_VESSEL, measure_vessel

__all__ = ["ShapeDescriptors", "describe_shapes", "describe_triangles"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_WELD = 1e-6
"""Points nearer than about this, in diagonals of the object, are one point."""
_FLOAT32 = 2.0**-22
"""How far rounding to single precision may move a point, relative to its distance from the origin."""
_FARTHEST = 1e30
_SMALLEST = 1e-12
"""Metres: coordinates beyond and objects below are broken data."""
_SAME = 1e-5
"""Two objects have the same shape where no point differs by more than this, in diagonals."""
_LARGE = 0.01
"""Faces of the hull that are smaller, in surfaces of the hull, decide nothing about its box."""
_PARALLEL = 1 - 2e-6
"""Cosine of normals that are the same."""
_GAP = 1e-3
"""The largest share of a part's surface that may be missing from a closed part."""


@dataclass(frozen=True, slots=True)
class ShapeDescriptors:
    """The form of one object at its true size, as it stands.

    Of the object's own drawn triangles; lengths are metres, ratios have no unit. All but `openness`, `capacity_m3` and
    `verticality` are the same however the object is turned; those three only if it is turned about the vertical.
    """

    volume_m3: float | None
    """Enclosed volume by the divergence theorem (Zhang & Chen 2001, eq. 4): the sum over triangles of a·(b×c)/6.

    Parts that are apart are added up (where they overlap, it counts twice), whichever way their faces look; a part
    inside the box of another that looks the other way is a cavity and is taken off. None if one of the parts is not
    closed: welded by position, each edge must be passed as often one way as the other; edges that are not may bound a
    gap of at most 0.1 % of the part's surface (length² / 4π). A part without thickness is not closed either.
    """
    hull_volume_m3: float
    """Volume of the convex hull; 0 for flat things."""
    surface_m2: float
    """Area of all triangles, as they are authored: a sheet drawn from both sides counts twice."""
    long_m: float
    """Longest edge of the smallest box around the object in any orientation (L of Blott & Pye 2008).

    The box of least surface among those that stand on a large face of the hull, on the ground or across a principal
    axis. Extents along principal axes alone would be the diagonals of a square thing as often as its sides.
    """
    middle_m: float
    """Middle edge of that box (I)."""
    short_m: float
    """Shortest edge of that box (S); 0 for flat things."""
    elongation: float | None
    """1 - middle / long, after Zingg 1935: 0 for as wide as long, towards 1 for a rod. None if all is in one place."""
    flatness: float | None
    """1 - short / middle, after Zingg 1935: 0 for as thick as wide, 1 for a sheet. None if all is on one line."""
    roundness: float | None
    """Sphericity of the hull, Wadell 1935: surface of the ball of the same volume / surface, ∛(36π V²) / S.

    1 for a ball, 0.806 for a cube, 0 for a sheet; of the hull, so that a hollow ball is round. None on one line.
    """
    verticality: float | None
    """h / (h + w), height by the longer side of the smallest rectangle on the ground around the object.

    0 for what lies flat, 0.5 for a cube, towards 1 for a pole. None if all is in one place.
    """
    openness: float
    """How much like an open vessel it stands: `capacity_m3` / (area seen from above × height).

    0 for whatever holds no water, towards 1 for a thin-walled tub. Handles count: a raised one makes it less.
    """
    capacity_m3: float
    """The water that stays in it after rain from straight above.

    Depressions of the height field on 128 × 128 cells over the footprint are filled to where they overflow (Planchon
    & Darboux 2001; the same as priority flood, Barnes et al. 2014), but no higher than to where they leak sideways:
    through gaps in 64 × 64 × 64 voxels. About 2 % less than true for a cup. What is below the surface seen from above
    holds nothing: the inside of a bottle, or under a lid. Gaps below 1/64 of the extent count as tight; where no
    hollow is wider than 1/32 of it, there is none.
    """


def describe_shapes(
    source: OpenedStage | Path | str | Usd.Stage,
    scene: Scene,
    paths: Iterable[str] | None = None,
    *,
    diagnostics: list[Diagnostic] | None = None,
) -> Mapping[str, ShapeDescriptors]:
    """Return prim path → shape of the objects of a scene, in the scene's order.

    An object's shape is that of its own drawn geometry: objects nested below it are left out, and so are the copies
    of point instancers but where each is an object. Objects without such geometry are left out. Objects that differ
    in no more than where they stand and a turn about the vertical are measured once.

    Args:
        source: the stage that the scene was read from.
        scene: what `read_scene` returned for it.
        paths: the objects to describe; default: all. Paths that are no objects are left out.
        diagnostics: gets a note for each geometry prim that is left out because its data are broken.

    Raises:
        SceneError: the stage cannot be read, or is another than the scene's.
    """
    frame = scene.frame
    options = ReadOptions(metres_per_unit=frame.metres_per_unit, up_axis=frame.up_axis, time=scene.time)
    opened = source if isinstance(source, OpenedStage) else open_stage(source, options)
    wanted = set(scene.by_path if paths is None else paths) & scene.by_path.keys()
    notes = diagnostics if diagnostics is not None else []
    known = _KnownShapes()
    found: dict[str, ShapeDescriptors] = {}
    with captured_diagnostics() as openusd_notes:
        for path, meshes in _own_meshes(opened, scene, wanted, notes):
            shape = known.describe(*_joined(meshes))
            if shape is not None:
                found[path] = shape
    notes.extend(openusd_notes)
    return {obj.prim_path: found[obj.prim_path] for obj in scene.objects if obj.prim_path in found}


def _own_meshes(
    opened: OpenedStage, scene: Scene, wanted: set[str], notes: list[Diagnostic]
) -> Iterator[tuple[str, list[ObjectMesh]]]:
    time = Usd.TimeCode.EarliestTime() if scene.time is None else Usd.TimeCode(scene.time)
    copies = {path for path in wanted if path.endswith("]")}
    own: dict[str, list[ObjectMesh]] = defaultdict(list)
    for mesh in iterate_meshes(opened, sorted(wanted - copies), time, diagnostics=notes):
        above = (str(path) for path in Sdf.Path(mesh.prim_path).GetAncestorsRange())
        owner = next((path for path in above if path in scene.by_path), None)
        if owner in wanted and not opened.stage.GetPrimAtPath(mesh.prim_path).IsA(UsdGeom.PointInstancer):
            own[owner].append(mesh)
    yield from own.items()
    for path in sorted(copies):
        yield path, list(iterate_meshes(opened, [path], time, diagnostics=notes))


def _joined(meshes: list[ObjectMesh]) -> tuple[Array, Indices]:
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    points = [mesh.points.astype(np.float64) for mesh in meshes]
    triangles = [mesh.triangles.astype(np.int64) + start for mesh, start in zip(meshes, starts, strict=False)]
    return np.concatenate([np.zeros((0, 3)), *points]), np.concatenate([np.zeros((0, 3), np.int64), *triangles])


class _Known(NamedTuple):
    points: Array
    shape: ShapeDescriptors


@dataclass
class _KnownShapes:
    """The shapes met so far, found again by triangles that are the same and points that are the same but turned.

    Comparing points rather than a hash of them: where an instance stands decides how its points are rounded.
    """

    by_triangles: dict[bytes, list[_Known]] = field(default_factory=lambda: defaultdict(list))

    def describe(self, points: Array, triangles: Indices) -> ShapeDescriptors | None:
        usable = _usable(points, triangles)
        if usable is None:
            return None
        key = hashlib.sha256(usable.triangles.tobytes()).digest()
        for known in self.by_triangles[key]:
            if _is_turned(known.points, usable):
                return known.shape
        shape = _describe(usable)
        self.by_triangles[key].append(_Known(usable.points, shape))
        return shape


class _Body(NamedTuple):
    """Triangles of one object about the middle of their box, without points that belong to none."""

    points: Array
    triangles: Indices
    noise: float
    """Metres by which points may be off, as they are stored in single precision."""

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))


def _usable(points: Array, triangles: Indices) -> _Body | None:
    is_usable = np.asarray((np.abs(points) < _FARTHEST).all(axis=1))
    used, corners = np.unique(triangles[is_usable[triangles].all(axis=1)], return_inverse=True)
    if not len(used):
        return None
    points = points[used]
    low, high = points.min(axis=0), points.max(axis=0)
    noise = _FLOAT32 * float(np.abs([low, high]).max())
    body = _Body(points - (low + high) / 2, corners.reshape(-1, 3), noise)
    return body if body.diagonal > _SMALLEST else None


def _is_turned(known: Array, body: _Body) -> bool:
    """Return whether two lists of points are the same up to a shift and a turn about z."""
    if known.shape != body.points.shape:
        return False
    here, there = known - known.mean(axis=0), body.points - body.points.mean(axis=0)
    allowed = max(_SAME * body.diagonal, 4 * body.noise)
    flat, flat_there = here[:, 0] + 1j * here[:, 1], there[:, 0] + 1j * there[:, 1]
    # The turn of least squares: the angle of the sum of the quotients' phases, weighted by length.
    turn = complex(np.vdot(flat, flat_there))
    unit = turn / abs(turn) if turn else 1.0
    is_level = np.abs(here[:, 2] - there[:, 2]).max() <= allowed
    return bool(is_level and np.abs(flat * unit - flat_there).max() <= allowed)


def describe_triangles(points: Array, triangles: Indices) -> ShapeDescriptors | None:
    """Return the shape of triangles; None where none has finite corners, or all corners are in one place.

    Args:
        points: (n, 3), metres, z-up.
        triangles: (m, 3), indices into `points`.
    """
    body = _usable(np.asarray(points, np.float64).reshape(-1, 3), np.asarray(triangles, np.int64).reshape(-1, 3))
    return _describe(body) if body is not None else None


def _describe(body: _Body) -> ShapeDescriptors:
    principal = np.linalg.eigh(np.cov(body.points.T, ddof=0))[1].T
    hull = convex_hull(body.points, max(_WELD * body.diagonal, body.noise))
    across = np.concatenate([[[0.0, 0.0, 1.0]], principal])
    if hull is not None:
        hull_volume, hull_surface = hull.volume, hull.surface
        box = smallest_box(hull.vertices, _standing(hull, across))
    else:
        hull_volume, hull_surface = 0.0, _flat_surface(body.points @ principal[1:].T)
        box = smallest_box(body.points, across)
    long, middle, short = box.size
    if hull is None:
        short = 0.0
    height = float(np.ptp(body.points[:, 2]))
    plan, (width, depth) = smallest_rectangle((body.points if hull is None else hull.vertices)[:, :2])
    has_inside = min(width, depth, height) > 4 * body.noise
    vessel = measure_vessel(body.points, body.triangles, plan) if has_inside else NO_VESSEL
    return ShapeDescriptors(
        volume_m3=_enclosed_volume(body),
        hull_volume_m3=hull_volume,
        surface_m2=float(np.linalg.norm(_areas(body.points, body.triangles), axis=1).sum()),
        long_m=long,
        middle_m=middle,
        short_m=short,
        elongation=1 - middle / long if long > 0 else None,
        flatness=1 - short / middle if middle > 0 else None,
        roundness=(36 * math.pi * hull_volume**2) ** (1 / 3) / hull_surface if hull_surface > 0 else None,
        verticality=height / (height + width) if height + width > 0 else None,
        openness=vessel.openness,
        capacity_m3=vessel.capacity_m3,
    )


def _standing(hull: ConvexHull, across: Array) -> Array:
    """Return the normals of the planes that a box around a hull may stand on: `across` and those of large faces.

    A box on the opposite face is the same, and round things have many faces of which none is large.
    """
    areas = hull.areas
    normals = np.concatenate([across, largest_normals(hull)])
    units = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    along = areas @ units.T
    is_on = along > _PARALLEL * np.linalg.norm(areas, axis=1)[:, None]
    is_large = np.where(is_on, along, 0.0).sum(axis=0) > _LARGE * hull.surface
    is_large[: len(across)] = True
    is_same = np.tril(np.abs(units @ units.T) > _PARALLEL, -1).any(axis=1)
    return np.asarray(normals[is_large & ~is_same])


def _areas(points: Array, triangles: Indices) -> Array:
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return np.asarray(np.cross(b - a, c - a) / 2)


def _flat_surface(points: Array) -> float:
    """Return both sides of the hull of points in a plane (n, 2)."""
    x, y = points[convex_polygon(points)].T
    return abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))


def _enclosed_volume(body: _Body) -> float | None:
    """Return the enclosed volume of all parts, None if a part is not closed; see `ShapeDescriptors.volume_m3`."""
    points, triangles = _welded(body)
    if not len(triangles):
        return None
    _, part = np.unique(_linked(triangles, len(points))[triangles[:, 0]], return_inverse=True)
    corners = points[triangles]
    # About each part's own middle: that of what is far away would be lost in rounding, and a gap weighs least.
    size = np.bincount(part)
    middle = np.stack([_sums(part, corners[..., i].mean(axis=1)) / size for i in range(3)], axis=1)
    a, b, c = np.moveaxis(corners - middle[part][:, None], 1, 0)
    volume = _sums(part, np.einsum("ij,ij->i", a, np.cross(b, c)) / 6)
    surface = _sums(part, np.linalg.norm(_areas(points, triangles), axis=1))
    gap = _open_length(points, triangles, part) ** 2 / (4 * math.pi)
    thinnest = max(10 * _WELD * body.diagonal, 4 * body.noise)
    if (gap > _GAP * surface).any() or (np.abs(volume) <= thinnest * surface).any():
        return None
    return float((np.abs(volume) * np.where(_is_cavity(corners, part, volume), -1, 1)).sum())


def _welded(body: _Body) -> tuple[Array, Indices]:
    """Return points and triangles with points at the same place as one, without triangles that shrink to a line."""
    step = max(_WELD * body.diagonal, body.noise)
    cells = np.round(body.points / step).astype(np.int64)
    cells -= cells.min(axis=0)
    keys = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    triangles = place.reshape(-1)[body.triangles]
    a, b, c = triangles.T
    return body.points[first], triangles[(a != b) & (b != c) & (c != a)]


def _linked(triangles: Indices, count: int) -> Indices:
    """Return a number for each point, the same for points that edges link (Shiloach & Vishkin 1982)."""
    label = np.arange(count)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]])
    while True:
        ends = label[edges]
        if (ends[:, 0] == ends[:, 1]).all():
            return label
        np.minimum.at(label, ends.max(axis=1), ends.min(axis=1))
        while (label != label[label]).any():
            label = label[label]


def _open_length(points: Array, triangles: Indices, part: Indices) -> Array:
    """Return for each part the length of the edges that are not passed as often one way as the other."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    way = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    keys = edges.min(axis=1) * len(points) + edges.max(axis=1)
    _, first, which = np.unique(keys, return_index=True, return_inverse=True)
    unpaired = np.abs(_sums(which.reshape(-1), way))
    length = np.linalg.norm(points[edges[first, 0]] - points[edges[first, 1]], axis=1)
    return _sums(np.tile(part, 3)[first], unpaired * length)


def _sums(part: Indices, values: Array) -> Array:
    return np.asarray(np.bincount(part, values), np.float64)


def _is_cavity(corners: Array, part: Indices, volume: Array) -> NDArray[np.bool_]:
    """Return for each part whether it looks the other way than the smallest larger part around it."""
    low, high = np.full((len(volume), 3), np.inf), np.full((len(volume), 3), -np.inf)
    np.minimum.at(low, part, corners.min(axis=1))
    np.maximum.at(high, part, corners.max(axis=1))
    size = np.abs(volume)
    found = np.zeros(len(volume), np.bool_)
    if (volume > 0).all() or (volume < 0).all():
        return found
    for i in range(len(volume)):
        around = np.flatnonzero((low <= low[i]).all(axis=1) & (high >= high[i]).all(axis=1) & (size > size[i]))
        if len(around):
            found[i] = (volume[around[size[around].argmin()]] > 0) != (volume[i] > 0)
    return found
