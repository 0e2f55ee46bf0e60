"""Convex hulls of points in space and in the plane, and the smallest box around a hull: numpy alone."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "ConvexHull",
    "SmallestBox",
    "convex_hull",
    "convex_polygon",
    "largest_normals",
    "smallest_box",
    "smallest_rectangle",
]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_FLAT = 1e-6
"""Points nearer than this to a hull, in diagonals of their box, lie on it."""
_MOST_VERTICES = 600
"""A hull with more is cut short: of a finely cut sphere the volume comes out 1 % too small."""
_MOST_NORMALS = 16
"""A box is laid against this many of the largest faces of a hull."""
_TINY = 1e-300


@dataclass(frozen=True, slots=True)
class ConvexHull:
    """The smallest convex body around some points."""

    vertices: Array
    """(k, 3), some of the points."""
    triangles: Indices
    """(m, 3), indices into `vertices`, counter-clockwise seen from outside, without gaps."""

    @property
    def volume(self) -> float:
        """Enclosed volume, in cubed units of the points."""
        a, b, c = np.moveaxis((self.vertices - self.vertices.mean(axis=0))[self.triangles], 1, 0)
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6

    @property
    def surface(self) -> float:
        """Area of the surface, in squared units of the points."""
        return float(np.linalg.norm(self.areas, axis=1).sum())

    @property
    def areas(self) -> Array:
        """Outward normals of the triangles, as long as the triangles are large (m, 3)."""
        a, b, c = np.moveaxis(self.vertices[self.triangles], 1, 0)
        return np.asarray(np.cross(b - a, c - a) / 2)


class SmallestBox(NamedTuple):
    """A box around points, in any orientation."""

    size: tuple[float, float, float]
    """Longest edge first."""
    axes: Array
    """(3, 3), rows are unit vectors along those edges."""


def convex_hull(points: Array, tolerance: float | None = None) -> ConvexHull | None:
    """Return the convex hull of finite points (n, 3); None where they lie in a plane, on a line or in one place.

    Quickhull (Barber, Dobkin & Huhdanpaa 1996): the point farthest outside comes next, so that where the hull is cut
    short after 600 vertices, what is missing is least. Of points that are rounded, like those of meshes, the volume
    comes out within 0.5 %; the surface, too, but for rare slivers that fold over each other (7 % seen).

    Args:
        points: finite numbers; may hold duplicates and points inside.
        tolerance: points less far outside are on the hull; default: a millionth of the diagonal of the points' box.
    """
    if len(points) < 4:
        return None
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    centred = points - middle
    near = _FLAT * _diagonal(points) if tolerance is None else tolerance
    simplex = _simplex(centred, near)
    if simplex is None:
        return None
    growing = _GrowingHull(centred, simplex, near)
    for _ in range(_MOST_VERTICES - 4):
        if not growing.add_farthest():
            break
    used, triangles = np.unique(growing.faces, return_inverse=True)
    return ConvexHull(points[used], triangles.reshape(-1, 3))


def _diagonal(points: Array) -> float:
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def _simplex(points: Array, near: float) -> Array | None:
    """Return four faces between points that are far apart (4, 3); None if all points are near one plane."""
    axis = int(np.argmax(np.ptp(points, axis=0)))
    a, b = int(points[:, axis].argmin()), int(points[:, axis].argmax())
    along = points[b] - points[a]
    from_line = np.linalg.norm(np.cross(points - points[a], along), axis=1) / max(float(np.linalg.norm(along)), _TINY)
    c = int(from_line.argmax())
    if from_line[c] <= near:
        return None
    normal = np.cross(along, points[c] - points[a])
    above = (points - points[a]) @ (normal / max(float(np.linalg.norm(normal)), _TINY))
    d = int(np.abs(above).argmax())
    if abs(above[d]) <= near:
        return None
    if above[d] > 0:
        b, c = c, b
    return np.array([[a, b, c], [a, d, b], [b, d, c], [c, d, a]])


class _GrowingHull:
    """A closed convex surface that takes in one point after another."""

    def __init__(self, points: Array, simplex: Array, near: float) -> None:
        self.points = points
        self.near = near
        self.faces = np.zeros((0, 3), np.int64)
        self.normals = np.zeros((0, 3))
        self.offsets = np.zeros(0)
        self.farthest = np.zeros(0)
        """How far outside each face its farthest point is; -1 where there is none."""
        self.number = np.zeros(0, np.int64)
        """The number of each face; no two faces ever have the same."""
        self.numbered = 0
        self.outside: dict[int, Indices] = {}
        """Number of a face → points outside of it, the farthest first; each point is kept with one face only."""
        self._attach(simplex.astype(np.int64), np.arange(len(points)))

    def add_farthest(self) -> bool:
        """Take in the point that is farthest outside; return whether there was one."""
        chosen = int(self.farthest.argmax())
        if self.farthest[chosen] < 0:
            return False
        point = int(self.outside[int(self.number[chosen])][0])
        above = self.normals @ self.points[point] - self.offsets
        for threshold in (self.near, 0.0, -self.near):
            is_seen = above > threshold
            # Rounding must not keep the face that the point was found outside of.
            is_seen[chosen] = True
            rim = _rim(self.faces[is_seen].tolist())
            if rim:
                self._replace(is_seen, rim, point)
                return True
        self._forget_farthest(chosen)
        return True

    def _replace(self, is_seen: NDArray[np.bool_], rim: list[tuple[int, int]], point: int) -> None:
        loose = np.concatenate([self.outside.pop(number) for number in self.number[is_seen].tolist()])
        self._keep(~is_seen)
        self._attach(np.array([(start, end, point) for start, end in rim]), loose[loose != point])

    def _forget_farthest(self, face: int) -> None:
        """Leave out a point that rounding keeps from being taken in."""
        number = int(self.number[face])
        rest = self.outside[number] = self.outside[number][1:]
        self.farthest[face] = self.points[rest[0]] @ self.normals[face] - self.offsets[face] if len(rest) else -1.0

    def _keep(self, kept: NDArray[np.bool_]) -> None:
        self.faces, self.normals, self.offsets = self.faces[kept], self.normals[kept], self.offsets[kept]
        self.farthest, self.number = self.farthest[kept], self.number[kept]

    def _attach(self, faces: Indices, loose: Indices) -> None:
        """Add faces and give them the loose points that are outside of them."""
        corners = self.points[faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.sqrt(np.einsum("ij,ij->i", normals, normals)), _TINY)[:, None]
        offsets = np.einsum("ij,ij->i", normals, corners[:, 0])
        height = self.points[loose] @ normals.T - offsets
        best = height.argmax(axis=1)
        height = height[np.arange(len(loose)), best]
        order = np.lexsort((-height, best))
        order = order[height[order] > self.near]
        ends = np.cumsum(np.bincount(best[order], minlength=len(faces)))
        starts = np.concatenate([[0], ends[:-1]])
        farthest = np.full(len(faces), -1.0)
        has_points = ends > starts
        farthest[has_points] = height[order[starts[has_points]]]
        numbers = np.arange(self.numbered, self.numbered + len(faces))
        ordered = loose[order]
        for number, start, end in zip(numbers.tolist(), starts.tolist(), ends.tolist(), strict=True):
            self.outside[number] = ordered[start:end]
        self.numbered += len(faces)
        self.faces = np.concatenate([self.faces, faces])
        self.normals = np.concatenate([self.normals, normals])
        self.offsets = np.concatenate([self.offsets, offsets])
        self.farthest = np.concatenate([self.farthest, farthest])
        self.number = np.concatenate([self.number, numbers])


def _rim(faces: list[list[int]]) -> list[tuple[int, int]]:
    """Return the edges around faces, in the faces' direction; empty if they are not one closed line.

    Rounding may leave a face out amid those that are seen from a point: to close around it would fold the hull.
    """
    edges = {edge: None for a, b, c in faces for edge in ((a, b), (b, c), (c, a))}
    after = {start: end for start, end in edges if (end, start) not in edges}
    rim: list[tuple[int, int]] = []
    here = next(iter(after), -1)
    while here in after:
        rim.append((here, after[here]))
        here = after.pop(here)
    is_closed = bool(rim) and not after and rim[0][0] == rim[-1][1]
    count = sum((end, start) not in edges for start, end in edges)
    return rim if is_closed and len(rim) == count else []


def convex_polygon(points: Array) -> Indices:
    """Return the corners of the convex hull of points in a plane (n, 2), as indices, counter-clockwise.

    Points on an edge are no corners. Points on a line give its two ends, points in one place give one.
    """
    order = np.lexsort((points[:, 1], points[:, 0]))
    first, last = int(order[0]), int(order[-1])
    near = _FLAT * 1e-3 * float(np.hypot(*np.ptp(points, axis=0)))
    if bool((points[first] == points[last]).all()):
        return np.array([first])
    everything = np.arange(len(points))
    below = _beyond(points, everything, first, last, near)
    above = _beyond(points, everything, last, first, near)
    return np.array([first, *below, last, *above])


def _beyond(points: Array, candidates: Indices, start: int, end: int, near: float) -> Iterator[int]:
    """Yield the corners right of the line from `start` to `end`, in order."""
    along = points[end] - points[start]
    away = points[candidates] - points[start]
    distance = (along[1] * away[:, 0] - along[0] * away[:, 1]) / max(float(np.hypot(*along)), _TINY)
    is_beyond = distance > near
    if is_beyond.any():
        corner = int(candidates[int(distance.argmax())])
        candidates = candidates[is_beyond]
        yield from _beyond(points, candidates, start, corner, near)
        yield corner
        yield from _beyond(points, candidates, corner, end, near)


def smallest_rectangle(points: Array, height: float = 0.0) -> tuple[Array, tuple[float, float]]:
    """Return axes (2, 2) and extents of a rectangle around points in a plane (n, 2), the longer side first.

    It lies along an edge of the points' hull, as the rectangle of least area does (Freeman & Shapira 1975).

    Args:
        points: finite numbers.
        height: what is least is the surface of the box of this height on the rectangle; default: the area.
    """
    corners = points[convex_polygon(points)]
    edges = np.roll(corners, -1, axis=0) - corners
    length = np.linalg.norm(edges, axis=1)
    along = edges[length > 0] / length[length > 0, None] if (length > 0).any() else np.array([[1.0, 0.0]])
    across = np.column_stack([-along[:, 1], along[:, 0]])
    width, depth = np.ptp(corners @ along.T, axis=0), np.ptp(corners @ across.T, axis=0)
    # Rounded, so that of equal ones the first is taken and not the one that rounding favours.
    best = int(_rounded(width * depth + height * (width + depth)).argmin())
    axes, extents = np.stack([along[best], across[best]]), (float(width[best]), float(depth[best]))
    return (axes, extents) if extents[0] >= extents[1] else (axes[::-1] * [[1], [-1]], extents[::-1])


def _rounded(values: Array) -> Array:
    return np.asarray(np.round(values / max(float(values.max()), _TINY), 9))


def smallest_box(vertices: Array, normals: Array) -> SmallestBox:
    """Return the box of least surface around points (n, 3) among those that stand on one of some planes.

    Least surface rather than volume: it decides for flat things too, all of whose boxes have volume 0.

    Args:
        vertices: finite numbers, the vertices of the hull.
        normals: (m, 3) of the planes, of any length but 0.
    """
    boxes = [_box_on(vertices, normal) for normal in normals]
    return boxes[int(_rounded(np.array([_surface(box) for box in boxes])).argmin())]


def _surface(box: SmallestBox) -> float:
    long, middle, short = box.size
    return long * middle + middle * short + short * long


def _box_on(vertices: Array, normal: Array) -> SmallestBox:
    up = normal / max(float(np.linalg.norm(normal)), _TINY)
    beside = np.eye(3)[int(np.abs(up).argmin())]
    first = np.cross(beside, up)
    plane = np.stack([first / float(np.linalg.norm(first)), np.zeros(3)])
    plane[1] = np.cross(up, plane[0])
    height = float(np.ptp(vertices @ up))
    axes, extents = smallest_rectangle(vertices @ plane.T, height)
    rows = np.concatenate([axes @ plane, up[None]])
    sizes = np.array([*extents, height])
    order = np.argsort(-sizes, kind="stable")
    long, middle, short = sizes[order].tolist()
    return SmallestBox((long, middle, short), rows[order])


def largest_normals(hull: ConvexHull) -> Array:
    """Return the normals of the largest faces of a hull (k, 3), coplanar triangles taken together, at most 16."""
    areas = hull.areas
    length = np.linalg.norm(areas, axis=1)
    areas, length = areas[length > 0], length[length > 0]
    keys = np.round(areas / length[:, None] * 500).astype(np.int64)
    _, first, group = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    total = np.bincount(group.reshape(-1), length, minlength=len(first))
    order = np.argsort(-np.round(total / math.fsum(total), 9), kind="stable")[:_MOST_NORMALS]
    return np.asarray(areas[first[order]])
