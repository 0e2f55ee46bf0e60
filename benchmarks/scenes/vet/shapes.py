"""Gprims and meshes by formula, Z up, in millimetres; most stand with the middle of their base at the origin."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Part",
    "ball",
    "box",
    "crate",
    "cup",
    "cyl",
    "lathe",
    "moved",
    "pillow",
    "pose",
    "ring",
    "rod",
    "sheet",
    "slabs",
    "strip",
    "tube",
]

Vec = Sequence[float]
Faces = tuple[tuple[int, ...], ...]
ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Part:
    """A gprim of size 1 with a matrix, or a mesh."""

    kind: str
    """Cube, Cylinder, Sphere or Mesh."""
    matrix: NDArray[np.float64] = field(default_factory=lambda: np.eye(4))
    """(4, 4), for row vectors, as USD has it."""
    points: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))
    faces: Faces = ()


def pose(at: Vec = ORIGIN, rot: Vec = ORIGIN, scale: Vec = (1, 1, 1)) -> NDArray[np.float64]:
    """Return the matrix that scales, turns by degrees about x, then y, then z, and displaces row vectors."""
    matrix = np.diag([*scale, 1.0])
    for axis, angle in enumerate(rot):
        turn = np.eye(4)
        first, second = (axis + 1) % 3, (axis + 2) % 3
        turn[first, first] = turn[second, second] = cos(angle * pi / 180)
        turn[first, second] = sin(angle * pi / 180)
        turn[second, first] = -turn[first, second]
        matrix = matrix @ turn
    matrix[3, :3] = at
    return matrix


def moved(part: Part, at: Vec = ORIGIN, rot: Vec = ORIGIN) -> Part:
    """Return the part turned about the origin, then displaced."""
    matrix = pose(at, rot)
    if part.kind == "Mesh":
        return replace(part, points=part.points @ matrix[:3, :3] + matrix[3, :3])
    return replace(part, matrix=part.matrix @ matrix)


def box(w: float, d: float, h: float, at: Vec = ORIGIN, rot: Vec = ORIGIN) -> Part:
    """Return a cube; `at` is the middle of its base."""
    return moved(Part("Cube", pose((0, 0, h / 2), scale=(w, d, h))), at, rot)


def cyl(r: float, h: float, at: Vec = ORIGIN, rot: Vec = ORIGIN) -> Part:
    """Return an upright cylinder."""
    return moved(Part("Cylinder", pose((0, 0, h / 2), scale=(2 * r, 2 * r, h))), at, rot)


def rod(start: Vec, end: Vec, r: float) -> Part:
    """Return a cylinder between two points."""
    across = np.subtract(end, start)
    length = float(np.linalg.norm(across))
    x, y, z = across / length
    tilt = np.degrees(np.arccos(z))
    yaw = np.degrees(np.arctan2(y, x)) if abs(x) + abs(y) > 1e-9 else 0.0
    return cyl(r, length, start, (0, float(tilt), float(yaw)))


def ball(r: float, at: Vec = ORIGIN, flat: float = 1.0) -> Part:
    """Return a sphere, or a flattened one, that rests on `at`."""
    return moved(Part("Sphere", pose((0, 0, r * flat), scale=(2 * r, 2 * r, 2 * r * flat))), at)


def _mesh(points: Sequence[Vec] | NDArray[np.float64], faces: Sequence[Sequence[int]]) -> Part:
    known = tuple(tuple(int(index) for index in face) for face in faces)
    return Part("Mesh", points=np.asarray(points, dtype=float), faces=known)


_CUBE = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def slabs(*bounds: Vec) -> Part:
    """Return one mesh of boxes, each given by x, x, y, y, z, z."""
    points: list[Vec] = []
    faces: list[list[int]] = []
    for x0, x1, y0, y1, z0, z1 in bounds:
        faces += [[len(points) + index for index in face] for face in _CUBE]
        points += [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    return _mesh(points, faces)


def crate(w: float, d: float, h: float, t: float, flare: float = 0.0) -> Part:
    """Return an open box with walls and a floor of thickness t, wider by `flare` at its rim."""

    def ring(inset: float, z: float) -> list[Vec]:
        x, y = w / 2 - inset, d / 2 - inset
        return [(-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)]

    points = [*ring(0, 0), *ring(-flare, h), *ring(t - flare, h), *ring(t, t)]
    sides = [
        (4 * level + i, 4 * level + (i + 1) % 4, 4 * level + 4 + (i + 1) % 4, 4 * level + 4 + i)
        for level in range(3)
        for i in range(4)
    ]
    return _mesh(points, [*sides, (3, 2, 1, 0), (12, 13, 14, 15)])


def lathe(profile: Sequence[tuple[float, float]], n: int = 20) -> Part:
    """Return the surface that turns a profile of radius and height about z; it begins and ends on the axis."""
    points: list[Vec] = [(0, 0, profile[0][1])]
    for r, z in profile[1:-1]:
        points += [(r * cos(2 * pi * i / n), r * sin(2 * pi * i / n), z) for i in range(n)]
    points.append((0, 0, profile[-1][1]))
    last = len(points) - 1
    faces: list[tuple[int, ...]] = [(0, 1 + (i + 1) % n, 1 + i) for i in range(n)]
    for level in range(len(profile) - 3):
        a, b = 1 + level * n, 1 + (level + 1) * n
        faces += [(a + i, a + (i + 1) % n, b + (i + 1) % n, b + i) for i in range(n)]
    faces += [(last, last - n + i, last - n + (i + 1) % n) for i in range(n)]
    return _mesh(points, faces)


def cup(low: float, high: float, h: float, t: float = 3.0, n: int = 20) -> Part:
    """Return a hollow vessel, open at its top, by the radii of its foot and its rim."""
    return lathe([(0, 0), (low, 0), (high, h), (high - t, h), (low - t, t), (0, t)], n)


def ring(hole: float, r: float, h: float, n: int = 24) -> Part:
    """Return a roll with a round hole."""
    profile = ((hole, 0), (r, 0), (r, h), (hole, h))
    points = [(a * cos(2 * pi * i / n), a * sin(2 * pi * i / n), z) for i in range(n) for a, z in profile]
    last = 4 * n
    faces = [
        (4 * i + k, (4 * i + 4 + k) % last, (4 * i + 4 + (k + 1) % 4) % last, 4 * i + (k + 1) % 4)
        for i in range(n)
        for k in range(4)
    ]
    return _mesh(points, faces)


def _sweep(rings: Sequence[NDArray[np.float64]]) -> Part:
    n = len(rings[0])
    faces: list[Sequence[int]] = [list(range(n - 1, -1, -1)), [(len(rings) - 1) * n + i for i in range(n)]]
    for level in range(len(rings) - 1):
        a, b = level * n, (level + 1) * n
        faces += [(a + i, a + (i + 1) % n, b + (i + 1) % n, b + i) for i in range(n)]
    return _mesh(np.concatenate(rings), faces)


def tube(path: Sequence[Vec], r: float, n: int = 8) -> Part:
    """Return a round tube along a polyline."""
    line = np.asarray(path, dtype=float)
    rings = []
    side = np.array([0.31, 0.87, 0.39])
    for index, middle in enumerate(line):
        along = line[min(index + 1, len(line) - 1)] - line[max(index - 1, 0)]
        along /= np.linalg.norm(along)
        # The last side is carried on, so that the tube does not twist.
        side = side - along * (side @ along)
        side /= np.linalg.norm(side)
        up = np.cross(along, side)
        angles = [2 * pi * i / n for i in range(n)]
        rings.append(np.array([middle + r * (cos(a) * side + sin(a) * up) for a in angles]))
    return _sweep(rings)


def strip(path: Sequence[tuple[float, float]], width: float, t: float) -> Part:
    """Return a band of thickness t along a polyline of x and z, the middle of its width at y = 0."""
    line = np.asarray(path, dtype=float)
    rings = []
    for index, (x, z) in enumerate(line):
        along = line[min(index + 1, len(line) - 1)] - line[max(index - 1, 0)]
        nx, nz = np.array([-along[1], along[0]]) / np.linalg.norm(along) * t / 2
        y = width / 2
        rings.append(np.array([(x - nx, -y, z - nz), (x - nx, y, z - nz), (x + nx, y, z + nz), (x + nx, -y, z + nz)]))
    return _sweep(rings)


def sheet(w: float, d: float, t: float, wave: float = 0.0, n: int = 12) -> Part:
    """Return a cloth of thickness t with folds of height `wave` along x; it rests on z = 0."""
    path = [(w * (i / n - 0.5), t / 2 + wave * (0.5 - 0.5 * cos(2 * pi * i * 3 / n))) for i in range(n + 1)]
    return strip(path, d, t)


def pillow(w: float, d: float, h: float, n: int = 16) -> Part:
    """Return a soft, filled thing: a sack, a cushion or a heap, flat below."""
    rings: list[tuple[float, float]] = [(0.80, 0), (0.95, 0.15), (1, 0.4), (0.97, 0.65), (0.85, 0.88), (0.6, 1)]
    points: list[Vec] = [(0, 0, 0)]
    for size, z in rings:
        for i in range(n):
            c, s = cos(2 * pi * i / n), sin(2 * pi * i / n)
            x, y = (np.sign(v) * abs(v) ** 0.45 * size / 2 for v in (c, s))
            points.append((float(x) * w, float(y) * d, z * h))
    points.append((0, 0, h))
    last = len(points) - 1
    faces: list[tuple[int, ...]] = [(0, 1 + (i + 1) % n, 1 + i) for i in range(n)]
    for level in range(len(rings) - 1):
        a, b = 1 + level * n, 1 + (level + 1) * n
        faces += [(a + i, a + (i + 1) % n, b + (i + 1) % n, b + i) for i in range(n)]
    return _mesh(points, [*faces, *((last, last - n + i, last - n + (i + 1) % n) for i in range(n))])
