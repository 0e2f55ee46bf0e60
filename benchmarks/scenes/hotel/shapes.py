"""Gprims and meshes by formula, Y up, in centimetres; most stand with the middle of their base at the origin."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Part",
    "ball",
    "box",
    "cone",
    "crate",
    "cup",
    "cyl",
    "drape",
    "lathe",
    "moved",
    "puff",
    "resized",
    "slabs",
    "tube",
    "wave",
]

Vec = Sequence[float]
ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Part:
    """A gprim of size 1 at a pose, or a mesh."""

    kind: str
    """Cube, Cylinder, Cone, Sphere or Mesh."""
    size: tuple[float, float, float] = (1.0, 1.0, 1.0)
    at: tuple[float, float, float] = ORIGIN
    """The middle of a gprim; the displacement of a mesh."""
    rot: tuple[float, float, float] = ORIGIN
    """Degrees about x, then y, then z."""
    points: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))
    faces: tuple[tuple[int, ...], ...] = ()


def _three(values: Vec) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])


def _solid(kind: str, size: Vec, at: Vec, rot: Vec) -> Part:
    return Part(kind, _three(size), (at[0], at[1] + size[1] / 2, at[2]), _three(rot))


def box(w: float, h: float, d: float, at: Vec = ORIGIN, rot: Vec = ORIGIN) -> Part:
    """Return a cube; `at` is the middle of its base, `rot` turns it about its middle."""
    return _solid("Cube", (w, h, d), at, rot)


def cyl(r: float, h: float, at: Vec = ORIGIN, rot: Vec = ORIGIN) -> Part:
    """Return an upright cylinder; `at` is the middle of its base, `rot` turns it about its middle."""
    return _solid("Cylinder", (2 * r, h, 2 * r), at, rot)


def cone(r: float, h: float, at: Vec = ORIGIN, rot: Vec = ORIGIN) -> Part:
    """Return an upright cone; `at` is the middle of its base, `rot` turns it about its middle."""
    return _solid("Cone", (2 * r, h, 2 * r), at, rot)


def ball(w: float, h: float, d: float, at: Vec = ORIGIN, rot: Vec = ORIGIN) -> Part:
    """Return an ellipsoid; `at` is its lowest point, `rot` turns it about its middle."""
    return _solid("Sphere", (w, h, d), at, rot)


def moved(part: Part, at: Vec, rot: Vec = ORIGIN) -> Part:
    """Return a mesh at another pose; a gprim has its pose from the start."""
    return Part(part.kind, part.size, _three(at), _three(rot), part.points, part.faces)


def resized(part: Part, factor: float) -> Part:
    """Return a part scaled about its origin."""
    at = _three([value * factor for value in part.at])
    size = part.size if part.kind == "Mesh" else _three([value * factor for value in part.size])
    return Part(part.kind, size, at, part.rot, part.points * factor, part.faces)


def slabs(*ranges: Vec) -> Part:
    """Return one mesh of boxes, each (x0, x1, y0, y1, z0, z1)."""
    points: list[tuple[float, float, float]] = []
    faces: list[tuple[int, ...]] = []
    for x0, x1, y0, y1, z0, z1 in ranges:
        n = len(points)
        points += [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
        sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        faces += [tuple(n + i for i in side) for side in sides]
    return Part("Mesh", points=np.array(points), faces=tuple(faces))


def crate(w: float, h: float, d: float, t: float = 1.0, side: str = "top", top: float | None = None) -> Part:
    """Return a hollow box with walls of thickness t, open at its top or its front (+z)."""
    x, z = w / 2, d / 2
    walls = [
        (-x, x, 0.0, t, -z, z),
        (-x, -x + t, t, h, -z, z),
        (x - t, x, t, h, -z, z),
        (-x + t, x - t, t, h, -z, -z + t),
    ]
    if side == "top":
        walls.append((-x + t, x - t, t, h if top is None else top, z - t, z))
    else:
        walls.append((-x + t, x - t, h - t, h, -z + t, z))
    return slabs(*walls)


def lathe(profile: Sequence[tuple[float, float]], n: int = 20) -> Part:
    """Return the mesh of a profile of (radius, height) turned about the vertical."""
    points = [(r * cos(2 * pi * k / n), y, r * sin(2 * pi * k / n)) for r, y in profile for k in range(n)]
    faces = [
        (i * n + k, (i + 1) * n + k, (i + 1) * n + (k + 1) % n, i * n + (k + 1) % n)
        for i in range(len(profile) - 1)
        for k in range(n)
    ]
    return Part("Mesh", points=np.array(points), faces=tuple(faces))


def cup(r0: float, r1: float, h: float, t: float = 0.4) -> Part:
    """Return a vessel with a base of radius r0 and a mouth of radius r1."""
    return lathe([(0.001, 0), (r0, 0), (r1, h), (r1 - t, h), (max(r0 - t, 0.1), t), (0.001, t)])


def tube(path: Sequence[Vec], r: float, n: int = 8) -> Part:
    """Return a round bar along a path, with ends."""
    line = np.array(path, dtype=float)
    points: list[NDArray[np.float64]] = []
    side = np.array([0.0, 0.0, 1.0])
    for i, point in enumerate(line):
        along = line[min(i + 1, len(line) - 1)] - line[max(i - 1, 0)]
        along = along / np.linalg.norm(along)
        # Carry the side on from point to point, so that the bar does not twist.
        side = side - along * (side @ along)
        if np.linalg.norm(side) < 1e-6:
            side = np.cross(along, (1.0, 0.3, 0.2))
        side = side / np.linalg.norm(side)
        other = np.cross(along, side)
        points += [point + r * (side * cos(2 * pi * k / n) + other * sin(2 * pi * k / n)) for k in range(n)]
    last = (len(line) - 1) * n
    faces: list[tuple[int, ...]] = [
        (i * n + k, i * n + (k + 1) % n, (i + 1) * n + (k + 1) % n, (i + 1) * n + k)
        for i in range(len(line) - 1)
        for k in range(n)
    ]
    faces += [tuple(range(n))[::-1], tuple(range(last, last + n))]
    return Part("Mesh", points=np.array(points), faces=tuple(faces))


def drape(profile: Sequence[tuple[float, float]], depth: float, t: float) -> Part:
    """Return a cloth: a polyline in x and y, its thickness t to its left, stretched along z about 0."""
    line = np.array(profile, dtype=float)
    step = np.gradient(line, axis=0)
    step /= np.linalg.norm(step, axis=1, keepdims=True)
    other = line + t * np.stack([-step[:, 1], step[:, 0]], axis=1)
    n = len(line)
    ring = [np.column_stack([side, np.full(n, z)]) for z in (-depth / 2, depth / 2) for side in (line, other)]
    faces: list[tuple[int, ...]] = []
    for i in range(n - 1):
        a, b, c, d = i, n + i, 2 * n + i, 3 * n + i
        faces += [(a, a + 1, c + 1, c), (b, d, d + 1, b + 1), (a, b, b + 1, a + 1), (c, c + 1, d + 1, d)]
    faces += [(0, 2 * n, 3 * n, n), (n - 1, 2 * n - 1, 4 * n - 1, 3 * n - 1)]
    return Part("Mesh", points=np.concatenate(ring), faces=tuple(faces))


def wave(width: float, amplitude: float, folds: int) -> list[tuple[float, float]]:
    """Return the plan of a curtain, for `drape`."""
    count = folds * 8 + 1
    return [(width * i / (count - 1) - width / 2, amplitude * sin(2 * pi * i / 8)) for i in range(count)]


def puff(w: float, h: float, d: float, e: float = 0.4) -> Part:
    """Return a superellipsoid, boxy for a small exponent e: a pillow, a folded towel, a loaf."""

    def power(value: float) -> float:
        return float(np.sign(value) * abs(value) ** e)

    rows, n = 8, 20
    points = [
        (
            w / 2 * power(cos(pi * (i / rows - 0.5))) * power(cos(2 * pi * k / n)),
            h / 2 * (1 + power(sin(pi * (i / rows - 0.5)))),
            d / 2 * power(cos(pi * (i / rows - 0.5))) * power(sin(2 * pi * k / n)),
        )
        for i in range(rows + 1)
        for k in range(n)
    ]
    faces = [
        (i * n + k, (i + 1) * n + k, (i + 1) * n + (k + 1) % n, i * n + (k + 1) % n)
        for i in range(rows)
        for k in range(n)
    ]
    return Part("Mesh", points=np.array(points), faces=tuple(faces))
