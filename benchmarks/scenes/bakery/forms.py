"""Gprims and meshes that things of the bakery are made of: Y up, centimetres, most resting on y = 0."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import acos, atan2, cos, degrees, pi, radians, sin, tau

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Piece",
    "Triple",
    "bar",
    "bent",
    "block",
    "bulge",
    "cabinet",
    "cloth",
    "column",
    "hoop",
    "hose",
    "joined",
    "open_box",
    "orb",
    "panels",
    "roll",
    "tipped",
    "turned",
    "vessel",
]

Triple = Sequence[float]
Points = NDArray[np.float64]
NONE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Piece:
    """A gprim of size 1 with translation, rotation and scale, or a mesh."""

    kind: str
    """Cube, Cylinder, Cone, Sphere or Mesh."""
    at: Triple = NONE
    rot: Triple = NONE
    scale: Triple = (1.0, 1.0, 1.0)
    points: Points | None = None
    faces: tuple[tuple[int, ...], ...] = ()

    def to(self, x: float, y: float, z: float) -> "Piece":
        """Return the piece displaced."""
        if self.points is not None:
            return replace(self, points=self.points + np.array([x, y, z]))
        return replace(self, at=(self.at[0] + x, self.at[1] + y, self.at[2] + z))


def _spin(points: Points, rot: Triple) -> Points:
    """Turn points by degrees about x, then y, then z."""
    for axis in range(3):
        c, s = cos(radians(rot[axis])), sin(radians(rot[axis]))
        i, j = (axis + 1) % 3, (axis + 2) % 3
        first = points[:, i] * c - points[:, j] * s
        second = points[:, i] * s + points[:, j] * c
        points = points.copy()
        points[:, i], points[:, j] = first, second
    return points


def _gprim(kind: str, scale: Triple, at: Triple, rot: Triple) -> Piece:
    """Return a gprim whose base is turned about `at`, its middle."""
    middle = _spin(np.array([[0.0, scale[1] / 2, 0.0]]), rot)[0] + np.array(at)
    return Piece(kind, tuple(map(float, middle)), tuple(rot), tuple(scale))


def block(w: float, h: float, d: float, at: Triple = NONE, rot: Triple = NONE) -> Piece:
    """Return a cube of width, height and depth."""
    return _gprim("Cube", (w, h, d), at, rot)


def column(r: float, h: float, at: Triple = NONE, rot: Triple = NONE) -> Piece:
    """Return an upright cylinder."""
    return _gprim("Cylinder", (2 * r, h, 2 * r), at, rot)


def orb(r: float, at: Triple = NONE, squash: float = 1.0) -> Piece:
    """Return a sphere, flattened by `squash`."""
    return _gprim("Sphere", (2 * r, 2 * r * squash, 2 * r), at, NONE)


def bar(start: Triple, end: Triple, r: float) -> Piece:
    """Return a cylinder from one point to another."""
    way = np.subtract(end, start)
    length = float(np.linalg.norm(way))
    x, y, z = way / length
    turn = degrees(atan2(x, z)) if abs(x) + abs(z) > 1e-9 else 0.0
    return column(r, length, start, (degrees(acos(y)), turn, 0))


def joined(*pieces: Piece) -> Piece:
    """Return one mesh of several."""
    points: list[Points] = []
    faces: list[tuple[int, ...]] = []
    for piece in pieces:
        assert piece.points is not None, "gprims are no part of a mesh"
        start = sum(len(some) for some in points)
        points.append(piece.points)
        faces += [tuple(start + index for index in face) for face in piece.faces]
    return _mesh(np.concatenate(points), faces)


def tipped(piece: Piece, rot: Triple) -> Piece:
    """Return a mesh turned about the origin."""
    assert piece.points is not None, "gprims are turned when they are made"
    return replace(piece, points=_spin(piece.points, rot))


def _mesh(points: Points, faces: Sequence[Sequence[int]]) -> Piece:
    return Piece("Mesh", points=points, faces=tuple(tuple(face) for face in faces))


def panels(*bounds: Triple) -> Piece:
    """Return one mesh of boxes, each given by x, x, y, y, z, z."""
    points: list[Triple] = []
    faces: list[list[int]] = []
    for x0, x1, y0, y1, z0, z1 in bounds:
        n = len(points)
        points += [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)]
        points += [(x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)]
        faces += [[n, n + 1, n + 2, n + 3], [n + 7, n + 6, n + 5, n + 4]]
        faces += [[n + i, n + 4 + i, n + 4 + (i + 1) % 4, n + (i + 1) % 4] for i in range(4)]
    return _mesh(np.array(points, dtype=float), faces)


def cabinet(w: float, y0: float, y1: float, d: float, t: float = 1.8, *inner: Triple) -> Piece:
    """Return a box without a front; its back is at z = 0, its front at z = d; `inner` are more panels."""
    x = w / 2
    return panels(
        (-x, x, y0, y0 + t, 0, d),
        (-x, x, y1 - t, y1, 0, d),
        (-x, -x + t, y0 + t, y1 - t, 0, d),
        (x - t, x, y0 + t, y1 - t, 0, d),
        (-x + t, x - t, y0 + t, y1 - t, 0, t / 2),
        *inner,
    )


def open_box(w: float, h: float, d: float, t: float = 0.4, flare: float = 0.0) -> Piece:
    """Return a box without a lid, wider at its rim by `flare` on each side."""
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=float)
    levels = [(0.0, 0.0, 0.0), (h, flare, 0.0), (h, flare, t), (t, 0.0, t)]
    points = [
        (cx * (w / 2 + out - wall), y, cz * (d / 2 + out - wall)) for y, out, wall in levels for cx, cz in corners
    ]
    sides = [
        (4 * k + i, 4 * k + 4 + i, 4 * k + 4 + (i + 1) % 4, 4 * k + (i + 1) % 4) for k in range(3) for i in range(4)
    ]
    return _mesh(np.array(points), [*sides, (0, 1, 2, 3), (15, 14, 13, 12)])


def turned(profile: Sequence[tuple[float, float]], n: int = 24) -> Piece:
    """Return the solid that turns a profile of radius and height about y; it starts and ends on the axis."""
    turns = [(cos(tau * i / n), sin(tau * i / n)) for i in range(n)]
    points: list[Triple] = [(0, profile[0][1], 0)]
    for r, y in profile[1:-1]:
        points += [(r * c, y, r * s) for c, s in turns]
    points.append((0, profile[-1][1], 0))
    top = len(points) - 1
    faces: list[tuple[int, ...]] = [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)]
    for level in range(len(profile) - 3):
        low = 1 + level * n
        faces += [(low + i, low + n + i, low + n + (i + 1) % n, low + (i + 1) % n) for i in range(n)]
    faces += [(top, top - n + (i + 1) % n, top - n + i) for i in range(n)]
    return _mesh(np.array(points, dtype=float), faces)


def vessel(foot: float, rim: float, h: float, t: float = 0.3, n: int = 24) -> Piece:
    """Return a round hollow vessel without a lid, by the radii of its foot and rim."""
    return turned([(0, 0), (foot, 0), (rim, h), (rim - t, h), (foot - t, t), (0, t)], n)


def roll(hole: float, r: float, h: float, n: int = 24) -> Piece:
    """Return an upright roll with a round hole."""
    points, faces = [], []
    for i in range(n):
        c, s = cos(tau * i / n), sin(tau * i / n)
        points += [(a * c, y, a * s) for a, y in ((hole, 0), (hole, h), (r, h), (r, 0))]
        here, there = 4 * i, 4 * ((i + 1) % n)
        faces += [(here + k, here + (k + 1) % 4, there + (k + 1) % 4, there + k) for k in range(4)]
    return _mesh(np.array(points), faces)


def _skin(rings: Sequence[Points], closed: bool = False) -> Piece:
    n, count = len(rings[0]), len(rings)
    faces: list[Sequence[int]] = []
    for level in range(count if closed else count - 1):
        a, b = level * n, (level + 1) % count * n
        faces += [(a + i, b + i, b + (i + 1) % n, a + (i + 1) % n) for i in range(n)]
    if not closed:
        faces += [list(range(n)), [(count - 1) * n + i for i in reversed(range(n))]]
    return _mesh(np.concatenate(rings), faces)


def hose(path: Sequence[Triple], r: float, n: int = 8) -> Piece:
    """Return a round tube along a polyline, its sharp corners kept."""
    line = np.asarray(path, dtype=float)
    side = np.array([0.37, 0.21, 0.9])
    rings = []
    for index, middle in enumerate(line):
        along = line[min(index + 1, len(line) - 1)] - line[max(index - 1, 0)]
        along = along / np.linalg.norm(along)
        side = side - along * float(side @ along)
        side = side / np.linalg.norm(side)
        other = np.cross(along, side)
        rings.append(np.array([middle + r * (cos(tau * i / n) * side + sin(tau * i / n) * other) for i in range(n)]))
    return _skin(rings)


def hoop(big: float, small: float, at: Triple = NONE, rot: Triple = NONE, n: int = 20) -> Piece:
    """Return a ring of wire around the z axis, turned and displaced; `at` is its middle."""
    rings = []
    for i in range(n):
        c, s = cos(tau * i / n), sin(tau * i / n)
        rings.append(
            np.array([((big + small * cos(a)) * c, (big + small * cos(a)) * s, small * sin(a)) for a in _octagon()])
        )
    skin = _skin(rings, closed=True)
    return tipped(skin, rot).to(*at)


def _octagon() -> list[float]:
    return [tau * i / 8 for i in range(8)]


def cloth(path: Sequence[tuple[float, float]], width: float, t: float = 0.4) -> Piece:
    """Return a band of thickness t along a polyline of z and y; its width is along x."""
    line = np.asarray(path, dtype=float)
    rings = []
    for index, (z, y) in enumerate(line):
        along = line[min(index + 1, len(line) - 1)] - line[max(index - 1, 0)]
        nz, ny = np.array([-along[1], along[0]]) / np.linalg.norm(along) * t / 2
        x = width / 2
        rings.append(np.array([(-x, y - ny, z - nz), (x, y - ny, z - nz), (x, y + ny, z + nz), (-x, y + ny, z + nz)]))
    return _skin(rings)


def bulge(w: float, h: float, d: float, power: float = 0.5, n: int = 20) -> Piece:
    """Return a soft, filled thing that is flat below: a loaf, a sack, a cushion or a heap of flour.

    Args:
        w: its width.
        h: its height.
        d: its depth.
        power: how far its outline is a rectangle (near 0) or an ellipse (1).
        n: the corners of its outline.
    """
    outline = []
    for i in range(n):
        c, s = cos(tau * i / n), sin(tau * i / n)
        outline.append((np.sign(c) * abs(c) ** power, np.sign(s) * abs(s) ** power))
    profile = [(0.84, 0.0), (0.97, 0.18), (1.0, 0.38), (0.95, 0.62), (0.78, 0.85), (0.45, 0.97)]
    points: list[Triple] = [(0, 0, 0)]
    for size, y in profile:
        points += [(float(cx) * w / 2 * size, y * h, float(cz) * d / 2 * size) for cx, cz in outline]
    points.append((0, h, 0))
    top = len(points) - 1
    faces: list[tuple[int, ...]] = [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)]
    for level in range(len(profile) - 1):
        low = 1 + level * n
        faces += [(low + i, low + n + i, low + n + (i + 1) % n, low + (i + 1) % n) for i in range(n)]
    faces += [(top, top - n + (i + 1) % n, top - n + i) for i in range(n)]
    return _mesh(np.array(points, dtype=float), faces)


def bent(r: float, thick: float, sweep: float = 200.0, n: int = 12) -> Piece:
    """Return a croissant that lies on y = 0: a horn along an arc of radius r."""
    rings = []
    for i in range(n + 1):
        angle = radians(sweep) * (i / n - 0.5)
        size = thick * (0.25 + 0.75 * sin(pi * i / n)) / 2
        out = np.array([sin(angle), 0, cos(angle)])
        centre = out * r + np.array([0, size, 0])
        rings.append(np.array([centre + size * (cos(a) * out + sin(a) * np.array([0, 1, 0])) for a in _octagon()]))
    return _skin(rings)
