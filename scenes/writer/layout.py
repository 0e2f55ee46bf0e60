"""Layout of a scene: where each object of `objects.csv` is, and what it is on and inside."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

import numpy as np
from pxr import Sdf, Usd, UsdGeom

from scenes.writer.assets import Asset, AssetFile, collect_assets
from scenes.writer.mesh import Floats, Vec3, rotation
from scenes.writer.palette import ShaderStyle, Surface

GAP = 0.05
"""Gap in centimetres between an object and its support, so that no faces coincide."""

Z_UP: Floats = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""(3, 3), turns Y-up column vectors into Z-up ones."""


class Placement(NamedTuple):
    """One object of the scene: a row of `objects.csv`, resolved."""

    path: str
    asset: str
    """Key of the asset."""
    position: Vec3
    """Centimetres, axes of the stage."""
    turn: Vec3
    """Degrees about x, y, z of the stage."""
    mass: float | None = None
    """Kilograms."""
    options: frozenset[str] = frozenset()
    """`instance`: instanceable; `kinematic`: a body that stays put; `no_link`: a model without link."""
    scale: float = 1.0
    display_name: str = ""
    documentation: str = ""


@dataclass(frozen=True)
class AuthoredScene:
    """One scene: its tables and assets, and the conventions of its files."""

    root: str
    """Path of the default prim."""
    tables: Path
    """Folder with `objects.csv` and `labels.csv`."""
    modules: tuple[ModuleType, ...]
    """Modules with the assets."""
    palette: Mapping[str, Surface]
    shader: ShaderStyle
    documentation: str
    is_z_up: bool = True
    meters_per_unit: float = 0.01
    turn_order: str = "XYZ"
    """Order of the rotations of an object."""
    has_yaw_op: bool = False
    """Whether a turn about the vertical alone is authored as `rotateZ`."""
    areas: Mapping[str, str] = field(default_factory=dict)
    """Top-level group → `references`, `bodies` or `models`; objects and groups in such an area have no kind."""
    writes_asset_info: bool = False
    welds_points: bool = False
    """Whether the faces of flat-shaded meshes share points."""
    writes_relations: bool = False

    @property
    def axes(self) -> Floats:
        """(3, 3), turns column vectors of an asset into the axes of the stage."""
        return Z_UP if self.is_z_up else np.eye(3)

    def area(self, path: str) -> str:
        """Return the kind of area that a prim is in; empty: objects are components."""
        return self.areas.get(path.removeprefix(f"{self.root}/").split("/")[0], "")


@dataclass
class Layout:
    """A scene in memory."""

    spec: AuthoredScene
    files: dict[str, AssetFile]
    assets: dict[str, Asset] = field(default_factory=dict)
    """Used assets by key."""
    placed: dict[str, Placement] = field(default_factory=dict)
    relations: list[tuple[str, str, str]] = field(default_factory=list)
    """(subject path, `on` or `inside`, object path)."""

    @property
    def groups(self) -> list[str]:
        """Paths of the group prims, parents first, in the order in which objects need them."""
        parents = (Sdf.Path(path).GetParentPath().GetPrefixes()[1:] for path in self.placed)
        return list(dict.fromkeys(str(prefix) for prefixes in parents for prefix in prefixes))

    def points(self, placement: Placement) -> Floats:
        """Return the (N, 3) points of an object relative to its origin, centimetres, axes of the stage."""
        turned = self.spec.axes.T @ rotation(placement.turn, self.spec.turn_order).T
        return np.asarray(placement.scale * self.assets[placement.asset].points() @ turned)

    @property
    def up(self) -> int:
        """Index of the vertical axis."""
        return 2 if self.spec.is_z_up else 1

    def add(self, row: Mapping[str, str]) -> None:
        """Add the object of a row; a height that is not given follows from its support.

        Raises:
            ValueError: the path is taken.
        """
        placement = _read_placement(row, self.spec.root, self.up)
        if placement.path in self.placed:
            raise ValueError(f"objects.csv: {placement.path} is placed twice; rename one of the objects")
        if placement.asset not in self.assets:
            self.assets[placement.asset] = self.files[placement.asset].make()
        at = [float(value) for value in row["at"].split()]
        if len(at) == 2:
            lowest = float(self.points(placement)[:, self.up].min())
            at.insert(self.up, round(self._support_height(row["on"], row["inside"]) + GAP - lowest, 4))
        self.placed[placement.path] = placement._replace(position=(at[0], at[1], at[2]))
        for relation in ("on", "inside"):
            for other in filter(None, row[relation].split("|")):
                path = f"{self.spec.root}/{other.partition('#')[0]}"
                if path in self.placed:
                    self.relations.append((placement.path, relation, path))

    def _support_height(self, on: str, inside: str) -> float:
        """Return the height that an object rests at: a number, a surface of its support, or the ground."""
        first = on.split("|", maxsplit=1)[0] or inside
        try:
            return float(first or 0)
        except ValueError:
            carrier, _, surface = first.partition("#")
        below = self.placed[f"{self.spec.root}/{carrier}"]
        return below.position[self.up] + self.assets[below.asset].surface(surface or ("top" if on else "inside"))


def _read_placement(row: Mapping[str, str], root: str, up: int) -> Placement:
    """Return the object of a row at the origin."""
    turn = [float(value) for value in row["turn"].split()] or [0.0]
    if len(turn) == 1:
        turn = [turn[0] if axis == up else 0.0 for axis in range(3)]
    words = dict(word.partition("=")[::2] for word in row["options"].split())
    return Placement(
        path=f"{root}/{row['path']}",
        asset=row["asset"],
        position=(0.0, 0.0, 0.0),
        turn=(turn[0], turn[1], turn[2]),
        mass=float(row["mass"]) if row["mass"] else None,
        options=frozenset(words),
        scale=float(words.get("scale", 1)),
        display_name=row["display"],
        documentation=row["doc"],
    )


def read_layout(spec: AuthoredScene) -> Layout:
    """Return the scene with all objects of `objects.csv` in place."""
    layout = Layout(spec, collect_assets(spec.modules))
    with (spec.tables / "objects.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            layout.add(row)
    return layout


def open_stage(layer: Sdf.Layer, root: str, *, is_z_up: bool, meters_per_unit: float) -> tuple[Usd.Stage, Usd.Prim]:
    """Return a stage on an empty layer with its metrics and default prim."""
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z if is_z_up else UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, meters_per_unit)
    prim = UsdGeom.Xform.Define(stage, root).GetPrim()
    stage.SetDefaultPrim(prim)
    return stage, prim
