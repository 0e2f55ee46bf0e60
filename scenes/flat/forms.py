"""Shapes of things: blocks and solids of revolution, given in `forms.csv` as fractions of a thing's size."""

import csv
import math
from functools import cache
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from scenes.writer.mesh import Vec3

SIDES = 8
"""Number of points of each ring of a solid of revolution."""

PROFILES: dict[str, list[tuple[float, float]]] = {
    "cyl": [(1, 0), (1, 1)],
    "ball": [(0.4, 0), (0.85, 0.2), (1, 0.5), (0.85, 0.8), (0.4, 1)],
    "bottle": [(1, 0), (1, 0.62), (0.36, 0.8), (0.36, 1)],
    "cup": [(0.85, 0), (1, 1), (0.92, 1), (0.77, 0.08)],
    "bowl": [(0.5, 0), (1, 1), (0.93, 1), (0.45, 0.1)],
    "dish": [(0.7, 0), (1, 1), (0.95, 1), (0.65, 0.15)],
    "plate": [(0.6, 0), (1, 0.9), (1, 1), (0.6, 0.3)],
    "vase": [(0.6, 0), (1, 0.4), (0.6, 1), (0.5, 1), (0.88, 0.4), (0.5, 0.06)],
    "goblet": [(0.8, 0), (0.1, 0.05), (0.1, 0.45), (1, 0.7), (0.8, 1), (0.76, 1), (0.94, 0.7), (0.1, 0.5)],
}
"""Rings of (radius, height) as fractions, from the bottom up the outside and down the inside."""

BLOCK_FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
"""Faces of a block; bits 0, 1 and 2 of a corner's number are set for high x, y and z."""


class Part(NamedTuple):
    """A closed mesh; faces are counter-clockwise seen from outside."""

    name: str
    points: list[Vec3]
    """Metres, frame of the thing: Z up, origin at the middle of its underside, front towards -y."""
    faces: list[tuple[int, ...]]

    @property
    def is_block(self) -> bool:
        """Whether the part is one axis-aligned block."""
        return self.faces == BLOCK_FACES


class _Piece(NamedTuple):
    part: str
    profile: str
    low: Vec3
    high: Vec3


@cache
def _pieces() -> dict[str, list[_Piece]]:
    found: dict[str, list[_Piece]] = {}
    with Path(__file__).with_name("forms.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            low = (float(row["x0"]), float(row["y0"]), float(row["z0"]))
            high = (float(row["x1"]), float(row["y1"]), float(row["z1"]))
            found.setdefault(row["form"], []).append(_Piece(row["part"], row["profile"], low, high))
    return found


def make_parts(form: str, size: Vec3) -> list[Part]:
    """Return the parts of a form scaled to `size`, the extents along x, y and z in metres."""
    return [_scale(_make(piece), piece, size) for piece in _pieces()[form]]


def merge_parts(parts: list[Part], name: str) -> Part:
    """Return all parts in one mesh."""
    points = list(chain.from_iterable(part.points for part in parts))
    faces: list[tuple[int, ...]] = []
    start = 0
    for part in parts:
        faces += [tuple(start + index for index in face) for face in part.faces]
        start += len(part.points)
    return Part(name, points, faces)


def _scale(unit: Part, piece: _Piece, size: Vec3) -> Part:
    """Return a shape of the unit cube scaled to its piece; rounded to 1 mm, or to 0.1 mm for things below 12 cm."""
    digits = 3 if max(size) >= 0.12 else 4
    points = []
    for point in unit.points:
        lie = [lo + (hi - lo) * at for lo, hi, at in zip(piece.low, piece.high, point, strict=True)]
        x, y, z = (round(at * length, digits) + 0.0 for at, length in zip(lie, size, strict=True))
        points.append((x, y, z))
    return unit._replace(points=points)


def _make(piece: _Piece) -> Part:
    if not piece.profile:
        corners = [(float(n & 1), float(n >> 1 & 1), float(n >> 2 & 1)) for n in range(8)]
        return Part(piece.part, corners, list(BLOCK_FACES))
    profile, _, axis = piece.profile.partition("@")
    turned = _turn(piece.part, PROFILES[profile])
    if axis == "y":
        # A cyclic change of axes is a rotation, so the orientation of faces is kept.
        turned = turned._replace(points=[(y, z, x) for x, y, z in turned.points])
    return turned


def _turn(name: str, profile: list[tuple[float, float]]) -> Part:
    angles = [2 * math.pi * side / SIDES for side in range(SIDES)]
    # Stretch the rings so that the polygon touches its box in y as it does in x.
    reach = max(math.sin(angle) for angle in angles)
    points = [
        (0.5 + radius * math.cos(angle) / 2, 0.5 + radius * math.sin(angle) / reach / 2, height)
        for radius, height in profile
        for angle in angles
    ]
    last = (len(profile) - 1) * SIDES
    faces = [tuple(range(SIDES - 1, -1, -1)), tuple(range(last, last + SIDES))]
    for ring in range(0, last, SIDES):
        for side in range(SIDES):
            along = (side + 1) % SIDES
            faces.append((ring + side, ring + along, ring + along + SIDES, ring + side + SIDES))
    return Part(name, points, faces)
