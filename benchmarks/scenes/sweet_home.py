"""Models of a library of Sweet Home 3D: a `.sh3f` file, which is a ZIP archive of OBJ files and their catalogue."""

import argparse
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple
from zipfile import ZipFile

import numpy as np
from numpy.typing import NDArray

__all__ = ["DEFAULT_MODELS", "Library", "Model", "ModelError", "parse_obj", "run_build"]

DEFAULT_MODELS = Path("/usr/share/sweethome3d/furniture")
"""Folder of the `.sh3f` files of the Debian package sweethome3d-furniture."""
CATALOGUE = "PluginFurnitureCatalog.properties"
ENCODING = "latin-1"


class ModelError(Exception):
    """A library or a model of it is missing, or has not the expected groups."""


class Model(NamedTuple):
    """Points and faces, with the group of each face."""

    points: NDArray[np.float64]
    """(n, 3)."""
    faces: list[list[int]]
    """Indices of the points of each face, three or more."""
    groups: list[str]
    """`OBJECT|MATERIAL` of each face, as the OBJ file names them."""


class Library:
    """A library and its catalogue."""

    def __init__(self, path: Path) -> None:
        if not path.is_file():
            raise ModelError(
                f"{path}: no such library; install the Debian package sweethome3d-furniture, or give the folder of its "
                ".sh3f files"
            )
        self._path = path
        self._archive = ZipFile(path)
        self._entries = _read_catalogue(self._archive.read(CATALOGUE).decode(ENCODING))

    def read(self, name: str) -> Model:
        """Return a model by the stem of its file: Z up, its front towards -Y, metres, from the middle of its underside.

        Raises `ModelError` if the catalogue has no model of this name.
        """
        if (entry := self._entries.get(name)) is None:
            raise ModelError(f"{self._path}: has no model {name!r}; expected that of sweethome3d-furniture 1.8")
        model = parse_obj(self._archive.read(entry["model"].lstrip("/")).decode(ENCODING))
        return _merge_points(model._replace(points=_fit_points(model.points, entry)))


def _read_catalogue(text: str) -> dict[str, dict[str, str]]:
    """Return name → properties, from lines such as `width#12=60`."""
    entries: dict[str, dict[str, str]] = {}
    for key, number, value in re.findall(r"^(\w+)#(\d+)=(.*?)\r?$", text, re.MULTILINE):
        entries.setdefault(number, {})[key] = value
    return {Path(entry["model"]).stem: entry for entry in entries.values() if "model" in entry}


def parse_obj(text: str) -> Model:
    """Return the faces of an OBJ file and the points that they use, in the units and axes of the file."""
    points: list[list[float]] = []
    faces: list[list[int]] = []
    groups = []
    name = material = ""
    for line in text.splitlines():
        match line.split():
            case ["v", *numbers]:
                points.append([float(number) for number in numbers[:3]])
            case ["o" | "g", *names]:
                name = names[0] if names else ""
            case ["usemtl", material, *_]:
                pass
            case ["f", *corners] if len(corners) >= 3:
                indices = [int(corner.split("/")[0]) for corner in corners]
                # Negative indices count back from the last point so far.
                faces.append([index - 1 if index > 0 else len(points) + index for index in indices])
                groups.append(f"{name}|{material}")
    used, renumbered = np.unique(np.concatenate(faces), return_inverse=True)
    ends = np.cumsum([len(face) for face in faces])[:-1]
    return Model(np.array(points)[used], [face.tolist() for face in np.split(renumbered, ends)], groups)


def _fit_points(points: NDArray[np.float64], entry: dict[str, str]) -> NDArray[np.float64]:
    """Return points with the orientation and size of a catalogue entry, whose lengths are centimetres."""
    if "modelRotation" in entry:
        points = points @ _floats(entry["modelRotation"]).reshape(3, 3).T
    low, high = points.min(axis=0), points.max(axis=0)
    middle = (low + high) / 2
    size = _floats(" ".join(entry[side] for side in ("width", "height", "depth"))) / 100
    scaled = (points - [middle[0], low[1], middle[2]]) * (size / np.maximum(high - low, 1e-9))
    x, y, z = scaled.T
    return np.stack([x, -z, y], axis=1)


def _merge_points(model: Model) -> Model:
    """Return a model with one point for all within 0.01 mm, without faces that thereby lose their area."""
    points, merged = np.unique(model.points.round(5), axis=0, return_inverse=True)
    merged = merged.ravel()
    faces = [merged[face].tolist() for face in model.faces]
    kept = [index for index, face in enumerate(faces) if len(set(face)) >= 3]
    return Model(points, [faces[index] for index in kept], [model.groups[index] for index in kept])


def _floats(text: str) -> NDArray[np.float64]:
    return np.array([float(number) for number in text.split()])


def run_build(description: str, stage: Path, build: Callable[[Path, Path], int]) -> None:
    """Run the command that builds a scene from such models.

    Args:
        description: what the command says of itself.
        stage: where the stage is written by default.
        build: writes a stage with the models of a folder and returns the number of its objects.
    """
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", type=Path, default=stage, help=f"default: {stage.name} beside this script")
    parser.add_argument(
        "--models", type=Path, default=DEFAULT_MODELS, help="folder of the .sh3f files; default: %(default)s"
    )
    asked = parser.parse_args()
    try:
        count = build(asked.out, asked.models)
    except ModelError as error:
        sys.exit(f"build.py: {error}")
    print(f"{asked.out}: {count} objects")
