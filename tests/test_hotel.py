"""The hotel: gprims and meshes by formula, placed by script."""

import numpy as np
import pytest
from pxr import Usd

from benchmarks.scenes.hotel.shapes import box, crate, cup, puff, resized, slabs
from benchmarks.scenes.hotel.stage import ROOT, Hotel, write
from tests.world_bounds import bounds


def test_shapes_have_their_sizes():
    assert np.ptp(crate(40, 30, 20).points, axis=0) == pytest.approx([40, 30, 20])
    assert np.ptp(cup(3, 4, 10).points[:, 1]) == pytest.approx(10)
    assert np.ptp(puff(30, 6, 20).points, axis=0) == pytest.approx([30, 6, 20])
    assert resized(box(2, 4, 6), 0.5).size == (1, 2, 3)
    assert np.ptp(resized(slabs((0, 2, 0, 4, 0, 6)), 0.5).points, axis=0) == pytest.approx([1, 2, 3])


@pytest.mark.parametrize("unit", [1.0, 0.1, 2.54, 100.0])
def test_a_group_places_things_alike_in_any_unit(tmp_path, unit):
    hotel = Hotel()
    group = hotel.group("room", (100, 0, 0), 90, unit).group("corner", (0, 10, 0))
    group.put("block", box(10, 4, 2), (20, 0, 0), fixed=True)
    group.put("copy", slabs((0, 10, 0, 4, 0, 2)), (0, 0, 5), fixed=True, asset="slab", scale=0.5)
    write(hotel, tmp_path / "hotel.usda")
    stage = Usd.Stage.Open(str(tmp_path / "hotel.usda"))
    assert bounds(stage, f"{ROOT}/room/corner/block") == pytest.approx([99, 10, -25, 101, 14, -15], abs=1e-4)
    assert bounds(stage, f"{ROOT}/room/corner/copy") == pytest.approx([105, 10, -5, 106, 12, 0], abs=1e-4)
    with pytest.raises(ValueError, match="block is placed twice"):
        group.put("block", box(1, 1, 1))
