"""Meshes by formula: boxes, vessels, tubes, ribbons of cloth and soft bags, in centimetres, z up."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Mesh",
    "bag",
    "box",
    "carcass",
    "heap",
    "lathe",
    "merge",
    "moved",
    "open_bag",
    "ribbon",
    "ring",
    "rod",
    "tray",
    "tube",
    "turned",
    "vessel",
]

Point = tuple[float, float, float]
Profile = Sequence[tuple[float, float]]


class Mesh(NamedTuple):
    """A polygon mesh, counter-clockwise seen from outside."""

    points: NDArray[np.float64]
    """(n, 3), centimetres."""
    faces: list[list[int]]


def merge(*meshes: Mesh) -> Mesh:
    """Return one mesh with the faces of all."""
    faces: list[list[int]] = []
    start = 0
    for mesh in meshes:
        faces += [[start + index for index in face] for face in mesh.faces]
        start += len(mesh.points)
    return Mesh(np.vstack([mesh.points for mesh in meshes]), faces)


def moved(mesh: Mesh, x: float = 0, y: float = 0, z: float = 0) -> Mesh:
    """Return the mesh, translated."""
    return Mesh(mesh.points + np.array([x, y, z]), mesh.faces)


def turned(mesh: Mesh, x: float = 0, y: float = 0, z: float = 0) -> Mesh:
    """Return the mesh, turned by degrees about x, then y, then z."""
    points = mesh.points
    for angle, (a, b) in ((x, (1, 2)), (y, (2, 0)), (z, (0, 1))):
        cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        rotated = points.copy()
        rotated[:, a] = cos * points[:, a] - sin * points[:, b]
        rotated[:, b] = sin * points[:, a] + cos * points[:, b]
        points = rotated
    return Mesh(points, mesh.faces)


def box(sx: float, sy: float, sz: float, x: float = 0, y: float = 0, z: float = 0) -> Mesh:
    """Return a box whose bottom is centred at x, y, z."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    points = [(x + a * sx / 2, y + b * sy / 2, z + c) for c in (0, sz) for a, b in corners]
    faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    return Mesh(np.array(points, dtype=float), faces)


def lathe(profile: Profile, n: int = 24, closed: bool = False) -> Mesh:
    """Return a profile of radius and height turned about z; a closed one is a ring without an axis."""
    rings: list[list[int]] = []
    points: list[Point] = []
    for radius, z in profile:
        count = 1 if radius == 0 else n
        rings.append(list(range(len(points), len(points) + count)))
        angles = [2 * math.pi * step / n for step in range(count)]
        points += [(radius * math.cos(angle), radius * math.sin(angle), z) for angle in angles]
    if closed:
        rings.append(rings[0])
    return Mesh(np.array(points, dtype=float), _bands(rings, n))


def _bands(rings: list[list[int]], n: int) -> list[list[int]]:
    """Return the faces between rings of n points or of one."""
    faces: list[list[int]] = []
    for low, high in pairwise(rings):
        for i in range(n):
            j = (i + 1) % n
            corners = [low[i % len(low)], low[j % len(low)], high[j % len(high)], high[i % len(high)]]
            face = list(dict.fromkeys(corners))
            if len(face) > 2:
                faces.append(face)
    return faces


def vessel(outer: Profile, wall: float = 0.5, floor: float = 0.7, n: int = 24) -> Mesh:
    """Return a hollow vessel with this outer profile from its foot to its rim."""
    inner = [(max(radius - wall, 0.2), z) for radius, z in outer if z > floor]
    radii = np.interp(floor, [z for _, z in outer], [radius for radius, _ in outer])
    bottom = (max(float(radii) - wall, 0.2), floor)
    return lathe([(0, 0), *outer, *reversed(inner), bottom, (0, floor)], n)


def ring(inner: float, outer: float, height: float, n: int = 24) -> Mesh:
    """Return a flat ring on z = 0."""
    return lathe([(inner, 0), (outer, 0), (outer, height), (inner, height)], n, closed=True)


def rod(radius: float, length: float, axis: str = "z", x: float = 0, y: float = 0, z: float = 0, n: int = 12) -> Mesh:
    """Return a cylinder that starts at x, y, z and runs along an axis: x, y, z or -y."""
    mesh = lathe([(0, 0), (radius, 0), (radius, length), (0, length)], n)
    tilt = {"z": (0, 0), "x": (0, 90), "y": (-90, 0), "-y": (90, 0)}[axis]
    return moved(turned(mesh, tilt[0], tilt[1]), x, y, z)


def tube(path: Sequence[Point], radius: float, n: int = 8) -> Mesh:
    """Return a round tube along a path, with flat ends."""
    line = np.array(path, dtype=float)
    tangents = np.gradient(line, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    side = np.cross(tangents[0], [0.31, 0.87, 0.38])
    points: list[NDArray[np.float64]] = []
    rings: list[list[int]] = []
    for centre, tangent in zip(line, tangents, strict=True):
        side = side - tangent * (side @ tangent)
        side /= np.linalg.norm(side)
        other = np.cross(tangent, side)
        rings.append(list(range(len(points), len(points) + n)))
        for step in range(n):
            angle = 2 * math.pi * step / n
            points.append(centre + radius * (math.cos(angle) * side + math.sin(angle) * other))
    faces = [rings[0][::-1], *_bands(rings, n), rings[-1]]
    return Mesh(np.array(points), faces)


def ribbon(path: Profile, thickness: float, height: float) -> Mesh:
    """Return an upright strip along a path in x and y, as of cloth or bent sheet."""
    line = np.array(path, dtype=float)
    along = np.gradient(line, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    normal = np.stack([-along[:, 1], along[:, 0]], axis=1) * thickness / 2
    flat = np.vstack([line + normal, line - normal])
    n = len(line)
    points = np.vstack([np.column_stack([flat, np.full(2 * n, z)]) for z in (0, height)])
    faces = [[n, 0, 2 * n, 3 * n][::-1], [2 * n - 1, n - 1, 3 * n - 1, 4 * n - 1]]
    for i in range(n - 1):
        left, right, up = i, n + i, 2 * n
        faces += [
            [left + 1, left, left + up, left + 1 + up],
            [right, right + 1, right + 1 + up, right + up],
            [right + up, right + 1 + up, left + 1 + up, left + up],
            [left, left + 1, right + 1, right],
        ]
    return Mesh(points, faces)


def _outline(sx: float, sy: float, n: int = 24) -> NDArray[np.float64]:
    """Return a rectangle with very round corners, (n, 2)."""
    angles = np.arange(n) * 2 * math.pi / n
    cos, sin = np.cos(angles), np.sin(angles)
    x, y = np.sign(cos) * np.abs(cos) ** 0.4, np.sign(sin) * np.abs(sin) ** 0.4
    return np.column_stack([x * sx / 2, y * sy / 2])


def _loft(levels: Sequence[tuple[float, float, float]], sx: float, sy: float) -> Mesh:
    """Return soft outlines, each with a factor, a margin and a height, joined and closed at both ends."""
    n = 24
    points = np.vstack(
        [np.column_stack([_outline(sx * k - 2 * m, sy * k - 2 * m), np.full(n, z)]) for k, m, z in levels]
    )
    rings = [list(range(level * n, level * n + n)) for level in range(len(levels))]
    return Mesh(points, [rings[0][::-1], *_bands(rings, n), rings[-1]])


def bag(sx: float, sy: float, sz: float) -> Mesh:
    """Return a full bag that lies: flat above and below, with soft edges."""
    steps = [(0.88, 0.0), (0.96, 0.08), (1, 0.25), (1, 0.75), (0.96, 0.92), (0.88, 1)]
    return _loft([(k, 0, z * sz) for k, z in steps], sx, sy)


def open_bag(sx: float, sy: float, sz: float, skin: float = 0.2) -> Mesh:
    """Return an open bag that stands, hollow, with a slightly narrower rim."""
    outer = [(0.92, 0.0, 0.0), (1, 0, sz * 0.2), (1, 0, sz * 0.7), (0.94, 0, sz)]
    inner = [(0.94, skin, sz), (1, skin, sz * 0.7), (1, skin, sz * 0.2), (0.92, skin, skin)]
    return _loft([*outer, *inner], sx, sy)


def heap(radius: float, height: float) -> Mesh:
    """Return a round heap of powder or soil."""
    return lathe([(0, 0), (radius, 0), (radius * 0.75, height * 0.55), (radius * 0.4, height * 0.9), (0, height)])


def tray(sx: float, sy: float, sz: float, wall: float = 0.6) -> Mesh:
    """Return an open box on z = 0."""
    return merge(
        box(sx, sy, wall),
        *(box(wall, sy, sz - wall, side * (sx - wall) / 2, 0, wall) for side in (-1, 1)),
        *(box(sx - 2 * wall, wall, sz - wall, 0, side * (sy - wall) / 2, wall) for side in (-1, 1)),
    )


def carcass(
    sx: float, sy: float, sz: float, boards: Sequence[float] = (), panel: float = 1.8, plinth: float = 0
) -> Mesh:
    """Return a cupboard without doors; its back on y = 0, its front open at -y, boards by the height of their tops."""
    inside = sx - 2 * panel
    parts = [box(panel, sy, sz, side * (sx - panel) / 2, -sy / 2) for side in (-1, 1)]
    parts += [box(inside, sy, panel, 0, -sy / 2, z) for z in (plinth, sz - panel)]
    parts.append(box(inside, 0.8, sz - plinth - 2 * panel, 0, -0.4, plinth + panel))
    parts += [box(inside, sy - 3, panel, 0, -sy / 2 + 1.4, z - panel) for z in boards]
    if plinth:
        parts.append(box(inside, panel, plinth, 0, -sy + 5))
    return merge(*parts)
