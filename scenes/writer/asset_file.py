"""Write one asset as a layer of its own."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from scenes.writer.assets import Asset, AssetFile, Hinge, Part
from scenes.writer.layout import AuthoredScene, open_stage
from scenes.writer.mesh import Floats, Mesh, is_flat
from scenes.writer.palette import write_materials


def write_asset(asset: Asset, file: AssetFile, spec: AuthoredScene, path: Path) -> None:
    """Write an asset; without a kind it has colliders if the scene is simulated."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    unit = 0.01 if file.is_y_up else spec.meters_per_unit
    stage, root = open_stage(layer, f"/{asset.name}", is_z_up=spec.is_z_up and not file.is_y_up, meters_per_unit=unit)
    model = Usd.ModelAPI(root)
    if file.has_kind:
        model.SetKind(Kind.Tokens.component)
    if spec.writes_asset_info:
        model.SetAssetName(asset.name)
        model.SetAssetIdentifier(f"./assets/{path.name}")
    if asset.documentation:
        root.SetDocumentation(asset.documentation)
    materials = {}
    if asset.looks:
        scope = root.GetPath().AppendChild(asset.looks)
        used = sorted({part.material for part in asset.parts if part.purpose == "default"})
        materials = write_materials(stage, scope, used, spec.palette, spec.shader)
    base = root.GetPath().AppendPath("base_link/visual") if file.is_model else root.GetPath()
    for part in asset.parts:
        mesh = _define_mesh(stage, base, part.path)
        write_geometry(mesh, part.mesh if file.is_y_up else to_stage(part.mesh, spec), spec.welds_points)
        _shade(mesh, part, spec, materials)
        if "bodies" in spec.areas.values() and not (file.has_kind or file.is_model):
            UsdPhysics.CollisionAPI.Apply(mesh.GetPrim())
    if file.is_model:
        write_collision(stage, f"/{asset.name}/base_link", asset.points() @ spec.axes.T)
    for name in asset.subcomponents:
        prim = UsdGeom.Xform.Define(stage, root.GetPath().AppendPath(name)).GetPrim()
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.subcomponent)
    if asset.hinges:
        _write_hinges(stage, root, asset.hinges)
    layer.Export(str(path))


def to_stage(mesh: Mesh, spec: AuthoredScene) -> Mesh:
    """Return a mesh in the axes and unit of the stage."""
    unit = 0.01 / spec.meters_per_unit
    return mesh._replace(points=unit * (mesh.points @ spec.axes.T), normals=mesh.normals @ spec.axes.T)


def _define_mesh(stage: Usd.Stage, base: Sdf.Path, path: str) -> UsdGeom.Mesh:
    full = base.AppendPath(path)
    for prefix in full.GetPrefixes()[1:-1]:
        UsdGeom.Xform.Define(stage, prefix)
    return UsdGeom.Mesh.Define(stage, full)


def write_geometry(mesh: UsdGeom.Mesh, shape: Mesh, is_welded: bool = False) -> None:
    """Author topology, points, extent and, unless all faces are flat-shaded, normals on a Mesh prim."""
    points, indices = _rounded(shape.points), shape.indices
    flat = is_flat(shape)
    if flat and is_welded:
        points, place = np.unique(points, axis=0, return_inverse=True)
        indices = place.reshape(-1)[indices]
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    if not flat:
        mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(_rounded(shape.normals)))
        mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(shape.counts.astype(np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(indices.astype(np.int32)))
    extent = np.stack([points.min(axis=0), points.max(axis=0)])
    mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(extent))


def _rounded(values: Floats) -> NDArray[np.float32]:
    # The sign of a zero from a sine depends on the processor.
    return np.round(values, 4).astype(np.float32) + np.float32(0)


def _shade(mesh: UsdGeom.Mesh, part: Part, spec: AuthoredScene, materials: dict[str, UsdShade.Material]) -> None:
    if part.purpose != "default":
        mesh.CreatePurposeAttr(part.purpose)
        return
    surface = spec.palette[part.material]
    mesh.CreateDisplayColorAttr([Gf.Vec3f(*surface.color)])
    if surface.opacity < 1:
        mesh.CreateDisplayOpacityAttr([surface.opacity])
    if materials:
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(materials[part.material])


def write_collision(stage: Usd.Stage, link: str, points: Floats) -> None:
    """Add `collision/geometry` below a link: the box around the points, of purpose guide."""
    low, high = points.min(axis=0), points.max(axis=0)
    UsdGeom.Xform.Define(stage, f"{link}/collision")
    shape = UsdGeom.Cube.Define(stage, f"{link}/collision/geometry")
    shape.CreateSizeAttr(1.0)
    shape.CreatePurposeAttr(UsdGeom.Tokens.guide)
    shape.AddTranslateOp().Set(Gf.Vec3d(*(round(float(v), 3) for v in (low + high) / 2)))
    shape.AddScaleOp().Set(Gf.Vec3f(*(round(float(v), 3) for v in high - low)))
    UsdPhysics.CollisionAPI.Apply(shape.GetPrim())


def _write_hinges(stage: Usd.Stage, root: Usd.Prim, hinges: list[Hinge]) -> None:
    """Author a variant set `doorState` that turns the parts, and a joint for each."""
    variants = root.GetVariantSets().AddVariantSet("doorState")
    for state in ("closed", "open"):
        variants.AddVariant(state)
        variants.SetVariantSelection(state)
        with variants.GetVariantEditContext():
            for hinge in hinges:
                door = UsdGeom.Xformable(stage.GetPrimAtPath(root.GetPath().AppendPath(hinge.part)))
                door.AddTranslateOp(opSuffix="pivot").Set(Gf.Vec3d(*hinge.pivot))
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
