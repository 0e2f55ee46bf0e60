"""Feet: points on the underside of objects, and how far the surfaces below them are."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.settings import FEET
from usd2kg.shapes.axis_rays import find_crossings
from usd2kg.shapes.extent import extent_of
from usd2kg.shapes.surface import Surface

__all__ = ["Tops", "find_feet", "find_tops", "find_undersides", "grid_feet", "underside_at"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_SAME_FACE = 1e-3
"""Metres: closer crossings are the two sides of a sheet."""
_UP = 2
_BLOCK = 1 << 9
"""Surfaces measured at a time, which bounds memory; the corners of so many are still cached when needed again."""


class Tops(NamedTuple):
    """For each foot, the highest face that is below it, or above it by at most a tolerance."""

    height: Array
    """NaN if there is none."""
    thickness: Array
    """Metres down to the next face; 0 if there is none."""
    cosine: Array
    """Cosine of the slope of the face: distance to the face = height above it × cosine."""


def grid_feet(lower: Array, upper: Array) -> Array:
    """Return a grid of points (n, 3) on the bottom of a box."""
    shares = (np.arange(FEET.grid) + 0.5) / FEET.grid
    x, y = (lower[axis] + shares * (upper[axis] - lower[axis]) for axis in range(_UP))
    return np.column_stack([np.tile(x, FEET.grid), np.repeat(y, FEET.grid), np.full(FEET.grid**2, lower[_UP])])


def find_undersides(surfaces: Sequence[Surface]) -> list[Array]:
    """Return points (n, 3) on the whole underside of each surface, on a grid over its footprint."""
    return [points for some in _blocks(surfaces) for points in _undersides_of(some)]


def _undersides_of(surfaces: Sequence[Surface]) -> list[Array]:
    grids = [grid_feet(*extent_of(surface.corners)) for surface in surfaces]
    lowest = np.split(underside_at(grids, surfaces), len(surfaces))
    return [
        np.column_stack([grid[:, :_UP], heights])[np.isfinite(heights)]
        for grid, heights in zip(grids, lowest, strict=True)
    ]


def find_feet(surfaces: Sequence[Surface], height: float) -> list[Array]:
    """Return points (n, 3) on the underside of each surface, no higher than `height` above its bottom.

    They are spread evenly: a grid where the underside is broad, corners of the surface for legs and round bottoms.
    """
    return [points for some in _blocks(surfaces) for points in _feet_of(some, height)]


def _feet_of(surfaces: Sequence[Surface], height: float) -> list[Array]:
    low = [_low_corners(surface, height) for surface in surfaces]
    grids = [grid_feet(*extent_of(corners)) for corners in low]
    undersides = np.split(underside_at(grids, surfaces), len(surfaces))
    feet = []
    for corners, grid, underside in zip(low, grids, undersides, strict=True):
        broad = np.flatnonzero(underside <= corners[:, _UP].min() + height)
        if len(broad) >= FEET.min_grid_share * len(grid):
            lowest = corners[[int(corners[:, _UP].argmin())]]
            feet.append(np.concatenate([lowest, np.column_stack([grid[broad, :_UP], underside[broad]])]))
        else:
            feet.append(_spread(corners))
    return feet


def _blocks(surfaces: Sequence[Surface]) -> Iterator[Sequence[Surface]]:
    return (surfaces[start : start + _BLOCK] for start in range(0, len(surfaces), _BLOCK))


def _low_corners(surface: Surface, height: float) -> Array:
    corners = surface.corners.reshape(-1, 3)
    return np.asarray(corners[corners[:, _UP] <= corners[:, _UP].min() + height])


def _spread(corners: Array) -> Array:
    """Return the lowest corner in each cell of a grid, so that a finely modelled leg does not outweigh the others."""
    first, last = (corner[:_UP] for corner in extent_of(corners))
    cell = max(float((last - first).max()) / FEET.grid, _SAME_FACE)
    corners = corners[np.argsort(corners[:, _UP], kind="stable")]
    place = ((corners[:, :_UP] - first) // cell).astype(np.int64)
    _, kept = np.unique(place[:, 0] * (FEET.grid + 1) + place[:, 1], return_index=True)
    return np.asarray(corners[kept])


def underside_at(points: Sequence[Array], surfaces: Sequence[Surface]) -> Array:
    """Return the height of the underside of a surface over or under each of its points (n, 3); inf beside it.

    Args:
        points: for each surface, at least one point.
        surfaces: the surfaces.
    """
    found = find_crossings(points, surfaces, _UP)
    lowest = np.full(sum(map(len, points)), np.inf)
    np.minimum.at(lowest, found.line, found.at)
    return lowest


def find_tops(feet: Sequence[Array], surfaces: Sequence[Surface], max_sink: Array) -> Tops:
    """Return the faces of surfaces below feet.

    Args:
        feet: for each surface, points (n, 3), at least one; the result has one row per point, in this order.
        surfaces: the surfaces.
        max_sink: for each point, how far above it a face may be, in metres.
    """
    found = find_crossings(feet, surfaces, _UP)
    count = np.array([len(some) for some in feet], np.int64)
    orientation = np.repeat(np.array([surface.orientation for surface in surfaces]), count)
    level = np.concatenate([np.zeros(0), *(some[:, _UP] for some in feet)]) + max_sink
    is_reached = found.at <= level[found.line]
    order = np.lexsort((-found.at[is_reached], found.line[is_reached]))
    line, at, faces = found.line[is_reached][order], found.at[is_reached][order], found.faces[is_reached][order]
    # The faces of a sheet may be authored to face down.
    faces_up = faces * orientation[line] >= 0
    height, cosine, below = (np.full(len(level), np.nan) for _ in range(3))
    _fill_first(height, line[faces_up], at[faces_up])
    _fill_first(cosine, line[faces_up], np.abs(faces[faces_up]))
    is_lower = at < height[line] - _SAME_FACE
    _fill_first(below, line[is_lower], at[is_lower])
    return Tops(height, np.where(np.isfinite(below), height - below, 0.0), cosine)


def _fill_first(values: Array, line: Indices, at: Array) -> None:
    """Set the value of each line to the first one given for it; lines are sorted."""
    first = np.flatnonzero(np.diff(line, prepend=-1))
    values[line[first]] = at[first]
