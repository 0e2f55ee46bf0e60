"""Meshes for the page: decimated to a budget of triangles, and shaded smooth except at sharp edges."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.triangle_soup import corner_normals
from usd2kg.scene.object_geometry import NO_TEXTURE, ColoredMesh, join_meshes

__all__ = ["ShadedMesh", "decimate", "shade"]


class ShadedMesh(NamedTuple):
    """A mesh with one normal for each point."""

    points: NDArray[np.float32]
    normals: NDArray[np.float32]
    colors: NDArray[np.uint8]
    uv: NDArray[np.float32]
    triangles: NDArray[np.int32]
    texture: NDArray[np.int32]
    """(m,), see `ColoredMesh`."""


def decimate(mesh: ColoredMesh, target: int) -> ColoredMesh:
    """Return the mesh with about `target` triangles, by quadric error (Garland and Heckbert 1997), color by color.

    A mesh that is decimated loses its textures, since its points get new places.
    """
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
                points.astype(np.float32),
                faces.astype(np.int32),
                np.tile(color, (len(points), 1)).astype(np.uint8),
                np.zeros((len(points), 2), np.float32),
                np.full(len(faces), NO_TEXTURE, np.int32),
            )
        )
    return join_meshes(parts)


def shade(mesh: ColoredMesh) -> ShadedMesh:
    """Return the mesh with normals that are smooth except at sharp edges; points there are split."""
    triangles = mesh.triangles.astype(np.int64)
    normals = corner_normals(mesh.points, triangles, np.arange(len(triangles))).reshape(-1, 3)
    corners = triangles.reshape(-1)
    # Normals that differ by less than a percent are one.
    key = np.column_stack([corners, np.round(normals * 100).astype(np.int64)])
    _, first, corner_of = np.unique(key, axis=0, return_index=True, return_inverse=True)
    used = corners[first]
    return ShadedMesh(
        points=mesh.points[used],
        normals=normals[first].astype(np.float32),
        colors=mesh.colors[used],
        uv=mesh.uv[used],
        triangles=corner_of.reshape(-1, 3).astype(np.int32),
        texture=mesh.texture,
    )
