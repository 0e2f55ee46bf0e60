"""Demo kitchen with dining area: Y up, centimetres."""

from pathlib import Path

from pxr import Gf, Usd, UsdGeom, UsdLux

from scenes.kitchen import (
    assets_appliances,
    assets_cookware,
    assets_furniture,
    assets_household,
    assets_pantry,
    assets_room,
    assets_tableware,
    assets_units,
)
from scenes.writer.asset_file import write_geometry
from scenes.writer.layout import AuthoredScene, Layout
from scenes.writer.palette import ShaderStyle, read_palette
from scenes.writer.root_layer import write_object
from scenes.writer.scene import write_scene
from scenes.writer.shapes import box

TABLES = Path(__file__).parent
SPEC = AuthoredScene(
    root="/KitchenDining",
    tables=TABLES,
    modules=(
        assets_appliances,
        assets_cookware,
        assets_furniture,
        assets_household,
        assets_pantry,
        assets_room,
        assets_tableware,
        assets_units,
    ),
    palette=read_palette(TABLES / "materials.csv"),
    shader=ShaderStyle("preview", {"roughness": 0.5, "metallic": 0.0, "opacity": 1.0}),
    documentation="Demo kitchen: authored by script, free of third-party shapes.",
    is_z_up=False,
    writes_asset_info=True,
    writes_relations=True,
)


def write(folder: Path) -> str:
    """Write the scene; return a summary."""
    return write_scene(SPEC, _add_extras, folder)


def _add_extras(stage: Usd.Stage, layout: Layout) -> None:
    _add_cameras(stage)
    _add_lights(stage)
    _add_helpers(stage)
    _add_hidden(stage, layout)


def _add_cameras(stage: Usd.Stage) -> None:
    UsdGeom.Xform.Define(stage, f"{SPEC.root}/cams_grp")
    views = {
        "renderCam_hero": ((262.0, 190.0, 196.0), (-18.0, 48.0, 0.0), 18.0),
        "renderCam_table": ((215.0, 150.0, 190.0), (-26.0, 48.0, 0.0), 28.0),
    }
    for name, (position, turn, focal) in views.items():
        camera = UsdGeom.Camera.Define(stage, f"{SPEC.root}/cams_grp/{name}")
        camera.AddTranslateOp().Set(Gf.Vec3d(*position))
        camera.AddRotateXYZOp().Set(Gf.Vec3f(*turn))
        camera.CreateFocalLengthAttr(focal)
        camera.CreateHorizontalApertureAttr(36.0)
        camera.CreateVerticalApertureAttr(24.0)
        camera.CreateClippingRangeAttr(Gf.Vec2f(1, 5000))


def _add_lights(stage: Usd.Stage) -> None:
    group = f"{SPEC.root}/lights_grp"
    UsdGeom.Xform.Define(stage, group)
    UsdLux.DomeLight.Define(stage, f"{group}/dome_fill").CreateIntensityAttr(0.4)
    window = UsdLux.RectLight.Define(stage, f"{group}/window_area")
    window.AddTranslateOp().Set(Gf.Vec3d(300, 160, 35))
    window.AddRotateYOp().Set(90.0)
    window.CreateWidthAttr(150)
    window.CreateHeightAttr(130)
    window.CreateIntensityAttr(12)
    bulb = UsdLux.SphereLight.Define(stage, f"{group}/pendant_bulb")
    bulb.AddTranslateOp().Set(Gf.Vec3d(90, 150, 80))
    bulb.CreateRadiusAttr(3)
    bulb.CreateIntensityAttr(600)


def _add_helpers(stage: Usd.Stage) -> None:
    helpers = f"{SPEC.root}/helpers_grp"
    UsdGeom.Xform.Define(stage, helpers)
    UsdGeom.Xform.Define(stage, f"{helpers}/locator_spawn").AddTranslateOp().Set(Gf.Vec3d(-30, 0, 60))
    guide = UsdGeom.Mesh.Define(stage, f"{helpers}/walkArea_guide")
    write_geometry(guide, box((-150, 0.1, -140), (-60, 0.2, -80)))
    guide.CreatePurposeAttr(UsdGeom.Tokens.guide)


def _add_hidden(stage: Usd.Stage, layout: Layout) -> None:
    """Add an invisible and an inactive chair, a class prim and an `over` without definition."""
    area = f"{SPEC.root}/diningArea"
    chair = layout.placed[f"{area}/chair_01"]._replace(turn=(0.0, 0.0, 0.0))
    old = chair._replace(path=f"{area}/chair_old_v1", position=(-20.0, 1.3, 0.0))
    UsdGeom.Imageable(write_object(stage, layout, old)).MakeInvisible()
    broken = chair._replace(path=f"{area}/chair_broken", position=(0.0, 1.3, 0.0))
    write_object(stage, layout, broken).SetActive(False)
    stage.CreateClassPrim("/_class_prop")
    stage.OverridePrim(f"{area}/highChair")
