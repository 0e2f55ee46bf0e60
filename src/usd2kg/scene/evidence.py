"""What else the stage says about an object: asset, parts, mass, colour."""

import math
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any, NamedTuple

from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, Vt

from usd2kg.scene.bounds import BoxReader
from usd2kg.scene.metadata import vector_of
from usd2kg.scene.model import StageFrame, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.stage import read_value

__all__ = ["Mass", "asset_names", "display_color", "geometry_file", "own_records", "part_names", "read_mass"]

_FILES = 10_000
"""How many files are kept in mind: objects come from the same ones again and again."""
_COLORS = (Vt.Vec3fArray, Vt.Vec3dArray, Vt.Vec3hArray)


def own_records(record: PrimRecord, objects: frozenset[str] | dict[str, str]) -> Iterator[PrimRecord]:
    """Yield `record` and what is below it, without the other objects nested below it."""
    pending = [record]
    while pending:
        current = pending.pop()
        yield current
        if current.children:
            pending.extend(child for child in reversed(current.children) if child.path not in objects)


def asset_names(prim: Any) -> tuple[str, ...]:
    """Return the names of the asset a prim comes from: assetInfo name and identifier, then file stems."""
    names = []
    if prim.HasAuthoredAssetInfo():
        info = prim.GetAssetInfo()
        identifier = info.get("identifier")
        names = [str(info.get("name", "")), _stem(getattr(identifier, "path", str(identifier or "")))]
    if prim.HasAuthoredReferences() or prim.HasAuthoredPayloads():
        for spec in prim.GetPrimStack():
            for arcs in (spec.referenceList, spec.payloadList):
                names.extend(_stem(arc.assetPath) for arc in arcs.GetAddedOrExplicitItems())
    return tuple(dict.fromkeys(name for name in names if name))


@lru_cache(maxsize=_FILES)
def _stem(asset_path: str) -> str:
    return PurePosixPath(asset_path.replace("\\", "/")).stem


def geometry_file(records: list[PrimRecord]) -> str:
    """Return the path of the file that an object's geometry comes from; empty if there is none, or several.

    That is the strongest reference or payload on the object's prim, else the only one right below it. It is relative
    to the folder of the stage's root layer where the file lies in it (in a package: `room.usdz[chair.usda]`), else as
    authored.
    """
    if records[0].may_have_asset and (path := _strongest_file(records[0].prim)):
        return path
    below = [record for record in records[1:] if record.parent is records[0] and record.may_have_asset]
    paths = {path for record in below if (path := _strongest_file(record.prim))}
    return paths.pop() if len(paths) == 1 else ""


def _strongest_file(prim: Any) -> str:
    for spec in prim.GetPrimStack():
        for arcs in (spec.referenceList, spec.payloadList):
            for arc in arcs.GetAddedOrExplicitItems():
                if arc.assetPath:
                    return _beside_stage(arc.assetPath, spec.layer, prim.GetStage().GetRootLayer())
    return ""


def _beside_stage(asset_path: str, layer: Any, root: Any) -> str:
    """Return a path as seen from the root layer's folder, where the file lies in it."""
    beside = _path_beside(Sdf.ComputeAssetPathRelativeToLayer(layer, asset_path), root.realPath)
    return asset_path if beside is None else beside


@lru_cache(maxsize=_FILES)
def _path_beside(path: str, root: str) -> str | None:
    """Return a path as seen from the folder of the file `root`; None where it does not lie in it."""
    anchored, folder = Path(path), Path(root).parent
    is_inside = bool(root) and anchored.is_absolute() and anchored.is_relative_to(folder)
    return anchored.relative_to(folder).as_posix() if is_inside else None


def part_names(records: list[PrimRecord]) -> tuple[str, ...]:
    """Return the distinct names of the prims below an object, in order, its own name left out."""
    return tuple(dict.fromkeys(record.name for record in records[1:] if record.name != records[0].name))


class Mass(NamedTuple):
    """The authored mass of an object."""

    kg: float | None
    """Of the object's prim, or the sum over its parts; None if none is authored."""
    center: Vector | None
    """Centre of mass in the world, metres, z-up; None unless it is authored for all that has a mass."""


def read_mass(records: list[PrimRecord], boxes: BoxReader, frame: StageFrame) -> Mass:
    """Return the mass of the object's prim with its centre, or both for its parts together.

    UsdPhysics: a mass of 0 means "not authored, to be derived", so it is none; a centre that is not finite is none.
    """
    own = _mass(records[0])
    masses = [(records[0], own)] if own else [(record, mass) for record in records[1:] if (mass := _mass(record))]
    # Of huge and tiny masses and units the product may be none.
    total = sum(mass for _, mass in masses) * frame.kilograms_per_unit
    centers = [(center, mass) for record, mass in masses or [(records[0], 1.0)] if (center := _center(record, boxes))]
    is_known = len(centers) == max(len(masses), 1)
    return Mass(total if 0 < total < math.inf else None, _weighted_mean(centers) if is_known else None)


def _mass(record: PrimRecord) -> float | None:
    if not record.has_mass:
        return None
    mass = read_value(record.prim, UsdPhysics.Tokens.physicsMass, Usd.TimeCode.Default(), int, float)
    return float(f"{mass:.7g}") if mass and 0 < mass < math.inf else None


def _center(record: PrimRecord, boxes: BoxReader) -> Vector | None:
    if not record.has_mass:
        return None
    time = Usd.TimeCode.Default()
    center = read_value(record.prim, UsdPhysics.Tokens.physicsCenterOfMass, time, Gf.Vec3f, Gf.Vec3d, Gf.Vec3h)
    return boxes.read_point(record, center) if center is not None else None


def _weighted_mean(points: list[tuple[Vector, float]]) -> Vector | None:
    total = sum(weight for _, weight in points)
    x, y, z = (sum(point[axis] * weight for point, weight in points) / total for axis in range(3))
    return (x, y, z) if math.isfinite(x + y + z) else None


def display_color(records: list[PrimRecord], time: Usd.TimeCode) -> Vector | None:
    """Return the first display colour authored on the object's geometry, linear RGB; None if none is."""
    for record in records:
        if record.is_gprim and UsdGeom.Tokens.primvarsDisplayColor in record.authored.names:
            colors = read_value(record.prim, UsdGeom.Tokens.primvarsDisplayColor, time, *_COLORS)
            color = vector_of(colors[0]) if colors else None
            if color:
                return color
    return None
