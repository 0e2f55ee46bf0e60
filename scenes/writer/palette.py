"""Materials of a scene, read from `materials.csv`, and their USD prims."""

import csv
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

Vec3 = tuple[float, float, float]


class Surface(NamedTuple):
    """UsdPreviewSurface inputs."""

    color: Vec3
    """Linear RGB, 0 to 1."""
    roughness: float = 0.5
    metallic: float = 0.0
    opacity: float = 1.0


class ShaderStyle(NamedTuple):
    """How a studio authors UsdPreviewSurface shaders."""

    name: str
    inputs: Mapping[str, float | None] = {}
    """Authored inputs other than `diffuseColor`; an input equal to the given value is left out."""


def read_palette(*paths: Path) -> dict[str, Surface]:
    """Return the materials of the tables by name; an empty cell is the default of `Surface`."""
    found = {}
    for path in paths:
        with path.open(encoding="utf-8") as file:
            for row in csv.DictReader(file):
                color = (float(row["red"]), float(row["green"]), float(row["blue"]))
                inputs = {key: float(row[key]) for key in ("roughness", "metallic", "opacity") if row[key]}
                found[row["name"]] = Surface(color, **inputs)
    return found


def write_materials(
    stage: Usd.Stage, scope: Sdf.Path, names: Iterable[str], palette: Mapping[str, Surface], style: ShaderStyle
) -> dict[str, UsdShade.Material]:
    """Author a UsdPreviewSurface material per name below a scope; return them by name."""
    UsdGeom.Scope.Define(stage, scope)
    materials = {}
    for name in names:
        surface = palette[name]
        material = UsdShade.Material.Define(stage, scope.AppendChild(name))
        shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild(style.name))
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*surface.color))
        for key, omitted in style.inputs.items():
            if (value := getattr(surface, key)) != omitted:
                shader.CreateInput(key, Sdf.ValueTypeNames.Float).Set(value)
        output = shader.CreateOutput("surface", Sdf.ValueTypeNames.Token)
        material.CreateSurfaceOutput().ConnectToSource(output)
        materials[name] = material
    return materials
