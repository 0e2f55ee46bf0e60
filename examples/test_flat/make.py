"""Writes the test flat: `python -m examples.test_flat.make [OUT_DIR]`.

OUT_DIR (default `benchmarks/scenes/flat`) receives `flat.usda` and `gold.csv`. Two runs write the same bytes.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path
from typing import NamedTuple

from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdShade, Vt

from .forms import Part, Vector, make_parts, merge

ROOT = Sdf.Path("/StudentFlat")

COLOURS: dict[str, Vector] = {
    "beige": (0.82, 0.75, 0.62),
    "black": (0.06, 0.06, 0.06),
    "blue": (0.13, 0.25, 0.55),
    "brown": (0.36, 0.22, 0.12),
    "green": (0.15, 0.42, 0.2),
    "grey": (0.5, 0.5, 0.5),
    "orange": (0.87, 0.45, 0.12),
    "red": (0.7, 0.1, 0.1),
    "teal": (0.05, 0.42, 0.44),
    "white": (0.92, 0.92, 0.9),
    "yellow": (0.92, 0.8, 0.2),
}
"""Colours of things without material."""

MATERIALS: dict[str, Vector] = {
    "Aluminium": (0.75, 0.76, 0.78),
    "Bamboo": (0.8, 0.66, 0.4),
    "Beech": (0.78, 0.6, 0.42),
    "Cardboard": (0.65, 0.5, 0.33),
    "Ceramic_Green": (0.25, 0.5, 0.35),
    "Ceramic_White": (0.93, 0.92, 0.88),
    "Chrome": (0.8, 0.8, 0.82),
    "Cotton_Grey": (0.55, 0.55, 0.57),
    "Glass_Clear": (0.85, 0.9, 0.92),
    "Laminate_Oak": (0.7, 0.55, 0.38),
    "Linen": (0.85, 0.82, 0.74),
    "Oak": (0.66, 0.5, 0.33),
    "Opal_Glass": (0.95, 0.95, 0.93),
    "Plaster_White": (0.95, 0.94, 0.92),
    "Steel_Brushed": (0.6, 0.61, 0.62),
    "Walnut": (0.35, 0.23, 0.15),
}
"""Diffuse colours of the materials."""


class Thing(NamedTuple):
    """One row of `things.csv`: a thing, its copies and its label."""

    group: str
    at: str
    """`name x y z [yaw]` per copy, separated by `;`: middle of the underside in metres, degrees about z."""
    form: str
    size: str
    """Extents along x, y, z before turning, metres."""
    look: str
    """A material, or a colour without one."""
    parts: str
    """`y`: one mesh per part, with the part's name; else a single mesh."""
    label: str
    also: str
    asset: str
    """Name in `assetInfo`, or nothing."""
    display: str
    doc: str


def read_things() -> list[Thing]:
    """The table of things, in its order."""
    with Path(__file__).with_name("things.csv").open(encoding="utf-8") as file:
        rows = csv.reader(file)
        next(rows)
        return [Thing(*row) for row in rows]


def read_copies(thing: Thing) -> list[tuple[Sdf.Path, Vector, float]]:
    """Prim path, place (metres) and yaw (degrees) of each copy."""
    copies = []
    for copy in thing.at.split(";"):
        name, x, y, z, *yaw = copy.split()
        path = ROOT.AppendPath(thing.group).AppendChild(name)
        copies.append((path, (float(x), float(y), float(z)), float(yaw[0]) if yaw else 0.0))
    return copies


def write_stage(things: list[Thing], path: Path) -> None:
    """Writes the scene as one layer."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, ROOT).GetPrim()
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    stage.SetDefaultPrim(root)
    materials = _write_materials(stage)
    for thing in things:
        _define_groups(stage, ROOT.AppendPath(thing.group))
        _write_thing(stage, thing, materials)
    layer.Export(str(path))


def _write_materials(stage: Usd.Stage) -> dict[str, UsdShade.Material]:
    scope = UsdGeom.Scope.Define(stage, ROOT.AppendChild("Looks")).GetPath()
    materials = {}
    for name, colour in MATERIALS.items():
        material = UsdShade.Material.Define(stage, scope.AppendChild(name))
        shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("Surface"))
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*colour))
        output = shader.CreateOutput("surface", Sdf.ValueTypeNames.Token)
        material.CreateSurfaceOutput().ConnectToSource(output)
        materials[name] = material
    return materials


def _define_groups(stage: Usd.Stage, path: Sdf.Path) -> None:
    for prefix in path.GetPrefixes()[1:]:
        group = UsdGeom.Xform.Define(stage, prefix).GetPrim()
        Usd.ModelAPI(group).SetKind(Kind.Tokens.group)


def _write_thing(stage: Usd.Stage, thing: Thing, materials: dict[str, UsdShade.Material]) -> None:
    """Writes the first copy in full; the others refer to it."""
    (path, place, yaw), *others = read_copies(thing)
    prim = _place(stage, path, place, yaw)
    _describe(prim, thing)
    if thing.look in materials:
        UsdShade.MaterialBindingAPI.Apply(prim).Bind(materials[thing.look])
    x, y, z = (float(length) for length in thing.size.split())
    parts = make_parts(thing.form, (x, y, z))
    for part in parts if thing.parts else [merge(parts, "geo")]:
        write = _write_cube if part.is_block else _write_mesh
        shape = write(stage, path.AppendChild(part.name), part)
        if thing.look not in materials:
            shape.CreateDisplayColorAttr([Gf.Vec3f(*COLOURS[thing.look])])
    for other, there, turn in others:
        _place(stage, other, there, turn).GetReferences().AddInternalReference(path)


def _place(stage: Usd.Stage, path: Sdf.Path, place: Vector, yaw: float) -> Usd.Prim:
    if stage.GetPrimAtPath(path):
        raise ValueError(f"things.csv: two things at {path}; give one of them another name")
    xform = UsdGeom.Xform.Define(stage, path)
    xform.AddTranslateOp().Set(Gf.Vec3d(*place))
    if yaw:
        xform.AddRotateZOp().Set(yaw)
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
    # A block's first corner is the lowest, its last the highest. A cube has edges of 2 m where none are authored.
    low, high = Gf.Vec3d(*part.points[0]), Gf.Vec3d(*part.points[-1])
    cube.AddTranslateOp().Set(Gf.Vec3d(*(round(at, 5) + 0.0 for at in (low + high) / 2)))
    cube.AddScaleOp().Set(Gf.Vec3f(*(round(half, 5) for half in (high - low) / 2)))
    return cube


def _write_mesh(stage: Usd.Stage, path: Sdf.Path, part: Part) -> UsdGeom.Gprim:
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = Vt.Vec3fArray([Gf.Vec3f(*point) for point in part.points])
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr([len(face) for face in part.faces])
    mesh.CreateFaceVertexIndicesAttr([index for face in part.faces for index in face])
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    return mesh


def write_gold(things: list[Thing], path: Path) -> int:
    """Writes class and defensible further classes per object, sorted by path; returns the number of rows."""
    rows = [(str(copy[0]), thing.label, thing.also) for thing in things for copy in read_copies(thing)]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("path", "class", "also"))
        writer.writerows(sorted(rows))
    return len(rows)


def main() -> None:
    """Command line entry."""
    parser = argparse.ArgumentParser(description="Write the test flat.")
    parser.add_argument("out_dir", nargs="?", default="benchmarks/scenes/flat", type=Path)
    folder: Path = parser.parse_args().out_dir
    folder.mkdir(parents=True, exist_ok=True)
    things = read_things()
    write_stage(things, folder / "flat.usda")
    count = write_gold(things, folder / "gold.csv")
    size = (folder / "flat.usda").stat().st_size
    print(f"{count} objects, {len(things)} distinct things, {size / 1024:.0f} KiB in {folder / 'flat.usda'}")


if __name__ == "__main__":
    main()
