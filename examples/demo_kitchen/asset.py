"""One asset: its parts in memory, and its USD file."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from .mesh import Floats, Mesh, Vec3, is_flat
from .palette import PALETTE


@dataclass(frozen=True)
class Part:
    """One mesh of an asset."""

    path: str
    """Below the asset's root, `/` between the names of Xforms."""
    mesh: Mesh
    material: str
    """Key of `PALETTE`."""
    purpose: str = "default"


@dataclass(frozen=True)
class Hinge:
    """A part that turns about a vertical axis."""

    part: str
    """Path of the part's Xform."""
    pivot: Vec3
    """A point of the axis, centimetres."""
    opened: float
    """Angle about y of the open state, degrees."""


@dataclass
class Asset:
    """Parts with the origin where the asset rests or is fixed; centimetres, front towards +z."""

    name: str
    looks: str = "Looks"
    """Name of the material scope."""
    parts: list[Part] = field(default_factory=list)
    subcomponents: list[str] = field(default_factory=list)
    """Paths of Xforms with kind `subcomponent`."""
    surfaces: dict[str, float] = field(default_factory=dict)
    """Heights above the origin where things can stand; `top` defaults to the highest point."""
    hinges: list[Hinge] = field(default_factory=list)
    documentation: str = ""

    def add(self, path: str, mesh: Mesh, material: str) -> Asset:
        """Adds a mesh; returns the asset, so that calls chain."""
        self.parts.append(Part(path, mesh, material))
        return self

    def add_proxy(self, path: str, mesh: Mesh) -> Asset:
        """Adds a collision mesh of purpose `proxy`."""
        self.parts.append(Part(path, mesh, "plastic_grey", "proxy"))
        return self

    def points(self) -> Floats:
        """(N, 3) points of everything that is rendered, centimetres."""
        return np.concatenate([part.mesh.points for part in self.parts if part.purpose == "default"])

    def surface(self, name: str) -> float:
        """Height of a named surface, centimetres."""
        if name == "top" and "top" not in self.surfaces:
            return float(self.points()[:, 1].max())
        return self.surfaces[name]


def write_asset(asset: Asset, path: Path) -> None:
    """Writes the asset as a layer whose default prim is a component."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    root = UsdGeom.Xform.Define(stage, f"/{asset.name}").GetPrim()
    stage.SetDefaultPrim(root)
    model = Usd.ModelAPI(root)
    model.SetKind(Kind.Tokens.component)
    model.SetAssetName(asset.name)
    model.SetAssetIdentifier(f"./assets/{path.name}")
    if asset.documentation:
        root.SetDocumentation(asset.documentation)
    materials = _write_materials(stage, asset)
    for part in asset.parts:
        _write_part(stage, root, part, materials)
    for name in asset.subcomponents:
        Usd.ModelAPI(_xform(stage, root, name)).SetKind(Kind.Tokens.subcomponent)
    if asset.hinges:
        _write_hinges(stage, root, asset.hinges)
    layer.Export(str(path))


def _write_materials(stage: Usd.Stage, asset: Asset) -> dict[str, UsdShade.Material]:
    scope = UsdGeom.Scope.Define(stage, f"/{asset.name}/{asset.looks}").GetPath()
    materials = {}
    used = sorted({part.material for part in asset.parts if part.purpose == "default"})
    for name in used:
        surface = PALETTE[name]
        material = UsdShade.Material.Define(stage, scope.AppendChild(name))
        shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("preview"))
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*surface.colour))
        for key, fallback in (("roughness", 0.5), ("metallic", 0.0), ("opacity", 1.0)):
            if (value := getattr(surface, key)) != fallback:
                shader.CreateInput(key, Sdf.ValueTypeNames.Float).Set(value)
        output = shader.CreateOutput("surface", Sdf.ValueTypeNames.Token)
        material.CreateSurfaceOutput().ConnectToSource(output)
        materials[name] = material
    return materials


def _xform(stage: Usd.Stage, root: Usd.Prim, path: str) -> Usd.Prim:
    return UsdGeom.Xform.Define(stage, root.GetPath().AppendPath(path)).GetPrim()


def _write_part(stage: Usd.Stage, root: Usd.Prim, part: Part, materials: dict[str, UsdShade.Material]) -> None:
    parents = part.path.split("/")[:-1]
    for depth in range(len(parents)):
        _xform(stage, root, "/".join(parents[: depth + 1]))
    mesh = UsdGeom.Mesh.Define(stage, root.GetPath().AppendPath(part.path))
    write_geometry(mesh, part.mesh)
    if part.purpose != "default":
        mesh.CreatePurposeAttr(part.purpose)
        return
    surface = PALETTE[part.material]
    mesh.CreateDisplayColorAttr(Vt.Vec3fArray([Gf.Vec3f(*surface.colour)]))
    if surface.opacity < 1:
        mesh.CreateDisplayOpacityAttr(Vt.FloatArray([surface.opacity]))
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(materials[part.material])


def write_geometry(mesh: UsdGeom.Mesh, shape: Mesh) -> None:
    """Authors topology, points, normals and extent (centimetres) on a Mesh prim."""
    points = _rounded(shape.points)
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    if not is_flat(shape):
        mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(_rounded(shape.normals)))
        mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(shape.counts.astype(np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(shape.indices.astype(np.int32)))
    extent = np.stack([points.min(axis=0), points.max(axis=0)])
    mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(extent))


def _rounded(values: Floats) -> NDArray[np.float32]:
    # Which of the two zeros a sine ends at differs from processor to processor.
    return np.round(values, 4).astype(np.float32) + np.float32(0)


def _write_hinges(stage: Usd.Stage, root: Usd.Prim, hinges: list[Hinge]) -> None:
    variants = root.GetVariantSets().AddVariantSet("doorState")
    for state in ("closed", "open"):
        variants.AddVariant(state)
        variants.SetVariantSelection(state)
        with variants.GetVariantEditContext():
            for hinge in hinges:
                door = UsdGeom.Xformable(stage.GetPrimAtPath(root.GetPath().AppendPath(hinge.part)))
                pivot = door.AddTranslateOp(opSuffix="pivot")
                pivot.Set(Gf.Vec3d(*hinge.pivot))
                door.AddRotateYOp().Set(hinge.opened if state == "open" else 0.0)
                door.AddTranslateOp(opSuffix="pivot", isInverseOp=True)
    variants.SetVariantSelection("closed")
    for hinge in hinges:
        _write_joint(stage, root, hinge)


def _write_joint(stage: Usd.Stage, root: Usd.Prim, hinge: Hinge) -> None:
    door = root.GetPath().AppendPath(hinge.part)
    UsdPhysics.RigidBodyAPI.Apply(stage.GetPrimAtPath(door))
    joint = UsdPhysics.RevoluteJoint.Define(stage, root.GetPath().AppendChild(f"{door.name}_hinge"))
    joint.CreateAxisAttr(UsdPhysics.Tokens.y)
    joint.CreateBody0Rel().SetTargets([root.GetPath()])
    joint.CreateBody1Rel().SetTargets([door])
    joint.CreateLocalPos0Attr(Gf.Vec3f(*hinge.pivot))
    joint.CreateLocalPos1Attr(Gf.Vec3f(*hinge.pivot))
    joint.CreateLowerLimitAttr(min(0.0, hinge.opened))
    joint.CreateUpperLimitAttr(max(0.0, hinge.opened))
