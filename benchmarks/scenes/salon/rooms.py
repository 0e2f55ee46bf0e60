"""The walls of the salon, and places at them."""

from collections.abc import Sequence

import numpy as np

from benchmarks.scenes.salon.shapes import Shape, box, merge, turn
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = ["WALLS", "at_wall", "build_rooms", "hang"]

WALLS = {
    "shop north": (0.0, "y", 6.0),
    "shop east": (-90.0, "x", 6.0),
    "shop south": (180.0, "y", 0.0),
    "shop west": (90.0, "x", 0.0),
    "back north": (0.0, "y", 3.8),
    "back east": (-90.0, "x", 9.2),
    "back south": (180.0, "y", 0.0),
    "back west": (90.0, "x", 6.12),
    "wc north": (0.0, "y", 6.0),
    "wc east": (-90.0, "x", 9.2),
    "wc south": (180.0, "y", 3.92),
    "wc west": (90.0, "x", 6.12),
}
"""Face of a wall → yaw of what has it at its back, the axis across it, its coordinate."""
HEIGHT = 2.8


def at_wall(wall: str, along: float, off: float) -> tuple[float, float]:
    """Return the place in the plan at a coordinate along a wall, `off` metres before its face."""
    yaw, axis, face = WALLS[wall]
    face -= off if yaw in (0.0, -90.0) else -off
    return (along, face) if axis == "y" else (face, along)


def hang(salon: Salon, path: str, asset: Asset, wall: str, along: float, z: float, gap: float = 0.0) -> None:
    """Fix an asset with its back to a wall; a negative gap sinks it in."""
    back = float(asset.shape.points[:, 1].max())
    salon.put(path, asset, (*at_wall(wall, along, back + gap), z), WALLS[wall][0])


def build_rooms(salon: Salon) -> None:
    """Add the floor, the ceiling, and all walls as one mesh with the openings of the windows and doors."""
    _add(salon, "Building/Floor", box(-0.2, 9.4, -0.2, 6.2, -0.15, 0))
    _add(salon, "Building/Ceiling", box(-0.2, 9.4, -0.2, 6.2, HEIGHT, HEIGHT + 0.15))
    south = _wall((-0.2, 9.4), [(0.6, 2.6, 0.8, 2.3), (3.3, 4.3, 0, 2.1)])
    north = _wall((-0.2, 9.4), [(6.9, 7.7, 1.4, 2.2)])
    across = _wall((6.12, 9.2), [(6.5, 7.3, 0, 2.05)], 0.12)
    along = turn(_wall((0, 6), [(1.4, 2.4, 0, 2.05)], 0.12), "z", 90)
    walls = merge(
        _shift(south, y=-0.1),
        _shift(north, y=6.1),
        box(-0.2, 0, 0, 6, 0, HEIGHT),
        box(9.2, 9.4, 0, 6, 0, HEIGHT),
        _shift(across, y=3.86),
        _shift(along, x=6.06),
    )
    _add(salon, "Building/Walls", walls)


def _add(salon: Salon, path: str, shape: Shape) -> None:
    salon.put(path, Asset(path.replace("/", "_"), shape), (0, 0, 0))


def _shift(shape: Shape, x: float = 0.0, y: float = 0.0) -> Shape:
    return Shape(shape.points + np.array([x, y, 0]), shape.faces)


def _wall(
    ends: tuple[float, float], openings: Sequence[tuple[float, float, float, float]], thickness: float = 0.2
) -> Shape:
    """Return a wall along x, centred at y = 0, with openings x0 x1 z0 z1 from left to right."""
    half = thickness / 2
    parts = []
    left = ends[0]
    for x0, x1, z0, z1 in openings:
        parts.append(box(left, x0, -half, half, 0, HEIGHT))
        parts.append(box(x0, x1, -half, half, z1, HEIGHT))
        if z0 > 0:
            parts.append(box(x0, x1, -half, half, 0, z0))
        left = x1
    return merge(*parts, box(left, ends[1], -half, half, 0, HEIGHT))
