"""How much water a thing holds, as it stands: rain on a height field, leaks through voxels."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["NO_VESSEL", "Vessel", "measure_vessel"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_CELLS = 128
"""Cells of the height field along each side of the footprint, fewer where they would take too long."""
_COARSE = 2
"""Cells at a first glance, and voxels, are larger than cells by this factor."""
_TIGHT = np.uint8(255)
_FEWEST_CELLS = 8
_RIPPLE = 1e-3
"""Water that is less deep, in heights of the object, is there for the cells only."""
_STEEP = 0.25
"""Triangles whose unit normal rises less than this are walls: cell middles would miss them."""
_CHUNK = 1 << 19
"""The most cells or samples that are worked on at once."""
_MOST_SAMPLES = 3_000_000
"""The most for one object; a mesh needs more where very many large triangles lie above each other."""
_MOST_ROWS = 750_000
"""The most rows of cells under triangles."""
_NEAR = 1e-9
"""In cells: nothing may slip between two triangles that share an edge."""


class Vessel(NamedTuple):
    """The water that stays in a thing."""

    openness: float
    """Volume of the water / (area seen from above × height), 0 to below 1."""
    capacity_m3: float
    """Volume of the water in cubic metres."""


NO_VESSEL = Vessel(0.0, 0.0)


class _Upright(NamedTuple):
    """Triangles along the rectangle around the footprint."""

    corners: Array
    """(m, 3, 3), from 0 to 1 across the box: heights, too, so that cells and voxels fit it."""
    is_steep: NDArray[np.bool_]
    volume: float
    """Of the box, in cubic metres."""


def measure_vessel(points: Array, triangles: Indices, plan: Array) -> Vessel:
    """Return how much water stays in triangles after rain from straight above.

    Depressions of the height field over the footprint are filled to where they overflow (Planchon & Darboux 2001; the
    same as priority flood, Barnes et al. 2014), but no higher than to where they leak sideways, through gaps in
    voxels. Most things hold nothing at a first glance on coarse cells and are not looked at further: hollows narrower
    than 1/32 of the footprint do not count.

    Args:
        points: (n, 3), metres, z-up; they extend along all three axes.
        triangles: (m, 3), indices into `points`; all points are used.
        plan: (2, 2), rows are the unit vectors along the sides of the rectangle to lay the cells along.
    """
    x, y = plan
    upright = points @ np.array([[*x, 0.0], [*y, 0.0], [0.0, 0.0, 1.0]]).T
    extent = np.ptp(upright, axis=0)
    corners = upright[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    is_steep = np.abs(normals[:, 2]) <= _STEEP * np.linalg.norm(normals, axis=1)
    thing = _Upright((corners - upright.min(axis=0)) / extent, is_steep, float(extent.prod()))
    glance = _height_field(thing, _CELLS // _COARSE)
    if not (_rain_on(glance, np.inf) > _RIPPLE).any():
        return NO_VESSEL
    top = _height_field(thing, _CELLS)
    depth = _rain_on(top, _leak_levels(thing.corners, len(top) - 2))
    water = float(depth[depth > _RIPPLE].sum())
    if water <= 0:
        return NO_VESSEL
    return Vessel(water / float(np.isfinite(top).sum()), water * thing.volume / (len(top) - 2) ** 2)


def _rain_on(top: Array, most: Array | float) -> Array:
    """Return how deep water stands over each cell of a height field, where its surface rises no higher than `most`."""
    is_covered = np.isfinite(top)
    ground = np.where(is_covered, top, 0.0)
    return _filled(ground, np.where(is_covered, np.maximum(ground, most), 0.0)) - ground


def _height_field(thing: _Upright, cells: int) -> Array:
    """Return the highest z over each cell, -inf where there is nothing; a ring of cells around it is empty.

    Args:
        thing: what stands there.
        cells: along each side; fewer are taken where that would take too long.
    """
    while True:
        corners = thing.corners * [cells - 1e-6, cells - 1e-6, 1] + [1, 1, 0]
        lines, rows = _lines_of(corners[thing.is_steep]), _rows_under(corners)
        is_coarsest = cells <= _FEWEST_CELLS
        if is_coarsest or rows.number.sum() <= _MOST_ROWS:
            spans = _spans_of(corners, rows)
            if is_coarsest or spans.number.sum() + lines.steps.sum() <= _MOST_SAMPLES:
                break
        cells //= 2
    top = np.full((cells + 2, cells + 2), -np.inf)
    for x, y, z in (*_over_middles(spans), *_along(lines)):
        np.maximum.at(top, (y, x), z)
    return top


class _Rows(NamedTuple):
    """For each triangle the rows of cells whose middles its box covers."""

    first: Indices
    number: Indices


class _Spans(NamedTuple):
    """Cells whose middles a triangle covers, one item for each triangle and row."""

    row: Indices
    first: Indices
    """The first column."""
    number: Indices
    """How many columns."""
    z: Array
    """Height over the middle of the first column."""
    slope: Array
    """How much it rises from column to column."""


def _rows_under(corners: Array) -> _Rows:
    y = corners[..., 1]
    first = np.ceil(y.min(axis=1) - 0.5 - _NEAR).astype(np.int64)
    return _Rows(first, np.maximum(np.floor(y.max(axis=1) - 0.5 + _NEAR).astype(np.int64) - first + 1, 0))


def _spans_of(corners: Array, rows: _Rows) -> _Spans:
    """Return the spans of triangles (m, 3, 3), x and y in cells."""
    of, nth = _spread(rows.number)
    row = rows.first[of] + nth
    low, high = _crossings(corners[of], np.asarray(row + 0.5, np.float64))
    column = np.ceil(low[:, 0] - 0.5 - _NEAR)
    count = np.floor(high[:, 0] - 0.5 + _NEAR) - column + 1
    some = np.flatnonzero(count > 0)
    low, high, column = low[some], high[some], column[some]
    width = high[:, 0] - low[:, 0]
    # On what is narrower the slope would be rounding.
    slope = np.where(width > 1e-6, (high[:, 1] - low[:, 1]) / np.maximum(width, 1e-6), 0.0)
    z = low[:, 1] + slope * (column + 0.5 - low[:, 0])
    return _Spans(row[some], column.astype(np.int64), count[some].astype(np.int64), z, slope)


def _crossings(corners: Array, y: Array) -> tuple[Array, Array]:
    """Return (x, z) where triangles (k, 3, 3) enter and leave lines of constant y (k,); inf, -inf where they do not."""
    low = np.tile([np.inf, 0.0], (len(y), 1))
    high = np.tile([-np.inf, 0.0], (len(y), 1))
    for i in range(3):
        start, end = corners[:, i], corners[:, (i + 1) % 3]
        rise = end[:, 1] - start[:, 1]
        share = (y - start[:, 1]) / np.where(rise == 0, np.nan, rise)
        crosses = (share >= -_NEAR) & (share <= 1 + _NEAR)
        at = (start + np.where(crosses, share, 0.0)[:, None] * (end - start))[:, [0, 2]]
        is_low, is_high = crosses & (at[:, 0] < low[:, 0]), crosses & (at[:, 0] > high[:, 0])
        low[is_low], high[is_high] = at[is_low], at[is_high]
    return low, high


def _over_middles(spans: _Spans) -> Iterator[tuple[Indices, Indices, Array]]:
    """Yield column, row and z where a triangle covers the middle of a cell."""
    for chosen in _chunks(spans.number):
        of, nth = _spread(spans.number[chosen])
        of = chosen[of]
        yield spans.first[of] + nth, spans.row[of], spans.z[of] + nth * spans.slope[of]


class _Lines(NamedTuple):
    """Edges of triangles, each cut into steps of at most half a cell."""

    start: Array
    end: Array
    steps: Indices


def _lines_of(corners: Array) -> _Lines:
    start, end = corners.reshape(-1, 3), np.roll(corners, -1, axis=1).reshape(-1, 3)
    return _Lines(start, end, _half_cells((end - start)[:, :2]))


def _along(lines: _Lines) -> Iterator[tuple[Indices, Indices, Array]]:
    """Yield column, row and z of the cells that lines pass: cells in a row touch, so that a wall is tight."""
    for chosen in _chunks(lines.steps + 1):
        steps = lines.steps[chosen]
        _, nth = _spread(steps + 1)
        start, end = lines.start[chosen].T, lines.end[chosen].T
        x, y, z = np.repeat(start, steps + 1, axis=1) + nth * np.repeat((end - start) / steps, steps + 1, axis=1)
        yield x.astype(np.int64), y.astype(np.int64), z


def _leak_levels(corners: Array, cells: int) -> Array:
    """Return for each cell how high water can stand on what is seen from above before it leaks sideways, from 0 to 1.

    A height field takes a rail for a wall, a cage for a tub. So the box is cut into voxels, those with a surface in
    them are tight, and water sinks through the others as it does over the cells. Gaps of one voxel may go unnoticed.

    Args:
        corners: (m, 3, 3), from 0 to 1 across the box.
        cells: of the height field along each side, without its ring.
    """
    side = cells // _COARSE
    while True:
        rows = _rows_of(corners * (side - 1e-6) + 1)
        if (rows.steps + 1).sum() <= _MOST_SAMPLES or side <= _FEWEST_CELLS:
            break
        side //= 2
    is_solid = np.zeros((side + 2,) * 3, np.bool_)
    for x, y, z in _along(rows):
        is_solid[y, x, z.astype(np.int64)] = True
    # Small numbers: the whole field stays close to the processor.
    height = np.broadcast_to(np.arange(side + 2, dtype=np.uint8), is_solid.shape)
    start = height.copy()
    start[1:-1, 1:-1, 1:-1] = _TIGHT
    water = _filled(np.where(is_solid, _TIGHT, height), start)
    seen = (is_solid * np.arange(side + 2)).max(axis=2, keepdims=True)
    level = np.take_along_axis(water, seen + 1, axis=2)[1:-1, 1:-1, 0]
    fine = np.kron((level - 1.0) / side, np.ones((cells // side, cells // side)))
    return np.pad(fine, 1)


def _rows_of(corners: Array) -> _Lines:
    """Return lines across triangles (m, 3, 3), edges included, from the corner across from the shortest edge to it."""
    edges = np.abs(np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1)).max(axis=2)
    order = (edges.argmin(axis=1)[:, None] + np.arange(3)) % 3
    tip, a, b = np.moveaxis(np.take_along_axis(corners, order[..., None], axis=1), 1, 0)
    cuts = np.maximum(_half_cells(a - tip), _half_cells(b - tip))
    of, nth = _spread(cuts + 1)
    share = (nth / cuts[of])[:, None]
    start, end = tip[of] + share * (a - tip)[of], tip[of] + share * (b - tip)[of]
    return _Lines(start, end, _half_cells(end - start))


def _half_cells(lines: Array) -> Indices:
    """Return into how many pieces to cut vectors (..., n), for pieces of at most half a cell along each axis."""
    return np.asarray(np.maximum(np.ceil(2 * np.abs(lines).max(axis=-1)), 1), np.int64)


def _chunks(counts: Indices) -> Iterator[Indices]:
    """Yield indices of counts above 0, parted so that each part adds up to a bounded number."""
    some = np.flatnonzero(counts)
    part = np.cumsum(counts[some]) // _CHUNK
    yield from (chosen for chosen in np.split(some, np.flatnonzero(np.diff(part)) + 1) if len(chosen))


def _spread(counts: Indices) -> tuple[Indices, Indices]:
    """Return which count each item belongs to, and its number there: [2, 1] gives 0 0 1 and 0 1 0."""
    of = np.repeat(np.arange(len(counts)), counts)
    return of, np.arange(len(of)) - np.repeat(np.cumsum(counts) - counts, counts)


def _filled(ground: NDArray[Any], water: NDArray[Any]) -> NDArray[Any]:
    """Return how high water stands over the ground, in a field of any dimension, once all has run off that can.

    Water sinks to the highest of the ground and the lowest neighbour's water, swept along each axis both ways until
    nothing changes. It does not pass between cells that touch at a corner only: a wall of one cell is tight.

    Args:
        ground: heights, the largest number where nothing passes.
        water: how high it may stand at most; at the edge of the field, where it runs off.
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
