"""Where lines along a coordinate axis cross triangles; all crossings, with their side."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.ragged import ragged_indices
from usd2kg.shapes.surface import Surface

__all__ = ["Crossings", "find_crossings"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_EDGE_TOLERANCE = 1e-4
"""In barycentric coordinates: keeps a line through a shared edge from falling between two triangles."""
_MIN_PROJECTION = 1e-9
"""Share of the squared extent below which a projected triangle has no area: the line runs along it."""
_CHUNK = 1 << 18
"""Triangles, and pairs of lines and triangles, tested at a time, which bounds memory."""


class Crossings(NamedTuple):
    """The crossings of lines and triangles, one row each, in no particular order."""

    line: Indices
    """Index of the line."""
    at: Array
    """Coordinate along the axis, metres."""
    faces: Array
    """Cosine of the angle between the normal of the triangle and the axis: 1 if it faces along the axis."""


def find_crossings(points: Sequence[Array], surfaces: Sequence[Surface], axis: int) -> Crossings:
    """Return where the lines through points along an axis (0, 1 or 2) cross a surface, for many surfaces at once.

    A line through an edge crosses each of its triangles.

    Args:
        points: for each surface, the points (n, 3) of its lines, at least one; lines are numbered in this order.
        surfaces: the surfaces.
        axis: 0, 1 or 2.
    """
    found = [Crossings(np.zeros(0, np.int64), np.zeros(0), np.zeros(0))]
    start = line = 0
    while start < len(surfaces):
        end, triangles = start, 0
        while end < len(surfaces) and (end == start or triangles + len(surfaces[end].corners) <= _CHUNK):
            triangles += len(surfaces[end].corners)
            end += 1
        for crossings in _cross_some(points[start:end], surfaces[start:end], axis):
            found.append(crossings._replace(line=crossings.line + line))
        line += sum(len(some) for some in points[start:end])
        start = end
    return Crossings(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _cross_some(points: Sequence[Array], surfaces: Sequence[Surface], axis: int) -> Iterator[Crossings]:
    first, second = (other for other in range(3) if other != axis)
    sides = [first, second]
    count = np.array([len(some) for some in points], np.int64)
    starts = np.cumsum(count) - count
    lines = np.concatenate(points)
    low, high = np.minimum.reduceat(lines[:, sides], starts), np.maximum.reduceat(lines[:, sides], starts)
    size = np.array([len(surface.corners) for surface in surfaces], np.int64)
    lower = np.concatenate([surface.lower for surface in surfaces])[:, sides]
    upper = np.concatenate([surface.upper for surface in surfaces])[:, sides]
    owner = np.repeat(np.arange(len(surfaces)), size)
    near = np.flatnonzero(((lower <= high[owner]) & (upper >= low[owner])).all(axis=1))
    corners = np.concatenate([surface.corners for surface in surfaces])[near]
    lower, upper, owner = lower[near], upper[near], owner[near]
    tests = np.cumsum(count[owner])
    for part in np.split(np.arange(len(near)), np.flatnonzero(np.diff(tests // _CHUNK)) + 1):
        row, nth = ragged_indices(count[owner[part]])
        triangle = part[row]
        line = starts[owner[triangle]] + nth
        is_over = np.ones(len(line), np.bool_)
        for place, side in enumerate(sides):
            at = lines[line, side]
            is_over &= (lower[triangle, place] <= at) & (upper[triangle, place] >= at)
        yield _cross(lines, line[is_over], corners[triangle[is_over]], (axis, first, second))


def _cross(lines: Array, line: Indices, corners: Array, axes: tuple[int, int, int]) -> Crossings:
    axis, first, second = axes
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    to_first, to_second = lines[line, first] - a[:, first], lines[line, second] - a[:, second]
    area = u[:, first] * v[:, second] - u[:, second] * v[:, first]
    is_wide = np.abs(area) > _MIN_PROJECTION * ((u * u).sum(axis=1) + (v * v).sum(axis=1))
    safe = np.where(is_wide, area, 1.0)
    s = (to_first * v[:, second] - to_second * v[:, first]) / safe
    t = (u[:, first] * to_second - u[:, second] * to_first) / safe
    is_in = is_wide & (s >= -_EDGE_TOLERANCE) & (t >= -_EDGE_TOLERANCE) & (s + t <= 1 + _EDGE_TOLERANCE)
    at = a[:, axis] + s * u[:, axis] + t * v[:, axis]
    u, v = u[is_in], v[is_in]
    normals = np.cross(u, v)
    return Crossings(line[is_in], at[is_in], normals[:, axis] / np.sqrt((normals * normals).sum(axis=1)))
