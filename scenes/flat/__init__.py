"""Student flat, held out as test scene: Z up, metres, one layer."""

import csv
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdShade

from scenes.flat.forms import Part, make_parts, merge_parts
from scenes.writer.asset_file import write_geometry
from scenes.writer.gold import write_gold
from scenes.writer.layout import open_stage
from scenes.writer.mesh import Vec3, mesh_from_faces
from scenes.writer.palette import ShaderStyle, read_palette, write_materials

TABLES = Path(__file__).parent
ROOT = Sdf.Path("/StudentFlat")
PALETTE = read_palette(TABLES / "materials.csv")
"""Materials have capital initials; the others are display colours."""
MATERIALS = [name for name in PALETTE if name[0].isupper()]


class Thing(NamedTuple):
    """One row of `things.csv`: a thing, its copies and its label."""

    group: str
    at: str
    """`name x y z [yaw]` per copy, separated by `;`: middle of the underside in metres, degrees about z."""
    form: str
    size: str
    """Extents along x, y, z before turning, metres."""
    look: str
    """A material or a display colour."""
    parts: str
    """`y`: one mesh per part, with the part's name; else a single mesh."""
    label: str
    also: str
    asset: str
    """Name in `assetInfo`, or empty."""
    display: str
    doc: str


class Copy(NamedTuple):
    """Where one copy of a thing is."""

    path: Sdf.Path
    place: Vec3
    """Metres."""
    yaw: float
    """Degrees."""


def write(folder: Path) -> str:
    """Write `flat.usda` and `gold.csv`; return a summary."""
    folder.mkdir(parents=True, exist_ok=True)
    with (TABLES / "things.csv").open(encoding="utf-8") as file:
        things = [Thing(*row) for row in list(csv.reader(file))[1:]]
    _write_stage(things, folder / "flat.usda")
    gold = {str(copy.path): (thing.label, thing.also) for thing in things for copy in _read_copies(thing)}
    write_gold(folder / "gold.csv", gold)
    return f"{len(gold)} objects, {len(things)} distinct things"


def _read_copies(thing: Thing) -> list[Copy]:
    copies = []
    for copy in thing.at.split(";"):
        name, x, y, z, *yaw = copy.split()
        path = ROOT.AppendPath(thing.group).AppendChild(name)
        copies.append(Copy(path, (float(x), float(y), float(z)), float(yaw[0]) if yaw else 0.0))
    return copies


def _write_stage(things: list[Thing], path: Path) -> None:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    stage, root = open_stage(layer, str(ROOT), is_z_up=True, meters_per_unit=1.0)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    materials = write_materials(stage, ROOT.AppendChild("Looks"), MATERIALS, PALETTE, ShaderStyle("Surface"))
    for thing in things:
        for prefix in ROOT.AppendPath(thing.group).GetPrefixes()[1:]:
            Usd.ModelAPI(UsdGeom.Xform.Define(stage, prefix).GetPrim()).SetKind(Kind.Tokens.group)
        _write_thing(stage, thing, materials)
    layer.Export(str(path))


def _write_thing(stage: Usd.Stage, thing: Thing, materials: dict[str, UsdShade.Material]) -> None:
    """Write the first copy in full; the others reference it."""
    first, *others = _read_copies(thing)
    prim = _place(stage, first)
    _describe(prim, thing)
    if thing.look in materials:
        UsdShade.MaterialBindingAPI.Apply(prim).Bind(materials[thing.look])
    x, y, z = (float(length) for length in thing.size.split())
    parts = make_parts(thing.form, (x, y, z))
    for part in parts if thing.parts else [merge_parts(parts, "geo")]:
        gprim = (_write_cube if part.is_block else _write_mesh)(stage, first.path.AppendChild(part.name), part)
        if thing.look not in materials:
            gprim.CreateDisplayColorAttr([Gf.Vec3f(*PALETTE[thing.look].color)])
    for other in others:
        _place(stage, other).GetReferences().AddInternalReference(first.path)


def _place(stage: Usd.Stage, copy: Copy) -> Usd.Prim:
    if stage.GetPrimAtPath(copy.path):
        raise ValueError(f"things.csv: two things at {copy.path}; rename one of them")
    xform = UsdGeom.Xform.Define(stage, copy.path)
    xform.AddTranslateOp().Set(Gf.Vec3d(*copy.place))
    if copy.yaw:
        xform.AddRotateZOp().Set(copy.yaw)
    return xform.GetPrim()


def _describe(prim: Usd.Prim, thing: Thing) -> None:
    model = Usd.ModelAPI(prim)
    model.SetKind(Kind.Tokens.component)
    if thing.asset:
        model.SetAssetName(thing.asset)
    if thing.display:
        prim.SetDisplayName(thing.display)
    if thing.doc:
        prim.SetDocumentation(thing.doc)


def _write_cube(stage: Usd.Stage, path: Sdf.Path, part: Part) -> UsdGeom.Gprim:
    cube = UsdGeom.Cube.Define(stage, path)
    # The first corner of a block is the lowest, the last the highest; the default size of a cube is 2.
    low, high = Gf.Vec3d(*part.points[0]), Gf.Vec3d(*part.points[-1])
    cube.AddTranslateOp().Set(Gf.Vec3d(*(round(at, 5) + 0.0 for at in (low + high) / 2)))
    cube.AddScaleOp().Set(Gf.Vec3f(*(round(half, 5) for half in (high - low) / 2)))
    return cube


def _write_mesh(stage: Usd.Stage, path: Sdf.Path, part: Part) -> UsdGeom.Gprim:
    mesh = UsdGeom.Mesh.Define(stage, path)
    write_geometry(mesh, mesh_from_faces(part.points, np.empty((0, 3)), part.faces))
    return mesh
