"""Exact distances between triangles."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["least_triangle_distance"]

Array = NDArray[np.float64]

_EDGES = np.array([[0, 1], [1, 2], [2, 0]])
_FIRST, _SECOND = (_EDGES[pair] for pair in (np.repeat(np.arange(3), 3), np.tile(np.arange(3), 3)))
"""The nine pairs of edges of two triangles."""
_SMALLEST = 1e-18


def least_triangle_distance(one: Array, other: Array, reach: float) -> float:
    """Return the least distance between the triangles in the same rows (n, 3, 3), in their unit, inf beyond `reach`.

    It is that of two edges, or of a corner of one and the face of the other (Ericson, Real-Time Collision Detection,
    5.1.9 and 5.1.5), and 0 where an edge pierces a face.
    """
    is_near = np.maximum(_off_plane(one, other), _off_plane(other, one)) < reach
    if not is_near.any():
        return np.inf
    one, other = one[is_near], other[is_near]
    nearest = min(_to_faces(one, other), _to_faces(other, one))
    if nearest > 0:
        p, q = one[:, _FIRST].reshape(-1, 2, 3), other[:, _SECOND].reshape(-1, 2, 3)
        nearest = min(nearest, _between_edges(p[:, 0], p[:, 1], q[:, 0], q[:, 1]))
    return nearest if nearest <= reach else np.inf


def _off_plane(triangles: Array, others: Array) -> Array:
    """Return how far the triangles are from the planes of others; 0 if they are on both sides, or for a line."""
    normal = _cross(others[:, 1] - others[:, 0], others[:, 2] - others[:, 0])
    heights = np.einsum("ijk,ik->ij", triangles - others[:, :1], normal)
    length = np.sqrt(np.maximum(_dot(normal, normal), _SMALLEST))
    return np.asarray(np.maximum(np.maximum(heights.min(axis=1), -heights.max(axis=1)), 0) / length)


def _between_edges(p: Array, p_end: Array, q: Array, q_end: Array) -> float:
    """Return the least distance between the segments in the same rows."""
    d, e, r = p_end - p, q_end - q, p - q
    dd, ee, de = _dot(d, d), _dot(e, e), _dot(d, e)
    dr, er = _dot(d, r), _dot(e, r)
    determinant = dd * ee - de * de
    is_skew = determinant > _SMALLEST
    s = np.clip(np.where(is_skew, (de * er - dr * ee) / np.where(is_skew, determinant, 1.0), 0.0), 0.0, 1.0)
    t = np.clip((de * s + er) / np.maximum(ee, _SMALLEST), 0.0, 1.0)
    s = np.clip((de * t - dr) / np.maximum(dd, _SMALLEST), 0.0, 1.0)
    away = r + s[:, None] * d - t[:, None] * e
    return float(np.sqrt(_dot(away, away).min()))


def _to_faces(triangles: Array, faces: Array) -> float:
    """Return the least distance of corners of triangles to the faces above or below them; 0 if an edge pierces one."""
    u, v = faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]
    normal = _cross(u, v)
    square = _dot(normal, normal)
    is_face = square > _SMALLEST
    square = np.maximum(square, _SMALLEST)
    away = triangles - faces[:, :1]
    height = np.einsum("ijk,ik->ij", away, normal)
    after = np.roll(height, -1, axis=1)
    crosses = (height * after < 0) & is_face[:, None]
    share = height / np.where(crosses, height - after, 1.0)
    at = away + share[..., None] * (np.roll(away, -1, axis=1) - away)
    if (crosses & _are_within(at, u, v)).any():
        return 0.0
    is_over = _are_within(away, u, v) & is_face[:, None]
    return float(np.where(is_over, np.abs(height) / np.sqrt(square)[:, None], np.inf).min())


def _are_within(away: Array, u: Array, v: Array) -> NDArray[np.bool_]:
    """Return for each point (n, 3, 3) from a corner whether its projection is in the triangle with sides u and v."""
    uu, vv, uv = _dot(u, u), _dot(v, v), _dot(u, v)
    square = np.maximum(uu * vv - uv * uv, _SMALLEST)[:, None]
    along, across = (np.einsum("ijk,ik->ij", away, side) for side in (u, v))
    first = (vv[:, None] * along - uv[:, None] * across) / square
    second = (uu[:, None] * across - uv[:, None] * along) / square
    return np.asarray((first >= 0) & (second >= 0) & (first + second <= 1))


def _cross(one: Array, other: Array) -> Array:
    # Half the time of numpy's.
    x, y, z = one.T
    a, b, c = other.T
    return np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=1)


def _dot(one: Array, other: Array) -> Array:
    return np.asarray(np.einsum("ij,ij->i", one, other))
