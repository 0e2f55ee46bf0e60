"""Exact distances between triangles and between surfaces, by hand and against samples."""

import numpy as np
import pytest

from tests.shapes.solids import boxes
from usd2kg.shapes.mesh_distance import Solid, exact_distance, mesh_distance
from usd2kg.shapes.triangle_distance import least_triangle_distance

FLAT = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])


def test_a_corner_above_a_face():
    assert least_triangle_distance(FLAT, FLAT[:, ::-1] + [0.1, 0.1, 0.5], 1) == pytest.approx(0.5)


def test_edges_beside_each_other():
    other = np.array([[[2.0, 0, 0], [3, 0, 0], [2, 0, 1]]])
    assert least_triangle_distance(FLAT, other, 2) == pytest.approx(1)


def test_an_edge_that_pierces_a_face_is_at_zero():
    needle = np.array([[[0.2, 0.2, -1.0], [0.2, 0.2, 1], [0.2, 0.3, 1]]])
    assert least_triangle_distance(FLAT, needle, 1) == 0
    assert least_triangle_distance(needle, FLAT, 1) == 0


def test_nothing_is_found_beyond_the_reach():
    assert least_triangle_distance(FLAT, FLAT + np.array([0, 0, 0.5]), 0.4) == np.inf


def test_the_least_distance_is_that_of_the_nearest_points():
    random = np.random.default_rng(3)
    weights = random.dirichlet(np.ones(3), 4000)
    for _ in range(20):
        one, other = random.random((2, 1, 3, 3))
        other += [1.5, 0, 0]
        gaps = np.linalg.norm((weights @ one[0])[:, None] - (weights[:400] @ other[0])[None], axis=2)
        found = least_triangle_distance(one, other, 10)
        assert found <= gaps.min()
        assert found == pytest.approx(gaps.min(), abs=0.15)


def test_oblique_surfaces_are_farther_apart_than_the_boxes_of_their_triangles():
    one = boxes(((0, 0, 0), (1, 1, 0.01)))
    (piece,) = one.pieces
    turn = np.eye(4)
    turn[:3, :3] = [[np.cos(0.7), 0, np.sin(0.7)], [0, 1, 0], [-np.sin(0.7), 0, np.cos(0.7)]]
    slanted = type(one)((piece._replace(matrix=piece.matrix @ turn),))
    shift = np.eye(4)
    shift[3, :3] = (0, 0, 0.1)
    higher = type(one)((piece._replace(matrix=piece.matrix @ turn @ shift),))
    first, second = (Solid(s.lower.min(axis=0), s.upper.max(axis=0), s) for s in (slanted, higher))
    assert mesh_distance(first, second, 0.2) <= 0
    assert exact_distance(first, second, 0.2) == pytest.approx(0.1 * np.cos(0.7) - 0.01)
    assert exact_distance(first, second, 0.05) == np.inf
    assert exact_distance(first, first, 0.05) == 0
