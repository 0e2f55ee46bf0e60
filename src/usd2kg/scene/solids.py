"""Surfaces of UsdGeom's solids: spheres, cylinders, cones, capsules, cubes, planes."""

import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from usd2kg.scene.settings import SOLIDS
from usd2kg.scene.stage import read_value

__all__ = ["ROUND_SOLIDS", "solid_surface"]

Points = NDArray[np.float64]
"""(n, 3)"""
Triangles = NDArray[np.int32]
"""(m, 3) indices into points, counter-clockwise seen from outside"""

ROUND_SOLIDS = frozenset({"Sphere", "Cylinder", "Cylinder_1", "Cone", "Capsule", "Capsule_1"})
"""Solids whose rotated local box is larger than their world box."""
_ARC_STEP = 10
"""Degrees between the rings of a sphere."""
_SQUARE_CORNERS = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
_SQUARE_TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
_CUBE_CORNERS = np.array([[x, y, z] for z in (-1.0, 1.0) for y in (-1.0, 1.0) for x in (-1.0, 1.0)])
_CUBE_QUADS = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]], np.int32)
_CUBE_TRIANGLES = np.concatenate([_CUBE_QUADS[:, [0, 1, 2]], _CUBE_QUADS[:, [0, 2, 3]]])


def solid_surface(prim: Any, time: Usd.TimeCode, segments: int = SOLIDS.segments) -> tuple[Points, Triangles] | None:
    """Return points and triangles of a solid in its own frame and stage units; None for other types.

    Round solids have `segments` points per ring; their boxes are too small by up to 1 - cos(π / segments) of the
    radius, 0.5 % with 32. A size that is not a number makes the points NaN.
    """

    def number(name: str) -> float:
        value = read_value(prim, name, time, int, float)
        return math.nan if value is None else float(value)

    solid = _solid(str(prim.GetTypeName()), number, segments)
    if solid is None:
        return None
    points, triangles = solid
    # A cyclic permutation of the axes keeps the orientation.
    order = {"X": [2, 0, 1], "Y": [1, 2, 0]}.get(read_value(prim, "axis", time, str) or "Z", [0, 1, 2])
    return points[:, order], triangles


def _solid(type_name: str, number: Callable[[str], float], segments: int) -> tuple[Points, Triangles] | None:
    """Return a UsdGeom solid about the z axis; None for other types."""
    half, radius = number("height") / 2, number("radius")
    # Cylinder_1 and Capsule_1 have a radius at each end.
    low, high = (radius, radius) if math.isfinite(radius) else (number("radiusBottom"), number("radiusTop"))
    match type_name.removesuffix("_1"):
        case "Cube":
            return _CUBE_CORNERS * (number("size") / 2), _CUBE_TRIANGLES
        case "Plane":
            return _SQUARE_CORNERS * np.array([number("width") / 2, number("length") / 2, 0]), _SQUARE_TRIANGLES
        case "Sphere":
            profile = [*_arc(radius, 0.0, -90, 90)]
        case "Cylinder":
            profile = [(0, -half), (low, -half), (high, half), (0, half)]
        case "Cone":
            profile = [(0, -half), (radius, -half), (0, half)]
        case "Capsule":
            profile = [*_arc(low, -half, -90, 0), *_arc(high, half, 0, 90)]
        case _:
            return None
    return _revolve(profile, segments)


def _arc(radius: float, middle: float, start: int, end: int) -> Iterator[tuple[float, float]]:
    for degrees in np.linspace(start, end, 1 + (end - start) // _ARC_STEP):
        # Exactly 0 at the poles, where _revolve makes no triangles.
        distance = 0.0 if abs(degrees) == 90 else radius * math.cos(math.radians(degrees))
        yield distance, middle + radius * math.sin(math.radians(degrees))


def _revolve(profile: list[tuple[float, float]], segments: int) -> tuple[Points, Triangles]:
    """Return the solid of revolution about z of a profile of (distance from the axis, height) from the bottom up."""
    angles = np.arange(segments) * (2 * math.pi / segments)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    rings = [np.column_stack([circle * distance, np.full(segments, height)]) for distance, height in profile]
    here = np.arange(segments, dtype=np.int32)
    after = (here + 1) % segments
    # A radius of 0 leaves no triangles.
    triangles = [np.empty((0, 3), np.int32)]
    for i, ((low, _), (high, _)) in enumerate(pairwise(profile)):
        below, above = i * segments, (i + 1) * segments
        if low != 0:
            triangles.append(np.stack([below + here, below + after, above + after], axis=1))
        if high != 0:
            triangles.append(np.stack([below + here, above + after, above + here], axis=1))
    return np.concatenate(rings), np.concatenate(triangles).astype(np.int32)
