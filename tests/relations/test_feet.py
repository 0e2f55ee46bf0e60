"""Feet of many surfaces, which are found block by block."""

import numpy as np
import pytest

from usd2kg.relations import feet
from usd2kg.shapes.surface import Surface, SurfacePiece

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], np.float32)
TOP_AND_BOTTOM = np.array([(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6)], np.int32)


def slab(x: float, side: float) -> Surface:
    matrix = np.diag([side, side, side, 1.0])
    matrix[3, 0] = x
    return Surface((SurfacePiece(CUBE, TOP_AND_BOTTOM, matrix),))


@pytest.mark.parametrize("block", [1, 2, 7])
def test_blocks_do_not_change_the_feet(block: int, monkeypatch: pytest.MonkeyPatch):
    surfaces = [slab(10.0 * number, 1.0 + number) for number in range(7)]
    at_once = feet.find_feet(surfaces, 0.05), feet.find_undersides(surfaces)
    monkeypatch.setattr(feet, "_BLOCK", block)
    for found, expected in zip((feet.find_feet(surfaces, 0.05), feet.find_undersides(surfaces)), at_once, strict=True):
        assert len(found) == len(surfaces)
        assert all(map(np.array_equal, found, expected))
        # Each is below its own slab.
        for number, points in enumerate(found):
            assert len(points) > 1
            assert (points[:, 0] >= 10.0 * number).all()
            assert (points[:, 0] <= 10.0 * number + 1.0 + number).all()


def test_no_surfaces_have_no_feet():
    assert feet.find_feet([], 0.05) == feet.find_undersides([]) == []
