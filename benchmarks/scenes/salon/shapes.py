"""Meshes by formula: boxes, hollow boxes, bodies of revolution, rods, ribbons. Z up, metres."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Shape",
    "ball",
    "bent",
    "box",
    "cuboid",
    "disc",
    "hollow_box",
    "lathe",
    "merge",
    "move",
    "ribbon",
    "rod",
    "squash",
    "turn",
    "vessel",
]

SIDES = 20
BOX_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
AXES = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


class Shape(NamedTuple):
    """Points and faces."""

    points: NDArray[np.float64]
    """(n, 3) metres."""
    faces: list[list[int]]
    """Indices of the points of each face."""


def box(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float) -> Shape:
    """Return a box by its bounds."""
    corners = np.array([(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)], dtype=float)
    return Shape(corners, [list(face) for face in BOX_FACES])


def cuboid(width: float, depth: float, height: float, z: float = 0.0) -> Shape:
    """Return a box centred at the origin of the plan, from height `z` up."""
    return box(-width / 2, width / 2, -depth / 2, depth / 2, z, z + height)


def hollow_box(width: float, depth: float, height: float, wall: float) -> Shape:
    """Return a box without lid, of one skin that also lines the inside."""
    outer = cuboid(width, depth, height)
    inner = cuboid(width - 2 * wall, depth - 2 * wall, height - wall, wall)
    # Face 5 of a box is its top; the rim joins the two tops.
    faces = [list(face) for face in BOX_FACES[:5]] + [[8 + corner for corner in face[::-1]] for face in BOX_FACES[:5]]
    top = BOX_FACES[5]
    rim = [[top[i], top[(i + 1) % 4], 8 + top[(i + 1) % 4], 8 + top[i]] for i in range(4)]
    return Shape(np.concatenate([outer.points, inner.points]), faces + rim)


def lathe(profile: Sequence[tuple[float, float]], sides: int = SIDES) -> Shape:
    """Return the surface that a profile of (radius, z) sweeps around the z axis."""
    angles = 2 * np.pi * np.arange(sides) / sides
    rings = [np.stack([r * np.cos(angles), r * np.sin(angles), np.full(sides, z)], axis=1) for r, z in profile]
    faces = []
    for ring in range(len(profile) - 1):
        low, high = ring * sides, (ring + 1) * sides
        for i in range(sides):
            j = (i + 1) % sides
            faces.append([low + i, low + j, high + j, high + i])
    for ring, (radius, _) in ((0, profile[0]), (len(profile) - 1, profile[-1])):
        if radius > 0:
            faces.append([ring * sides + i for i in range(sides)])
    return _without_slivers(Shape(np.concatenate(rings), faces))


def vessel(foot: float, rim: float, height: float, wall: float = 0.004, belly: float | None = None) -> Shape:
    """Return a hollow body of revolution, open at the top, by its radii."""
    middle = (foot + rim) / 2 if belly is None else belly
    outside = [(foot, 0.0), (middle, height / 2), (rim, height)]
    inside = [(max(r - wall, 0.001), max(z, wall)) for r, z in reversed(outside)]
    return lathe([(0.0, 0.0), *outside, *inside, (0.0, wall)])


def disc(radius: float, height: float, z: float = 0.0) -> Shape:
    """Return a cylinder that stands at height `z`."""
    return lathe([(0.0, z), (radius, z), (radius, z + height), (0.0, z + height)])


def ball(radius: float) -> Shape:
    """Return a ball that stands at the origin."""
    turns = np.linspace(-np.pi / 2, np.pi / 2, 9)
    return lathe([(float(radius * np.cos(t)), float(radius * (1 + np.sin(t)))) for t in turns], 14)


def rod(axis: str, start: float, end: float, at: tuple[float, float], radius: float, sides: int = 10) -> Shape:
    """Return a round rod along an axis; `at` are the two other coordinates, in the order y z, z x, or x y."""
    along = lathe([(0.0, start), (radius, start), (radius, end), (0.0, end)], sides)
    first, second = AXES[axis]
    points = np.empty_like(along.points)
    points[:, first], points[:, second] = along.points[:, 0] + at[0], along.points[:, 1] + at[1]
    points[:, "xyz".index(axis)] = along.points[:, 2]
    return Shape(points, along.faces)


def bent(path: Sequence[tuple[float, float, float]], radius: float, sides: int = 8) -> Shape:
    """Return a pipe along a path of points."""
    nodes = np.array(path, dtype=float)
    ways = np.gradient(nodes, axis=0)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    angles = 2 * np.pi * np.arange(sides) / sides
    side = np.cross(ways, [0.31, 0.52, 0.79])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(ways, side)
    rings = nodes[:, None] + radius * (np.cos(angles)[:, None] * side[:, None] + np.sin(angles)[:, None] * up[:, None])
    faces = [
        [k * sides + i, k * sides + (i + 1) % sides, (k + 1) * sides + (i + 1) % sides, (k + 1) * sides + i]
        for k in range(len(nodes) - 1)
        for i in range(sides)
    ]
    faces += [list(range(sides)), list(range((len(nodes) - 1) * sides, len(nodes) * sides))]
    return Shape(rings.reshape(-1, 3), faces)


def ribbon(line: Sequence[tuple[float, float]], length: float, thickness: float) -> Shape:
    """Return a strip of cloth: a line in the plane of y and z, drawn out along x, centred."""
    nodes = np.array(line, dtype=float)
    ways = np.gradient(nodes, axis=0)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    normals = np.stack([-ways[:, 1], ways[:, 0]], axis=1) * thickness / 2
    around = np.concatenate([nodes + normals, (nodes - normals)[::-1]])
    count = len(around)
    points = np.concatenate(
        [np.column_stack([np.full(count, x), around[:, 0], around[:, 1]]) for x in (-length / 2, length / 2)]
    )
    faces = [[i, (i + 1) % count, count + (i + 1) % count, count + i] for i in range(count)]
    half = count // 2
    ends = [[i, i + 1, count - 2 - i, count - 1 - i] for i in range(half - 1)]
    return Shape(points, faces + ends + [[count + i for i in face] for face in ends])


def merge(*shapes: Shape) -> Shape:
    """Return one mesh of several."""
    starts = np.cumsum([0, *(len(shape.points) for shape in shapes)])
    faces = [
        [int(start) + i for i in face] for shape, start in zip(shapes, starts, strict=False) for face in shape.faces
    ]
    return Shape(np.concatenate([shape.points for shape in shapes]), faces)


def move(shape: Shape, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Shape:
    """Return a moved shape."""
    return Shape(shape.points + np.array([x, y, z]), shape.faces)


def squash(shape: Shape, x: float = 1.0, y: float = 1.0, z: float = 1.0) -> Shape:
    """Return a shape scaled along the axes."""
    return Shape(shape.points * [x, y, z], shape.faces)


def turn(shape: Shape, axis: str, degrees: float) -> Shape:
    """Return a shape turned about an axis through the origin."""
    first, second = AXES[axis]
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    points = shape.points.copy()
    points[:, first] = cos * shape.points[:, first] - sin * shape.points[:, second]
    points[:, second] = sin * shape.points[:, first] + cos * shape.points[:, second]
    return Shape(points, shape.faces)


def _without_slivers(shape: Shape) -> Shape:
    """Return a shape with one point where several coincide, and without faces of no area."""
    points, merged = np.unique(shape.points.round(7), axis=0, return_inverse=True)
    faces = []
    for face in shape.faces:
        corners = [int(merged.ravel()[i]) for i in face]
        kept = [corner for i, corner in enumerate(corners) if corner != corners[i - 1]]
        if len(kept) >= 3:
            faces.append(kept)
    return Shape(points, faces)
