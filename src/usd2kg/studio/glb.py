"""write_glb: binary glTF 2.0 with shared meshes (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html).

trimesh's exporter writes a mesh either with vertex colours or with texture coordinates, and no extras of nodes that
share a mesh; the page needs all three.
"""

import json
import struct
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.scene.object_geometry import NO_TEXTURE
from usd2kg.studio.mesh_budget import ShadedMesh

__all__ = ["GlbNode", "write_glb"]

_MAGIC, _VERSION, _JSON, _BINARY = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
_COMPONENT_TYPES = {"uint8": 5121, "uint16": 5123, "uint32": 5125, "float32": 5126}
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963
_MAX_SHORT = 65535
"""Points of a mesh whose indices are 16 bits wide; the largest index is a restart."""


class GlbNode(NamedTuple):
    """A mesh in the scene."""

    mesh: int
    """Key of the meshes."""
    matrix: NDArray[np.float64]
    """(4, 4), for row vectors, which glTF stores in the same order."""
    extras: Mapping[str, Any]


def write_glb(
    meshes: Mapping[int, ShadedMesh], nodes: Sequence[GlbNode], textures: Sequence[Mapping[str, Any]] = ()
) -> bytes:
    """Return a file with the nodes, which share meshes.

    Args:
        meshes: key → mesh.
        nodes: the nodes, in order.
        textures: extras of the primitives with each texture.
    """
    writer = _Writer(textures)
    number = {key: index for index, key in enumerate(meshes)}
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "usd2kg"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}] if nodes else [{}],
    }
    if nodes:
        document["meshes"] = [{"primitives": writer.primitives(mesh)} for mesh in meshes.values()]
        document["nodes"] = [
            {
                "name": f"n{index}",
                "mesh": number[node.mesh],
                "matrix": node.matrix.reshape(-1).tolist(),
                "extras": dict(node.extras),
            }
            for index, node in enumerate(nodes)
        ]
        document |= writer.tables()
    return _pack(json.dumps(document, separators=(",", ":")).encode(), writer.binary())


class _Writer:
    """The binary part of a file: one view for each accessor."""

    def __init__(self, textures: Sequence[Mapping[str, Any]]) -> None:
        self._textures = textures
        self._parts: list[bytes] = []
        self._size = 0
        self._views: list[dict[str, int]] = []
        self._accessors: list[dict[str, Any]] = []

    def primitives(self, mesh: ShadedMesh) -> list[dict[str, Any]]:
        """Add a mesh; return a primitive for each of its textures. They share the points."""
        width = np.uint16 if len(mesh.points) <= _MAX_SHORT else np.uint32
        low, high = mesh.points.min(axis=0).tolist(), mesh.points.max(axis=0).tolist()
        attributes = {
            "POSITION": self._add(mesh.points, "VEC3", min=low, max=high),
            "NORMAL": self._add(mesh.normals, "VEC3"),
            "COLOR_0": self._add(mesh.colors, "VEC4", normalized=True),
        }
        textures = np.unique(mesh.texture).tolist()
        if textures != [NO_TEXTURE]:
            # USD has the origin below the first row of an image, glTF above it.
            attributes["TEXCOORD_0"] = self._add(np.column_stack([mesh.uv[:, 0], 1 - mesh.uv[:, 1]]), "VEC2")
        return [
            {
                "attributes": attributes,
                "indices": self._add(
                    mesh.triangles[mesh.texture == texture].astype(width).reshape(-1), "SCALAR", _ELEMENT_ARRAY_BUFFER
                ),
                **({} if texture == NO_TEXTURE else {"extras": dict(self._textures[texture])}),
            }
            for texture in textures
        ]

    def _add(self, values: NDArray[Any], kind: str, target: int = _ARRAY_BUFFER, **more: Any) -> int:
        data = np.ascontiguousarray(values).tobytes()
        self._views.append({"buffer": 0, "byteOffset": self._size, "byteLength": len(data), "target": target})
        # Offsets are multiples of the component size, 4 at most.
        padded = data + bytes(-len(data) % 4)
        self._parts.append(padded)
        self._size += len(padded)
        self._accessors.append(
            {
                "bufferView": len(self._views) - 1,
                "componentType": _COMPONENT_TYPES[values.dtype.name],
                "count": len(values),
                "type": kind,
                **more,
            }
        )
        return len(self._accessors) - 1

    def tables(self) -> dict[str, Any]:
        """Return the parts of the document about the binary part."""
        return {
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": self._size}],
        }

    def binary(self) -> bytes:
        """Return the binary part."""
        return b"".join(self._parts)


def _pack(document: bytes, binary: bytes) -> bytes:
    """Return a file of two chunks; the second is left out if it is empty."""
    document += b" " * (-len(document) % 4)
    chunks = struct.pack("<II", len(document), _JSON) + document
    if binary:
        chunks += struct.pack("<II", len(binary), _BINARY) + binary
    return struct.pack("<III", _MAGIC, _VERSION, 12 + len(chunks)) + chunks
