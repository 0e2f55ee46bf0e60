"""GeometryFiles: the meshes of a scene as GLB files for the page, the largest objects first, within a budget."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from usd2kg.scene import Scene
from usd2kg.scene.object_geometry import GeometryReader, MeshPlacement
from usd2kg.studio.glb import GlbNode, write_glb
from usd2kg.studio.mesh_budget import ShadedMesh, decimate, shade
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.settings import GEOMETRY
from usd2kg.studio.texture_images import TextureImage, TextureImages

__all__ = ["NO_MESHES", "GeometryFiles"]

NO_MESHES: dict[str, Any] = {"chunks": [], "triangles": 0, "source_triangles": 0}
"""Manifest of a scene without meshes."""


@dataclass
class _Chunk:
    """The outermost objects of one file."""

    prim_paths: list[str] = field(default_factory=list)
    has_outside: bool = False
    """Whether it has the geometry outside any object instead."""
    triangles: int = 0


class GeometryFiles:
    """The files of one scene. The stage is read file by file, when they are asked for."""

    def __init__(self, reader: GeometryReader, scene: Scene, indices: PageIndices) -> None:
        self._reader = reader
        self._indices = indices
        self._chunks = _split(reader, scene)
        self._source_triangles = sum(chunk.triangles for chunk in self._chunks)
        self._share = min(1.0, GEOMETRY.max_triangles / max(1, self._source_triangles))
        self._shaded: dict[int, ShadedMesh] = {}
        self._files: dict[int, bytes] = {}
        self._images = TextureImages()

    def manifest(self) -> dict[str, Any]:
        """Return the number of files and an estimate of triangles; see `web/src/api/types.ts`."""
        drawn = [int(chunk.triangles * self._share) for chunk in self._chunks]
        return {
            "chunks": [{"triangles": count} for count in drawn],
            "triangles": sum(drawn),
            "source_triangles": self._source_triangles,
        }

    def file(self, index: int) -> bytes:
        """Return one GLB file.

        Raises:
            IndexError: there is no such file.
        """
        if not 0 <= index < len(self._chunks):
            raise IndexError(index)
        if index not in self._files:
            chunk = self._chunks[index]
            outside = self._reader.read_outside() if chunk.has_outside else []
            self._files[index] = self._write([*self._reader.read(chunk.prim_paths), *outside])
        return self._files[index]

    def texture(self, index: int) -> TextureImage | None:
        """Return the image of a texture that a file names; None if it is not shown.

        Raises:
            IndexError: no file that was made has such a texture.
        """
        if not 0 <= index < len(self._reader.textures):
            raise IndexError(index)
        return self._images.image(self._reader.textures[index])

    def _write(self, placements: Sequence[MeshPlacement]) -> bytes:
        meshes = {placement.mesh: self._mesh(placement.mesh) for placement in placements}
        nodes = [
            GlbNode(placement.mesh, placement.matrix, {"object": self._indices.object(placement.prim_path)})
            for placement in placements
            if len(meshes[placement.mesh].triangles)
        ]
        textures = [
            {"texture": number, "wrap": texture.wrap, "scale": texture.scale}
            for number, texture in enumerate(self._reader.textures)
        ]
        return write_glb({node.mesh: meshes[node.mesh] for node in nodes}, nodes, textures)

    def _mesh(self, index: int) -> ShadedMesh:
        if index not in self._shaded:
            mesh = self._reader.meshes[index]
            target = max(GEOMETRY.min_mesh_triangles, int(len(mesh.triangles) * self._share))
            self._shaded[index] = shade(decimate(mesh, target))
        return self._shaded[index]


def _split(reader: GeometryReader, scene: Scene) -> list[_Chunk]:
    """Return the objects in files of limited size, the largest first; what is outside of objects comes last.

    Copies of one asset are next to each other, so that they share a mesh.
    """
    size_of = {path: _size(scene, path) for path in reader.outermost}
    asset_of = {path: "".join(scene.by_path[path].asset[:1]) or path for path in reader.outermost}
    largest: dict[str, float] = {}
    for path, asset in asset_of.items():
        largest[asset] = max(size_of[path], largest.get(asset, 0.0))
    chunks: list[_Chunk] = []
    for path in sorted(reader.outermost, key=lambda path: (-largest[asset_of[path]], asset_of[path])):
        if not chunks or _is_full(chunks):
            chunks.append(_Chunk())
        chunks[-1].prim_paths.append(path)
        chunks[-1].triangles += reader.count(path)
    if outside := reader.count_outside():
        chunks.append(_Chunk(has_outside=True, triangles=outside))
    return chunks


def _is_full(chunks: Sequence[_Chunk]) -> bool:
    """Return whether the last file is full. The first ones are small, so that the picture fills in at once."""
    most = min(GEOMETRY.chunk_objects, GEOMETRY.first_chunk_objects * 2 ** (len(chunks) - 1))
    return chunks[-1].triangles >= GEOMETRY.chunk_triangles or len(chunks[-1].prim_paths) >= most


def _size(scene: Scene, prim_path: str) -> float:
    """Return the diagonal of an object's box in centimetres, so that equal objects are equal; 0 without a box."""
    box = scene.by_path[prim_path].box
    return float(round(100 * math.dist(box.lower, box.upper))) if box is not None else 0.0
