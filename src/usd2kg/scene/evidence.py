"""What else the stage says about an object: asset, parts, mass, colour."""

import math
from collections.abc import Iterator
from pathlib import PurePosixPath
from typing import Any

from pxr import Usd, UsdGeom, UsdPhysics, Vt

from usd2kg.scene.metadata import vector_of
from usd2kg.scene.model import StageFrame, Vector
from usd2kg.scene.outline import Node
from usd2kg.scene.stage import read_value

__all__ = ["asset_names", "display_color", "mass_kg", "own_nodes", "part_names"]

_COLORS = (Vt.Vec3fArray, Vt.Vec3dArray, Vt.Vec3hArray)


def own_nodes(node: Node, objects: frozenset[str] | dict[str, str]) -> Iterator[Node]:
    """Yield `node` and what is below it, without the other objects nested below it."""
    pending = [node]
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


def _stem(asset_path: str) -> str:
    return PurePosixPath(asset_path.replace("\\", "/")).stem


def part_names(nodes: list[Node]) -> tuple[str, ...]:
    """Return the distinct names of the prims below an object, in order, its own name left out."""
    return tuple(dict.fromkeys(node.name for node in nodes[1:] if node.name != nodes[0].name))


def mass_kg(nodes: list[Node], frame: StageFrame) -> float | None:
    """Return the authored mass of the object's prim, or the sum over its parts; None if none is authored.

    UsdPhysics: a mass of 0 means "not authored, to be derived", so it is none.
    """
    own = _mass(nodes[0])
    parts = [own] if own else [mass for node in nodes[1:] if (mass := _mass(node))]
    # Of huge and tiny masses and units the product may be none.
    total = sum(parts) * frame.kilograms_per_unit
    return total if 0 < total < math.inf else None


def _mass(node: Node) -> float | None:
    if not node.has_mass:
        return None
    mass = read_value(node.prim, UsdPhysics.Tokens.physicsMass, Usd.TimeCode.Default(), int, float)
    return float(f"{mass:.7g}") if mass and 0 < mass < math.inf else None


def display_color(nodes: list[Node], time: Usd.TimeCode) -> Vector | None:
    """Return the first display colour authored on the object's geometry, linear RGB; None if none is."""
    for node in nodes:
        if node.is_gprim and UsdGeom.Tokens.primvarsDisplayColor in node.authored.names:
            colors = read_value(node.prim, UsdGeom.Tokens.primvarsDisplayColor, time, *_COLORS)
            color = vector_of(colors[0]) if colors else None
            if color:
                return color
    return None
