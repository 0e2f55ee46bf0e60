"""Wavefront OBJ → prims: a transform for each object (`o`) or, without objects, each group (`g`).

OBJ states neither units nor an up axis: metres and y-up are assumed.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from usd2kg.convert.converted import Converted
from usd2kg.convert.prims import PrimAuthor, new_stage
from usd2kg.convert.trimesh_files import MeshAuthor, load_scene, trimesh_name

if TYPE_CHECKING:
    import trimesh

__all__ = ["ASSUMED", "ObjPart", "define_parts", "read_parts", "read_prims"]

ASSUMED = (
    "OBJ states neither units nor an up axis; metres and y-up are assumed, --metres-per-unit and --up-axis change it"
)
"""Note on all OBJ files."""
_OBJECT = re.compile(rb"^o[ \t]+\S", re.MULTILINE)


class ObjPart(NamedTuple):
    """The triangles of one object that share a material."""

    name: str
    """Name of the object or group; without them, of the material or of the file."""
    geometry: "trimesh.Trimesh"


def read_prims(path: Path) -> Converted:
    """Return the stage of an OBJ file: its objects below a prim named after the file.

    Raises:
        SceneError: trimesh cannot read the file, or it has no triangles.
    """
    parts = read_parts(path)
    stage = new_stage("Y", 1.0)
    author = PrimAuthor(stage)
    root = author.define("/", path.stem)
    stage.SetDefaultPrim(root)
    root.SetAssetInfo({"name": path.stem})
    top = str(root.GetPath())
    define_parts(author, MeshAuthor(author, top), top, parts)
    return Converted(stage, trimesh_name(), (ASSUMED,))


def read_parts(path: Path) -> list[ObjPart]:
    """Return the objects of a file, or its groups if it has no objects, in the order of the names.

    Raises:
        SceneError: trimesh cannot read the file, or it has no triangles.
    """
    has_objects = _OBJECT.search(path.read_bytes()) is not None
    expected = "a Wavefront OBJ file with faces"
    return list(_parts(load_scene(path, expected, split_objects=has_objects, split_groups=not has_objects)))


def define_parts(author: PrimAuthor, meshes: MeshAuthor, parent: str, parts: list[ObjPart]) -> list[Any]:
    """Return the prims of objects below the path `parent`, each with a mesh for each of its materials."""
    prims: dict[str, Any] = {}
    for name, geometry in parts:
        if name not in prims:
            prims[name] = author.define(parent, name)
        meshes.define(str(prims[name].GetPath()), "mesh", geometry)
    return list(prims.values())


def _parts(scene: "trimesh.Scene") -> Iterator[ObjPart]:
    materials = {name: _material_name(geometry) for name, geometry in scene.geometry.items()}
    # trimesh appends the name of the material if the library has several.
    is_suffixed = len(set(materials.values())) > 1
    for name in sorted(scene.geometry):
        material = materials[name]
        geometry: Any = scene.geometry[name]
        yield ObjPart(name.removesuffix(f"_{material}") if is_suffixed and material else name, geometry)


def _material_name(geometry: Any) -> str | None:
    return getattr(getattr(geometry.visual, "material", None), "_name", None)
