"""A z-buffer rasteriser in numpy."""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.camera import Camera
from usd2kg.shapes.ragged import ragged_indices

__all__ = ["Hits", "rasterise"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_CHUNK = 1 << 21
"""Pixels rasterised at a time, which bounds memory."""


class Hits(NamedTuple):
    """The visible triangle at each pixel."""

    triangle: NDArray[np.int32]
    """(height, width): index of the nearest triangle, -1 for background."""
    nearness: NDArray[np.float32]
    """(height, width): 1 / (metres along the view direction), 0 for background."""


def rasterise(camera: Camera, points: NDArray[np.floating], triangles: NDArray[np.integer]) -> Hits:
    """Return the nearest triangle at each pixel centre; triangles are two-sided.

    Among triangles at equal distance, the last one wins.
    """
    corners, source = _in_front(camera, points, triangles)
    buffer = np.full(camera.width * camera.height, -1, np.int64)
    pixels = camera.to_pixels(corners)
    for rows in _chunks(*_kept(pixels, source, camera)):
        _draw(rows, camera, buffer)
    found = buffer >= 0
    triangle = np.where(found, buffer & 0x7FFFFFFF, -1).astype(np.int32)
    nearness = np.where(found, buffer >> 32, 0).astype(np.int32).view(np.float32)
    shape = (camera.height, camera.width)
    return Hits(triangle.reshape(shape), nearness.reshape(shape))


def _in_front(camera: Camera, points: NDArray[np.floating], triangles: NDArray[np.integer]) -> tuple[Array, Indices]:
    """Return corners (n, 3, 3) in camera axes, clipped at the near plane, and their source triangles (n,)."""
    view = camera.to_view(points)
    is_behind = view[:, 2] < camera.near
    behind = sum(is_behind[triangles[:, i]].astype(np.int8) for i in range(3))
    whole = np.flatnonzero(behind == 0)
    parts, sources = [view[triangles[whole]]], [whole]
    for count in (1, 2):
        cut = np.flatnonzero(behind == count)
        if len(cut):
            # Rotate each so that the corner that is alone on its side of the plane comes first.
            alone = np.argmax(is_behind[triangles[cut]] == (count == 1), axis=1)
            order = (alone[:, None] + np.arange(3)) % 3
            a, b, c = np.moveaxis(view[np.take_along_axis(triangles[cut], order, axis=1)], 1, 0)
            ab, ac = _at_near(a, b, camera.near), _at_near(a, c, camera.near)
            made = [(a, ab, ac)] if count == 2 else [(ab, b, c), (ab, c, ac)]
            parts.extend(np.stack(corners, axis=1) for corners in made)
            sources.extend([cut] * len(made))
    return np.concatenate(parts), np.concatenate(sources)


def _at_near(a: Array, b: Array, near: float) -> Array:
    share = (near - a[:, 2:]) / (b[:, 2:] - a[:, 2:])
    point: Array = a + share * (b - a)
    point[:, 2] = near
    return point


def _kept(pixels: Array, source: Indices, camera: Camera) -> tuple[Array, Indices, Indices, Indices]:
    """Return triangles whose bounds contain a pixel centre, their sources, first rows and numbers of rows."""
    # numpy reduces slowly over short axes: use three columns.
    (x0, x1, x2), (y0, y1, y2), _ = np.moveaxis(pixels, (2, 1), (0, 1))
    left = np.clip(np.ceil(np.minimum(np.minimum(x0, x1), x2) - 0.5), 0, camera.width)
    right = np.clip(np.ceil(np.maximum(np.maximum(x0, x1), x2) - 0.5), 0, camera.width)
    top = np.clip(np.ceil(np.minimum(np.minimum(y0, y1), y2) - 0.5), 0, camera.height).astype(np.int64)
    bottom = np.clip(np.ceil(np.maximum(np.maximum(y0, y1), y2) - 0.5), 0, camera.height).astype(np.int64)
    kept = np.flatnonzero((bottom > top) & (right > left))
    return pixels[kept], source[kept], top[kept], (bottom - top)[kept]


class _Rows(NamedTuple):
    pixels: Array
    """(n, 3, 3), triangles."""
    source: Indices
    of: Indices
    """Triangle of each row."""
    y: Indices


def _chunks(pixels: Array, source: Indices, top: Indices, count: Indices) -> Iterator[_Rows]:
    """Yield triangle rows in parts that cover a bounded number of pixels."""
    spans = np.clip(np.ptp(pixels[..., 0], axis=1), 1, 1 << 13) * count
    part = (np.cumsum(spans) // _CHUNK).astype(np.int64)
    starts = [0, *(np.flatnonzero(np.diff(part)) + 1).tolist(), len(part)]
    for start, end in pairwise(starts):
        counts = count[start:end]
        of, line = ragged_indices(counts)
        y = np.repeat(top[start:end], counts) + line
        yield _Rows(pixels[start:end], source[start:end], of, y)


def _draw(rows: _Rows, camera: Camera, buffer: Indices) -> None:
    """Fill the pixel spans between the edges of triangles, row by row."""
    middle = rows.y + 0.5
    left, right = np.full(len(middle), np.inf), np.full(len(middle), -np.inf)
    for i in range(3):
        a, b = rows.pixels[:, i][rows.of], rows.pixels[:, (i + 1) % 3][rows.of]
        rise = b[:, 1] - a[:, 1]
        share = (middle - a[:, 1]) / np.where(rise == 0, 1, rise)
        x = a[:, 0] + share * (b[:, 0] - a[:, 0])
        is_crossed = (rise != 0) & (share >= 0) & (share <= 1)
        left = np.where(is_crossed, np.minimum(left, x), left)
        right = np.where(is_crossed, np.maximum(right, x), right)
    first = np.clip(np.ceil(left - 0.5), 0, camera.width)
    counts = np.maximum(np.clip(np.ceil(right - 0.5), 0, camera.width) - first, 0).astype(np.int64)
    kept = np.flatnonzero(counts)
    counts, of = counts[kept], rows.of[kept]
    start = first[kept].astype(np.int64)
    nearness, slope = _planes(rows.pixels)
    begin = nearness[of, 0] + slope[of, 0] * (start + 0.5 - rows.pixels[of, 0, 0])
    begin += slope[of, 1] * (middle[kept] - rows.pixels[of, 0, 1])
    step = ragged_indices(counts).column
    values = np.repeat(begin, counts) + step * np.repeat(slope[of, 0], counts)
    # The plane of a sliver is ill-conditioned: clamp to the depth of its corners.
    np.clip(values, np.repeat(nearness[of].min(axis=1), counts), np.repeat(nearness[of].max(axis=1), counts), values)
    # Bits of positive floats sort as the floats do: pack nearness above the triangle index, and compare one number.
    bits = values.astype(np.float32).view(np.int32).astype(np.int64) << 32
    place = np.repeat(rows.y[kept] * camera.width + start, counts) + step
    np.maximum.at(buffer, place, bits | np.repeat(rows.source[of], counts))


def _planes(pixels: Array) -> tuple[Array, Array]:
    """Return inverse depth at the corners (n, 3) and its gradient along x and y (n, 2): it is linear in image space."""
    ab, ac = pixels[:, 1] - pixels[:, 0], pixels[:, 2] - pixels[:, 0]
    area = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    safe = np.where(np.abs(area) < 1e-9, np.inf, area)
    along_x = (ab[:, 2] * ac[:, 1] - ac[:, 2] * ab[:, 1]) / safe
    along_y = (ac[:, 2] * ab[:, 0] - ab[:, 2] * ac[:, 0]) / safe
    return pixels[..., 2], np.stack([along_x, along_y], axis=1)
