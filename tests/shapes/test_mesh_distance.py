import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.shapes.solids import boxes, table, turned
from usd2kg.shapes.mesh_distance import Solid, mesh_distance
from usd2kg.shapes.surface import Surface, SurfacePiece


def solid(surface) -> Solid:
    return Solid(surface.lower.min(axis=0), surface.upper.max(axis=0), surface)


def box(lower, upper) -> Solid:
    return Solid(np.array(lower, float), np.array(upper, float), None)


TABLE = solid(table((0, 0, 0), (2, 1, 0.7)))
STOOL = box((0.8, 0.3, 0), (1.2, 0.7, 0.4))


class TestBoxes:
    def test_a_stool_under_a_table_is_below_its_top(self):
        # The top begins at 0.67 m; the nearest leg is 0.75 m away.
        assert mesh_distance(STOOL, TABLE, 1.0) == pytest.approx(0.27)

    def test_nothing_is_found_beyond_the_reach(self):
        assert mesh_distance(STOOL, TABLE, 0.2) == math.inf
        assert mesh_distance(box((5, 0, 0), (6, 1, 1)), TABLE, 1.0) == math.inf

    def test_the_distance_is_symmetric(self):
        assert mesh_distance(TABLE, STOOL, 1.0) == pytest.approx(mesh_distance(STOOL, TABLE, 1.0))

    def test_penetration_is_negative(self):
        # A socket sunk 4 mm into a wall.
        wall = solid(boxes(((-3, 0, 0), (3, 0.2, 2.5)), ((-3, 0, 0), (-2.8, 5, 2.5))))
        assert mesh_distance(box((0, -0.006, 1), (0.08, 0.004, 1.08)), wall, 0.05) == pytest.approx(-0.004, abs=1e-6)


def test_round_things_are_farther_apart_than_their_boxes():
    one, other = (solid(turned((0, 0), (1, 0), (1, 1), (0, 1), at=(at, at, 0), segments=64)) for at in (0, 2.5))
    # The axes are 2.5 √2 apart, the radii are 1; the boxes are 0.5 √2 apart. Triangles end with their boxes.
    found = mesh_distance(one, other, 2.0)
    assert 0.5 * math.sqrt(2) < found <= 2.5 * math.sqrt(2) - 2
    assert found == pytest.approx(2.5 * math.sqrt(2) - 2, abs=0.2)


@given(st.integers(1, 300), st.integers(1, 300), st.integers(0, 2**32 - 1), st.floats(0, 2))
@settings(max_examples=40, deadline=None)
def test_blocks_give_the_least_distance_of_all_pairs(count: int, other_count: int, seed: int, offset: float):
    chance = np.random.default_rng(seed)
    one, other = (chance.random((n, 1, 3)) + 0.02 * chance.random((n, 3, 3)) for n in (count, other_count))
    other[..., 0] += offset
    lower, upper = other.min(axis=1), other.max(axis=1)
    gaps = [np.maximum(np.maximum(t.min(axis=0) - upper, lower - t.max(axis=0)), 0) for t in one]
    expected = min(np.sqrt((gap**2).sum(axis=1)).min() for gap in gaps)
    assert mesh_distance(_solid(one), _solid(other), 10.0) == pytest.approx(expected, abs=1e-6) or expected == 0


def _solid(corners: np.ndarray) -> Solid:
    points = corners.reshape(-1, 3).astype(np.float32)
    piece = SurfacePiece(points, np.arange(len(points), dtype=np.int32).reshape(-1, 3), np.eye(4))
    return solid(Surface((piece,)))
