"""An asset's file; z up, so that points (x, y, z) of the shapes become (x, -z, y)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from examples.demo_kitchen.asset import Asset, Part, write_geometry
from examples.demo_kitchen.mesh import Floats, Mesh, is_flat

from .catalogue import Entry
from .palette import PALETTE

Z_UP: Floats = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""(3, 3), turns y-up column vectors into z-up ones."""


def to_z_up(mesh: Mesh) -> Mesh:
    """The mesh with z up; its front faces -y."""
    return mesh._replace(points=mesh.points @ Z_UP.T, normals=mesh.normals @ Z_UP.T)


def write_asset(made: Asset, entry: Entry, path: Path) -> None:
    """Writes the asset as a layer; one without kind carries colliders, as for a simulation."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    root = UsdGeom.Xform.Define(stage, f"/{made.name}").GetPrim()
    stage.SetDefaultPrim(root)
    if entry.is_component:
        Usd.ModelAPI(root).SetKind(Kind.Tokens.component)
    if made.documentation:
        root.SetDocumentation(made.documentation)
    materials = _write_materials(stage, made) if made.looks else {}
    for part in made.parts:
        below = "base_link/visual/" if entry.is_model else ""
        mesh = _write_part(stage, root, replace(part, path=below + part.path), materials)
        if not entry.is_component and not entry.is_model:
            UsdPhysics.CollisionAPI.Apply(mesh)
    if entry.is_model:
        write_collision(stage, f"/{made.name}/base_link", made.points() @ Z_UP.T)
    layer.Export(str(path))


def write_collision(stage: Usd.Stage, link: str, points: Floats) -> None:
    """Adds `collision/geometry` below a link: the box around z-up points (centimetres), of purpose guide."""
    low, high = points.min(axis=0), points.max(axis=0)
    UsdGeom.Xform.Define(stage, f"{link}/collision")
    shape = UsdGeom.Cube.Define(stage, f"{link}/collision/geometry")
    shape.CreateSizeAttr(1.0)
    shape.CreatePurposeAttr(UsdGeom.Tokens.guide)
    shape.AddTranslateOp().Set(Gf.Vec3d(*(round(float(v), 3) for v in (low + high) / 2)))
    shape.AddScaleOp().Set(Gf.Vec3f(*(round(float(v), 3) for v in high - low)))
    UsdPhysics.CollisionAPI.Apply(shape.GetPrim())


def _write_materials(stage: Usd.Stage, made: Asset) -> dict[str, UsdShade.Material]:
    scope = UsdGeom.Scope.Define(stage, f"/{made.name}/{made.looks}").GetPath()
    materials = {}
    for name in sorted({part.material for part in made.parts}):
        surface = PALETTE[name]
        material = UsdShade.Material.Define(stage, scope.AppendChild(name))
        shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("Shader"))
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*surface.colour))
        shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(surface.roughness)
        if surface.metallic:
            shader.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(surface.metallic)
        output = shader.CreateOutput("surface", Sdf.ValueTypeNames.Token)
        material.CreateSurfaceOutput().ConnectToSource(output)
        materials[name] = material
    return materials


def _write_part(stage: Usd.Stage, root: Usd.Prim, part: Part, materials: dict[str, UsdShade.Material]) -> Usd.Prim:
    *parents, _ = part.path.split("/")
    for depth in range(len(parents)):
        UsdGeom.Xform.Define(stage, root.GetPath().AppendPath("/".join(parents[: depth + 1])))
    mesh = UsdGeom.Mesh.Define(stage, root.GetPath().AppendPath(part.path))
    shape = to_z_up(part.mesh)
    write_geometry(mesh, shape)
    if is_flat(shape):
        _weld(mesh)
    surface = PALETTE[part.material]
    mesh.CreateDisplayColorAttr(Vt.Vec3fArray([Gf.Vec3f(*surface.colour)]))
    if surface.opacity < 1:
        mesh.CreateDisplayOpacityAttr(Vt.FloatArray([surface.opacity]))
    if materials:
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(materials[part.material])
    return mesh.GetPrim()


def _weld(mesh: UsdGeom.Mesh) -> None:
    """Makes faces share their corners, which a mesh without normals can afford: a third of the points."""
    points, place = np.unique(np.asarray(mesh.GetPointsAttr().Get()), axis=0, return_inverse=True)
    indices = np.asarray(mesh.GetFaceVertexIndicesAttr().Get())
    mesh.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(points))
    mesh.GetFaceVertexIndicesAttr().Set(Vt.IntArray.FromNumpy(place.reshape(-1)[indices].astype(np.int32)))
