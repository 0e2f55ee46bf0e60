"""Evidence on objects: asset names, geometry file, part names, display colour, and all other fields."""

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any, NamedTuple

from pxr import Sdf, Usd, UsdGeom, Vt

from usd2kg.scene.instancers import count_copies
from usd2kg.scene.label_reader import LabelReader
from usd2kg.scene.metadata import MaterialReader, source_id, text_attributes, variant_selections, vector_of
from usd2kg.scene.model import NO_LABELS, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.stage import read_value

__all__ = [
    "NO_EVIDENCE",
    "AssetArc",
    "asset_arcs",
    "asset_names",
    "display_color",
    "geometry_file",
    "own_records",
    "part_names",
    "stated_fields",
]

NO_EVIDENCE: dict[str, Any] = {"mass_kg": None, "asset": (), "materials": (), "display_color": None}
"""Fields of `SceneObject` without defaults, for a prim that OpenUSD cannot read."""

_CACHE_SIZE = 10_000
"""Asset paths that each cache keeps; many objects reference the same few files."""
_COLORS = (Vt.Vec3fArray, Vt.Vec3dArray, Vt.Vec3hArray)


def own_records(record: PrimRecord, objects: frozenset[str] | dict[str, str]) -> Iterator[PrimRecord]:
    """Yield a prim and the prims below it, without nested objects.

    Args:
        record: the prim of an object.
        objects: the paths of all objects.
    """
    pending = [record]
    while pending:
        current = pending.pop()
        yield current
        if current.children:
            pending.extend(child for child in reversed(current.children) if child.path not in objects)


class AssetArc(NamedTuple):
    """A reference or payload."""

    layer: Any
    """The layer that states it."""
    asset_path: str
    """As authored; empty for a prim in the same layer."""


def asset_arcs(prim: Any) -> list[AssetArc]:
    """Return the references and payloads of a prim, the strongest first."""
    return [
        AssetArc(spec.layer, arc.assetPath)
        for spec in prim.GetPrimStack()
        if spec.hasReferences or spec.hasPayloads
        for arcs in (spec.referenceList, spec.payloadList)
        for arc in arcs.GetAddedOrExplicitItems()
    ]


def asset_names(info: Mapping[str, Any], arcs: Sequence[AssetArc]) -> tuple[str, ...]:
    """Return the names of a prim's asset: name and identifier of assetInfo, then the stems of referenced files.

    Args:
        info: the prim's assetInfo; empty if it has none.
        arcs: its references and payloads.
    """
    identifier = info.get("identifier")
    names = [str(info.get("name", "")), _stem(getattr(identifier, "path", str(identifier or "")))]
    names.extend(_stem(arc.asset_path) for arc in arcs)
    return tuple(dict.fromkeys(name for name in names if name))


@lru_cache(maxsize=_CACHE_SIZE)
def _stem(asset_path: str) -> str:
    return PurePosixPath(asset_path.replace("\\", "/")).stem


def geometry_file(records: list[PrimRecord], arcs: Sequence[AssetArc]) -> str:
    """Return the file of an object's geometry; empty if there is none, or more than one.

    The strongest reference or payload on the object's prim, else the only one on its children. The path is relative to
    the folder of the root layer if the file is in it (in a package: `room.usdz[chair.usda]`), else as authored.

    Args:
        records: the object's prim and the prims below it without nested objects.
        arcs: the references and payloads of the object's prim.
    """
    if path := _strongest_file(records[0], arcs):
        return path
    below = [record for record in records[1:] if record.parent is records[0] and record.may_have_asset]
    paths = {path for record in below if (path := _strongest_file(record, asset_arcs(record.prim)))}
    return paths.pop() if len(paths) == 1 else ""


def _strongest_file(record: PrimRecord, arcs: Sequence[AssetArc]) -> str:
    for layer, asset_path in arcs:
        if asset_path:
            path = Sdf.ComputeAssetPathRelativeToLayer(layer, asset_path)
            relative = _relative_path(path, record.stage.GetRootLayer().realPath)
            return str(asset_path) if relative is None else relative
    return ""


@lru_cache(maxsize=_CACHE_SIZE)
def _relative_path(path: str, root: str) -> str | None:
    """Return a path relative to the folder of the file `root`; None if it is not in that folder."""
    anchored, folder = Path(path), Path(root).parent
    is_inside = bool(root) and anchored.is_absolute() and anchored.is_relative_to(folder)
    return anchored.relative_to(folder).as_posix() if is_inside else None


def part_names(records: list[PrimRecord]) -> tuple[str, ...]:
    """Return the distinct names of the prims below an object, in traversal order, without its own name."""
    return tuple(dict.fromkeys(record.name for record in records[1:] if record.name != records[0].name))


def display_color(records: list[PrimRecord], time: Usd.TimeCode) -> Vector | None:
    """Return the first display colour authored on an object's geometry, linear RGB; None if there is none."""
    for record in records:
        if record.is_gprim and UsdGeom.Tokens.primvarsDisplayColor in record.authored.names:
            colors = read_value(record.prim, UsdGeom.Tokens.primvarsDisplayColor, time, *_COLORS)
            color = vector_of(colors[0]) if colors else None
            if color:
                return color
    return None


def stated_fields(
    records: list[PrimRecord], materials: MaterialReader, labels: LabelReader | None, time: Usd.TimeCode
) -> dict[str, Any]:
    """Return the fields of `SceneObject` that hold wherever the prim is, except its mass.

    Args:
        records: the object's prim and the prims below it without nested objects.
        materials: reads the bound materials.
        labels: reads the labels; None if no prim has one.
        time: time code.
    """
    record, prim = records[0], records[0].prim
    arcs = asset_arcs(prim) if record.may_have_asset else []
    bound = materials.read(records)
    return {
        "asset": asset_names(record.metadata.get("assetInfo", {}), arcs),
        "geometry_file": geometry_file(records, arcs),
        "materials": tuple(dict.fromkeys(material.name for material in bound)),
        "material_details": bound,
        "display_color": display_color(records, time),
        "instances": count_copies(records, time),
        "labels": NO_LABELS if labels is None else labels.read(records),
        "variants": variant_selections(prim),
        "source_id": source_id(prim) if "customData" in record.metadata else "",
        "texts": text_attributes(prim, time) if record.may_have_texts else (),
    }
