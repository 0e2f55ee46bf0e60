"""Write objects to the stage: groups, meshes and instances, with the small faults of a real asset."""

import random
from pathlib import Path
from typing import NamedTuple

from pxr import Gf, Kind, Sdf, Usd, UsdGeom, Vt

from benchmarks.scenes.pottery.shapes import Mesh
from benchmarks.scenes.prims import write_instance

__all__ = ["Group", "Part", "Pottery", "Shape", "shape"]

Point = tuple[float, float, float]

_LIFT = 0.18
"""Centimetres by which a standing thing may be too high or too low."""


class Part(NamedTuple):
    """A mesh with one colour."""

    mesh: Mesh
    color: Point
    opacity: float = 1


class Shape(NamedTuple):
    """The parts of an object, and the name of its asset if copies are instances."""

    parts: tuple[Part, ...]
    asset: str | None = None

    @property
    def height(self) -> float:
        """Its extent along z."""
        lows, highs = zip(
            *((part.mesh.points[:, 2].min(), part.mesh.points[:, 2].max()) for part in self.parts), strict=True
        )
        return float(max(highs) - min(lows))


def shape(mesh: Mesh, color: Point, *others: Part, opacity: float = 1, asset: str | None = None) -> Shape:
    """Return a shape of a mesh and further parts."""
    return Shape((Part(mesh, color, opacity), *others), asset)


class Group(NamedTuple):
    """A prim with a transform, below which things are placed."""

    path: str
    unit: float
    """Its units in one centimetre: the kiln room is modelled in millimetres."""


class Pottery:
    """A stage that is being written: y up, in metres; below its root, z is up and lengths are in centimetres."""

    def __init__(self, out: Path) -> None:
        self.stage = Usd.Stage.CreateNew(str(out))
        UsdGeom.SetStageUpAxis(self.stage, UsdGeom.Tokens.y)
        UsdGeom.SetStageMetersPerUnit(self.stage, 1)
        root = UsdGeom.Xform.Define(self.stage, "/Pottery")
        root.AddRotateXYZOp().Set(Gf.Vec3f(-90, 0, 0))
        root.AddScaleOp().Set(Gf.Vec3f(0.01))
        Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
        self.stage.SetDefaultPrim(root.GetPrim())
        self.root = Group("/Pottery", 1)
        self.things: list[str] = []

    def group(self, parent: Group, name: str, at: Point = (0, 0, 0), turn: float = 0, unit: float = 1) -> Group:
        """Add a group, turned about z; the units of its contents are `unit` times smaller."""
        path = f"{parent.path}/{name}"
        xform = UsdGeom.Xform.Define(self.stage, path)
        Usd.ModelAPI(xform).SetKind(Kind.Tokens.group)
        if any(at):
            xform.AddTranslateOp().Set(Gf.Vec3d(*at) * parent.unit)
        if turn:
            xform.AddRotateZOp().Set(turn)
        if unit != 1:
            xform.AddScaleOp().Set(Gf.Vec3f(1 / unit))
        return Group(path, parent.unit * unit)

    def put(self, group: Group, name: str, what: Shape, at: Point, turn: float = 0, rot: Point | None = None) -> None:
        """Add a thing that stands or lies: a little too high or too low, never sunk by much of its height."""
        draw = random.Random(f"{group.path}/{name}")
        lift = draw.uniform(-min(_LIFT, 0.3 * what.height), _LIFT)
        self.fix(group, name, what, (at[0], at[1], at[2] + lift), turn, rot)

    def wall(self, group: Group, name: str, what: Shape, at: Point, turn: float = 0) -> None:
        """Add a thing at a wall whose face is y = 0 of the group: up to 3.5 mm off it or 2 mm in it."""
        off = random.Random(f"{group.path}/{name}").uniform(-0.35, 0.2)
        self.fix(group, name, what, (at[0], at[1] + off, at[2]), turn)

    def fix(self, group: Group, name: str, what: Shape, at: Point, turn: float = 0, rot: Point | None = None) -> None:
        """Add a thing exactly where it is said, turned about z or by three angles."""
        path = f"{group.path}/{name}"
        draw = random.Random(path)
        angles = rot or (0, 0, turn)
        single = len(what.parts) == 1 and what.asset is None and draw.random() < 0.5
        if single:
            gprim = self._write_mesh(path, what.parts[0], group.unit)
        elif what.asset:
            gprim = self._refer(path, what)
        else:
            gprim = UsdGeom.Xform.Define(self.stage, path)
            self._write_parts(path, what, group.unit)
        Usd.ModelAPI(gprim).SetKind(Kind.Tokens.component)
        self._place(gprim, Gf.Vec3d(*at) * group.unit, angles, group.unit if what.asset else 1, draw.random() < 0.3)
        self.things.append(path)

    def _place(self, gprim: UsdGeom.Xformable, at: Gf.Vec3d, angles: Point, scale: float, matrix: bool) -> None:
        """Write a transform, as a matrix or as separate operations."""
        if matrix:
            rotation = Gf.Matrix3d(1)
            for axis, angle in zip((Gf.Vec3d.XAxis(), Gf.Vec3d.YAxis(), Gf.Vec3d.ZAxis()), angles, strict=True):
                rotation *= Gf.Matrix3d(Gf.Rotation(axis, angle))
            gprim.AddTransformOp().Set(Gf.Matrix4d(rotation * Gf.Matrix3d(scale), at))
            return
        gprim.AddTranslateOp().Set(at)
        if any(angles):
            gprim.AddRotateXYZOp().Set(Gf.Vec3f(*angles))
        if scale != 1:
            gprim.AddScaleOp().Set(Gf.Vec3f(scale))

    def _refer(self, path: str, what: Shape) -> UsdGeom.Xform:
        """Return an instance of an asset, which is written once as a class."""
        source = Sdf.Path(f"/_assets/{what.asset}")
        return UsdGeom.Xform(
            write_instance(self.stage, path, source, lambda path: self._write_parts(str(path), what, 1))
        )

    def _write_parts(self, path: str, what: Shape, unit: float) -> None:
        for number, part in enumerate(what.parts, 1):
            self._write_mesh(f"{path}/mesh_{number:03d}", part, unit)

    def _write_mesh(self, path: str, part: Part, unit: float) -> UsdGeom.Mesh:
        mesh = UsdGeom.Mesh.Define(self.stage, path)
        points = Vt.Vec3fArray.FromNumpy((part.mesh.points * unit).astype("float32"))
        mesh.CreatePointsAttr(points)
        mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
        mesh.CreateFaceVertexCountsAttr([len(face) for face in part.mesh.faces])
        mesh.CreateFaceVertexIndicesAttr([index for face in part.mesh.faces for index in face])
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        mesh.CreateDisplayColorAttr([Gf.Vec3f(*part.color)])
        if part.opacity < 1:
            mesh.CreateDisplayOpacityAttr([part.opacity])
        return mesh
