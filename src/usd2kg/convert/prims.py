"""Author prims with the names, transforms, colours and metadata of a source file."""

import json
from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

__all__ = ["PrimAuthor", "SourceMesh", "custom_data", "new_stage", "safe_name", "valid_text"]

_MAX_DEPTH = 8
"""Nesting of dictionaries that custom data keeps; deeper ones become JSON text."""
_INT64 = range(-(2**63), 2**63)


class SourceMesh:
    """Triangles in the frame of a prim, with optional colours."""

    def __init__(
        self, points: ArrayLike, triangles: ArrayLike, colors: ArrayLike | None = None, *, is_per_point: bool = False
    ) -> None:
        """Keep points (n, 3), triangles (m, 3) as indices, and colours as linear RGB.

        There is one colour (1, 3), or one for each triangle (m, 3) or, with `is_per_point`, for each point (n, 3).
        """
        self.points = np.asarray(points, np.float32).reshape(-1, 3)
        self.triangles = np.asarray(triangles, np.int32).reshape(-1, 3)
        self.colors = None if colors is None else np.asarray(colors, np.float32).reshape(-1, 3)
        self.is_per_point = is_per_point

    @cached_property
    def arrays(self) -> "_MeshArrays":
        """The values of a mesh prim; OpenUSD shares their memory among all prims of the same mesh."""
        points = Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(self.points))
        return _MeshArrays(
            points,
            Vt.IntArray(len(self.triangles), 3),
            Vt.IntArray.FromNumpy(np.ascontiguousarray(self.triangles.reshape(-1))),
            UsdGeom.PointBased.ComputeExtent(points) if len(points) else None,
        )


class _MeshArrays(NamedTuple):
    points: Any
    counts: Any
    """Number of corners of each face."""
    indices: Any
    extent: Any
    """Lower and upper corner; None without points."""


def new_stage(up_axis: str, metres_per_unit: float) -> Usd.Stage:
    """Return an empty stage in memory with its units and up axis."""
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, up_axis)
    UsdGeom.SetStageMetersPerUnit(stage, metres_per_unit)
    return stage


class PrimAuthor:
    """Defines prims below each other; siblings with the same name get a number."""

    def __init__(self, stage: Usd.Stage) -> None:
        self.stage = stage
        self._taken: dict[str, set[str]] = {}
        self._next: dict[tuple[str, str], int] = {}

    def define(self, parent: str, name: str, type_name: str = "Xform", display_name: str = "") -> Usd.Prim:
        """Return a new prim below the path `parent`.

        The display name is the given one; without one, it keeps a name that is not a valid prim name.
        """
        path = Sdf.Path(parent).AppendChild(self._free_name(parent, safe_name(name)))
        prim = self.stage.DefinePrim(path, type_name)
        shown = display_name or name
        if path.name != shown and shown:
            prim.SetDisplayName(valid_text(shown))
        return prim

    def _free_name(self, parent: str, name: str) -> str:
        taken = self._taken.setdefault(parent, set())
        free, number = name, self._next.get((parent, name), 1)
        while free in taken:
            free, number = f"{name}_{number}", number + 1
        self._next[parent, name] = number
        taken.add(free)
        return free

    def define_mesh(self, parent: str, name: str, mesh: SourceMesh) -> Usd.Prim:
        """Return a new mesh below the path `parent`."""
        prim = self.define(parent, name, "Mesh")
        geometry = UsdGeom.Mesh(prim)
        arrays = mesh.arrays
        geometry.CreatePointsAttr(arrays.points)
        geometry.CreateFaceVertexCountsAttr(arrays.counts)
        geometry.CreateFaceVertexIndicesAttr(arrays.indices)
        geometry.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        if arrays.extent:
            geometry.CreateExtentAttr(arrays.extent)
        if mesh.colors is not None and len(mesh.colors):
            self._color(geometry, mesh, mesh.colors)
        return prim

    def _color(self, geometry: Any, mesh: SourceMesh, colors: NDArray[np.float32]) -> None:
        tokens = UsdGeom.Tokens
        interpolation = tokens.vertex if mesh.is_per_point else tokens.uniform
        if len(colors) == 1 or (colors == colors[0]).all():
            colors, interpolation = colors[:1], tokens.constant
        primvar = geometry.CreateDisplayColorPrimvar(interpolation)
        primvar.Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(colors)))

    def move(self, prim: Usd.Prim, matrix: NDArray[np.float64]) -> None:
        """Place a prim in the frame of its parent; `matrix` (4, 4) acts on column vectors. Nothing for identity."""
        if not np.array_equal(matrix, np.eye(4)):
            rows = np.asarray(matrix, np.float64).T.tolist()
            UsdGeom.Xformable(prim).AddTransformOp().Set(Gf.Matrix4d(rows))


def safe_name(name: str) -> str:
    """Return a valid prim name that is as close to `name` as possible; letters of all scripts are kept.

    >>> safe_name("Tür 1/links"), safe_name("3 cups"), safe_name("")
    ('Tür_1_links', '_3_cups', 'prim')
    """
    kept = "".join(c if f"a{c}".isidentifier() else "_" for c in name)
    kept = kept if kept[:1].isidentifier() or not kept else f"_{kept}"
    if Sdf.Path.IsValidIdentifier(kept):
        return kept
    # Python and OpenUSD may know different versions of Unicode.
    return "".join(c if c.isascii() else "_" for c in kept) or "prim"


def valid_text(text: str) -> str:
    """Return text that a layer can hold: without lone surrogates, which JSON can express, and without NUL."""
    return text.encode("utf-8", "replace").decode("utf-8").replace("\0", "")


def custom_data(values: Mapping[Any, Any], depth: int = 0) -> dict[str, Any]:
    """Return values of JSON as custom data; values that a layer cannot hold become JSON text, nulls are left out."""
    pairs = ((valid_text(str(key)), _custom_value(value, depth)) for key, value in values.items())
    return {key: value for key, value in pairs if key and value is not None}


def _custom_value(value: Any, depth: int) -> Any:
    if isinstance(value, str):
        return valid_text(value)
    if value is None or isinstance(value, bool | float) or (isinstance(value, int) and value in _INT64):
        return value
    if isinstance(value, Mapping) and depth < _MAX_DEPTH:
        return custom_data(value, depth + 1)
    return _array(value) if isinstance(value, list | tuple) and value else _json(value)


def _array(values: list[Any] | tuple[Any, ...]) -> Any:
    if all(isinstance(item, str) for item in values):
        return Vt.StringArray([valid_text(item) for item in values])
    if all(type(item) in {int, float} for item in values):
        return Vt.DoubleArray([float(item) for item in values])
    return _json(values)


def _json(value: Any) -> str:
    return valid_text(json.dumps(value, default=str))
