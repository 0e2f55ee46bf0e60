import numpy as np
import pytest

from tests.shapes.solids import boxes, surface_of
from usd2kg.shapes.axis_rays import find_crossings

BOX = boxes(((0, 0, 0), (2, 3, 4)))


def crossings(points, surface, axis):
    """Return the distinct (line, coordinate, cosine) of all crossings."""
    found = find_crossings([np.array(points, float)], [surface], axis)
    rows = np.round(np.stack(found, axis=1), 6)
    return [tuple(row) for row in np.unique(rows, axis=0).tolist()]


@pytest.mark.parametrize(("axis", "length"), [(0, 2), (1, 3), (2, 4)])
def test_a_line_through_a_box_enters_and_leaves(axis: int, length: float):
    # Off the diagonals of the faces.
    assert crossings([(0.5, 0.4, 0.3)], BOX, axis) == [(0, 0, -1), (0, length, 1)]


def test_lines_beside_a_box_miss_it():
    assert crossings([(2.1, 1, 0), (-0.1, 1, 0), (1, 3.1, 0)], BOX, 2) == []


def test_a_line_through_a_shared_edge_does_not_fall_between():
    assert crossings([(1, 1.5, 0)], BOX, 2) == [(0, 0, -1), (0, 4, 1)]


def test_a_tilted_triangle_is_crossed_at_its_height():
    # The plane z = x, whose normal is at 45 degrees to the vertical.
    tilted = surface_of([(0, 0, 0), (2, 0, 2), (0, 2, 0)], [(0, 1, 2)])
    ((line, at, cosine),) = crossings([(0.5, 0.5, 9)], tilted, 2)
    assert (line, at, cosine) == (0, 0.5, pytest.approx(np.sqrt(0.5)))


def test_lines_of_several_surfaces_are_numbered_in_order():
    other = boxes(((0, 0, 10), (1, 1, 11)))
    points = [np.array([(0.3, 0.2, 0), (9, 9, 0)], float), np.array([(0.3, 0.2, 0)], float)]
    found = find_crossings(points, [BOX, other], 2)
    assert {(line, round(at, 6)) for line, at in zip(found.line.tolist(), found.at.tolist(), strict=True)} == {
        (0, 0),
        (0, 4),
        (2, 10),
        (2, 11),
    }


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_each_line_is_tested_against_each_triangle_of_its_surface_only(axis: int):
    random = np.random.default_rng(axis)
    first, second = (other for other in range(3) if other != axis)
    surfaces = [surface_of(random.integers(0, 9, (30, 3)), random.integers(0, 30, (40, 3))) for _ in range(3)]
    # Halves lie at the ends of some triangles, and on their edges.
    points = [random.integers(0, 18, (count, 3)) / 2 for count in (50, 1, 20)]
    expected, start = set(), 0
    for lines, surface in zip(points, surfaces, strict=True):
        for number, line in enumerate(lines):
            for a, b, c in surface.corners:
                matrix = np.array(
                    [[b[first] - a[first], c[first] - a[first]], [b[second] - a[second], c[second] - a[second]]]
                )
                if abs(np.linalg.det(matrix)) > 1e-9:
                    s, t = np.linalg.solve(matrix, [line[first] - a[first], line[second] - a[second]])
                    if min(s, t) >= -1e-9 and s + t <= 1 + 1e-9:
                        at = a[axis] + s * (b[axis] - a[axis]) + t * (c[axis] - a[axis])
                        expected.add((start + number, round(float(at), 6)))
        start += len(lines)
    found = find_crossings(points, surfaces, axis)
    assert {(line, round(at, 6)) for line, at in zip(found.line.tolist(), found.at.tolist(), strict=True)} == expected
    assert len(expected) > 20
