"""The root layer: groups, references, and what a reader should leave out."""

from __future__ import annotations

from pathlib import Path

from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdLux, UsdPhysics

from .asset import write_geometry
from .layout import Layout, Placed
from .shapes import box


def write_stage(scene: Layout, path: Path) -> None:
    """Writes the scene; assets are referenced as `./assets/NAME.usdc`."""
    layer = Sdf.Layer.CreateNew(str(path))
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    layer.documentation = "Demo kitchen: authored by script, free of third-party shapes."
    root = UsdGeom.Xform.Define(stage, scene.root).GetPrim()
    stage.SetDefaultPrim(root)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    for group in scene.groups:
        Usd.ModelAPI(UsdGeom.Xform.Define(stage, group).GetPrim()).SetKind(Kind.Tokens.group)
    for placed in scene.placed.values():
        _write_reference(stage, placed)
    _write_cameras(stage, scene.root)
    _write_lights(stage, scene.root)
    _write_left_out(stage, scene)
    layer.Save()


def _write_reference(stage: Usd.Stage, placed: Placed) -> Usd.Prim:
    xform = UsdGeom.Xform.Define(stage, placed.path)
    prim = xform.GetPrim()
    prim.GetReferences().AddReference(f"./assets/{placed.asset.name}.usdc")
    xform.AddTranslateOp().Set(Gf.Vec3d(*(round(v, 4) for v in placed.position)))
    if any(placed.turn):
        xform.AddRotateXYZOp().Set(Gf.Vec3f(*(round(v, 4) for v in placed.turn)))
    extras = placed.extras
    if extras.instanceable:
        prim.SetInstanceable(True)
    if extras.mass is not None:
        UsdPhysics.MassAPI.Apply(prim).CreateMassAttr(extras.mass)
    if extras.display_name:
        prim.SetDisplayName(extras.display_name)
    if extras.documentation:
        prim.SetDocumentation(extras.documentation)
    return prim


def _write_cameras(stage: Usd.Stage, root: str) -> None:
    UsdGeom.Xform.Define(stage, f"{root}/cams_grp")
    views = {
        "renderCam_hero": ((262.0, 190.0, 196.0), (-18.0, 48.0, 0.0), 18.0),
        "renderCam_table": ((215.0, 150.0, 190.0), (-26.0, 48.0, 0.0), 28.0),
    }
    for name, (position, turn, focal) in views.items():
        camera = UsdGeom.Camera.Define(stage, f"{root}/cams_grp/{name}")
        camera.AddTranslateOp().Set(Gf.Vec3d(*position))
        camera.AddRotateXYZOp().Set(Gf.Vec3f(*turn))
        camera.CreateFocalLengthAttr(focal)
        camera.CreateHorizontalApertureAttr(36.0)
        camera.CreateVerticalApertureAttr(24.0)
        camera.CreateClippingRangeAttr(Gf.Vec2f(1, 5000))


def _write_lights(stage: Usd.Stage, root: str) -> None:
    UsdGeom.Xform.Define(stage, f"{root}/lights_grp")
    UsdLux.DomeLight.Define(stage, f"{root}/lights_grp/dome_fill").CreateIntensityAttr(0.4)
    sun = UsdLux.RectLight.Define(stage, f"{root}/lights_grp/window_area")
    sun.AddTranslateOp().Set(Gf.Vec3d(300, 160, 35))
    sun.AddRotateYOp().Set(90.0)
    sun.CreateWidthAttr(150)
    sun.CreateHeightAttr(130)
    sun.CreateIntensityAttr(12)
    bulb = UsdLux.SphereLight.Define(stage, f"{root}/lights_grp/pendant_bulb")
    bulb.AddTranslateOp().Set(Gf.Vec3d(90, 150, 80))
    bulb.CreateRadiusAttr(3)
    bulb.CreateIntensityAttr(600)


def _write_left_out(stage: Usd.Stage, scene: Layout) -> None:
    root = scene.root
    helpers = f"{root}/helpers_grp"
    UsdGeom.Xform.Define(stage, helpers)
    UsdGeom.Xform.Define(stage, f"{helpers}/locator_spawn").AddTranslateOp().Set(Gf.Vec3d(-30, 0, 60))
    guide = UsdGeom.Mesh.Define(stage, f"{helpers}/walkArea_guide")
    write_geometry(guide, box((-150, 0.1, -140), (-60, 0.2, -80)))
    guide.CreatePurposeAttr(UsdGeom.Tokens.guide)
    chair = scene.placed[f"{root}/diningArea/chair_01"]
    hidden = _write_reference(stage, _copy(chair, f"{root}/diningArea/chair_old_v1", (-20.0, 1.3, 0.0)))
    UsdGeom.Imageable(hidden).MakeInvisible()
    broken = _write_reference(stage, _copy(chair, f"{root}/diningArea/chair_broken", (0.0, 1.3, 0.0)))
    broken.SetActive(False)
    stage.CreateClassPrim("/_class_prop")
    stage.OverridePrim(f"{root}/diningArea/highChair")


def _copy(placed: Placed, path: str, position: tuple[float, float, float]) -> Placed:
    return Placed(path, placed.asset, position, (0.0, 0.0, 0.0), placed.extras)
