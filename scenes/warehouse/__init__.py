"""Warehouse with packing station, workshop, charging bay and office corner: Z up, centimetres."""

from pathlib import Path

from pxr import Gf, Usd, UsdGeom, UsdLux

from scenes.warehouse import (
    assets_charging,
    assets_desk,
    assets_moving,
    assets_people,
    assets_shell,
    assets_storage,
    assets_workshop,
)
from scenes.writer.asset_file import to_stage, write_geometry
from scenes.writer.layout import AuthoredScene, Layout, Placement
from scenes.writer.mesh import Vec3
from scenes.writer.palette import ShaderStyle, read_palette
from scenes.writer.root_layer import write_object
from scenes.writer.scene import write_scene
from scenes.writer.shapes import box

TABLES = Path(__file__).parent
SPEC = AuthoredScene(
    root="/Warehouse_Full",
    tables=TABLES,
    modules=(
        assets_charging,
        assets_desk,
        assets_moving,
        assets_people,
        assets_shell,
        assets_storage,
        assets_workshop,
    ),
    palette=read_palette(TABLES / "materials.csv"),
    shader=ShaderStyle("Shader", {"roughness": None, "metallic": 0.0}),
    documentation="Demo warehouse: authored by script, free of third-party shapes.",
    areas={"workshop": "bodies", "charging_bay": "models"},
    welds_points=True,
)


def write(folder: Path) -> str:
    """Write the scene; return a summary."""
    return write_scene(SPEC, _add_extras, folder)


def _add_extras(stage: Usd.Stage, layout: Layout) -> None:
    _add_cameras(stage)
    _add_lights(stage)
    _add_helpers(stage, layout)


def _add_cameras(stage: Usd.Stage) -> None:
    UsdGeom.Xform.Define(stage, f"{SPEC.root}/Cameras")
    views: dict[str, tuple[Vec3, Vec3]] = {
        "Cam_Overview": ((1200.0, -900.0, 1500.0), (52.0, 0.0, 0.0)),
        "Cam_Packing": ((560.0, 520.0, 260.0), (62.0, 0.0, 180.0)),
    }
    for name, (position, turn) in views.items():
        camera = UsdGeom.Camera.Define(stage, f"{SPEC.root}/Cameras/{name}")
        camera.AddTranslateOp().Set(Gf.Vec3d(*position))
        camera.AddRotateXYZOp().Set(Gf.Vec3f(*turn))
        camera.CreateFocalLengthAttr(24.0)
        camera.CreateClippingRangeAttr(Gf.Vec2f(1, 10000))


def _add_lights(stage: Usd.Stage) -> None:
    UsdGeom.Xform.Define(stage, f"{SPEC.root}/Lights")
    UsdLux.DomeLight.Define(stage, f"{SPEC.root}/Lights/DomeLight").CreateIntensityAttr(0.5)
    for k, x in enumerate((400.0, 1000.0, 2100.0)):
        light = UsdLux.RectLight.Define(stage, f"{SPEC.root}/Lights/RectLight_{k + 1:02d}")
        light.AddTranslateOp().Set(Gf.Vec3d(x, 800, 440))
        light.CreateWidthAttr(60)
        light.CreateHeightAttr(900)
        light.CreateIntensityAttr(10)


def _add_helpers(stage: Usd.Stage, layout: Layout) -> None:
    """Add a spawn point, a guide mesh, an invisible rack and an inactive pallet."""
    helpers = f"{SPEC.root}/Helpers"
    UsdGeom.Xform.Define(stage, helpers)
    UsdGeom.Xform.Define(stage, f"{helpers}/SpawnPoint_01").AddTranslateOp().Set(Gf.Vec3d(300, 700, 0))
    guide = UsdGeom.Mesh.Define(stage, f"{helpers}/forklift_path")
    write_geometry(guide, to_stage(box((100, 0.3, -720), (2300, 0.5, -700)), SPEC))
    guide.CreatePurposeAttr(UsdGeom.Tokens.guide)
    turn = (0.0, 0.0, 0.0)
    old = Placement(f"{helpers}/SM_RackLong_A1_old", "pallet_rack", (1500, 1400, 0), turn)
    UsdGeom.Imageable(write_object(stage, layout, old)).MakeInvisible()
    off = Placement(f"{helpers}/EUR_Pallet_99", "pallet", (1700, 1400, 0), turn)
    write_object(stage, layout, off).SetActive(False)
