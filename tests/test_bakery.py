"""The bakery: gprims and meshes by formula, placed by script."""

import numpy as np
import pytest
from pxr import Usd

from benchmarks.relations.judged import main
from benchmarks.scenes.bakery.forms import Piece, bar, block, cabinet, hoop, roll, vessel
from benchmarks.scenes.bakery.layout import ROOT, new_stage, save
from tests.world_bounds import bounds


def test_meshes_have_their_sizes():
    assert sizes(vessel(6, 10, 12)) == pytest.approx([20, 12, 20])
    assert sizes(cabinet(80, 10, 90, 60)) == pytest.approx([80, 80, 60])
    assert sizes(roll(2, 6, 10)) == pytest.approx([12, 10, 12])
    assert sizes(hoop(10, 1)) == pytest.approx([22, 22, 2], abs=0.2)


def test_objects_are_where_they_are_placed(tmp_path):
    stage = new_stage()
    corner = stage.area("corner", (100, 0, 50), 90)
    corner.fix("block", block(10, 20, 30), (0, 5, 0))
    corner.fix("bar", [bar((0, 0, 0), (40, 0, 0), 2)])
    corner.stand("cup", vessel(3, 4, 9), (0, 40, 0))
    assert save(stage, tmp_path / "bakery.usda") == 3
    written = Usd.Stage.Open(str(tmp_path / "bakery.usda"))
    # Turned by 90° about y, x goes to -z, and z to x.
    assert bounds(written, f"{ROOT}/corner/block") == pytest.approx([85, 5, 45, 115, 25, 55], abs=1e-3)
    assert bounds(written, f"{ROOT}/corner/bar") == pytest.approx([98, -2, 10, 102, 2, 50], abs=1e-3)
    _, low, _, _, high, _ = bounds(written, f"{ROOT}/corner/cup")
    assert high - low == pytest.approx(9, abs=1e-3)
    assert low == pytest.approx(40, abs=0.2)


def test_the_errors_of_a_test_are_not_listed(capsys):
    main(["bakery"])
    printed = capsys.readouterr().out
    assert "| bakery | part-of | 59 |" in printed
    assert "\nbakery is a test: its errors are not listed\n" in printed
    assert "wrong:" not in printed
    assert "missed:" not in printed


def sizes(piece: Piece) -> list[float]:
    """Return the extents of a mesh in centimetres."""
    assert piece.points is not None
    return list(np.ptp(piece.points, axis=0))
