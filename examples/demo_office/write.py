"""The files of the office: assets Z up in metres (some Y up in centimetres) and the root layer, Z up in metres."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdLux, UsdPhysics, UsdShade, Vt

from examples.demo_kitchen.asset import Asset, Part, write_geometry
from examples.demo_kitchen.layout import Placed
from examples.demo_kitchen.mesh import Floats, Mesh

from .catalogue import SPECS, Office
from .palette import PALETTE

CENTIMETRE = 0.01
"""Metres."""
BARE = "print_room"
"""The group whose things are plain references, without any kind."""


def z_up(vectors: Floats) -> Floats:
    """(N, 3) vectors turned from Y up to Z up: a quarter turn about x."""
    return np.stack([vectors[:, 0], -vectors[:, 2], vectors[:, 1]], axis=1)


def write_asset(asset: Asset, path: Path) -> None:
    """Writes one asset; the file name is the name of its default prim."""
    spec = SPECS[asset.name]
    layer = Sdf.Layer.CreateAnonymous(".usda")
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y if spec.y_up else UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, CENTIMETRE if spec.y_up else 1.0)
    root = UsdGeom.Xform.Define(stage, f"/{path.stem}").GetPrim()
    stage.SetDefaultPrim(root)
    if spec.kind:
        Usd.ModelAPI(root).SetKind(Kind.Tokens.component)
    if asset.documentation:
        root.SetDocumentation(asset.documentation)
    materials = _write_materials(stage, root, asset) if spec.materials else {}
    for part in asset.parts:
        _write_part(stage, root, part, materials, spec.y_up)
    layer.Export(str(path))


def _write_materials(stage: Usd.Stage, root: Usd.Prim, asset: Asset) -> dict[str, UsdShade.Material]:
    scope = UsdGeom.Scope.Define(stage, root.GetPath().AppendChild(asset.looks)).GetPath()
    materials = {}
    for name in sorted({part.material for part in asset.parts}):
        surface = PALETTE[name]
        material = UsdShade.Material.Define(stage, scope.AppendChild(name))
        shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("preview"))
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*surface.colour))
        shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(surface.roughness)
        shader.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(surface.metallic)
        output = shader.CreateOutput("surface", Sdf.ValueTypeNames.Token)
        material.CreateSurfaceOutput().ConnectToSource(output)
        materials[name] = material
    return materials


def _write_part(
    stage: Usd.Stage, root: Usd.Prim, part: Part, materials: dict[str, UsdShade.Material], y_up: bool
) -> None:
    path = root.GetPath()
    for name in part.path.split("/")[:-1]:
        path = path.AppendChild(name)
        UsdGeom.Xform.Define(stage, path)
    mesh = UsdGeom.Mesh.Define(stage, root.GetPath().AppendPath(part.path))
    write_geometry(mesh, part.mesh if y_up else _in_metres(part.mesh))
    surface = PALETTE[part.material]
    mesh.CreateDisplayColorAttr(Vt.Vec3fArray([Gf.Vec3f(*surface.colour)]))
    if surface.opacity < 1:
        mesh.CreateDisplayOpacityAttr(Vt.FloatArray([surface.opacity]))
    if materials:
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(materials[part.material])


def _in_metres(mesh: Mesh) -> Mesh:
    return mesh._replace(points=z_up(mesh.points) * CENTIMETRE, normals=z_up(mesh.normals))


def write_stage(scene: Office, path: Path) -> None:
    """Writes the root layer; assets are referenced as `./assets/NAME.usdc`."""
    layer = Sdf.Layer.CreateNew(str(path))
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    layer.documentation = "Demo office: authored by script, free of third-party shapes."
    root = UsdGeom.Xform.Define(stage, scene.root).GetPrim()
    stage.SetDefaultPrim(root)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    for group in scene.groups:
        prim = UsdGeom.Xform.Define(stage, group).GetPrim()
        if not _is_bare(scene, group):
            Usd.ModelAPI(prim).SetKind(Kind.Tokens.group)
    for placed in scene.placed.values():
        _write_reference(stage, placed, _is_bare(scene, placed.path))
    _write_lights(stage, scene.root)
    _write_camera(stage, scene.root)
    layer.Save()


def _is_bare(scene: Office, path: str) -> bool:
    return path.removeprefix(f"{scene.root}/").split("/")[0] == BARE


def _write_reference(stage: Usd.Stage, placed: Placed, bare: bool) -> None:
    spec = SPECS[placed.asset.name]
    if bare and spec.kind:
        raise ValueError(f"{placed.path}: {spec.file} has a kind; things below {BARE} have none")
    xform = UsdGeom.Xform.Define(stage, placed.path)
    prim = xform.GetPrim()
    prim.GetReferences().AddReference(f"./assets/{spec.file}.usdc")
    if not (bare or spec.kind):
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
    _write_transform(xform, placed, spec.y_up)
    extras = placed.extras
    if extras.instanceable:
        prim.SetInstanceable(True)
    if extras.mass is not None:
        UsdPhysics.MassAPI.Apply(prim).CreateMassAttr(extras.mass)
    if extras.display_name:
        prim.SetDisplayName(extras.display_name)
    if extras.documentation:
        prim.SetDocumentation(extras.documentation)


def _write_transform(xform: UsdGeom.Xform, placed: Placed, y_up: bool) -> None:
    """Turns x, y, z about a Y-up frame are turns x, z, -y about a Z-up one, in that order."""
    x, y, z = (round(value * CENTIMETRE, 5) for value in placed.position)
    about_x, about_y, about_z = (round(angle, 4) for angle in placed.turn)
    xform.AddTranslateOp().Set(Gf.Vec3d(x, -z, y))
    if about_x or about_z:
        xform.AddRotateXZYOp().Set(Gf.Vec3f(about_x, -about_z, about_y))
    elif about_y:
        xform.AddRotateZOp().Set(about_y)
    if y_up:
        xform.AddRotateXOp(opSuffix="upAxis").Set(90.0)
        xform.AddScaleOp(opSuffix="unit").Set(Gf.Vec3f(CENTIMETRE))


def _write_lights(stage: Usd.Stage, root: str) -> None:
    UsdGeom.Xform.Define(stage, f"{root}/Lights")
    UsdLux.DomeLight.Define(stage, f"{root}/Lights/dome").CreateIntensityAttr(0.5)
    sun = UsdLux.DistantLight.Define(stage, f"{root}/Lights/key_sun")
    sun.AddRotateXYZOp().Set(Gf.Vec3f(50, 0, 20))
    sun.CreateIntensityAttr(3)


def _write_camera(stage: Usd.Stage, root: str) -> None:
    UsdGeom.Xform.Define(stage, f"{root}/Cameras")
    camera = UsdGeom.Camera.Define(stage, f"{root}/Cameras/shot010_cam")
    camera.AddTranslateOp().Set(Gf.Vec3d(6.0, -4.4, 2.4))
    camera.AddRotateXYZOp().Set(Gf.Vec3f(72, 0, 52))
    camera.CreateFocalLengthAttr(20.0)
