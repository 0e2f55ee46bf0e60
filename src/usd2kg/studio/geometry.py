"""GeometryFiles: the meshes of a scene as GLB files for the page, decimated to a budget of triangles."""

import logging
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.triangle_soup import corner_normals
from usd2kg.scene.object_geometry import ColoredMesh, Placement, SceneGeometry
from usd2kg.studio.catalog import Catalog
from usd2kg.studio.settings import GEOMETRY

__all__ = ["GeometryFiles"]

logger = logging.getLogger(__name__)


class _Shaded(NamedTuple):
    """A mesh with one normal for each point."""

    points: NDArray[np.float32]
    normals: NDArray[np.float32]
    colors: NDArray[np.uint8]
    triangles: NDArray[np.int32]


class GeometryFiles:
    """The files of one scene, made one by one when they are asked for."""

    def __init__(self, geometry: SceneGeometry, catalog: Catalog) -> None:
        self._geometry = geometry
        self._catalog = catalog
        self._counts = [len(mesh.triangles) for mesh in geometry.meshes]
        self.source_triangles = sum(self._counts[placement.mesh] for placement in geometry.placements)
        """Triangles that would be drawn without decimation."""
        self._share = min(1.0, GEOMETRY.max_triangles / max(1, self.source_triangles))
        self._chunks = self._split()
        self._files: dict[int, bytes] = {}

    def manifest(self) -> dict[str, Any]:
        """Return the number of files and of triangles; see `web/src/api/types.ts`."""
        drawn = [sum(self._target(placement.mesh) for placement in chunk) for chunk in self._chunks]
        return {
            "chunks": [{"triangles": count} for count in drawn],
            "triangles": sum(drawn),
            "source_triangles": self.source_triangles,
        }

    def file(self, index: int) -> bytes:
        """Return one GLB file.

        Raises:
            IndexError: there is no such file.
        """
        if not 0 <= index < len(self._chunks):
            raise IndexError(index)
        if index not in self._files:
            self._files[index] = self._write(self._chunks[index])
        return self._files[index]

    def _target(self, mesh: int) -> int:
        """Return the number of triangles that a mesh is decimated to."""
        count = self._counts[mesh]
        return min(count, max(GEOMETRY.min_mesh_triangles, int(count * self._share)))

    def _split(self) -> list[list[Placement]]:
        """Return the placements in parts of about equal size; those of one mesh are in one part."""
        of_mesh: dict[int, list[Placement]] = {}
        for placement in self._geometry.placements:
            of_mesh.setdefault(placement.mesh, []).append(placement)
        chunks: list[list[Placement]] = []
        room = 0
        for mesh, placements in of_mesh.items():
            if room <= 0:
                chunks.append([])
                room = GEOMETRY.chunk_triangles
            chunks[-1] += placements
            room -= self._target(mesh)
        return chunks

    def _write(self, placements: Sequence[Placement]) -> bytes:
        from trimesh.exchange import gltf  # noqa: PLC0415
        from trimesh.scene import Scene  # noqa: PLC0415 - an extra

        scene: Any = Scene()
        known: set[int] = set()
        for number, placement in enumerate(placements):
            name, node = f"m{placement.mesh}", f"n{number}"
            extras = {"object": self._catalog.object(placement.prim_path)}
            # trimesh has matrices for column vectors.
            matrix = placement.matrix.T
            if placement.mesh not in known:
                known.add(placement.mesh)
                scene.add_geometry(
                    self._trimesh(placement.mesh), geom_name=name, node_name=node, transform=matrix, metadata=extras
                )
            else:
                scene.graph.update(frame_to=node, matrix=matrix, geometry=name, metadata=extras)
        export: Any = gltf.export_glb
        return bytes(export(scene, include_normals=True))

    def _trimesh(self, index: int) -> Any:
        import trimesh  # noqa: PLC0415 - an extra

        mesh = _shade(_decimate(self._geometry.meshes[index], self._target(index)))
        return trimesh.Trimesh(
            vertices=mesh.points,
            faces=mesh.triangles,
            vertex_normals=mesh.normals,
            vertex_colors=mesh.colors,
            process=False,
        )


def _decimate(mesh: ColoredMesh, target: int) -> ColoredMesh:
    """Return the mesh with about `target` triangles, by quadric error (Garland and Heckbert 1997), color by color."""
    if len(mesh.triangles) <= target:
        return mesh
    import fast_simplification  # noqa: PLC0415 - an extra

    ratio = 1 - target / len(mesh.triangles)
    parts = []
    colors, group = np.unique(mesh.colors[mesh.triangles[:, 0]], axis=0, return_inverse=True)
    for number, color in enumerate(colors):
        chosen = mesh.triangles[group.reshape(-1) == number]
        used, triangles = np.unique(chosen, return_inverse=True)
        points, faces = fast_simplification.simplify(
            mesh.points[used], triangles.reshape(-1, 3).astype(np.int32), target_reduction=ratio
        )
        parts.append(
            ColoredMesh(
                points.astype(np.float32), faces.astype(np.int32), np.tile(color, (len(points), 1)).astype(np.uint8)
            )
        )
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    return ColoredMesh(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.triangles + np.int32(start) for part, start in zip(parts, starts, strict=False)]),
        np.concatenate([part.colors for part in parts]),
    )


def _shade(mesh: ColoredMesh) -> _Shaded:
    """Return the mesh with normals that are smooth except at sharp edges; points there are split."""
    triangles = mesh.triangles.astype(np.int64)
    normals = corner_normals(mesh.points, triangles, np.arange(len(triangles))).reshape(-1, 3)
    corners = triangles.reshape(-1)
    # Normals that differ by less than a percent are one.
    key = np.column_stack([corners, np.round(normals * 100).astype(np.int64)])
    _, first, corner_of = np.unique(key, axis=0, return_index=True, return_inverse=True)
    used = corners[first]
    return _Shaded(
        points=mesh.points[used],
        normals=normals[first].astype(np.float32),
        colors=mesh.colors[used],
        triangles=corner_of.reshape(-1, 3).astype(np.int32),
    )
