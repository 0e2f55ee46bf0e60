"""Write the root layer of a scene: groups and referenced assets."""

from collections.abc import Callable
from pathlib import Path

from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdPhysics

from scenes.writer.asset_file import write_collision
from scenes.writer.layout import Layout, Placement, open_stage

AddExtras = Callable[[Usd.Stage, Layout], None]
"""Adds prims that are not objects: cameras, lights, helpers."""


def write_root_layer(layout: Layout, path: Path, add_extras: AddExtras) -> None:
    """Write groups and objects; assets are referenced as `./assets/NAME.usdc`.

    Raises:
        ValueError: an asset with a kind is in an area without kinds.
    """
    spec = layout.spec
    path.unlink(missing_ok=True)
    layer = Sdf.Layer.CreateNew(str(path))
    stage, root = open_stage(layer, spec.root, is_z_up=spec.is_z_up, meters_per_unit=spec.meters_per_unit)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    layer.documentation = spec.documentation
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    if "bodies" in spec.areas.values():
        UsdPhysics.Scene.Define(stage, f"{spec.root}/physicsScene")
    for group in layout.groups:
        prim = UsdGeom.Xform.Define(stage, group).GetPrim()
        if not spec.area(group):
            Usd.ModelAPI(prim).SetKind(Kind.Tokens.group)
    for placement in layout.placed.values():
        write_object(stage, layout, placement)
    add_extras(stage, layout)
    layer.Save()


def write_object(stage: Usd.Stage, layout: Layout, placement: Placement) -> Usd.Prim:
    """Author one object by the conventions of its area; return its prim."""
    area, file = layout.spec.area(placement.path), layout.files[placement.asset]
    if area and file.has_kind:
        raise ValueError(f"{placement.path}: asset {placement.asset} has a kind, but the area has none; drop the kind")
    prim = UsdGeom.Xform.Define(stage, placement.path).GetPrim()
    if area == "models" and not file.is_model:
        _add_model(stage, layout, placement)
    else:
        _refer(prim, layout, placement)
    _write_transform(UsdGeom.Xformable(prim), layout, placement)
    if not area and not file.has_kind:
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
    if area == "bodies":
        body = UsdPhysics.RigidBodyAPI.Apply(prim)
        if "kinematic" in placement.options:
            body.CreateKinematicEnabledAttr(True)
    if placement.mass is not None:
        UsdPhysics.MassAPI.Apply(prim).CreateMassAttr(placement.mass)
    if "instance" in placement.options:
        prim.SetInstanceable(True)
    if placement.display_name:
        prim.SetDisplayName(placement.display_name)
    if placement.documentation:
        prim.SetDocumentation(placement.documentation)
    return prim


def _refer(prim: Usd.Prim, layout: Layout, placement: Placement) -> None:
    prim.GetReferences().AddReference(f"./assets/{layout.files[placement.asset].file}.usdc")


def _add_model(stage: Usd.Stage, layout: Layout, placement: Placement) -> None:
    """Author `visual` and `collision` below the object, or below its link."""
    link = placement.path if "no_link" in placement.options else f"{placement.path}/link"
    UsdGeom.Xform.Define(stage, link)
    _refer(UsdGeom.Xform.Define(stage, f"{link}/visual").GetPrim(), layout, placement)
    asset = layout.assets[placement.asset]
    write_collision(stage, link, asset.points() @ layout.spec.axes.T)


def _write_transform(xform: UsdGeom.Xformable, layout: Layout, placement: Placement) -> None:
    spec = layout.spec
    unit, digits = (1.0, 4) if spec.meters_per_unit == 0.01 else (0.01, 5)
    xform.AddTranslateOp().Set(Gf.Vec3d(*(round(unit * value, digits) for value in placement.position)))
    x, y, z = (round(angle, 4) for angle in placement.turn)
    if spec.has_yaw_op and not (x or y):
        if z:
            xform.AddRotateZOp().Set(z)
    elif x or y or z:
        add_op = xform.AddRotateXYZOp if spec.turn_order == "XYZ" else xform.AddRotateXZYOp
        add_op().Set(Gf.Vec3f(x, y, z))
    if placement.scale != 1.0:
        xform.AddScaleOp().Set(Gf.Vec3f(placement.scale))
    if layout.files[placement.asset].is_y_up:
        xform.AddRotateXOp(opSuffix="upAxis").Set(90.0)
        xform.AddScaleOp(opSuffix="unit").Set(Gf.Vec3f(0.01))
