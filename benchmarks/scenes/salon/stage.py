"""Place assets in the salon and write them as a stage: Y up, centimetres, as many editors write."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Usd, UsdGeom

from benchmarks.scenes.prims import draw, write_mesh
from benchmarks.scenes.salon.contact import Solid, lift_onto, solid
from benchmarks.scenes.salon.shapes import Shape, turn
from benchmarks.scenes.sweet_home import Library

__all__ = ["Asset", "Placed", "Salon", "write"]

MESH = "geo"
PROTOTYPES = Sdf.Path("/_assets")
ERRORS = (0.0, 0.0, 0.0, 0.001, -0.001, 0.002, -0.003, 0.004, 0.006, -0.006, 0.009)
"""Metres by which a thing stands too high or too low, one of which is drawn by its name."""
Z_TO_Y = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""Turns a column vector of a Z-up frame into the Y-up frame."""
CM = np.diag([100.0, 100, 100, 1])


class Asset(NamedTuple):
    """A mesh in its own frame and units."""

    name: str
    shape: Shape
    """Z up, metres, whatever the asset is written in."""
    unit: float = 0.01
    """Metres per unit of the written points."""
    up: str = "Y"
    file: str = ""
    """The file beside the stage in which it is written; "": in the stage."""


@dataclass
class Placed:
    """An object at its pose: a point p of the asset is at matrix · (p, 1)."""

    path: Sdf.Path
    asset: Asset
    matrix: NDArray[np.float64]
    """(4, 4), Z up, metres."""
    solid: Solid


class Salon:
    """The objects so far."""

    def __init__(self, models: Path) -> None:
        self.objects: dict[str, Placed] = {}
        self._models = models
        self._shapes: dict[str, Shape] = {}
        self._libraries: dict[str, Library] = {}
        self._read: dict[str, Asset] = {}

    def model(self, key: str) -> Asset:
        """Return the model LIBRARY/NAME of Sweet Home 3D."""
        if key not in self._read:
            library, name = key.split("/")
            if library not in self._libraries:
                self._libraries[library] = Library(self._models / f"{library}.sh3f")
            read = self._libraries[library].read(name)
            self._read[key] = Asset(name, Shape(read.points, read.faces), 1.0, "Z")
        return self._read[key]

    def put(
        self, path: str, asset: Asset, at: Sequence[float], yaw: float = 0.0, tilt: tuple[str, float] | None = None
    ) -> None:
        """Add an object at a place: first tilted about an axis, then turned about the vertical, then moved."""
        shape = asset.shape if tilt is None else turn(asset.shape, *tilt)
        matrix = np.eye(4)
        matrix[:3, :3] = turn(turn(Shape(np.eye(3), []), *(tilt or ("z", 0.0))), "z", yaw).points.T
        matrix[:3, 3] = at
        moved = turn(shape, "z", yaw).points + at
        if path in self.objects:
            raise ValueError(f"{path} is placed twice")
        # Copies refer to one mesh by the name of their asset.
        known = self._shapes.setdefault(asset.name, asset.shape)
        if known.faces != asset.shape.faces or not np.array_equal(known.points, asset.shape.points):
            raise ValueError(f"{path}: another asset is named {asset.name!r}")
        self.objects[path] = Placed(Sdf.Path(f"/Salon/{path}"), asset, matrix, solid(moved, shape.faces))

    def rest(
        self,
        path: str,
        asset: Asset,
        plan: tuple[float, float],
        onto: str | Sequence[str],
        *,
        yaw: float = 0.0,
        tilt: tuple[str, float] | None = None,
        below: float = np.inf,
    ) -> None:
        """Add an object that falls onto others, on their faces below a height; it then stands a little off."""
        self.put(path, asset, (*plan, 0.0), yaw, tilt)
        placed = self.objects[path]
        names = [onto] if isinstance(onto, str) else list(onto)
        try:
            lift = lift_onto(placed.solid, [self.objects[name].solid for name in names], below)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error
        height = float(np.ptp(placed.solid.points[:, 2]))
        lift += float(np.clip(draw(path, ERRORS), -0.3 * height, 0.009))
        placed.matrix[2, 3] += lift
        placed.solid = placed.solid._replace(points=placed.solid.points + np.array([0, 0, lift]))


def write(salon: Salon, out: Path) -> None:
    """Write the stage, and beside it the assets that have files of their own."""
    # A stage in memory would not find the assets beside the file.
    stage = Usd.Stage.CreateNew(str(out))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    uses: dict[str, int] = {}
    for placed in salon.objects.values():
        uses[placed.asset.name] = uses.get(placed.asset.name, 0) + 1
    files: set[str] = set()
    for placed in salon.objects.values():
        xform = _define(stage, placed)
        asset = placed.asset
        if asset.file:
            if asset.file not in files:
                _write_file(asset, out.parent)
                files.add(asset.file)
            xform.GetPrim().GetReferences().AddReference(f"./{asset.file}")
        elif uses[asset.name] > 1:
            prototype = PROTOTYPES.AppendChild("".join(c if c.isalnum() else "_" for c in f"p_{asset.name}"))
            if not stage.GetPrimAtPath(prototype):
                stage.CreateClassPrim(PROTOTYPES)
                _write_mesh(UsdGeom.Xform.Define(stage, prototype), asset)
            xform.GetPrim().GetReferences().AddInternalReference(prototype)
            xform.GetPrim().SetInstanceable(True)
        else:
            _write_mesh(xform, asset)
    root = stage.GetPrimAtPath("/Salon")
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    stage.SetDefaultPrim(root)
    stage.Save()


def _define(stage: Any, placed: Placed) -> Any:
    for parent in placed.path.GetParentPath().GetPrefixes():
        Usd.ModelAPI(UsdGeom.Xform.Define(stage, parent)).SetKind(Kind.Tokens.group)
    xform = UsdGeom.Xform.Define(stage, placed.path)
    Usd.ModelAPI(xform).SetKind(Kind.Tokens.component)
    matrix = CM @ Z_TO_Y @ placed.matrix @ np.linalg.inv(_own_frame(placed.asset))
    # OpenUSD multiplies row vectors from the left.
    xform.AddTransformOp().Set(Gf.Matrix4d(matrix.T))
    return xform


def _own_frame(asset: Asset) -> NDArray[np.float64]:
    """Return the matrix from Z-up metres to the frame in which an asset is written."""
    scale = np.diag([1 / asset.unit] * 3 + [1.0])
    return scale @ Z_TO_Y if asset.up == "Y" else scale


def _write_file(asset: Asset, folder: Path) -> None:
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y if asset.up == "Y" else UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, asset.unit)
    root = UsdGeom.Xform.Define(stage, f"/{asset.name}")
    _write_mesh(root, asset)
    stage.SetDefaultPrim(root.GetPrim())
    stage.GetRootLayer().Export(str(folder / asset.file))


def _write_mesh(xform: Any, asset: Asset) -> None:
    frame = _own_frame(asset)
    path = xform.GetPath().AppendChild(MESH)
    write_mesh(xform.GetPrim().GetStage(), path, asset.shape.points @ frame[:3, :3].T, asset.shape.faces)
