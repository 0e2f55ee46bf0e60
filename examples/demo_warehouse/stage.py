"""The root layer: groups, placements in three styles, and what a reader should leave out."""

from __future__ import annotations

from pathlib import Path

from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdLux, UsdPhysics

from examples.demo_kitchen.asset import write_geometry
from examples.demo_kitchen.mesh import Vec3
from examples.demo_kitchen.shapes import box

from .catalogue import ENTRIES
from .layout import Extras, Layout, Placed
from .writer import to_z_up, write_collision


def write_stage(scene: Layout, path: Path) -> None:
    """Writes the scene; assets are referenced as `./assets/NAME.usdc`. Raises ValueError for a kind that leaks."""
    layer = Sdf.Layer.CreateNew(str(path))
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    layer.documentation = "Demo warehouse: authored by script, free of third-party shapes."
    root = UsdGeom.Xform.Define(stage, scene.root).GetPrim()
    stage.SetDefaultPrim(root)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    UsdPhysics.Scene.Define(stage, f"{scene.root}/physicsScene")
    for group, kind in scene.groups.items():
        prim = UsdGeom.Xform.Define(stage, group).GetPrim()
        if kind:
            Usd.ModelAPI(prim).SetKind(kind)
    for placed in scene.placed.values():
        _write_placed(stage, scene, placed)
    _write_cameras(stage, scene.root)
    _write_lights(stage, scene.root)
    _write_left_out(stage, scene)
    layer.Save()


def _write_placed(stage: Usd.Stage, scene: Layout, placed: Placed) -> Usd.Prim:
    is_component = ENTRIES[placed.key].is_component
    if placed.style != "kind" and is_component:
        raise ValueError(f"{placed.path}: asset {placed.key} has a kind, but the area has none; register it without")
    if placed.style == "sdf" and not ENTRIES[placed.key].is_model:
        return _write_model(stage, scene, placed)
    prim = _reference(stage, placed.path, placed.key)
    _write_transform(prim, placed)
    if placed.style == "body":
        _write_body(prim, placed.extras)
    elif placed.style == "kind":
        if not is_component:
            Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
        if placed.extras.mass is not None:
            UsdPhysics.MassAPI.Apply(prim).CreateMassAttr(placed.extras.mass)
    return prim


def _reference(stage: Usd.Stage, path: str, key: str) -> Usd.Prim:
    prim = UsdGeom.Xform.Define(stage, path).GetPrim()
    prim.GetReferences().AddReference(f"./assets/{ENTRIES[key].file}.usdc")
    return prim


def _write_transform(prim: Usd.Prim, placed: Placed) -> None:
    xform, extras = UsdGeom.Xformable(prim), placed.extras
    xform.AddTranslateOp().Set(Gf.Vec3d(*(round(v, 4) for v in placed.position)))
    if any(placed.turn):
        xform.AddRotateXYZOp().Set(Gf.Vec3f(*placed.turn))
    if extras.scale != 1.0:
        xform.AddScaleOp().Set(Gf.Vec3f(extras.scale))
    if extras.instanceable:
        prim.SetInstanceable(True)
    if extras.display_name:
        prim.SetDisplayName(extras.display_name)
    if extras.documentation:
        prim.SetDocumentation(extras.documentation)


def _write_body(prim: Usd.Prim, extras: Extras) -> None:
    body = UsdPhysics.RigidBodyAPI.Apply(prim)
    if extras.kinematic:
        body.CreateKinematicEnabledAttr(True)
    if extras.mass is not None:
        UsdPhysics.MassAPI.Apply(prim).CreateMassAttr(extras.mass)


def _write_model(stage: Usd.Stage, scene: Layout, placed: Placed) -> Usd.Prim:
    """A model with `visual` and `collision`, below a link where the model has one."""
    model = UsdGeom.Xform.Define(stage, placed.path).GetPrim()
    _write_transform(model, placed)
    link = placed.path
    if placed.extras.link:
        link += f"/{placed.extras.link}"
        UsdGeom.Xform.Define(stage, link)
    _reference(stage, f"{link}/visual", placed.key)
    write_collision(stage, link, scene.points(placed.key))
    return model


def _write_cameras(stage: Usd.Stage, root: str) -> None:
    UsdGeom.Xform.Define(stage, f"{root}/Cameras")
    views: dict[str, tuple[Vec3, Vec3]] = {
        "Cam_Overview": ((1200.0, -900.0, 1500.0), (52.0, 0.0, 0.0)),
        "Cam_Packing": ((560.0, 520.0, 260.0), (62.0, 0.0, 180.0)),
    }
    for name, (position, turn) in views.items():
        camera = UsdGeom.Camera.Define(stage, f"{root}/Cameras/{name}")
        camera.AddTranslateOp().Set(Gf.Vec3d(*position))
        camera.AddRotateXYZOp().Set(Gf.Vec3f(*turn))
        camera.CreateFocalLengthAttr(24.0)
        camera.CreateClippingRangeAttr(Gf.Vec2f(1, 10000))


def _write_lights(stage: Usd.Stage, root: str) -> None:
    UsdGeom.Xform.Define(stage, f"{root}/Lights")
    UsdLux.DomeLight.Define(stage, f"{root}/Lights/DomeLight").CreateIntensityAttr(0.5)
    for k, x in enumerate((400.0, 1000.0, 2100.0)):
        light = UsdLux.RectLight.Define(stage, f"{root}/Lights/RectLight_{k + 1:02d}")
        light.AddTranslateOp().Set(Gf.Vec3d(x, 800, 440))
        light.CreateWidthAttr(60)
        light.CreateHeightAttr(900)
        light.CreateIntensityAttr(10)


def _write_left_out(stage: Usd.Stage, scene: Layout) -> None:
    """A spawn point, a guide mesh, an old rack made invisible and a pallet switched off."""
    helpers = f"{scene.root}/Helpers"
    UsdGeom.Xform.Define(stage, helpers)
    UsdGeom.Xform.Define(stage, f"{helpers}/SpawnPoint_01").AddTranslateOp().Set(Gf.Vec3d(300, 700, 0))
    guide = UsdGeom.Mesh.Define(stage, f"{helpers}/forklift_path")
    write_geometry(guide, to_z_up(box((100, 0.3, -720), (2300, 0.5, -700))))
    guide.CreatePurposeAttr(UsdGeom.Tokens.guide)
    old = Placed(f"{helpers}/SM_RackLong_A1_old", "pallet_rack", "kind", (1500, 1400, 0), (0, 0, 0), Extras())
    UsdGeom.Imageable(_write_placed(stage, scene, old)).MakeInvisible()
    off = Placed(f"{helpers}/EUR_Pallet_99", "pallet", "kind", (1700, 1400, 0), (0, 0, 0), Extras())
    _write_placed(stage, scene, off).SetActive(False)
