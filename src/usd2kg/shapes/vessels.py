"""Capacity of an object in its pose: rain on a height field, leaks through voxels."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.ragged import ragged_indices
from usd2kg.shapes.settings import VESSEL

__all__ = ["NO_VESSEL", "Vessel", "measure_vessel"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_SOLID = np.uint8(255)
"""Water level of a voxel impermeable to water."""
_CHUNK = 1 << 19
"""Cells or samples processed at a time, which bounds memory."""
_EDGE_TOLERANCE = 1e-9
"""In cells: keeps a cell centre on a shared edge from falling between two triangles."""
_INSET = 1e-6
"""In cells: keeps the upper end of the box inside the last cell. Spans narrower than this have no usable slope."""


class Vessel(NamedTuple):
    """The water that an object holds."""

    openness: float
    """Volume of the water / (area seen from above × height), 0 to below 1."""
    capacity_m3: float
    """Volume of the water in cubic metres."""


NO_VESSEL = Vessel(0.0, 0.0)


class _NormalizedMesh(NamedTuple):
    """Triangles in a box along the minimum rectangle of the footprint."""

    corners: Array
    """(m, 3, 3), scaled to 0 … 1 along each side of the box."""
    is_wall: NDArray[np.bool_]
    """(m,), whether a triangle is nearly vertical."""
    volume: float
    """Volume of the box in cubic metres."""


def measure_vessel(points: Array, triangles: Indices, plan: Array) -> Vessel:
    """Return the water that triangles hold after vertical rain.

    Depressions of the height field over the footprint are filled up to their spill level (Planchon & Darboux 2001;
    equivalent to priority flood, Barnes et al. 2014), but no higher than to where they leak sideways through gaps in
    voxels. A coarse pass rejects most objects: hollows narrower than 1/32 of the footprint are ignored.

    Args:
        points: (n, 3), metres, z-up, with a positive extent along each axis.
        triangles: (m, 3), indices into `points`; all points are used.
        plan: (2, 2), rows are the unit vectors along the sides of the footprint's rectangle.
    """
    x, y = plan
    upright = points @ np.array([[*x, 0.0], [*y, 0.0], [0.0, 0.0, 1.0]]).T
    extent = np.ptp(upright, axis=0)
    corners = upright[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    is_wall = np.abs(normals[:, 2]) <= VESSEL.wall_cosine * np.linalg.norm(normals, axis=1)
    mesh = _NormalizedMesh((corners - upright.min(axis=0)) / extent, is_wall, float(extent.prod()))
    coarse = _height_field(mesh, VESSEL.cells // VESSEL.coarse_factor)
    if not (_water_depth(coarse, np.inf) > VESSEL.min_depth).any():
        return NO_VESSEL
    top = _height_field(mesh, VESSEL.cells)
    depth = _water_depth(top, _leak_levels(mesh.corners, len(top) - 2))
    water = float(depth[depth > VESSEL.min_depth].sum())
    if water <= 0:
        return NO_VESSEL
    return Vessel(water / float(np.isfinite(top).sum()), water * mesh.volume / (len(top) - 2) ** 2)


def _water_depth(top: Array, max_level: Array | float) -> Array:
    """Return the depth of the water over each cell of a height field, with its surface no higher than `max_level`."""
    is_covered = np.isfinite(top)
    ground = np.where(is_covered, top, 0.0)
    return _fill_depressions(ground, np.where(is_covered, np.maximum(ground, max_level), 0.0)) - ground


def _height_field(mesh: _NormalizedMesh, cells: int) -> Array:
    """Return the largest z over each cell, -inf over cells without triangles, with a border of empty cells.

    Args:
        mesh: the triangles.
        cells: number along each side; halved until the mesh is within the limits on samples.
    """
    while True:
        corners = mesh.corners * [cells - _INSET, cells - _INSET, 1] + [1, 1, 0]
        lines, rows = _edge_lines(corners[mesh.is_wall]), _covered_rows(corners)
        is_coarsest = cells <= VESSEL.min_cells
        if is_coarsest or rows.number.sum() <= VESSEL.max_rows:
            spans = _covered_spans(corners, rows)
            if is_coarsest or spans.number.sum() + lines.steps.sum() <= VESSEL.max_samples:
                break
        cells //= 2
    top = np.full((cells + 2, cells + 2), -np.inf)
    for x, y, z in (*_sample_spans(spans), *_sample_lines(lines)):
        np.maximum.at(top, (y, x), z)
    return top


class _Rows(NamedTuple):
    """The rows of cell centres that the AABB of each triangle covers."""

    first: Indices
    number: Indices


class _Spans(NamedTuple):
    """The cell centres that a triangle covers in one row."""

    row: Indices
    first: Indices
    """First column."""
    number: Indices
    """Number of columns."""
    z: Array
    """Height at the centre of the first column."""
    slope: Array
    """Increase of the height per column."""


def _covered_rows(corners: Array) -> _Rows:
    y = corners[..., 1]
    first = np.ceil(y.min(axis=1) - 0.5 - _EDGE_TOLERANCE).astype(np.int64)
    return _Rows(first, np.maximum(np.floor(y.max(axis=1) - 0.5 + _EDGE_TOLERANCE).astype(np.int64) - first + 1, 0))


def _covered_spans(corners: Array, rows: _Rows) -> _Spans:
    """Return the spans of triangles (m, 3, 3), x and y in cells."""
    of, nth = ragged_indices(rows.number)
    row = rows.first[of] + nth
    low, high = _crossings(corners[of], np.asarray(row + 0.5, np.float64))
    column = np.ceil(low[:, 0] - 0.5 - _EDGE_TOLERANCE)
    count = np.floor(high[:, 0] - 0.5 + _EDGE_TOLERANCE) - column + 1
    some = np.flatnonzero(count > 0)
    low, high, column = low[some], high[some], column[some]
    width = high[:, 0] - low[:, 0]
    slope = np.where(width > _INSET, (high[:, 1] - low[:, 1]) / np.maximum(width, _INSET), 0.0)
    z = low[:, 1] + slope * (column + 0.5 - low[:, 0])
    return _Spans(row[some], column.astype(np.int64), count[some].astype(np.int64), z, slope)


def _crossings(corners: Array, y: Array) -> tuple[Array, Array]:
    """Return (x, z) where triangles (k, 3, 3) enter and leave lines of constant y (k,); inf, -inf if they miss them."""
    low = np.tile([np.inf, 0.0], (len(y), 1))
    high = np.tile([-np.inf, 0.0], (len(y), 1))
    for i in range(3):
        start, end = corners[:, i], corners[:, (i + 1) % 3]
        rise = end[:, 1] - start[:, 1]
        share = (y - start[:, 1]) / np.where(rise == 0, np.nan, rise)
        crosses = (share >= -_EDGE_TOLERANCE) & (share <= 1 + _EDGE_TOLERANCE)
        at = (start + np.where(crosses, share, 0.0)[:, None] * (end - start))[:, [0, 2]]
        is_low, is_high = crosses & (at[:, 0] < low[:, 0]), crosses & (at[:, 0] > high[:, 0])
        low[is_low], high[is_high] = at[is_low], at[is_high]
    return low, high


def _sample_spans(spans: _Spans) -> Iterator[tuple[Indices, Indices, Array]]:
    """Yield column, row and z of the cells whose centres a triangle covers."""
    for chosen in _chunks(spans.number):
        of, nth = ragged_indices(spans.number[chosen])
        of = chosen[of]
        yield spans.first[of] + nth, spans.row[of], spans.z[of] + nth * spans.slope[of]


class _Lines(NamedTuple):
    """Line segments, each sampled in steps of at most half a cell."""

    start: Array
    end: Array
    steps: Indices


def _edge_lines(corners: Array) -> _Lines:
    """Return the edges of triangles (m, 3, 3)."""
    start, end = corners.reshape(-1, 3), np.roll(corners, -1, axis=1).reshape(-1, 3)
    return _Lines(start, end, _half_cell_steps((end - start)[:, :2]))


def _sample_lines(lines: _Lines) -> Iterator[tuple[Indices, Indices, Array]]:
    """Yield column, row and z of the cells that lines pass; consecutive cells touch, so that a wall has no gaps."""
    for chosen in _chunks(lines.steps + 1):
        steps = lines.steps[chosen]
        _, nth = ragged_indices(steps + 1)
        start, end = lines.start[chosen].T, lines.end[chosen].T
        x, y, z = np.repeat(start, steps + 1, axis=1) + nth * np.repeat((end - start) / steps, steps + 1, axis=1)
        yield x.astype(np.int64), y.astype(np.int64), z


def _leak_levels(corners: Array, cells: int) -> Array:
    """Return for each cell the highest water level above the visible surface that does not leak sideways, 0 to 1.

    A height field cannot distinguish a rail from a wall, or a cage from a tub. Therefore the box is divided into
    voxels: those with a surface in them are solid, and water passes all others. Gaps of one voxel may remain
    undetected.

    Args:
        corners: (m, 3, 3), scaled to 0 … 1 along each side of the box.
        cells: number of cells of the height field along each side, without its border.
    """
    side = cells // VESSEL.coarse_factor
    while True:
        lines = _scan_lines(corners * (side - _INSET) + 1)
        if (lines.steps + 1).sum() <= VESSEL.max_samples or side <= VESSEL.min_cells:
            break
        side //= 2
    is_solid = np.zeros((side + 2,) * 3, np.bool_)
    for x, y, z in _sample_lines(lines):
        is_solid[y, x, z.astype(np.int64)] = True
    # uint8 keeps the whole field in the processor's cache.
    height = np.broadcast_to(np.arange(side + 2, dtype=np.uint8), is_solid.shape)
    start = height.copy()
    start[1:-1, 1:-1, 1:-1] = _SOLID
    water = _fill_depressions(np.where(is_solid, _SOLID, height), start)
    seen = (is_solid * np.arange(side + 2)).max(axis=2, keepdims=True)
    level = np.take_along_axis(water, seen + 1, axis=2)[1:-1, 1:-1, 0]
    fine = np.kron((level - 1.0) / side, np.ones((cells // side, cells // side)))
    return np.pad(fine, 1)


def _scan_lines(corners: Array) -> _Lines:
    """Return lines that cover triangles (m, 3, 3), edges included, parallel to the shortest edge."""
    edges = np.abs(np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1)).max(axis=2)
    order = (edges.argmin(axis=1)[:, None] + np.arange(3)) % 3
    tip, a, b = np.moveaxis(np.take_along_axis(corners, order[..., None], axis=1), 1, 0)
    cuts = np.maximum(_half_cell_steps(a - tip), _half_cell_steps(b - tip))
    of, nth = ragged_indices(cuts + 1)
    share = (nth / cuts[of])[:, None]
    start, end = tip[of] + share * (a - tip)[of], tip[of] + share * (b - tip)[of]
    return _Lines(start, end, _half_cell_steps(end - start))


def _half_cell_steps(lines: Array) -> Indices:
    """Return the number of steps of at most half a cell along each axis for vectors (..., n)."""
    return np.asarray(np.maximum(np.ceil(2 * np.abs(lines).max(axis=-1)), 1), np.int64)


def _chunks(counts: Indices) -> Iterator[Indices]:
    """Yield the indices of positive counts in groups with a bounded sum."""
    some = np.flatnonzero(counts)
    part = np.cumsum(counts[some]) // _CHUNK
    yield from (chosen for chosen in np.split(some, np.flatnonzero(np.diff(part)) + 1) if len(chosen))


def _fill_depressions(ground: NDArray[Any], water: NDArray[Any]) -> NDArray[Any]:
    """Return the water level over a field of any dimension after all excess water has run off.

    Planchon & Darboux 2001: the level falls to the maximum of the ground and the lowest level among the neighbours, in
    sweeps along each axis in both directions until nothing changes. Cells that only share a corner are not neighbours,
    so that a wall of one cell is tight.

    Args:
        ground: heights; the largest number for solid cells.
        water: initial and largest level; on the border of the field, the level at which water leaves it.
    """
    water = water.copy()
    rows = [(list(np.moveaxis(water, i, 0)), list(np.moveaxis(ground, i, 0))) for i in range(water.ndim)]
    sweeps = [(here[::way], floor[::way]) for here, floor in rows for way in (1, -1)]
    unchanged = 0
    while unchanged < len(sweeps):
        for here, floor in sweeps:
            before = water.copy()
            for (last, row), ground_row in zip(pairwise(here), floor[1:], strict=True):
                np.minimum(row, np.maximum(ground_row, last), out=row)
            unchanged = unchanged + 1 if np.array_equal(before, water) else 0
    return water
