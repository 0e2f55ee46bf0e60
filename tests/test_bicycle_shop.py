"""The bicycle shop: primitives and meshes by formula, placed by script."""

import numpy as np
import pytest

from benchmarks.scenes.bicycle_shop.parts import block, cube, height, open_box, ring, tube, vessel
from benchmarks.scenes.bicycle_shop.stage import Asset, Shop
from tests.world_bounds import bounds


def test_shapes_have_their_sizes():
    assert np.ptp(open_box(40, 30, 20, 1).points, axis=0) == pytest.approx([40, 30, 20])
    assert np.ptp(ring(10, 2, "x").points, axis=0) == pytest.approx([4, 24, 24])
    assert height(vessel(3, 4, 10)) == pytest.approx(10)
    assert height(block(0, 1, 0, 1, 0, 3)) == pytest.approx(3)
    assert height(cube(1, 2, 5)) == pytest.approx(5)


def test_groups_turn_what_is_in_them(tmp_path):
    shop = Shop(tmp_path / "shop.usda")
    group = shop.group("Room/Wall", (100, 0, 0), 90)
    group.put("Beam", cube(10, 2, 4, 20, -5, 30))
    group.put("Half", Asset("cube", (cube(4, 4, 4),)), (0, 0, 1), scale=0.5)
    group.put("Rod", tube((0, 0, 0), (0, 8, 0), 1))
    assert shop.things == [f"/Bicycle_shop/Room/Wall/{name}" for name in ("Beam", "Half", "Rod")]
    assert bounds(shop.stage, shop.things[0]) == pytest.approx([104, 15, 30, 106, 25, 34])
    assert bounds(shop.stage, shop.things[1]) == pytest.approx([99, -1, 1, 101, 1, 3])
    assert bounds(shop.stage, shop.things[2]) == pytest.approx([92, -1, -1, 100, 1, 1], abs=1e-4)
    with pytest.raises(ValueError, match="Beam is placed twice"):
        group.put("Beam", cube(1, 1, 1))
