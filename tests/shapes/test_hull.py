"""Convex hulls and minimum bounding boxes."""

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.shapes.meshes import box, rotation
from usd2kg.shapes.bounding_boxes import face_normals, minimum_box, minimum_rectangle
from usd2kg.shapes.hull import convex_hull, hull_area, hull_corners

TOLERANCE = 1e-6


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(4, 60), st.integers(1, 6))
def test_hull_contains_all_points(seed, count, digits):
    points = np.round(np.random.default_rng(seed).random((count, 3)), digits)
    hull = convex_hull(points, TOLERANCE)
    if hull is None:
        assert np.linalg.matrix_rank(points - points[0], tol=1e-3) < 3
        return
    normals = hull.normals[np.linalg.norm(hull.normals, axis=1) > 1e-6]
    assert ((points @ normals.T).max(axis=0) <= (hull.vertices @ normals.T).max(axis=0) + 1e-9).all()
    assert np.linalg.norm(hull.normals, axis=1).sum() == pytest.approx(hull.surface)


def test_hull_of_a_grid_with_duplicates():
    grid = np.array(list(product(range(5), repeat=3)) * 2, float)
    hull = convex_hull(grid @ rotation(0, 33).T @ rotation(2, 12).T, TOLERANCE)
    assert hull is not None
    assert (hull.volume, hull.surface) == pytest.approx((64, 96))


@pytest.mark.parametrize(
    "points",
    [
        np.zeros((9, 3)),
        np.eye(3),
        np.outer(np.arange(9.0), [1, 2, 3]),
        np.array(list(product(range(4), range(3), [7.0])), float),
        np.random.default_rng(0).random((50, 3)) * [1, 1, 1e-7],
    ],
)
def test_coplanar_points_have_no_hull(points):
    assert convex_hull(points, TOLERANCE) is None


def test_corners_in_the_plane():
    points = np.array([[0, 0], [2, 0], [1, 1], [2, 2], [0, 2], [1, 0], [0, 0]], float)
    assert sorted(hull_corners(points).tolist()) == [[0, 0], [0, 2], [2, 0], [2, 2]]
    assert hull_area(points) == pytest.approx(4)


@pytest.mark.parametrize(("points", "ends"), [(np.ones((4, 2)), 1), ([[0, 0], [1, 1], [2, 2]], 2)])
def test_corners_of_collinear_points_are_their_ends(points, ends):
    corners = hull_corners(np.array(points, float))
    assert len(np.unique(corners, axis=0)) == ends


def test_rectangle_around_a_rotated_one():
    points = np.array([[0, 0], [3, 0], [3, 1], [0, 1]]) @ rotation(2, 20)[:2, :2].T
    axes, extents = minimum_rectangle(points)
    assert extents == pytest.approx((3, 1))
    assert abs(axes[0] @ [math.cos(math.radians(20)), math.sin(math.radians(20))]) == pytest.approx(1)
    assert np.linalg.det(axes) == pytest.approx(1)


def test_box_stands_on_a_large_face():
    hull = convex_hull(box(3, 2, 1)[0] @ rotation(0, 25).T, TOLERANCE)
    assert hull is not None
    normals = face_normals(hull)
    assert len(normals) == 6
    assert minimum_box(hull.vertices, normals) == pytest.approx((3, 2, 1))
