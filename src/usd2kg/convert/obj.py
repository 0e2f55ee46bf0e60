"""Wavefront OBJ → prims: a transform for each object (`o`) or, without objects, each group (`g`).

OBJ states neither units nor an up axis: metres and y-up are assumed.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usd2kg.convert.converted import Converted
from usd2kg.convert.prims import PrimAuthor, new_stage
from usd2kg.convert.trimesh_files import MeshAuthor, load_scene, trimesh_name

if TYPE_CHECKING:
    import trimesh

__all__ = ["read_prims"]

_OBJECT = re.compile(rb"^o[ \t]+\S", re.MULTILINE)
_ASSUMED = (
    "OBJ states neither units nor an up axis; metres and y-up are assumed, --metres-per-unit and --up-axis change it"
)


def read_prims(path: Path) -> Converted:
    """Return the stage of an OBJ file: its objects below a prim named after the file.

    Raises:
        SceneError: trimesh cannot read the file, or it has no triangles.
    """
    has_objects = _OBJECT.search(path.read_bytes()) is not None
    expected = "a Wavefront OBJ file with faces"
    scene = load_scene(path, expected, split_objects=has_objects, split_groups=not has_objects)
    stage = new_stage("Y", 1.0)
    author = PrimAuthor(stage)
    root = author.define("/", path.stem)
    stage.SetDefaultPrim(root)
    root.SetAssetInfo({"name": path.stem})
    top = str(root.GetPath())
    meshes = MeshAuthor(author, top)
    parents: dict[str, str] = {}
    for name, geometry in _named_meshes(scene):
        if name not in parents:
            parents[name] = str(author.define(top, name).GetPath())
        meshes.define(parents[name], "mesh", geometry)
    return Converted(stage, trimesh_name(), (_ASSUMED,))


def _named_meshes(scene: "trimesh.Scene") -> Iterator[tuple[str, Any]]:
    """Yield (name of the object, mesh) for each material of each object, in the order of the names."""
    materials = {name: _material_name(geometry) for name, geometry in scene.geometry.items()}
    # trimesh appends the name of the material if the library has several.
    is_suffixed = len(set(materials.values())) > 1
    for name in sorted(scene.geometry):
        material = materials[name]
        yield (name.removesuffix(f"_{material}") if is_suffixed and material else name), scene.geometry[name]


def _material_name(geometry: Any) -> str | None:
    return getattr(getattr(geometry.visual, "material", None), "_name", None)
