"""Prims that the scripts of scenes write: meshes, gprims of size 1, instances and transforms."""

import hashlib
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Usd, UsdGeom

__all__ = ["draw", "write_instance", "write_mesh", "write_root", "write_transform", "write_unit_gprim"]


def draw(path: str, errors: Sequence[float]) -> float:
    """Return the one of the errors that the path of an object decides, the same in each run."""
    return errors[hashlib.sha256(path.encode()).digest()[0] % len(errors)]


def write_root(stage: Usd.Stage, path: Any, *, up: str, unit: float) -> None:
    """Write the frame of a stage, and the assembly that holds all of it.

    Args:
        stage: an empty stage.
        path: the path of the assembly, the default prim.
        up: the axis that points up, Y or Z.
        unit: metres per unit.
    """
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    root = UsdGeom.Xform.Define(stage, path).GetPrim()
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    stage.SetDefaultPrim(root)


def write_mesh(stage: Usd.Stage, path: Any, points: NDArray[np.float64], faces: Iterable[Sequence[int]]) -> Any:
    """Write a polygon mesh whose both sides are seen; return its schema.

    Args:
        stage: the stage.
        path: the path of the mesh.
        points: (n, 3), in the units of the prim above.
        faces: the indices of the corners of each face.
    """
    corners = [list(map(int, face)) for face in faces]
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(points.astype(np.float32))
    mesh.CreateFaceVertexCountsAttr([len(face) for face in corners])
    mesh.CreateFaceVertexIndicesAttr([index for face in corners for index in face])
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateDoubleSidedAttr(True)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(mesh.GetPointsAttr().Get()))
    return mesh


def write_unit_gprim(stage: Usd.Stage, path: Any, kind: str, axis: str) -> Any:
    """Write a Cube, Sphere, Cylinder or Cone that fills a cube of side 1; return its schema."""
    gprim = getattr(UsdGeom, kind).Define(stage, path)
    if kind == "Cube":
        gprim.CreateSizeAttr(1.0)
    else:
        gprim.CreateRadiusAttr(0.5)
    if kind in {"Cylinder", "Cone"}:
        gprim.CreateHeightAttr(1.0)
        gprim.CreateAxisAttr(axis)
    return gprim


def write_instance(stage: Usd.Stage, path: Any, prototype: Sdf.Path, write_parts: Callable[[Sdf.Path], None]) -> Any:
    """Write an instance; return its prim.

    Args:
        stage: the stage.
        path: the path of the instance.
        prototype: the path of what is instanced, below a class prim; it is written with the first instance.
        write_parts: writes the geometry below the prototype.
    """
    if not stage.GetPrimAtPath(prototype):
        stage.CreateClassPrim(prototype.GetParentPath())
        UsdGeom.Xform.Define(stage, prototype)
        write_parts(prototype)
    prim = UsdGeom.Xform.Define(stage, path).GetPrim()
    prim.GetReferences().AddInternalReference(prototype)
    prim.SetInstanceable(True)
    return prim


def write_transform(
    xform: UsdGeom.Xformable, at: Sequence[float], rot: Sequence[float], scale: Sequence[float]
) -> None:
    """Write a scale, a rotation by degrees about x, then y, then z, and a translation; identities are left out."""
    if any(at):
        xform.AddTranslateOp().Set(Gf.Vec3d(*map(float, at)))
    if any(rot):
        xform.AddRotateXYZOp().Set(Gf.Vec3f(*map(float, rot)))
    if any(value != 1.0 for value in scale):
        xform.AddScaleOp().Set(Gf.Vec3f(*map(float, scale)))
