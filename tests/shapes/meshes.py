"""Triangle meshes with known volume and capacity."""

import math
from itertools import product

import numpy as np

SIDES = 48
"""Segments of round meshes, whose area is that of the polygon."""


def polygon_area(radius):
    return SIDES / 2 * math.sin(2 * math.pi / SIDES) * radius**2


def box(x, y, z, at=(0, 0, 0)):
    """Return points and outward triangles of a box with its lowest corner at `at`."""
    points = np.array(list(product((0, x), (0, y), (0, z))), float) + at
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def surface_of_revolution(*profile):
    """Return the surface of a profile of (radius, height) rotated about z, from the bottom outside to the inside."""
    angles = 2 * math.pi / SIDES * np.arange(SIDES)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.concatenate([np.column_stack([ring * r, np.full(SIDES, z)]) for r, z in profile])
    i = np.arange(SIDES)
    j = (i + 1) % SIDES
    faces = []
    for below in range(0, SIDES * (len(profile) - 1), SIDES):
        above = below + SIDES
        faces += [
            np.column_stack([below + i, below + j, above + j]),
            np.column_stack([below + i, above + j, above + i]),
        ]
    return points, np.concatenate(faces)


def join(*meshes):
    starts = np.cumsum([0, *(len(points) for points, _ in meshes)])
    return (
        np.concatenate([points for points, _ in meshes]),
        np.concatenate([triangles + start for (_, triangles), start in zip(meshes, starts, strict=False)]),
    )


def rotation(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    a, b = [i for i in range(3) if i != axis]
    matrix = np.eye(3)
    matrix[a, a], matrix[a, b], matrix[b, a], matrix[b, b] = c, -s, s, c
    return matrix


def moved(mesh, matrix=None, shift=(0, 0, 0)):
    points, triangles = mesh
    matrix = np.eye(3) if matrix is None else matrix
    return points @ matrix.T + shift, triangles if np.linalg.det(matrix) > 0 else triangles[:, ::-1]


def globe(radius=1.0, rings=24):
    steps = np.linspace(-math.pi / 2, math.pi / 2, rings + 1)
    return surface_of_revolution(
        *[(radius * max(math.cos(s), 0) if 0 < k < rings else 0, radius * math.sin(s)) for k, s in enumerate(steps)]
    )


def cup(radius=0.04, height=0.1, wall=0.003):
    """Return a cup with a flat bottom as thick as its wall; its capacity is the inner cylinder."""
    inner = radius - wall
    return surface_of_revolution((0, 0), (radius, 0), (radius, height), (inner, height), (inner, wall), (0, wall))


def tub(x, y, z, wall):
    """Return an open box as one closed surface of five slabs."""
    return join(
        box(x, y, wall),
        box(wall, y, z - wall, (0, 0, wall)),
        box(wall, y, z - wall, (x - wall, 0, wall)),
        box(x - 2 * wall, wall, z - wall, (wall, 0, wall)),
        box(x - 2 * wall, wall, z - wall, (wall, y - wall, wall)),
    )


CUP = cup()
CUP_CAPACITY = polygon_area(0.037) * 0.097
TETRAHEDRON = (
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
)
TABLE = join(box(1.6, 0.8, 0.04, (0, 0, 0.7)), *(box(0.06, 0.06, 0.7, (x, y, 0)) for x in (0, 1.54) for y in (0, 0.74)))
