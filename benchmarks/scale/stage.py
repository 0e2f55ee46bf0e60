"""Write a synthetic place as a stage that references a library of assets."""

import itertools
import random
from pathlib import Path

from pxr import Gf, Sdf, Tf, Usd, UsdGeom, Vt

from benchmarks.scale.catalogue import Asset, Catalogue
from benchmarks.scale.places import PLACES, Point, Thing, board_tops

MATERIALS = ("Oak", "Steel", "Plastic", "Ceramic", "Cardboard", "Glass")
THICKNESS = 0.02
"""Thickness of a board in metres."""
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def write_place(path: Path, place: str, objects: int) -> None:
    """Write a stage with a number of objects, every third one an instance, and a library of assets next to it."""
    chance = random.Random(objects)
    catalogue = Catalogue(objects, chance)
    library = path.with_name(f"{path.stem}_assets.usdc")
    _write_library(library, catalogue)
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    layer = stage.GetRootLayer()
    with Sdf.ChangeBlock():
        for index, thing in enumerate(itertools.islice(PLACES[place](catalogue, chance), objects)):
            _write_thing(layer, thing, library.name, is_instance=index % 3 == 0)
        for prim in _groups(layer):
            prim.specifier, prim.typeName, prim.kind = Sdf.SpecifierDef, "Xform", "group"
    layer.Save()


def _groups(layer: Sdf.Layer) -> list[Sdf.PrimSpec]:
    world = layer.GetPrimAtPath("/World")
    below = [child for outer in world.nameChildren for child in outer.nameChildren]
    return [world, *world.nameChildren, *below]


def _write_thing(layer: Sdf.Layer, thing: Thing, library: str, *, is_instance: bool) -> None:
    prim = Sdf.CreatePrimInLayer(layer, thing.path)
    prim.specifier = Sdf.SpecifierDef
    prim.referenceList.prependedItems = [Sdf.Reference(library, f"/{_prim_name(thing.asset)}")]
    if is_instance:
        prim.instanceable = True
    _place(prim, thing.place)


def _write_library(path: Path, catalogue: Catalogue) -> None:
    layer = Sdf.Layer.CreateNew(str(path))
    with Sdf.ChangeBlock():
        for kind_index, assets in enumerate(catalogue.by_kind.values()):
            for asset in assets:
                _write_asset(layer, asset, MATERIALS[kind_index % len(MATERIALS)])
    layer.Save()


def _write_asset(layer: Sdf.Layer, asset: Asset, material: str) -> None:
    root = Sdf.CreatePrimInLayer(layer, f"/{_prim_name(asset)}")
    root.specifier, root.typeName, root.kind = Sdf.SpecifierDef, "Xform", "component"
    root.SetInfo("assetInfo", {"name": asset.name})
    looks = Sdf.PrimSpec(root, "Looks", Sdf.SpecifierDef, "Scope")
    Sdf.PrimSpec(looks, material, Sdf.SpecifierDef, "Material")
    width, depth, height = asset.size
    if asset.boards:
        for number, top in enumerate(board_tops(asset)):
            _write_mesh(root, f"board_{number}", (0, 0, top - THICKNESS), (width, depth, top), material)
        _write_mesh(root, "back", (0, depth - THICKNESS, 0), (width, depth, height), material)
    else:
        _write_mesh(root, "body", (0, 0, 0), (width, depth, height * 0.8), material)
        _write_mesh(root, "top", (0, 0, height * 0.8), (width, depth, height), material)


def _write_mesh(root: Sdf.PrimSpec, name: str, lower: Point, upper: Point, material: str) -> None:
    mesh = Sdf.PrimSpec(root, name, Sdf.SpecifierDef, "Mesh")
    corners = [Gf.Vec3f(*corner) for corner in itertools.product(*zip(lower, upper, strict=True))]
    values = (
        ("points", Sdf.ValueTypeNames.Point3fArray, Vt.Vec3fArray(corners)),
        ("extent", Sdf.ValueTypeNames.Float3Array, Vt.Vec3fArray([corners[0], corners[-1]])),
        ("faceVertexCounts", Sdf.ValueTypeNames.IntArray, Vt.IntArray([4] * 6)),
        ("faceVertexIndices", Sdf.ValueTypeNames.IntArray, Vt.IntArray([index for face in FACES for index in face])),
    )
    for attribute, value_type, value in values:
        Sdf.AttributeSpec(mesh, attribute, value_type).default = value
    binding = Sdf.RelationshipSpec(mesh, "material:binding", custom=False)
    binding.targetPathList.explicitItems = [root.path.AppendPath(f"Looks/{material}")]
    mesh.SetInfo("apiSchemas", Sdf.TokenListOp.CreateExplicit(["MaterialBindingAPI"]))


def _place(prim: Sdf.PrimSpec, place: Point) -> None:
    Sdf.AttributeSpec(prim, "xformOp:translate", Sdf.ValueTypeNames.Double3).default = Gf.Vec3d(*place)
    order = Sdf.AttributeSpec(prim, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, Sdf.VariabilityUniform)
    order.default = Vt.TokenArray(["xformOp:translate"])


def _prim_name(asset: Asset) -> str:
    return str(Tf.MakeValidIdentifier(asset.name))
