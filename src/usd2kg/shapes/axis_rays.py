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
"""Tolerance in barycentric coordinates, so that a line through a shared edge does not miss both triangles."""
_MIN_PROJECTION = 1e-9
"""Share of the squared extent below which a projected triangle has no area: the line runs along it."""
_CHUNK = 1 << 15
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
        while end < len(surfaces) and (end == start or triangles + surfaces[end].triangle_count <= _CHUNK):
            triangles += surfaces[end].triangle_count
            end += 1
        for crossings in _cross_some(points[start:end], surfaces[start:end], axis):
            found.append(crossings._replace(line=crossings.line + line))
        line += sum(len(some) for some in points[start:end])
        start = end
    return Crossings(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _cross_some(points: Sequence[Array], surfaces: Sequence[Surface], axis: int) -> Iterator[Crossings]:
    first, second = (other for other in range(3) if other != axis)
    count = np.array([len(some) for some in points], np.int64)
    starts = np.cumsum(count) - count
    lines = np.concatenate(points)
    lines_first, lines_second = np.ascontiguousarray(lines[:, first]), np.ascontiguousarray(lines[:, second])
    owner = np.repeat(np.arange(len(surfaces)), [surface.triangle_count for surface in surfaces])
    lower = np.concatenate([surface.lower for surface in surfaces])
    upper = np.concatenate([surface.upper for surface in surfaces])
    near = np.flatnonzero(
        (lower[:, second] <= np.maximum.reduceat(lines_second, starts)[owner])
        & (upper[:, second] >= np.minimum.reduceat(lines_second, starts)[owner])
    )
    lower, upper, owner = lower[near], upper[near], owner[near]
    order, begin, end = _spans(
        lines_first, np.repeat(np.arange(len(surfaces)), count), lower[:, first], upper[:, first], owner
    )
    # Few triangles are over a line, and what a crossing needs of one takes longest.
    met = np.flatnonzero(end > begin)
    corners = np.concatenate([surface.corners for surface in surfaces])[near[met]]
    is_wide, triangles = _Triangles.of(corners, (axis, first, second))
    met = met[is_wide]
    begin, end = begin[met], end[met]
    low, high = lower[met, second], upper[met, second]
    tests = np.cumsum(end - begin)
    for part in np.split(np.arange(len(met)), np.flatnonzero(np.diff(tests // _CHUNK)) + 1):
        row, nth = ragged_indices((end - begin)[part])
        triangle = part[row]
        line = order[begin[triangle] + nth]
        at = lines_second[line]
        is_over = (low[triangle] <= at) & (high[triangle] >= at)
        yield triangles.crossed_by(line[is_over], triangle[is_over], lines_first, lines_second)


def _spans(
    at: Array, line_owner: Indices, lower: Array, upper: Array, owner: Indices
) -> tuple[Indices, Indices, Indices]:
    """Return the lines sorted by owner and coordinate, and begin and end in that order of those over each triangle.

    Args:
        at: (n,), coordinate of each line.
        line_owner: (n,), the surface that each line may cross, ascending.
        lower: (m,), smallest coordinate of each triangle.
        upper: (m,)
        owner: (m,), the surface of each triangle.
    """
    order = np.lexsort((at, line_owner))
    lines = _keys(line_owner[order], at[order])
    return order, lines.searchsorted(_keys(owner, lower)), lines.searchsorted(_keys(owner, upper), side="right")


def _keys(owner: Indices, at: Array) -> NDArray[np.complex128]:
    """Return keys that sort by owner, then by coordinate, as numpy sorts complex numbers by their real part first."""
    keys = np.empty(len(owner), np.complex128)
    keys.real, keys.imag = owner, at
    return keys


class _Triangles(NamedTuple):
    """Triangle data for crossings, in one array per number: gathering rows of a matrix is slower."""

    origin: tuple[Array, Array, Array]
    """A corner: along the axis and the two others."""
    u: tuple[Array, Array, Array]
    """The side from it to the second corner."""
    v: tuple[Array, Array, Array]
    area: Array
    """Twice the signed area of the projection along the axis."""
    faces: Array
    """As in `Crossings`."""

    @classmethod
    def of(cls, corners: Array, axes: tuple[int, int, int]) -> tuple[Indices, "_Triangles"]:
        """Return the rows of the triangles that are not seen from the side, and these triangles."""
        u_rows, v_rows = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        _, first, second = axes
        area = u_rows[:, first] * v_rows[:, second] - u_rows[:, second] * v_rows[:, first]
        least = _MIN_PROJECTION * ((u_rows * u_rows).sum(axis=1) + (v_rows * v_rows).sum(axis=1))
        is_wide = np.flatnonzero(np.abs(area) > least)
        u_rows, v_rows = u_rows[is_wide], v_rows[is_wide]
        origin, u, v = (_columns(rows, axes) for rows in (corners[is_wide, 0], u_rows, v_rows))
        normals = np.cross(u_rows, v_rows)
        faces = normals[:, axes[0]] / np.sqrt((normals * normals).sum(axis=1))
        return is_wide, cls(origin, u, v, area[is_wide], faces)

    def crossed_by(self, line: Indices, triangle: Indices, first: Array, second: Array) -> Crossings:
        """Return the crossings of pairs of lines, at `first` and `second`, and triangles; in order of both."""
        area = self.area[triangle]
        u_first, u_second = self.u[1][triangle], self.u[2][triangle]
        v_first, v_second = self.v[1][triangle], self.v[2][triangle]
        to_first = first[line] - self.origin[1][triangle]
        to_second = second[line] - self.origin[2][triangle]
        s = (to_first * v_second - to_second * v_first) / area
        t = (u_first * to_second - u_second * to_first) / area
        found = np.flatnonzero((s >= -_EDGE_TOLERANCE) & (t >= -_EDGE_TOLERANCE) & (s + t <= 1 + _EDGE_TOLERANCE))
        found = found[np.lexsort((line[found], triangle[found]))]
        line, triangle, s, t = line[found], triangle[found], s[found], t[found]
        at = self.origin[0][triangle] + s * self.u[0][triangle] + t * self.v[0][triangle]
        return Crossings(line, at, self.faces[triangle])


def _columns(rows: Array, axes: tuple[int, int, int]) -> tuple[Array, Array, Array]:
    first, second, third = (np.ascontiguousarray(rows[:, axis]) for axis in axes)
    return first, second, third
