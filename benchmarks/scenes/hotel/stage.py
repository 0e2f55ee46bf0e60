"""Collect groups and objects, and write them as a stage: Y up, centimetres, as Maya does."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from pxr import Kind, Sdf, Usd, UsdGeom

from benchmarks.scenes.hotel.shapes import Part, resized
from benchmarks.scenes.prims import draw, write_instance, write_mesh, write_root, write_transform, write_unit_gprim

__all__ = ["Group", "Hotel", "write"]

ROOT = "/hotel_floor2"
PROTOTYPES = Sdf.Path("/_library")
ERRORS = (0.0, 0.0, 0.05, 0.1, 0.15, 0.2, -0.05, -0.1, -0.15, -0.2)
"""Centimetres by which a standing thing is too high or too low, one of which is drawn by its path."""
Vec = Sequence[float]
ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class _Placed:
    parts: tuple[Part, ...]
    at: Vec
    rot: Vec
    scale: float
    asset: str
    """The name of a prototype of which this is an instance; "": geometry of its own."""


class Hotel:
    """The groups and objects so far, by path below the root."""

    def __init__(self) -> None:
        self.groups: dict[str, tuple[Vec, Vec, float]] = {}
        self.objects: dict[str, _Placed] = {}
        self.assets: dict[str, tuple[Part, ...]] = {}

    def group(self, path: str, at: Vec = ORIGIN, yaw: float = 0.0, unit: float = 1.0) -> "Group":
        """Add a group with a transform of its own."""
        return Group(self, path, at, yaw, unit, 1.0)


class Group:
    """A prim of kind group, below which objects are placed in its own frame."""

    def __init__(self, hotel: Hotel, path: str, at: Vec, yaw: float, unit: float, outer: float) -> None:
        self.hotel = hotel
        self.path = path
        self.unit = unit * outer
        """Centimetres per unit of what is written below; all that is passed here is in centimetres."""
        hotel.groups[path] = (_divided(at, outer), (0.0, yaw, 0.0), unit)

    def group(self, name: str, at: Vec = ORIGIN, yaw: float = 0.0, unit: float = 1.0) -> "Group":
        """Add a group within this one."""
        return Group(self.hotel, f"{self.path}/{name}", at, yaw, unit, self.unit)

    def put(
        self,
        name: str,
        parts: Part | Sequence[Part],
        at: Vec = ORIGIN,
        rot: Vec = ORIGIN,
        *,
        fixed: bool = False,
        asset: str = "",
        scale: float = 1.0,
    ) -> None:
        """Add an object; unless it is fixed, it then stands a little too high or too low."""
        path = f"{self.path}/{name}"
        if path in self.hotel.objects:
            raise ValueError(f"{path} is placed twice")
        known = (parts,) if isinstance(parts, Part) else tuple(parts)
        if asset:
            # All copies share one mesh, in centimetres.
            known = self.hotel.assets.setdefault(asset, known)
            scale /= self.unit
        elif self.unit != 1:
            known = tuple(resized(part, 1 / self.unit) for part in known)
        error = 0.0 if fixed else draw(path, ERRORS)
        place = _divided((at[0], at[1] + error, at[2]), self.unit)
        self.hotel.objects[path] = _Placed(known, place, tuple(rot), scale, asset)


def _divided(values: Vec, unit: float) -> Vec:
    return tuple(value / unit for value in values)


def write(hotel: Hotel, out: Path) -> None:
    """Write the stage."""
    stage = Usd.Stage.CreateInMemory()
    write_root(stage, ROOT, up="Y", unit=0.01)
    for path, (at, rot, unit) in hotel.groups.items():
        xform = UsdGeom.Xform.Define(stage, f"{ROOT}/{path}")
        Usd.ModelAPI(xform.GetPrim()).SetKind(Kind.Tokens.group)
        write_transform(xform, at, rot, (unit,) * 3)
    for path, placed in hotel.objects.items():
        prim_path = Sdf.Path(f"{ROOT}/{path}")
        if placed.asset:
            prototype = PROTOTYPES.AppendChild(placed.asset)
            prim = write_instance(stage, prim_path, prototype, partial(_geometry, stage, parts=placed.parts))
        elif len(placed.parts) == 1 and _is_plain_mesh(placed.parts[0]):
            prim = _gprim(stage, prim_path, placed.parts[0], pose=False)
        else:
            prim = UsdGeom.Xform.Define(stage, prim_path).GetPrim()
            _geometry(stage, prim_path, placed.parts)
        write_transform(UsdGeom.Xformable(prim), placed.at, placed.rot, (placed.scale,) * 3)
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
    stage.GetRootLayer().Export(str(out))


def _is_plain_mesh(part: Part) -> bool:
    return part.kind == "Mesh" and not any((*part.at, *part.rot))


def _geometry(stage: Usd.Stage, path: Sdf.Path, parts: Sequence[Part]) -> None:
    for index, part in enumerate(parts):
        _gprim(stage, path.AppendChild(f"{part.kind.lower()}_{index + 1}"), part, pose=True)


def _gprim(stage: Usd.Stage, path: Sdf.Path, part: Part, *, pose: bool) -> Any:
    if part.kind == "Mesh":
        gprim = write_mesh(stage, path, part.points, part.faces)
    else:
        gprim = write_unit_gprim(stage, path, part.kind, UsdGeom.Tokens.y)
    if pose:
        write_transform(gprim, part.at, part.rot, part.size)
    return gprim.GetPrim()
