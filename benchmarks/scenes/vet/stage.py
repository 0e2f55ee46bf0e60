"""Collect groups and objects, and write them as a stage: Z up, millimetres, as a CAD export does."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from pxr import Gf, Kind, Sdf, Usd, UsdGeom

from benchmarks.scenes.prims import draw, write_instance, write_mesh, write_root, write_transform, write_unit_gprim
from benchmarks.scenes.vet.shapes import Part

__all__ = ["ROOT", "Group", "Practice", "write"]

ROOT = "/VetPractice"
BLOCKS = Sdf.Path("/_Blocks")
ERRORS = (0.0, 0.0, 0.5, 1.0, 1.5, 2.0, -0.5, -1.0, -1.5, -2.0)
"""Millimetres by which a standing thing is too high or too low, one of which is drawn by its path."""
Vec = Sequence[float]
ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class _Placed:
    parts: tuple[Part, ...]
    at: Vec
    rot: Vec
    scale: float
    block: str
    """The name of a prototype of which this is an instance; "": geometry of its own."""


class Practice:
    """The groups and objects so far, by path below the root."""

    def __init__(self) -> None:
        self.groups: dict[str, tuple[Vec, float, float]] = {}
        self.objects: dict[str, _Placed] = {}
        self.blocks: dict[str, tuple[Part, ...]] = {}

    def group(self, path: str, at: Vec = ORIGIN, yaw: float = 0.0) -> "Group":
        """Add a group with a transform of its own."""
        return Group(self, path, at, yaw)


class Group:
    """A prim of kind group, below which objects are placed in its own frame."""

    def __init__(self, practice: Practice, path: str, at: Vec, yaw: float, scale: float = 1.0) -> None:
        self.practice = practice
        self.path = path
        practice.groups[path] = (at, yaw, scale)

    def group(self, name: str, at: Vec = ORIGIN, yaw: float = 0.0, scale: float = 1.0) -> "Group":
        """Add a group within this one."""
        return Group(self.practice, f"{self.path}/{name}", at, yaw, scale)

    def put(
        self,
        name: str,
        parts: Part | Sequence[Part],
        at: Vec = ORIGIN,
        rot: Vec = ORIGIN,
        *,
        fixed: bool = False,
        block: str = "",
        scale: float = 1.0,
    ) -> None:
        """Add an object; unless it is fixed, it then stands a little too high or too low."""
        path = f"{self.path}/{name}"
        if path in self.practice.objects:
            raise ValueError(f"{path} is placed twice")
        known = (parts,) if isinstance(parts, Part) else tuple(parts)
        if block:
            known = self.practice.blocks.setdefault(block, known)
        error = 0.0 if fixed else draw(path, ERRORS)
        self.practice.objects[path] = _Placed(known, (at[0], at[1], at[2] + error), tuple(rot), scale, block)


def write(practice: Practice, out: Path) -> None:
    """Write the stage."""
    stage = Usd.Stage.CreateInMemory()
    write_root(stage, ROOT, up="Z", unit=0.001)
    for path, (at, yaw, scale) in practice.groups.items():
        xform = UsdGeom.Xform.Define(stage, f"{ROOT}/{path}")
        Usd.ModelAPI(xform.GetPrim()).SetKind(Kind.Tokens.group)
        write_transform(xform, at, (0, 0, yaw), (scale,) * 3)
    for path, placed in practice.objects.items():
        prim_path = Sdf.Path(f"{ROOT}/{path}")
        if placed.block:
            prototype = BLOCKS.AppendChild(placed.block)
            prim = write_instance(stage, prim_path, prototype, partial(_geometry, stage, parts=placed.parts))
        elif len(placed.parts) == 1 and placed.parts[0].kind == "Mesh":
            prim = _gprim(stage, prim_path, placed.parts[0])
        else:
            prim = UsdGeom.Xform.Define(stage, prim_path).GetPrim()
            _geometry(stage, prim_path, placed.parts)
        write_transform(UsdGeom.Xformable(prim), placed.at, placed.rot, (placed.scale,) * 3)
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
    stage.GetRootLayer().Export(str(out))


def _geometry(stage: Usd.Stage, path: Sdf.Path, parts: Sequence[Part]) -> None:
    for index, part in enumerate(parts):
        _gprim(stage, path.AppendChild(f"Body{index + 1}"), part)


def _gprim(stage: Usd.Stage, path: Sdf.Path, part: Part) -> Any:
    if part.kind == "Mesh":
        return write_mesh(stage, path, part.points, part.faces).GetPrim()
    gprim = write_unit_gprim(stage, path, part.kind, UsdGeom.Tokens.z)
    gprim.AddTransformOp().Set(Gf.Matrix4d(part.matrix.tolist()))
    return gprim.GetPrim()
