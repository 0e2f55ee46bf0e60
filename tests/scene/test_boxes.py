"""World boxes: metres, z-up, of visible geometry, with and without nested objects."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pxr import Gf, Usd, UsdGeom

from tests.scene.usda import component, cube, header, move, ops, prim, rigid, xform
from usd2kg.scene import Box, read_scene

CENTIMETRES = header(metersPerUnit=0.01, upAxis="Y")


def close_to(lower, upper):
    return pytest.approx((*lower, *upper), abs=1e-9)


def corners(box):
    return (*box.lower, *box.upper)


def test_size_center_and_volume():
    box = Box((1, 2, 3), (2, 4, 6))
    assert (box.size, box.center, box.volume) == ((1, 2, 3), (1.5, 3, 4.5), 6)
    assert Box((0, 0, 0), (1, 1, 0)).volume == 0


def test_y_up_centimetres_and_z_up_metres_give_the_same_box(read):
    # (200, 300, 400) cm y-up is x = 2, y = -4, z = 3 in metres z-up.
    y_up = read(cube("Box", size=100, at=(200, 300, 400)), layer=CENTIMETRES).objects[0].box
    z_up = read(cube("Box", size=1, at=(2, -4, 3))).objects[0].box
    assert corners(y_up) == close_to((1.5, -4.5, 2.5), (2.5, -3.5, 3.5))
    assert corners(y_up) == pytest.approx(corners(z_up))


def test_y_up_depth_and_height_are_swapped(read):
    mesh = prim("Mesh", "Board", "point3f[] points = [(0, 0, 0), (1, 2, 3)]")
    box = read(mesh, layer=header(metersPerUnit=1, upAxis="Y")).objects[0].box
    # z from 0 to 3 points to the viewer, so y runs from -3 to 0.
    assert corners(box) == close_to((0, -3, 0), (1, 0, 2))


def test_rotated_cube(read):
    # A square of side 2 turned by 45 degrees reaches sqrt(2) from its middle.
    r = math.sqrt(2)
    box = read(cube("Box", ops(("double3", "translate", (1, 0, 5)), ("double", "rotateZ", 45)), size=2)).objects[0].box
    assert corners(box) == close_to((1 - r, -r, 4), (1 + r, r, 6))


def test_scaled_and_turned_cube(read):
    # 2 x 3 x 4, then a quarter turn about z swaps width and depth.
    turned = ops(("double", "rotateZ", 90), ("double3", "scale", (2, 3, 4)))
    assert read(cube("Box", turned)).objects[0].box.size == pytest.approx((3, 2, 4))


def test_box_includes_transforms_of_ancestors(read):
    chair = xform("Chair", ops(("double3", "translate", (1, 1, 0)), ("double3", "scale", (0.01, 0.01, 0.01))),
                  cube("a", size=100, at=(50, 0, 0)), cube("b", size=100, at=(-50, 0, 0)))  # fmt: skip
    box = read(xform("World", move(0, 0, 10), chair, cube("other"))).by_path["/World/Chair"].box
    # Two cubes of 1 m side by side, their middle at (1, 1, 10).
    assert corners(box) == close_to((0, 0.5, 9.5), (2, 1.5, 10.5))


def test_a_mirrored_box_keeps_its_corners_in_order(read):
    box = read(cube("Box", ops(("double3", "scale", (-1, 1, 1)), ("double3", "translate", (5, 0, 0))))).objects[0].box
    assert corners(box) == close_to((-5.5, -0.5, -0.5), (-4.5, 0.5, 0.5))


@pytest.mark.parametrize(("purpose", "width"), [("guide", 1), ("proxy", 1), ("render", 6), ("default", 6)])
def test_only_default_and_render_purpose_is_measured(read, purpose, width):
    extra = cube("extra", at=(5, 0, 0), purpose=purpose)
    box = read(xform("World", component("Chair", cube("seat"), extra), cube("b"))).by_path["/World/Chair"].box
    assert box.size[0] == pytest.approx(width)


def test_invisible_geometry_is_not_measured(read):
    hidden = cube("hidden", 'token visibility = "invisible"', at=(5, 0, 0))
    scene = read(xform("World", component("Chair", cube("seat"), hidden), cube("b")))
    assert scene.by_path["/World/Chair"].box.size == pytest.approx((1, 1, 1))


def test_time_samples_without_a_time_range_are_read(read):
    moved = cube("Box", "double3 xformOp:translate.timeSamples = {5: (1, 2, 3)}",
                 'uniform token[] xformOpOrder = ["xformOp:translate"]')  # fmt: skip
    obj = read(xform("World", moved, cube("other"))).by_path["/World/Box"]
    assert obj.position == (1, 2, 3)
    assert obj.box.center == pytest.approx((1, 2, 3))


def test_the_earliest_time_of_a_range_is_read_and_recorded(read):
    moved = cube("Box", "double3 xformOp:translate.timeSamples = {5: (1, 2, 3), 9: (8, 8, 8)}",
                 'uniform token[] xformOpOrder = ["xformOp:translate"]')  # fmt: skip
    layer = header(metersPerUnit=1, upAxis="Z", startTimeCode=5, endTimeCode=9)
    scene = read(xform("World", moved, cube("other")), layer=layer)
    assert scene.by_path["/World/Box"].box.center == pytest.approx((1, 2, 3))
    assert scene.time == 5
    assert read(cube("Still")).time is None


# --- boxes with and without nested objects -----------------------------------------------------------


def test_own_box_leaves_out_nested_objects(read):
    # Carcass from x = -0.5 to 0.5; drawer, a nested object, from 2.5 to 3.5.
    drawer = rigid("Drawer", move(3, 0, 0), cube("front"))
    scene = read(xform("World", rigid("Cabinet", cube("carcass"), drawer), cube("other")))
    cabinet, drawer = scene.by_path["/World/Cabinet"], scene.by_path["/World/Cabinet/Drawer"]
    assert corners(cabinet.box) == close_to((-0.5, -0.5, -0.5), (3.5, 0.5, 0.5))
    assert corners(cabinet.own_box) == close_to((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
    assert drawer.own_box == drawer.box


def test_own_box_includes_all_own_parts(read):
    drawer = rigid("Drawer", move(9, 0, 0), cube("front"))
    cabinet = rigid("Cabinet", cube("a"), xform("sides", cube("b", at=(2, 0, 0))), drawer)
    scene = read(xform("World", cabinet, cube("other")))
    assert scene.by_path["/World/Cabinet"].own_box.size == pytest.approx((3, 1, 1))


def test_own_box_excludes_guides(read):
    # One visible and one guide part: as many own gprims as there are visible ones below the cabinet.
    drawer = rigid("Drawer", move(3, 0, 0), cube("front"))
    cabinet = rigid("Cabinet", cube("carcass"), cube("collider", purpose="guide"), drawer)
    scene = read(xform("World", cabinet, cube("other")))
    assert scene.by_path["/World/Cabinet"].own_box.size == pytest.approx((1, 1, 1))


def test_own_box_equals_box_without_nested_objects(read):
    chair = read(xform("World", component("Chair", cube("a"), cube("b", at=(2, 0, 0))), cube("c"))).objects[0]
    assert chair.own_box == chair.box


# --- boxes of the parts ------------------------------------------------------------------------------


def shelf(read, *parts):
    return read(xform("World", component("Shelf", *parts), cube("other"))).by_path["/World/Shelf"]


def test_part_boxes_are_in_traversal_order(read):
    guide = cube("hull", size=9, purpose="guide")
    boards = shelf(read, cube("low"), guide, xform("upper", cube("high", size=2, at=(0, 0, 5)))).part_boxes
    assert [board.center[2] for board in boards] == [0, 5]
    assert [board.size[0] for board in boards] == [1, 2]


def test_a_single_part_has_no_part_boxes(read):
    assert shelf(read, cube("low"), cube("hull", purpose="guide")).part_boxes == ()


def test_part_boxes_exclude_nested_objects(read):
    obj = shelf(read, cube("low"), cube("high", at=(0, 0, 5)), rigid("Box", cube("a"), cube("b", at=(9, 0, 0))))
    assert len(obj.part_boxes) == 2


def test_keeps_the_64_largest_part_boxes_in_order(read):
    # Sizes 1.01 to 1.70: the six smallest, up to 1.06, go.
    parts = [cube(f"p{index}", size=round(1 + index / 100, 2), at=(index, 0, 0)) for index in range(1, 71)]
    widths = [round(box.size[0], 6) for box in shelf(read, *parts).part_boxes]
    assert widths == [round(1 + index / 100, 2) for index in range(7, 71)]


def test_equal_parts_are_not_merged(read):
    assert len(shelf(read, *(cube(f"p{index}") for index in range(70))).part_boxes) == 64


# --- where geometry cannot be measured ---------------------------------------------------------------

HINT = "float3[] extentsHint = [(0, 0, 0), (1, 2, 3)]"


def hinted(*body, meta=()):
    return xform("World", component("Chair", HINT, *body, meta=meta), component("Table", cube("top")), kind="group")


def test_extents_hint_replaces_missing_geometry(read):
    scene = read(hinted(meta=["payload = @missing.usd@"]))
    assert corners(scene.by_path["/World/Chair"].box) == close_to((0, 0, 0), (1, 2, 3))
    assert "empty-box" not in {note.code for note in scene.diagnostics}


def test_geometry_overrides_the_extents_hint(read):
    assert read(hinted(cube("seat"))).by_path["/World/Chair"].box.size == pytest.approx((1, 1, 1))


@pytest.mark.parametrize(
    "points",
    ["[]", "[(0, 0, 0), (inf, 1, 1)]", "[(0, 0, 0), (1, -inf, 1)]", "[(-1e38, 0, 0), (1e38, 1, 1)]"],
)
def test_unmeasurable_geometry_has_no_box_and_a_diagnostic(read, points):
    scene = read(xform("World", prim("Mesh", "Odd", f"point3f[] points = {points}"), cube("box")))
    odd = scene.by_path["/World/Odd"]
    assert (odd.box, odd.own_box, odd.position) == (None, None, (0, 0, 0))
    (note,) = scene.diagnostics
    assert (note.code, note.prim_path) == ("empty-box", "/World/Odd")
    assert note.message == "it has no measurable geometry; it has no size in the graph"


def test_a_flat_mesh_has_a_flat_box(read):
    mesh = prim("Mesh", "Rug", "point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 3, 0), (0, 3, 0)]")
    box = read(mesh).objects[0].box
    assert (box.size, box.volume) == ((2, 3, 0), 0)


def test_an_authored_extent_counts_up_to_a_margin(read):
    # Within a tenth of the longest side, it may allow for displacement.
    lines = ["point3f[] points = [(0, 0, 0), (1, 1, 1)]", "float3[] extent = [(0, 0, 0), (1.0625, 1, 1)]"]
    scene = read(prim("Mesh", "Box", *lines))
    assert (scene.objects[0].box.size, scene.diagnostics) == ((1.0625, 1, 1), ())


# --- any cube, any frame -----------------------------------------------------------------------------

coordinate = st.floats(-50, 50).map(lambda value: round(value, 3))
angle = st.integers(-180, 180)
scale = st.floats(0.1, 10).map(lambda value: round(value, 3))


def rotation(x, y, z):
    """Rotation by x, then y, then z degrees about the fixed axes, for column vectors."""
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(math.radians(a)), math.sin(math.radians(a))) for a in (x, y, z))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


@settings(max_examples=40, deadline=None)
@given(
    st.tuples(coordinate, coordinate, coordinate),
    st.tuples(angle, angle, angle),
    st.tuples(scale, scale, scale),
    st.sampled_from([0.001, 0.01, 0.0254, 1.0]),
    st.sampled_from("YZ"),
)
def test_box_is_the_tightest_around_the_eight_corners(tmp_path_factory, place, turn, factors, unit, up_axis):
    path = tmp_path_factory.getbasetemp() / "any_cube.usda"
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    UsdGeom.SetStageUpAxis(stage, up_axis)
    prim = UsdGeom.Cube.Define(stage, "/Box")
    prim.AddTranslateOp().Set(Gf.Vec3d(*place))
    prim.AddRotateXYZOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*turn))
    prim.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*factors))
    stage.GetRootLayer().Export(str(path))

    unit_cube = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    points = (rotation(*turn) @ np.diag(factors) @ unit_cube.T).T + place
    if up_axis == "Y":
        points = points @ np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])  # (x, y, z) becomes (x, -z, y)
    points *= unit
    box = read_scene(path).objects[0].box
    assert corners(box) == pytest.approx((*points.min(axis=0), *points.max(axis=0)), rel=1e-6, abs=1e-6 * unit)


# --- round solids: the box of the rotated surface, not the rotated box -----------------------------------------


def solid(type_name, *sizes):
    """Return a solid turned by 30° about x, its axis z."""
    turned = ops(("double", "rotateX", 30))
    return xform("World", component("Thing", prim(type_name, "solid", 'uniform token axis = "Z"', *sizes, turned)))


COS, SIN = math.cos(math.radians(30)), math.sin(math.radians(30))


@pytest.mark.parametrize(
    ("text", "size"),
    [
        pytest.param(
            prim("Sphere", "solid", "double radius = 2", ops(("double", "rotateX", 30))), (4, 4, 4), id="ball"
        ),
        # Across its axis 2 r = 2; along y the axis' 4 sin 30° and the disc's 2 cos 30°, along z the other way round.
        pytest.param(
            solid("Cylinder", "double radius = 1", "double height = 4"),
            (2, 4 * SIN + 2 * COS, 4 * COS + 2 * SIN),
            id="cylinder",
        ),
        # A capsule is a ball that is drawn along its axis.
        pytest.param(
            solid("Capsule", "double radius = 1", "double height = 4"), (2, 4 * SIN + 2, 4 * COS + 2), id="capsule"
        ),
        # The tip is at -2 sin 30° in y, beyond the base circle's 2 sin 30° - cos 30°.
        pytest.param(
            solid("Cone", "double radius = 1", "double height = 4"),
            (2, 2 * SIN + 2 * SIN + COS, 2 * COS + 2 * COS + SIN),
            id="cone",
        ),
    ],
)
def test_rotated_round_solids_have_tight_boxes(read, text, size):
    assert read(text).objects[0].box.size == pytest.approx(size, rel=1e-3)


def test_rotation_about_the_axis_keeps_the_width_of_a_pot(read):
    pot = prim("Cylinder", "pot", "double radius = 0.1", "double height = 0.2", 'uniform token axis = "Z"')
    scene = read(xform("World", component("Pot", pot, ops(("double", "rotateZ", 45)))))
    assert scene.objects[0].box.size == pytest.approx((0.2, 0.2, 0.2), rel=1e-3)


def test_a_solid_with_a_mistyped_size_has_no_box(read):
    solid_of_text = prim("Sphere", "ball", 'string radius = "large"', ops(("double", "rotateX", 30)))
    [thing] = [obj for obj in read(xform("World", solid_of_text, cube("box"))).objects if obj.name == "ball"]
    assert thing.box is None


def test_a_sphere_of_radius_0_is_read(read):
    scene = read(xform("World", component("Dot", prim("Sphere", "m", "double radius = 0"), cube("c")), cube("box")))
    assert "/World/Dot" in scene.by_path
