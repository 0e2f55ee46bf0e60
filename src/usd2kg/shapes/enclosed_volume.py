"""Volume enclosed by triangle meshes: welding, connected parts, gaps and cavities."""

import math

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.settings import MESH
from usd2kg.shapes.triangle_mesh import TriangleMesh, area_vectors
from usd2kg.shapes.welding import weld_points

__all__ = ["enclosed_volume"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def enclosed_volume(mesh: TriangleMesh) -> float | None:
    """Return the enclosed volume in cubic metres, None if a part is not closed; see `ShapeDescriptors.volume_m3`."""
    points, triangles = _weld(mesh)
    if not len(triangles):
        return None
    part = _connected_parts(triangles, len(points))
    corners = points[triangles]
    # Relative to each part's centre: limits cancellation, and minimises the error that a gap causes.
    size = np.bincount(part)
    center = np.stack([_sums(part, corners[..., i].mean(axis=1)) / size for i in range(3)], axis=1)
    a, b, c = np.moveaxis(corners - center[part][:, None], 1, 0)
    volume = _sums(part, np.einsum("ij,ij->i", a, np.cross(b, c)) / 6)
    surface = _sums(part, np.linalg.norm(area_vectors(points, triangles), axis=1))
    gap = _open_edge_length(points, triangles, part) ** 2 / (4 * math.pi)
    min_thickness = max(MESH.min_thickness * mesh.diagonal, MESH.noise_factor * mesh.noise)
    if (gap > MESH.max_gap_share * surface).any() or (np.abs(volume) <= min_thickness * surface).any():
        return None
    return float((np.abs(volume) * np.where(_are_cavities(corners, part, volume), -1, 1)).sum())


def _weld(mesh: TriangleMesh) -> tuple[Array, Indices]:
    """Return points and triangles with coincident points merged, without triangles that collapse to a line."""
    welded = weld_points(mesh.points, max(MESH.weld_distance * mesh.diagonal, mesh.noise))
    triangles = welded.group[mesh.triangles]
    a, b, c = triangles.T
    return mesh.points[welded.first], triangles[(a != b) & (b != c) & (c != a)]


def _connected_parts(triangles: Indices, count: int) -> Indices:
    """Return the index of the connected part of each triangle."""
    from scipy.sparse import coo_array  # noqa: PLC0415 - optional
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]])
    graph = coo_array((np.ones(len(edges), np.bool_), edges.T), shape=(count, count))
    _, label = connected_components(graph, directed=False)
    return np.unique(label[triangles[:, 0]], return_inverse=True)[1].reshape(-1)


def _open_edge_length(points: Array, triangles: Indices, part: Indices) -> Array:
    """Return for each part the length of the edges that are not traversed equally often in both directions."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    direction = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    keys = edges.min(axis=1) * len(points) + edges.max(axis=1)
    _, first, edge = np.unique(keys, return_index=True, return_inverse=True)
    unpaired = np.abs(_sums(edge.reshape(-1), direction))
    length = np.linalg.norm(points[edges[first, 0]] - points[edges[first, 1]], axis=1)
    return _sums(np.tile(part, 3)[first], unpaired * length)


def _sums(part: Indices, values: Array) -> Array:
    return np.asarray(np.bincount(part, values), np.float64)


def _are_cavities(corners: Array, part: Indices, volume: Array) -> NDArray[np.bool_]:
    """Return for each part whether its winding is opposite to that of the smallest part around it."""
    is_cavity = np.zeros(len(volume), np.bool_)
    if (volume > 0).all() or (volume < 0).all():
        return is_cavity
    low, high = np.full((len(volume), 3), np.inf), np.full((len(volume), 3), -np.inf)
    np.minimum.at(low, part, corners.min(axis=1))
    np.maximum.at(high, part, corners.max(axis=1))
    size = np.abs(volume)
    for i in range(len(volume)):
        around = np.flatnonzero((low <= low[i]).all(axis=1) & (high >= high[i]).all(axis=1) & (size > size[i]))
        if len(around):
            is_cavity[i] = (volume[around[size[around].argmin()]] > 0) != (volume[i] > 0)
    return is_cavity
