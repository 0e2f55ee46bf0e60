"""Compound shapes in centimetres, Y up, front towards +z."""

from collections.abc import Sequence

from scenes.writer.mesh import Mesh, Vec3, moved
from scenes.writer.shapes import Point2, box, cylinder, lathe, tube


def block(size: Vec3, at: Vec3 = (0, 0, 0), bevel: float = 0.0) -> Mesh:
    """Return a box of (width, height, depth) with its bottom face centred on `at`."""
    w, h, d = size
    x, y, z = at
    return box((x - w / 2, y, z - d / 2), (x + w / 2, y + h, z + d / 2), bevel)


def rod(start: Vec3, end: Vec3, radius: float, segments: int = 6) -> Mesh:
    """Return a round bar between two points."""
    return tube([start, end], radius, segments)


def disc(at: Vec3, radius: float, thickness: float, axis: str = "x", segments: int = 14) -> Mesh:
    """Return a wheel or plate centred on `at` with its axle along `axis`."""
    turns: dict[str, Vec3] = {"x": (0, 0, 90), "y": (0, 0, 0), "z": (90, 0, 0)}
    upright = cylinder((0, -thickness / 2, 0), radius, thickness, segments=segments)
    return moved(upright, by=at, turn=turns[axis])


def turned(outline: Sequence[Point2], at: Vec3 = (0, 0, 0), segments: int = 14) -> Mesh:
    """Return a solid of revolution standing on `at`; the outline is (radius, height) up the outside."""
    profile = [(0.0, outline[0][1]), *outline, (0.0, outline[-1][1])]
    clean = [p for k, p in enumerate(profile) if not k or p != profile[k - 1]]
    return moved(lathe(clean, segments), by=at)


def pail(low: float, high: float, height: float, wall: float = 0.5, segments: int = 14) -> Mesh:
    """Return an open vessel with its radius at the bottom and at the top."""
    outside: list[Point2] = [(0, 0), (low, 0), (high, height)]
    return lathe([*outside, (high - wall, height), (low - wall, wall), (0, wall)], segments)


def tray(size: Vec3, wall: float, at: Vec3 = (0, 0, 0)) -> list[Mesh]:
    """Return bottom and sides of an open box of (width, height, depth)."""
    w, h, d = size
    x, y, z = at
    side = (w - wall) / 2
    end = (d - wall) / 2
    return [
        block((w, wall, d), at),
        block((wall, h - wall, d), (x - side, y + wall, z)),
        block((wall, h - wall, d), (x + side, y + wall, z)),
        block((w - 2 * wall, h - wall, wall), (x, y + wall, z - end)),
        block((w - 2 * wall, h - wall, wall), (x, y + wall, z + end)),
    ]


def legs(width: float, depth: float, height: float, thick: float) -> list[Mesh]:
    """Return square legs in the corners of a footprint."""
    x, z = (width - thick) / 2, (depth - thick) / 2
    return [block((thick, height, thick), (i * x, 0, j * z)) for i in (-1, 1) for j in (-1, 1)]
