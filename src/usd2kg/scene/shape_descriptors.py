"""Shape descriptors of the objects of a scene."""

import hashlib
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom

from usd2kg.scene.meshes import ObjectMesh, iterate_meshes
from usd2kg.scene.model import Diagnostic, Scene
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import OpenedStage, captured_diagnostics, open_stage, time_code
from usd2kg.shapes.descriptors import ShapeDescriptors, describe_mesh
from usd2kg.shapes.triangle_mesh import is_turned_copy, make_triangle_mesh

__all__ = ["ShapeDescriptors", "describe_shapes"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def describe_shapes(
    source: OpenedStage | Path | str | Usd.Stage,
    scene: Scene,
    paths: Iterable[str] | None = None,
    *,
    diagnostics: list[Diagnostic] | None = None,
) -> Mapping[str, ShapeDescriptors]:
    """Return prim path → shape of the objects of a scene, in the order of the scene.

    The shape is that of an object's own visible geometry, without nested objects and without the copies of point
    instancers, unless each copy is an object. Objects without such geometry are left out. Objects that differ only by
    a translation and a rotation about the vertical are measured once.

    Args:
        source: the stage that the scene was read from.
        scene: what `read_scene` returned for it.
        paths: the objects to describe; default: all. Other paths are ignored.
        diagnostics: receives a note for each geometry prim that is left out because its data are broken.

    Raises:
        SceneError: the stage cannot be read or is not the scene's, or scipy is not installed.
    """
    frame = scene.frame
    options = ReadOptions(metres_per_unit=frame.metres_per_unit, up_axis=frame.up_axis, time=scene.time)
    opened = source if isinstance(source, OpenedStage) else open_stage(source, options)
    wanted = set(scene.by_path if paths is None else paths) & scene.by_path.keys()
    notes = diagnostics if diagnostics is not None else []
    cache = _ShapeCache()
    found: dict[str, ShapeDescriptors] = {}
    with captured_diagnostics() as openusd_notes:
        for path, meshes in _own_meshes(opened, scene, wanted, notes):
            shape = cache.describe(*_joined(meshes))
            if shape is not None:
                found[path] = shape
    notes.extend(openusd_notes)
    return {obj.prim_path: found[obj.prim_path] for obj in scene.objects if obj.prim_path in found}


def _own_meshes(
    opened: OpenedStage, scene: Scene, wanted: set[str], notes: list[Diagnostic]
) -> Iterator[tuple[str, list[ObjectMesh]]]:
    time = time_code(scene.time)
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


class _KnownShape(NamedTuple):
    points: Array
    shape: ShapeDescriptors


class _ShapeCache:
    """The shapes measured so far, by triangles; points are compared up to a rotation about z.

    Points cannot be hashed, because their rounding depends on the position of the instance.
    """

    def __init__(self) -> None:
        self._by_triangles: dict[bytes, list[_KnownShape]] = defaultdict(list)

    def describe(self, points: Array, triangles: Indices) -> ShapeDescriptors | None:
        mesh = make_triangle_mesh(points, triangles)
        if mesh is None:
            return None
        known = self._by_triangles[hashlib.sha256(mesh.triangles.tobytes()).digest()]
        for entry in known:
            if is_turned_copy(entry.points, mesh):
                return entry.shape
        shape = describe_mesh(mesh)
        known.append(_KnownShape(mesh.points, shape))
        return shape
