"""Open-plan office with meeting corner, kitchenette, reception and print room: Z up, metres."""

from pathlib import Path

from pxr import Gf, Usd, UsdGeom, UsdLux

from scenes.office import assets_desk, assets_meeting, assets_room, assets_service, assets_supplies
from scenes.writer.layout import AuthoredScene, Layout
from scenes.writer.palette import ShaderStyle, read_palette
from scenes.writer.scene import write_scene

TABLES = Path(__file__).parent
SPEC = AuthoredScene(
    root="/OfficeFloor_02",
    tables=TABLES,
    modules=(assets_desk, assets_meeting, assets_room, assets_service, assets_supplies),
    palette=read_palette(TABLES.parent / "kitchen" / "materials.csv", TABLES / "materials.csv"),
    shader=ShaderStyle("preview", {"roughness": None, "metallic": None}),
    documentation="Demo office: authored by script, free of third-party shapes.",
    meters_per_unit=1.0,
    turn_order="XZY",
    has_yaw_op=True,
    areas={"print_room": "references"},
)


def write(folder: Path) -> str:
    """Write the scene; return a summary."""
    return write_scene(SPEC, _add_extras, folder)


def _add_extras(stage: Usd.Stage, _: Layout) -> None:
    UsdGeom.Xform.Define(stage, f"{SPEC.root}/Lights")
    UsdLux.DomeLight.Define(stage, f"{SPEC.root}/Lights/dome").CreateIntensityAttr(0.5)
    sun = UsdLux.DistantLight.Define(stage, f"{SPEC.root}/Lights/key_sun")
    sun.AddRotateXYZOp().Set(Gf.Vec3f(50, 0, 20))
    sun.CreateIntensityAttr(3)
    UsdGeom.Xform.Define(stage, f"{SPEC.root}/Cameras")
    camera = UsdGeom.Camera.Define(stage, f"{SPEC.root}/Cameras/shot010_cam")
    camera.AddTranslateOp().Set(Gf.Vec3d(6.0, -4.4, 2.4))
    camera.AddRotateXYZOp().Set(Gf.Vec3f(72, 0, 52))
    camera.CreateFocalLengthAttr(20.0)
