"""The veterinary practice: gprims and meshes by formula, placed by script."""

import numpy as np
import pytest
from pxr import Usd

from benchmarks.scenes.vet.shapes import ball, box, crate, cup, moved, pillow, ring, rod, slabs
from benchmarks.scenes.vet.stage import ROOT, Practice, write
from tests.world_bounds import bounds


def test_meshes_have_their_sizes():
    assert np.ptp(crate(400, 300, 200, 5).points, axis=0) == pytest.approx([400, 300, 200])
    assert np.ptp(cup(30, 40, 100).points[:, 2]) == pytest.approx(100)
    assert np.ptp(pillow(300, 200, 60).points, axis=0) == pytest.approx([300, 200, 60])
    assert np.ptp(ring(10, 60, 240).points, axis=0) == pytest.approx([120, 120, 240])
    turned = moved(slabs((0, 20, 0, 40, 0, 60)), (5, 0, 0), (0, 0, 90))
    assert np.ptp(turned.points, axis=0) == pytest.approx([40, 20, 60])


def test_gprims_are_where_they_are_placed(tmp_path):
    practice = Practice()
    room = practice.group("room")
    room.put("block", box(10, 20, 30, (100, 0, 5)), fixed=True)
    room.put("rod", [rod((0, 0, 0), (0, 80, 0), 4)], fixed=True)
    room.put("egg", [ball(20, (0, 0, 10), 0.5)], fixed=True)
    write(practice, tmp_path / "vet.usda")
    stage = Usd.Stage.Open(str(tmp_path / "vet.usda"))
    assert bounds(stage, f"{ROOT}/room/block") == pytest.approx([95, -10, 5, 105, 10, 35], abs=1e-4)
    assert bounds(stage, f"{ROOT}/room/rod") == pytest.approx([-4, 0, -4, 4, 80, 4], abs=1e-4)
    assert bounds(stage, f"{ROOT}/room/egg") == pytest.approx([-20, -20, 10, 20, 20, 30], abs=1e-4)


def test_groups_turn_and_scale_what_is_in_them(tmp_path):
    practice = Practice()
    group = practice.group("room", (1000, 0, 0), 90).group("corner", (0, 100, 0), scale=2)
    group.put("block", slabs((0, 10, 0, 4, 0, 2)), (20, 0, 0), fixed=True)
    group.put("copy", slabs((0, 10, 0, 4, 0, 2)), (0, 0, 5), fixed=True, block="Slab", scale=0.5)
    write(practice, tmp_path / "vet.usda")
    stage = Usd.Stage.Open(str(tmp_path / "vet.usda"))
    assert bounds(stage, f"{ROOT}/room/corner/block") == pytest.approx([892, 40, 0, 900, 60, 4], abs=1e-3)
    assert bounds(stage, f"{ROOT}/room/corner/copy") == pytest.approx([896, 0, 10, 900, 10, 12], abs=1e-3)
    with pytest.raises(ValueError, match="block is placed twice"):
        group.put("block", box(1, 1, 1))
