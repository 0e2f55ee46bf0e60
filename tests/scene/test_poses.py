"""Positions and rotations of prims' own frames, in the z-up world."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.scene.test_boxes import angle, rotation
from tests.scene.usda import METRES, cube, header, move, ops, xform
from usd2kg.scene import read_scene

HALF = math.sqrt(0.5)
Y_UP = header(metersPerUnit=1, upAxis="Y")


def pose(read, *steps, layer=METRES):
    """Return the object that carries the transform `steps`, and the notes on it."""
    scene = read(xform("World", xform("Thing", ops(*steps) if steps else "", cube("mesh")), cube("other")), layer=layer)
    return scene.by_path["/World/Thing"], [note for note in scene.diagnostics if note.prim_path == "/World/Thing"]


def test_untouched_prim_has_the_identity(read):
    thing, notes = pose(read)
    assert (thing.position, thing.orientation, notes) == ((0, 0, 0), (0, 0, 0, 1), [])


def test_quarter_turn_about_z(read):
    # Half the angle is 45 degrees: (x, y, z, w) = (0, 0, sin 45, cos 45).
    thing, _ = pose(read, ("double3", "translate", (1, 2, 3)), ("double", "rotateZ", 90))
    assert thing.position == (1, 2, 3)
    assert thing.orientation == pytest.approx((0, 0, HALF, HALF))


def test_rotation_of_the_quaternion_is_written_x_y_z_w(read):
    # A third of a turn about (1, 1, 1): sin 60 / sqrt 3 = 0.5 each, cos 60 = 0.5.
    thing, _ = pose(read, ("double", "rotateX", 90), ("double", "rotateY", 90))
    assert thing.orientation == pytest.approx((0.5, 0.5, 0.5, 0.5))


def test_y_up_frame_is_rotated_to_z_up(read):
    # The prim's y axis becomes the world's z: a quarter turn about x.
    thing, _ = pose(read, ("double3", "translate", (1, 2, 3)), layer=Y_UP)
    assert thing.position == (1, -3, 2)
    assert thing.orientation == pytest.approx((HALF, 0, 0, HALF))


def test_y_up_turn_about_the_vertical(read):
    # First 90 degrees about y (the vertical), then tipped by 90 about x: (0.5, 0.5, 0.5, 0.5).
    thing, _ = pose(read, ("double", "rotateY", 90), layer=Y_UP)
    assert thing.orientation == pytest.approx((0.5, 0.5, 0.5, 0.5))


def test_position_is_in_metres_and_world_wide(read):
    inner = xform("Thing", move(100, 0, 0), cube("mesh"))
    tree = xform("World", ops(("double3", "translate", (0, 50, 0)), ("double", "rotateZ", 90)), inner, cube("other"))
    thing = read(tree, layer=header(metersPerUnit=0.01, upAxis="Z")).by_path["/World/Thing"]
    # (100, 0) turned by 90 degrees is (0, 100); plus (0, 50) makes 150 cm.
    assert thing.position == pytest.approx((0, 1.5, 0), abs=1e-12)


def test_rotation_excludes_scale(read):
    thing, notes = pose(read, ("double", "rotateZ", 90), ("double3", "scale", (2, 5, 0.1)))
    assert thing.orientation == pytest.approx((0, 0, HALF, HALF))
    assert notes == []


@pytest.mark.parametrize("factors", [(-1, 1, 1), (1, -1, 1), (-2, 3, 0.5)])
def test_rotation_excludes_mirroring_of_a_horizontal_axis(read, factors):
    thing, notes = pose(read, ("double3", "scale", factors))
    assert thing.orientation == (0, 0, 0, 1)
    assert notes == []


def test_the_axis_whose_mirroring_leaves_the_smaller_rotation_is_inverted(read):
    # A turn by 60 degrees about z, or one by 120 to the other side with the other axis inverted: sin 30, cos 30.
    thing, _ = pose(read, ("double", "rotateZ", 60), ("double3", "scale", (-1, 1, 1)))
    assert thing.orientation == pytest.approx((0, 0, 0.5, math.sqrt(0.75)))
    thing, _ = pose(read, ("double", "rotateZ", 60), ("double3", "scale", (1, -1, 1)))
    assert thing.orientation == pytest.approx((0, 0, 0.5, math.sqrt(0.75)))
    # At 90 degrees both are a quarter turn; the first axis is inverted.
    for factors in ((-1, 1, 1), (1, -1, 1)):
        thing, _ = pose(read, ("double", "rotateZ", 90), ("double3", "scale", factors))
        assert thing.orientation == pytest.approx((0, 0, math.copysign(HALF, -factors[0]), HALF))


@pytest.mark.parametrize(
    ("factors", "expected"),
    [((1, 1, -1), (0, 1, 0, 0)), ((-1, -1, -1), (1, 0, 0, 0))],
)
def test_what_is_mirrored_upside_down_is_turned_over(read, factors, expected):
    # Its z axis points down. With x inverted, diag(1, 1, -1) is diag(-1, 1, -1), half a turn about y.
    thing, _ = pose(read, ("double3", "scale", factors))
    assert thing.orientation == pytest.approx(expected)


def test_mirroring_in_a_y_up_stage_keeps_the_y_axis(read):
    upright = pytest.approx((HALF, 0, 0, HALF))
    assert pose(read, ("double3", "scale", (-1, 1, 1)), layer=Y_UP)[0].orientation == upright
    assert pose(read, ("double3", "scale", (1, 1, -1)), layer=Y_UP)[0].orientation == upright
    # Turned over about z in the stage, diag(-1, -1, 1), then by 90 degrees about x: (0, -1, 1, 0) / sqrt 2.
    over, _ = pose(read, ("double3", "scale", (1, -1, 1)), layer=Y_UP)
    assert over.orientation == pytest.approx((0, HALF, -HALF, 0))


@pytest.mark.parametrize("factors", [(0, 0, 0), (1, 0, 1)])
def test_zero_scale_has_a_position_but_no_rotation(read, factors):
    thing, notes = pose(
        read, ("double3", "translate", (1, 2, 3)), ("double", "rotateZ", 90), ("double3", "scale", factors)
    )
    assert thing.position == (1, 2, 3)
    assert thing.orientation is None
    assert [note.message for note in notes if note.code == "transform"] == [
        "its transform has no finite rotation; it is left out"
    ]


def test_non_finite_transform_has_no_pose(read):
    thing, notes = pose(read, ("double3", "translate", "(nan, 0, 0)"))
    assert (thing.position, thing.orientation, thing.box) == (None, None, None)
    assert [note.code for note in notes] == ["empty-box", "transform"]


@pytest.mark.parametrize("axis", "XYZ")
def test_half_turns_in_both_directions_have_the_same_quaternion(read, axis):
    # 180 and -180 degrees are one rotation; w is 0 but for rounding, so its sign must not decide.
    there, _ = pose(read, ("double", f"rotate{axis}", 180))
    back, _ = pose(read, ("double", f"rotate{axis}", -180))
    assert there.orientation == pytest.approx(back.orientation)


@settings(max_examples=30, deadline=None)
@given(st.tuples(angle, angle, angle), st.sampled_from("YZ"))
def test_quaternion_turns_as_the_matrix_does(tmp_path_factory, turn, up_axis):
    path = tmp_path_factory.getbasetemp() / "any_pose.usda"
    path.write_text(
        "#usda 1.0\n" + header(metersPerUnit=1, upAxis=up_axis) + cube("Box", ops(("double3", "rotateXYZ", turn)))
    )
    x, y, z, w = read_scene(path).objects[0].orientation
    assert w >= 0
    assert math.hypot(x, y, z, w) == pytest.approx(1)
    from_quaternion = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    tip = rotation(90, 0, 0) if up_axis == "Y" else np.eye(3)
    assert from_quaternion == pytest.approx(tip @ rotation(*turn), abs=1e-6)
