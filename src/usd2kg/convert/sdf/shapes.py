"""Shapes of SDFormat that are neither solids of USD nor files: planes and polylines."""

from importlib import import_module

import numpy as np
from numpy.typing import NDArray

from usd2kg.convert.prims import SourceMesh

__all__ = ["extrude", "plane"]


def plane(normal: tuple[float, ...], size: tuple[float, ...]) -> SourceMesh:
    """Return a rectangle of a size in x and y whose centre is the origin, turned the shortest way to a normal."""
    x, y = size[0] / 2, size[1] / 2
    corners = np.array([(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], np.float64)
    return SourceMesh(corners @ _turn_from_z(np.asarray(normal, np.float64)).T, [(0, 1, 2), (0, 2, 3)])


def _turn_from_z(normal: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the shortest rotation from z to a direction (Rodrigues' formula); about x if they are opposite."""
    x, y, z = normal / np.linalg.norm(normal)
    if z < -1 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    # The axis is the cross product of z and the normal: (-y, x, 0).
    cross = np.array([(0, 0, x), (0, 0, y), (-x, -y, 0)], np.float64)
    turn: NDArray[np.float64] = np.eye(3) + cross + cross @ cross / (1 + z)
    return turn


def extrude(rings: list[NDArray[np.float64]], height: float) -> SourceMesh:
    """Return the solid over a polygon from z = 0 to `height`.

    Args:
        rings: (n, 2) each, without the first point again: the outline, then holes. In any direction.
        height: metres.

    Raises:
        ModuleNotFoundError: mapbox-earcut is not installed.
    """
    earcut = import_module("mapbox_earcut")
    turned = [ring if (_area(ring) > 0) == (index == 0) else ring[::-1] for index, ring in enumerate(rings)]
    flat = np.concatenate(turned)
    ends = np.cumsum([len(ring) for ring in turned]).astype(np.uint32)
    cap = np.asarray(earcut.triangulate_float64(flat, ends), np.int32).reshape(-1, 3)
    corners = flat[cap]
    is_clockwise = np.array([_area(corner) < 0 for corner in corners], bool)
    cap[is_clockwise] = cap[is_clockwise, ::-1]
    count = len(flat)
    walls = []
    start = 0
    for end in ends.tolist():
        here = np.arange(start, end)
        after = np.roll(here, -1)
        walls.append(np.stack([here, after, after + count], axis=1))
        walls.append(np.stack([here, after + count, here + count], axis=1))
        start = end
    points = np.concatenate([np.c_[flat, np.zeros(count)], np.c_[flat, np.full(count, height)]])
    return SourceMesh(points, np.concatenate([cap[:, ::-1], cap + count, *walls]))


def _area(ring: NDArray[np.float64]) -> float:
    """Return the signed area of a polygon, positive if it is counter-clockwise."""
    x, y = ring.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)
