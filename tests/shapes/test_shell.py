import numpy as np
import pytest

from tests.shapes.solids import boxes
from usd2kg.shapes.shell import shell_boxes

WALLS = boxes(
    ((0, 0, 0), (8, 0.2, 2.5)), ((0, 4.8, 0), (8, 5, 2.5)), ((0, 0, 0), (0.2, 5, 2.5)), ((7.8, 0, 0), (8, 5, 2.5))
)


def distance(point, found):
    apart = [np.linalg.norm(np.maximum(np.maximum(low - point, point - high), 0)) for low, high in found]
    return min(apart)


def test_walls_in_one_mesh_are_several_boxes():
    found = shell_boxes(WALLS)
    assert 4 <= len(found) <= 8
    assert sum(float((high - low).prod()) for low, high in found) < 0.25 * 8 * 5 * 2.5
    # The middle of the room is 2.3 m from the nearest wall; boxes are up to half a cell of 0.2 m too thick.
    assert distance(np.array([4, 2.5, 1]), found) == pytest.approx(2.3, abs=0.1)


def test_boxes_cover_the_surface():
    found = shell_boxes(WALLS)
    assert max(distance(corner, found) for corner in WALLS.corners.reshape(-1, 3)) <= 1e-9


def test_an_l_shape_leaves_its_corner_free():
    found = shell_boxes(boxes(((0, 0, 0), (3, 1, 0.8)), ((0, 1, 0), (1, 3, 0.8))))
    assert distance(np.array([2.5, 2.5, 0.4]), found) > 1


def test_a_slab_is_one_box():
    ((low, high),) = shell_boxes(boxes(((0, 0, 0), (4, 0.1, 3))))
    assert (low.tolist(), high.tolist()) == (pytest.approx([0, 0, 0]), pytest.approx([4, 0.1, 3]))


def test_what_is_within_a_closed_surface_is_away_from_it():
    # A room drawn as one closed box is not told from a solid; what stands in it is in a room.
    found = shell_boxes(boxes(((0, 0, 0), (4, 4, 2.5))))
    assert distance(np.array([2, 2, 1]), found) > 0.9
