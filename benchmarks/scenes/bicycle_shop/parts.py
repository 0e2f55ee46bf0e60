"""Parts of the things: primitives of OpenUSD, and meshes by formula. Z up, centimetres."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Mesh",
    "Part",
    "Primitive",
    "Scatter",
    "Vector",
    "ball",
    "block",
    "capsule",
    "cone",
    "cube",
    "cyl",
    "height",
    "lathe",
    "merge",
    "open_box",
    "ring",
    "shift",
    "tube",
    "vessel",
]

Vector = tuple[float, float, float]
SIDES = 24
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


class Primitive(NamedTuple):
    """A cube, cylinder, cone, sphere or capsule whose own axis is turned to `way`."""

    kind: str
    centre: Vector
    radius: float = 0.0
    length: float = 0.0
    way: Vector = (0.0, 0.0, 1.0)
    size: Vector = (1.0, 1.0, 1.0)
    """Edges of a cube."""


class Mesh(NamedTuple):
    """Points and faces."""

    points: NDArray[np.float64]
    """(n, 3) centimetres."""
    faces: list[list[int]]
    """Indices of the points of each face."""


class Scatter(NamedTuple):
    """Copies of a primitive, written as a point instancer."""

    copy: Primitive
    places: list[Vector]


Part = Primitive | Mesh | Scatter


def cube(width: float, depth: float, tall: float, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Primitive:
    """Return a cube, stretched, that is centred at x and y and stands at height z."""
    return Primitive("Cube", (x, y, z + tall / 2), size=(width, depth, tall))


def cyl(radius: float, tall: float, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Primitive:
    """Return an upright cylinder that stands at height z."""
    return Primitive("Cylinder", (x, y, z + tall / 2), radius, tall)


def cone(radius: float, tall: float, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Primitive:
    """Return an upright cone that stands at height z."""
    return Primitive("Cone", (x, y, z + tall / 2), radius, tall)


def ball(radius: float, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Primitive:
    """Return a sphere about a centre."""
    return Primitive("Sphere", (x, y, z), radius)


def tube(start: Vector, end: Vector, radius: float) -> Primitive:
    """Return a cylinder from one point to another."""
    return _along("Cylinder", start, end, radius)


def capsule(start: Vector, end: Vector, radius: float) -> Primitive:
    """Return a capsule; its round ends are beyond the two points."""
    return _along("Capsule", start, end, radius)


def _along(kind: str, start: Vector, end: Vector, radius: float) -> Primitive:
    a, b = np.array(start), np.array(end)
    length = float(np.linalg.norm(b - a))
    x, y, z = ((a + b) / 2).tolist()
    u, v, w = ((b - a) / length).tolist()
    return Primitive(kind, (x, y, z), radius, length, (u, v, w))


def block(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float) -> Mesh:
    """Return a box by its bounds."""
    corners = np.array([(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)], dtype=float)
    return Mesh(corners, [list(face) for face in QUADS])


def open_box(width: float, depth: float, tall: float, wall: float) -> Mesh:
    """Return a box without a lid, of one skin, that stands at the origin."""
    outer = block(-width / 2, width / 2, -depth / 2, depth / 2, 0, tall)
    inner = block(wall - width / 2, width / 2 - wall, wall - depth / 2, depth / 2 - wall, wall, tall)
    top = QUADS[5]
    faces = [list(face) for face in QUADS[:5]] + [[8 + i for i in face[::-1]] for face in QUADS[:5]]
    faces += [[top[i], top[(i + 1) % 4], 8 + top[(i + 1) % 4], 8 + top[i]] for i in range(4)]
    return Mesh(np.concatenate([outer.points, inner.points]), faces)


def lathe(profile: Sequence[tuple[float, float]], sides: int = SIDES) -> Mesh:
    """Return what a profile of (radius, z) sweeps around the z axis."""
    turns = 2 * np.pi * np.arange(sides) / sides
    points = np.concatenate(
        [np.stack([r * np.cos(turns), r * np.sin(turns), 0 * turns + z], axis=1) for r, z in profile]
    )
    faces = [
        [k * sides + i, k * sides + (i + 1) % sides, (k + 1) * sides + (i + 1) % sides, (k + 1) * sides + i]
        for k in range(len(profile) - 1)
        for i in range(sides)
    ]
    return Mesh(points, faces)


def vessel(foot: float, rim: float, tall: float, wall: float = 0.4) -> Mesh:
    """Return a round pot, cup or bowl, open at the top, by its radii."""
    return lathe([(0.01, 0), (foot, 0), (rim, tall), (rim - wall, tall), (max(foot - wall, 0.02), wall), (0.01, wall)])


def ring(radius: float, thickness: float, axis: str = "y", sides: int = 32) -> Mesh:
    """Return a torus about the origin: the radius of its middle line, and that of its section."""
    turns, around = 2 * np.pi * np.arange(sides) / sides, 2 * np.pi * np.arange(8) / 8
    far = radius + thickness * np.cos(around)[None, :]
    first, second = far * np.cos(turns)[:, None], far * np.sin(turns)[:, None]
    third = np.broadcast_to(thickness * np.sin(around)[None, :], first.shape)
    order = {"x": (third, first, second), "y": (first, third, second), "z": (first, second, third)}[axis]
    points = np.stack(order, axis=2).reshape(-1, 3)
    faces = [
        [i * 8 + k, (i + 1) % sides * 8 + k, (i + 1) % sides * 8 + (k + 1) % 8, i * 8 + (k + 1) % 8]
        for i in range(sides)
        for k in range(8)
    ]
    return Mesh(points, faces)


def merge(*meshes: Mesh) -> Mesh:
    """Return one mesh of several."""
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)]).tolist()
    faces = [[start + i for i in face] for mesh, start in zip(meshes, starts, strict=False) for face in mesh.faces]
    return Mesh(np.concatenate([mesh.points for mesh in meshes]), faces)


def shift(mesh: Mesh, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Mesh:
    """Return a moved mesh."""
    return Mesh(mesh.points + np.array([x, y, z]), mesh.faces)


def height(part: Part) -> float:
    """Return how tall a part is, in centimetres, as if it stood upright."""
    if isinstance(part, Mesh):
        return float(np.ptp(part.points[:, 2]))
    primitive = part.copy if isinstance(part, Scatter) else part
    if primitive.kind == "Cube":
        return primitive.size[2]
    along = abs(primitive.way[2]) * primitive.length
    return max(along, 2 * primitive.radius * (1 - abs(primitive.way[2])), 0.1)
