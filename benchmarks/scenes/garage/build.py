"""Write the stage of the garage from the models of the Debian package sweethome3d-furniture.

Usage: apt-get install sweethome3d-furniture
       python -m benchmarks.scenes.garage.build [-o FILE] [--models FOLDER]

The models may not be part of the repository. The layout is: `objects.csv` has the model and the pose of each object,
`parts.csv` the parts of models that are objects of their own, `boxes.csv` the floor, the ceiling and the walls.
"""

import csv
import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Usd, UsdGeom

from benchmarks.scenes.sweet_home import DEFAULT_MODELS, Library, Model, ModelError, run_build

__all__ = ["COMMAND", "STAGE", "Layout", "build", "read_layout"]

HERE = Path(__file__).parent
STAGE = HERE / "garage.usdc"
"""Where the stage is written by default; git ignores it."""
COMMAND = "apt-get install sweethome3d-furniture && python -m benchmarks.scenes.garage.build"
"""How to write it."""
PROTOTYPES = Sdf.Path("/_models")
MESH = "mesh"
BOX_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


class PlacedModel(NamedTuple):
    """An object with the mesh of a model. A point p of the model is at rotation · p + position."""

    prim_path: Sdf.Path
    model: str
    """`LIBRARY/NAME`."""
    rotation: NDArray[np.float64]
    """(3, 3)."""
    position: NDArray[np.float64]
    """(3,) metres."""


class Part(NamedTuple):
    """An object beside the one that it was a part of."""

    prim_path: Sdf.Path
    faces: re.Pattern[str]
    """Found in the group of each of its faces."""


class Layout(NamedTuple):
    """All objects of the stage, in its order."""

    boxes: dict[Sdf.Path, NDArray[np.float64]]
    """Object → (n, 3, 2) lower and upper bounds of its boxes along x, y and z, metres."""
    models: list[PlacedModel]
    parts: dict[Sdf.Path, list[Part]]
    """Object → what is cut off its mesh. A face belongs to the first part that it fits."""


def read_layout(folder: Path = HERE) -> Layout:
    """Return the layout in the files of a folder."""
    bounds = defaultdict(list)
    for row in _rows(folder / "boxes.csv"):
        bounds[Sdf.Path(row["prim_path"])].append([[float(row[axis + end]) for end in "01"] for axis in "xyz"])
    parts = defaultdict(list)
    for row in _rows(folder / "parts.csv"):
        parts[Sdf.Path(row["whole"])].append(Part(Sdf.Path(row["prim_path"]), re.compile(row["faces"])))
    models = [
        PlacedModel(
            Sdf.Path(row["prim_path"]),
            row["model"],
            np.array(row["rotation"].split(), dtype=float).reshape(3, 3),
            np.array(row["position"].split(), dtype=float),
        )
        for row in _rows(folder / "objects.csv")
    ]
    return Layout({path: np.array(boxes) for path, boxes in bounds.items()}, models, dict(parts))


def build(out: Path, models: Path = DEFAULT_MODELS, layout: Layout | None = None) -> int:
    """Write the stage, from the `.sh3f` files of a folder; return the number of its objects.

    Raises `ModelError` if a library, a model or the faces of a part are missing.
    """
    layout = layout or read_layout()
    libraries = {name: Library(models / f"{name}.sh3f") for name in sorted({_library(m) for m in layout.models})}

    @cache
    def read_model(key: str) -> Model:
        library, name = key.split("/")
        return libraries[library].read(name)

    writer = _Writer(out)
    for path, boxes in layout.boxes.items():
        writer.add_boxes(path, boxes)
    for placed in layout.models:
        model = read_model(placed.model)
        if parts := layout.parts.get(placed.prim_path):
            writer.add_with_parts(placed, model, parts)
        else:
            writer.add_instance(placed, model)
    writer.save()
    return len(layout.boxes) + len(layout.models) + sum(map(len, layout.parts.values()))


def _library(placed: PlacedModel) -> str:
    return placed.model.split("/")[0]


class _Writer:
    """A stage to which objects are added."""

    def __init__(self, out: Path) -> None:
        self._out = out
        self._stage = Usd.Stage.CreateInMemory()
        UsdGeom.SetStageUpAxis(self._stage, UsdGeom.Tokens.z)
        UsdGeom.SetStageMetersPerUnit(self._stage, 1.0)

    def add_boxes(self, path: Sdf.Path, boxes: NDArray[np.float64]) -> None:
        """Add an object of boxes, around the mean of their corners."""
        corners = np.array([[(x, y, z) for x in box[0] for y in box[1] for z in box[2]] for box in boxes])
        points = corners.reshape(-1, 3)
        faces = [[8 * box + corner for corner in face] for box in range(len(boxes)) for face in BOX_FACES]
        centre = points.mean(axis=0)
        self._write_mesh(self._define(path, np.eye(3), centre), points - centre, faces)

    def add_instance(self, placed: PlacedModel, model: Model) -> None:
        """Add an object that shares its mesh with all others of its model."""
        name = re.sub(r"\W", "_", placed.model.split("/")[1])
        prototype = PROTOTYPES.AppendChild(f"m_{name}")
        if not self._stage.GetPrimAtPath(prototype):
            self._stage.CreateClassPrim(PROTOTYPES)
            self._write_mesh(UsdGeom.Xform.Define(self._stage, prototype), model.points, model.faces)
        xform = self._define(placed.prim_path, placed.rotation, placed.position)
        xform.GetPrim().GetReferences().AddInternalReference(prototype)

    def add_with_parts(self, placed: PlacedModel, model: Model, parts: Sequence[Part]) -> None:
        """Add an object and its parts, each with its share of the faces."""
        paths = [placed.prim_path, *(part.prim_path for part in parts)]
        shares: dict[Sdf.Path, list[list[int]]] = {path: [] for path in paths}
        for face, group in zip(model.faces, model.groups, strict=True):
            owner = next((part.prim_path for part in parts if part.faces.search(group)), placed.prim_path)
            shares[owner].append(face)
        for path, faces in shares.items():
            if not faces:
                raise ModelError(f"{path}: no face of the model {placed.model} belongs to it")
            self._write_mesh(self._define(path, placed.rotation, placed.position), model.points, faces)

    def save(self) -> None:
        """Write the file, with the root of the objects as the default prim."""
        root = self._stage.GetPseudoRoot().GetChildren()[0]
        Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
        self._stage.SetDefaultPrim(root)
        self._stage.GetRootLayer().Export(str(self._out))

    def _define(self, path: Sdf.Path, rotation: NDArray[np.float64], position: NDArray[np.float64]) -> Any:
        """Return the prim of an object at its pose, below groups."""
        for parent in path.GetParentPath().GetPrefixes():
            Usd.ModelAPI(UsdGeom.Xform.Define(self._stage, parent)).SetKind(Kind.Tokens.group)
        xform = UsdGeom.Xform.Define(self._stage, path)
        Usd.ModelAPI(xform).SetKind(Kind.Tokens.component)
        matrix = np.eye(4)
        # OpenUSD multiplies row vectors from the left.
        matrix[:3, :3], matrix[3, :3] = rotation.T, position
        xform.AddTransformOp().Set(Gf.Matrix4d(matrix))
        return xform

    def _write_mesh(self, xform: Any, points: NDArray[np.float64], faces: Sequence[Sequence[int]]) -> None:
        """Write a mesh of those points that the faces use, rounded to 0.1 mm."""
        used, renumbered = np.unique(np.concatenate(faces), return_inverse=True)
        corners = points[used].round(4).astype(np.float32)
        mesh = UsdGeom.Mesh.Define(self._stage, xform.GetPath().AppendChild(MESH))
        mesh.CreatePointsAttr(corners)
        mesh.CreateFaceVertexCountsAttr([len(face) for face in faces])
        mesh.CreateFaceVertexIndicesAttr(renumbered.astype(np.int32))
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        mesh.CreateDoubleSidedAttr(True)
        mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(mesh.GetPointsAttr().Get()))


def _rows(path: Path) -> Iterable[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        yield from csv.DictReader(file)


def main() -> None:
    """Write the stage and print the number of its objects."""
    run_build(__doc__ or "", STAGE, build)


if __name__ == "__main__":
    main()
