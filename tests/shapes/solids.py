"""Surfaces made of axis-aligned boxes and of solids of revolution, in metres, z-up."""

import numpy as np

from usd2kg.shapes.surface import Surface, SurfacePiece

Corner = tuple[float, float, float]
Span = tuple[Corner, Corner]
"""Lower and upper corner of a box."""

_BITS = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)])
_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
_FACES = np.concatenate([_QUADS[:, [0, 1, 2]], _QUADS[:, [0, 2, 3]]])


def surface_of(points, triangles) -> Surface:
    piece = SurfacePiece(np.asarray(points, np.float64), np.asarray(triangles, np.int32), np.eye(4))
    return Surface((piece,))


def boxes(*spans: Span) -> Surface:
    """Return the surface of boxes in one mesh."""
    points = np.concatenate([np.choose(_BITS, np.array(span, float)) for span in spans])
    return surface_of(points, np.concatenate([_FACES + 8 * number for number in range(len(spans))]))


def turned(*profile: tuple[float, float], at: Corner = (0, 0, 0), segments: int = 24) -> Surface:
    """Return the surface of revolution of (radius, height) pairs, from the outside of the bottom up."""
    angles = np.arange(segments) * 2 * np.pi / segments
    rings = [np.stack([r * np.cos(angles), r * np.sin(angles), np.full(segments, z)], 1) for r, z in profile]
    here, after = np.arange(segments), np.roll(np.arange(segments), -1)
    faces = []
    for row in range(len(profile) - 1):
        low, high = row * segments, (row + 1) * segments
        faces.append(np.stack([low + here, low + after, high + after], 1))
        faces.append(np.stack([low + here, high + after, high + here], 1))
    return surface_of(np.concatenate(rings) + np.array(at), np.concatenate(faces))


def open_box(lower: Corner, upper: Corner, wall: float = 0.01) -> Surface:
    """Return a box without a lid, with walls of a thickness."""
    (x0, y0, z0), (x1, y1, z1) = lower, upper
    return boxes(
        ((x0, y0, z0), (x1, y1, z0 + wall)),
        ((x0, y0, z0), (x0 + wall, y1, z1)),
        ((x1 - wall, y0, z0), (x1, y1, z1)),
        ((x0, y0, z0), (x1, y0 + wall, z1)),
        ((x0, y1 - wall, z0), (x1, y1, z1)),
    )


def table(lower: Corner, upper: Corner, top: float = 0.03, leg: float = 0.05) -> Surface:
    """Return a table top on four legs."""
    (x0, y0, z0), (x1, y1, z1) = lower, upper
    legs = [((x, y, z0), (x + leg, y + leg, z1 - top)) for x in (x0, x1 - leg) for y in (y0, y1 - leg)]
    return boxes(((x0, y0, z1 - top), (x1, y1, z1)), *legs)
