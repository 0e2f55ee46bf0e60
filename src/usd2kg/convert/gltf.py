"""glTF 2.0 → prims: a transform for each node, its meshes below it.

glTF is in metres and y-up (Khronos glTF 2.0, 3.4). Cameras, lights, skins, animations, lines and points are left out.
"""

import json
import re
import struct
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from pxr import Kind, Usd

from usd2kg.convert.converted import Converted, parse_error
from usd2kg.convert.prims import PrimAuthor, custom_data, new_stage
from usd2kg.convert.trimesh_files import MeshAuthor, load_scene, trimesh_name
from usd2kg.errors import SceneError

if TYPE_CHECKING:
    import trimesh

__all__ = ["read_prims"]

_UNNAMED_NODE = re.compile("[0-9]+")
"""trimesh names nodes without a name by their index."""
_UNNAMED_MESH = re.compile("GLTF(_[0-9]+)?")
_PRIMITIVE_SUFFIX_LENGTH = 7
"""Length of the underscore and the random letters by which trimesh names the node of each primitive of a mesh."""
_NOT_EXTRAS = frozenset({"units", "from_gltf_primitive", "gltf_extensions", "processed"})
"""Keys that trimesh adds to the extras of a node or mesh."""


_EXPECTED = "a glTF 2.0 file (.glb, or .gltf with its buffers beside it)"
_DRACO = "KHR_draco_mesh_compression"
_NOT_DECODED = ("EXT_meshopt_compression", "KHR_meshopt_compression")
_GLB_HEADER = struct.Struct("<4s4xII4s")
"""Magic number, length of the file, length and type of the first chunk, which is JSON (glTF 2.0, 4.4)."""


def read_prims(path: Path) -> Converted:
    """Return the stage of a glTF file. A file with several root nodes has them below a prim named after the file.

    Raises:
        SceneError: trimesh cannot read the file, it has no triangles, or they are compressed and cannot be decoded.
    """
    _check_compression(path)
    scene = load_scene(path, _EXPECTED)
    stage = new_stage("Y", 1.0)
    author = PrimAuthor(stage)
    nodes = _Nodes(scene)
    roots = nodes.below(str(scene.graph.base_frame))
    parent = "/" if len(roots) == 1 else str(author.define("/", path.stem).GetPath())
    writer = _NodeWriter(author, nodes)
    writer.write(roots, parent)
    top = stage.GetPseudoRoot().GetChildren()[0]
    if len(roots) == 1 and writer.is_leaf(roots[0]):
        # Several meshes below a root prim would be several objects.
        Usd.ModelAPI(top).SetKind(Kind.Tokens.component)
    stage.SetDefaultPrim(top)
    top.SetAssetInfo({"name": path.stem})
    if scene.metadata:
        _add_extras(top, "gltfScene", scene.metadata)
    return Converted(stage, trimesh_name(), tuple(writer.notes))


def _check_compression(path: Path) -> None:
    """Reject a file whose triangles trimesh would replace by zeros.

    Raises:
        SceneError: it requires an extension for compression that is not decoded.
    """
    required = _required_extensions(path)
    found = next((name for name in _NOT_DECODED if name in required), None)
    if found is not None:
        raise parse_error(path, f"its meshes are compressed with {found}", f"{_EXPECTED} without compression")
    if _DRACO in required and find_spec("DracoPy") is None:
        raise SceneError(f"{path}: its meshes are compressed with Draco, which needs DracoPy; run: pip install DracoPy")


def _required_extensions(path: Path) -> frozenset[str]:
    """Return the required extensions of a file; none for a file that trimesh will reject."""
    try:
        with path.open("rb") as file:
            header = file.read(_GLB_HEADER.size)
            if header.startswith(b"glTF"):
                _, _, length, _ = _GLB_HEADER.unpack(header)
                document = json.loads(file.read(length))
            else:
                document = json.loads(header + file.read())
        return frozenset(document["extensionsRequired"])
    except (ValueError, KeyError, TypeError, RecursionError, struct.error):
        return frozenset()


class _Node(NamedTuple):
    name: str
    edge: Mapping[str, Any]
    """trimesh's record of the node: matrix, geometry, metadata."""


class _Nodes:
    """The nodes of a scene by name, which is unique."""

    def __init__(self, scene: "trimesh.Scene") -> None:
        self.scene = scene
        self._children: Mapping[str, list[str]] = scene.graph.transforms.children
        self._edges = scene.graph.transforms.edge_data

    def below(self, name: str) -> list[_Node]:
        """Return the child nodes in the order of the file."""
        # trimesh reads children from the last to the first.
        return [_Node(child, self._edges[name, child]) for child in reversed(self._children.get(name, []))]

    def geometries(self, node: _Node, children: list[_Node]) -> Iterator[tuple[str, Any]]:
        """Yield (name, geometry) of the meshes of a node: one for each primitive."""
        # Unlike nodes, trimesh reads primitives from the first to the last.
        primitives = [child for child in reversed(children) if self.is_primitive(child, node)]
        for entry in (node, *primitives):
            name = entry.edge.get("geometry")
            if name is not None:
                yield name, self.scene.geometry[name]

    def is_primitive(self, child: _Node, node: _Node) -> bool:
        """Return whether trimesh made a child node for a primitive of the mesh of `node`."""
        geometry = self.scene.geometry.get(child.edge.get("geometry"))
        is_suffixed = child.name.startswith(f"{node.name}_")
        is_suffixed &= len(child.name) == len(node.name) + _PRIMITIVE_SUFFIX_LENGTH
        return is_suffixed and geometry is not None and geometry.metadata.get("from_gltf_primitive") is True


class _NodeWriter:
    """Writes nodes as prims, without recursion: a file may be nested deeper than Python's stack."""

    def __init__(self, author: PrimAuthor, nodes: _Nodes) -> None:
        self.notes: list[str] = []
        self._author = author
        self._nodes = nodes
        self._meshes: MeshAuthor | None = None

    def write(self, roots: list[_Node], parent: str) -> None:
        """Write nodes, and all nodes below them, below the path `parent`."""
        pending = [(node, parent) for node in reversed(roots)]
        while pending:
            node, above = pending.pop()
            children = self._nodes.below(node.name)
            path = self._write_node(node, children, above)
            below = [child for child in children if not self._nodes.is_primitive(child, node)]
            pending.extend((child, path) for child in reversed(below))

    def is_leaf(self, node: _Node) -> bool:
        """Return whether a node has no child nodes."""
        return all(self._nodes.is_primitive(child, node) for child in self._nodes.below(node.name))

    def _write_node(self, node: _Node, children: list[_Node], parent: str) -> str:
        name = f"node_{node.name}" if _UNNAMED_NODE.fullmatch(node.name) else node.name
        prim = self._author.define(parent, name)
        path = str(prim.GetPath())
        self._author.move(prim, np.asarray(node.edge.get("matrix", np.eye(4))))
        _add_extras(prim, "gltf", node.edge.get("metadata") or {})
        for mesh_name, geometry in self._nodes.geometries(node, children):
            self._write_mesh(path, mesh_name, geometry)
        return path

    def _write_mesh(self, parent: str, name: str, geometry: Any) -> None:
        import trimesh  # noqa: PLC0415

        if not isinstance(geometry, trimesh.Trimesh):
            self.notes.append(f"{parent}: {name} consists of points or lines, which have no surface; it is left out")
            return
        if self._meshes is None:
            root = parent.split("/")[1]
            self._meshes = MeshAuthor(self._author, f"/{root}")
        prim = self._meshes.define(parent, "mesh" if _UNNAMED_MESH.fullmatch(name) else name, geometry)
        _add_extras(prim, "gltf", geometry.metadata)


def _add_extras(prim: Any, key: str, extras: Mapping[str, Any]) -> None:
    kept = custom_data({name: value for name, value in extras.items() if name not in _NOT_EXTRAS})
    if kept:
        prim.SetCustomDataByKey(key, kept)
