"""Meshes of visuals, each file read once."""

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from usd2kg.convert.converted import parse_error
from usd2kg.convert.sdf.collada import ColladaFacts, read_collada
from usd2kg.convert.sdf.resources import ResourceError, Resources
from usd2kg.convert.sdf.values import Matrix
from usd2kg.convert.sdf.xml_tree import XmlError
from usd2kg.convert.trimesh_files import load_scene
from usd2kg.errors import SceneError

if TYPE_CHECKING:
    import trimesh

__all__ = ["MeshFiles", "MeshPart"]

_EXPECTED = "a mesh: COLLADA (.dae), OBJ, STL, PLY or glTF"
_COLLADA = ".dae"
_ENDINGS = frozenset({_COLLADA, ".obj", ".stl", ".ply", ".glb", ".gltf"})


class MeshPart(NamedTuple):
    """Triangles of a file."""

    name: str
    geometry: "trimesh.Trimesh"
    matrix: Matrix
    """Transform to the frame of the file in metres. As in Gazebo, the up axis of the file is ignored."""
    nodes: frozenset[str]
    """Accepted names of a submesh."""


class MeshFiles:
    """The mesh files of a world."""

    def __init__(self, resources: Resources) -> None:
        self._resources = resources
        self._parts: dict[Path, tuple[MeshPart, ...] | SceneError] = {}

    def parts(self, path: Path) -> tuple[MeshPart, ...]:
        """Return the meshes in a file.

        Raises:
            SceneError: trimesh cannot read it, or it has no triangles; the same for each call.
            ModuleNotFoundError: trimesh, or for COLLADA pycollada, is not installed.
        """
        found = self._parts.get(path)
        if found is None:
            try:
                found = tuple(self._read(path))
            except SceneError as error:
                found = error
            self._parts[path] = found
        if isinstance(found, SceneError):
            # Re-raising the same exception would keep the stack frames of each attempt alive.
            raise found.with_traceback(None)
        return found

    def _read(self, path: Path) -> list[MeshPart]:
        trimesh = import_module("trimesh")
        ending = path.suffix.lower()
        if ending not in _ENDINGS:
            raise parse_error(path, f"its ending is {ending!r}", _EXPECTED)
        facts = ColladaFacts()
        if ending == _COLLADA:
            import_module("collada")
            try:
                facts = read_collada(path)
            except XmlError as error:
                raise parse_error(path, error, _EXPECTED) from error
        scene = load_scene(path, _EXPECTED, resolver=_Textures(path.parent, self._resources))
        unit = np.diag([facts.metres_per_unit] * 3 + [1.0])
        parts = []
        for node in scene.graph.nodes_geometry:
            matrix, name = scene.graph[node]
            geometry = scene.geometry[name]
            if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
                parts.append(MeshPart(str(name), geometry, unit @ matrix, _names(str(node), str(name), facts)))
        return parts


def _names(node: str, geometry: str, facts: ColladaFacts) -> frozenset[str]:
    # trimesh appends a number to the id of a geometry for each further primitive or instance.
    ids = {geometry, geometry.rpartition("_")[0]}
    named = {name for name, found in facts.geometries.items() if found & ids}
    return frozenset({node, geometry, *named})


class _Textures:
    """trimesh's access to textures and material libraries, within the folders of the world."""

    def __init__(self, folder: Path, resources: Resources) -> None:
        self._folder = folder
        self._resources = resources

    def get(self, name: str) -> bytes:
        """Return the content of a file.

        Raises:
            FileNotFoundError: there is none in these folders.
        """
        name = name.strip().removeprefix("file://")
        base = name.replace("\\", "/").rpartition("/")[2]
        for place in (name, base, f"../materials/textures/{base}"):
            try:
                found = self._resources.find(place, self._folder)
            except ResourceError:
                continue
            if found.is_file():
                return found.read_bytes()
        raise FileNotFoundError(name)

    __getitem__ = get

    def namespaced(self, namespace: str) -> "_Textures":
        return _Textures(self._folder / namespace, self._resources)

    def keys(self) -> list[str]:
        return []
