"""Joints: bodies, axes and limits, compared with values calculated by hand."""

import math
from collections import Counter

import pytest
from pxr import Usd

from tests.conftest import shared_file
from tests.scene.usda import METRES, header, move, ops, prim, xform
from usd2kg.scene.joints import read_joints
from usd2kg.scene.model import Joint, StageFrame
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import open_stage
from usd2kg.scene.traversal import outline_stage

CENTIMETRES_Y_UP = header(metersPerUnit=0.01, upAxis="Y")
Z_UP = StageFrame("Z", 1.0, 1.0, True)
Y_UP = StageFrame("Y", 0.01, 1.0, True)
HALF = math.sqrt(0.5)


def read_file(path, frame=Z_UP, time=None):
    time = time or Usd.TimeCode.EarliestTime()
    opened = open_stage(path, ReadOptions())
    return read_joints(outline_stage(opened, time).joint_prims, frame, time)


@pytest.fixture
def read(write_stage):
    """A function that writes a cabinet, its door and a joint, and returns all joints."""

    def run(*prims, layer=METRES, frame=Z_UP, time=None):
        return read_file(write_stage(layer + "\n".join(prims)), frame, time)

    return run


def joint(kind, *body, body0="/Cabinet", body1="/Door", name="joint"):
    rels = [f"rel physics:body{i} = <{path}>" for i, path in enumerate((body0, body1)) if path]
    return prim(kind, name, *rels, *body)


def revolute(*body, **bodies):
    return joint("PhysicsRevoluteJoint", *body, **bodies)


def prismatic(*body, **bodies):
    return joint("PhysicsPrismaticJoint", *body, **bodies)


def world(joint_prim, cabinet=(), door=()):
    return xform("Cabinet", *cabinet), xform("Door", *door), joint_prim


def axis(token):
    return f'uniform token physics:axis = "{token}"'


def limits(lower, upper):
    return f"float physics:lowerLimit = {lower}\nfloat physics:upperLimit = {upper}"


def only(reading) -> Joint:
    assert reading.diagnostics == ()
    (found,) = reading.joints
    return found


# --- a whole joint ------------------------------------------------------------------------------------


def test_a_hinge(read):
    hinge = revolute(axis("Z"), limits(0, 90), "float state:angular:physics:position = 45")
    assert only(read(*world(hinge))) == Joint(
        prim_path="/joint",
        type="revolute",
        body0="/Cabinet",
        body1="/Door",
        axis="Z",
        axis_vector=(0.0, 0.0, 1.0),
        origin=(0.0, 0.0, 0.0),
        direction="vertical",
        lower=0.0,
        upper=math.pi / 2,
        value=math.pi / 4,
        is_enabled=True,
        is_excluded_from_articulation=False,
    )


def test_a_slide_on_a_y_up_stage_in_centimetres(read):
    slide = prismatic(axis("Z"), limits(-5, 40), "float state:linear:physics:position = 12.5")
    found = only(read(*world(slide), layer=CENTIMETRES_Y_UP, frame=Y_UP))
    assert (found.type, found.lower, found.upper, found.value) == ("prismatic", -0.05, 0.4, 0.125)
    # The stage's z is the world's -y.
    assert (found.axis, found.axis_vector, found.direction) == ("Z", (0.0, -1.0, 0.0), "horizontal")


@pytest.mark.parametrize(
    ("type_name", "expected"),
    [
        ("PhysicsRevoluteJoint", "revolute"),
        ("PhysicsPrismaticJoint", "prismatic"),
        ("PhysicsFixedJoint", "fixed"),
        ("PhysicsSphericalJoint", "spherical"),
        ("PhysicsDistanceJoint", "distance"),
        ("PhysicsJoint", "other"),
        ("PhysxPhysicsGearJoint", "other"),
    ],
)
def test_types(read, type_name, expected):
    assert only(read(*world(joint(type_name)))).type == expected


def test_a_type_named_like_a_joint_without_bodies_is_none(read):
    butt_joint = prim("Xform", "ButtJoint")
    unknown = prim("WoodJoint", "tenon", "double width = 2")
    assert read(butt_joint, unknown).joints == ()


def test_joints_are_in_traversal_order(read):
    found = read(*world(revolute(name="b") + prismatic(name="a"))).joints
    assert [joint.prim_path for joint in found] == ["/b", "/a"]


# --- axis ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("token", "z_up", "y_up"),
    [
        ("X", (1, 0, 0), (1, 0, 0)),
        ("Y", (0, 1, 0), (0, 0, 1)),
        ("Z", (0, 0, 1), (0, -1, 0)),
    ],
)
def test_axis_in_the_world(read, token, z_up, y_up):
    stage = world(revolute(axis(token)))
    assert only(read(*stage)).axis_vector == z_up
    assert only(read(*stage, layer=CENTIMETRES_Y_UP, frame=Y_UP)).axis_vector == y_up


def test_axis_defaults_to_x(read):
    # UsdPhysics: the fallback of physics:axis.
    assert only(read(*world(revolute()))).axis == "X"


def test_axis_is_turned_by_the_joint_frame(read):
    # 90 degrees about x take z to -y.
    found = only(read(*world(revolute(axis("Z"), f"quatf physics:localRot0 = ({HALF}, {HALF}, 0, 0)"))))
    assert found.axis_vector == pytest.approx((0, -1, 0), abs=1e-6)


def test_axis_is_turned_by_the_body_and_not_by_its_scale_or_place(read):
    placed = ops(("double3", "translate", (5, 6, 7)), ("float", "rotateZ", 30), ("float3", "scale", (1, 10, 0.1)))
    found = only(read(*world(prismatic(axis("X")), cabinet=[placed])))
    assert found.axis_vector == pytest.approx((math.sqrt(3) / 2, 0.5, 0))
    assert found.direction == "horizontal"


def test_body_and_joint_frame_together(read):
    # The frame takes x to y (90 degrees about z), the body takes y to z (90 degrees about x).
    frame = f"quatf physics:localRot0 = ({HALF}, 0, 0, {HALF})"
    found = only(read(*world(prismatic(axis("X"), frame), cabinet=[ops(("float", "rotateX", 90))])))
    assert found.axis_vector == pytest.approx((0, 0, 1), abs=1e-6)
    assert found.direction == "vertical"


def test_rotation_that_is_not_normalized(read):
    found = only(read(*world(revolute(axis("Z"), "quatf physics:localRot0 = (3, 3, 0, 0)"))))
    assert found.axis_vector == pytest.approx((0, -1, 0), abs=1e-6)


def test_an_all_zero_rotation_is_ignored(read):
    found = only(read(*world(revolute(axis("Z"), "quatf physics:localRot0 = (0, 0, 0, 0)"))))
    assert found.axis_vector == (0, 0, 1)


def test_axis_of_a_joint_to_the_world_is_read_from_the_moved_body(read):
    turned = ops(("float", "rotateX", 90))
    found = only(read(*world(revolute(axis("Z"), body0=None), door=[turned])))
    assert found.body0 is None
    assert found.axis_vector == pytest.approx((0, -1, 0), abs=1e-6)


def test_origin_is_that_of_the_joint_frame_in_the_still_body(read):
    # The cabinet is at (1, 2, 0), turned by 90° about z and twice its size: (0.5, 0, 1) in it is (1, 3, 2).
    placed = ops(("double3", "translate", (1, 2, 0)), ("float", "rotateZ", 90), ("float3", "scale", (2, 2, 2)))
    hinge = revolute("point3f physics:localPos0 = (0.5, 0, 1)", "point3f physics:localPos1 = (9, 9, 9)")
    assert only(read(*world(hinge, cabinet=[placed]))).origin == pytest.approx((1, 3, 2))


def test_origin_of_a_joint_to_the_world_is_read_from_the_moved_body(read):
    hinge = revolute("point3f physics:localPos1 = (0, 0, 1)", body0=None)
    assert only(read(*world(hinge, door=[move(0, 4, 0)]))).origin == pytest.approx((0, 4, 1))


def test_origin_on_a_y_up_stage_in_centimetres(read):
    # (100, 200, 300) cm, y up, is (1, -3, 2) m; a joint without an axis has an origin too.
    ball = joint("PhysicsSphericalJoint", "point3f physics:localPos0 = (100, 200, 300)")
    assert only(read(*world(ball), frame=Y_UP, layer=CENTIMETRES_Y_UP)).origin == pytest.approx((1, -3, 2))


def test_origin_that_nobody_authored_is_that_of_the_body(read):
    assert only(read(*world(revolute(), cabinet=[move(1, 0, 0)]))).origin == pytest.approx((1, 0, 0))


def test_origin_that_is_not_finite_is_none(read):
    assert only(read(*world(revolute("point3f physics:localPos0 = (nan, 0, 0)")))).origin is None


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [(0, "vertical"), (9, "vertical"), (11, "oblique"), (45, "oblique"), (79, "oblique"), (81, "horizontal")],
)
def test_direction_in_words(read, degrees, expected):
    tilted = ops(("float", "rotateX", degrees))
    assert only(read(*world(revolute(axis("Z")), cabinet=[tilted]))).direction == expected


@pytest.mark.parametrize("kind", ["PhysicsFixedJoint", "PhysicsDistanceJoint", "PhysicsJoint"])
def test_joints_without_axis(read, kind):
    found = only(read(*world(joint(kind, axis("Z")))))
    assert (found.axis, found.axis_vector, found.direction) == (None, None, None)


def test_singular_and_non_finite_bodies_do_not_crash(read):
    for scale in ("(0, 0, 0)", "(nan, 1, 1)"):
        flat = f'float3 xformOp:scale = {scale}\nuniform token[] xformOpOrder = ["xformOp:scale"]'
        (found,) = read(*world(revolute(axis("Z")), cabinet=[flat])).joints
        assert found.axis_vector is None or math.hypot(*found.axis_vector) == pytest.approx(1)


# --- limits, values, switches -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("lower", "upper", "expected"),
    [
        ("-inf", "inf", (None, None)),
        ("-inf", 180, (None, math.pi)),
        ("-3.4028235e38", "3.4028235e38", (None, None)),
        (-180, 0, (-math.pi, 0.0)),
        (720, 720, (4 * math.pi, 4 * math.pi)),
    ],
)
def test_limits_of_a_hinge(read, lower, upper, expected):
    found = only(read(*world(revolute(limits(lower, upper)))))
    assert (found.lower, found.upper) == pytest.approx(expected)


def test_limits_that_are_not_authored_are_none(read):
    found = only(read(*world(prismatic())))
    assert (found.lower, found.upper, found.value) == (None, None, None)


def test_limits_of_a_distance_joint(read):
    rope = joint("PhysicsDistanceJoint", "float physics:minDistance = -1", "float physics:maxDistance = 250")
    found = only(read(*world(rope), layer=CENTIMETRES_Y_UP, frame=Y_UP))
    assert (found.lower, found.upper) == (None, 2.5)


def test_a_fixed_joint_has_no_limits(read):
    found = only(read(*world(joint("PhysicsFixedJoint", limits(0, 1), "float state:linear:physics:position = 1"))))
    assert (found.lower, found.upper, found.value) == (None, None, None)


def test_numbers_of_32_bits_are_the_numbers_typed(read):
    assert only(read(*world(prismatic(limits(0, 0.4))))).upper == 0.4


def test_state_of_the_other_kind_is_not_this_joints(read):
    found = only(read(*world(revolute("float state:linear:physics:position = 0.2"))))
    assert found.value is None


def test_state_is_read_at_the_time_asked_for(read):
    samples = "float state:linear:physics:position.timeSamples = {\n1: 0.1,\n2: 0.3\n}"
    stage = world(prismatic(samples))
    assert only(read(*stage)).value == 0.1
    assert only(read(*stage, time=Usd.TimeCode(2))).value == 0.3


def test_switches(read):
    off = ("bool physics:jointEnabled = 0", "uniform bool physics:excludeFromArticulation = 1")
    found = only(read(*world(revolute(*off))))
    assert (found.is_enabled, found.is_excluded_from_articulation) == (False, True)


# --- instances ----------------------------------------------------------------------------------------


def test_joints_of_instances_join_the_parts_of_their_own_copy(read):
    inside = revolute(axis("Z"), body0="/Proto/Case", body1="/Proto/Door")
    proto = prim("Xform", "Proto", xform("Case"), xform("Door"), inside, specifier="class")
    copies = [
        xform(name, turn, meta=["instanceable = true", "references = </Proto>"])
        for name, turn in (("A", move(0, 0, 0)), ("B", ops(("float", "rotateX", 90))))
    ]
    first, second = read(proto, *copies).joints
    assert (first.prim_path, first.body0, first.body1) == ("/A/joint", "/A/Case", "/A/Door")
    assert (second.prim_path, second.body0, second.body1) == ("/B/joint", "/B/Case", "/B/Door")
    assert first.axis_vector == (0, 0, 1)
    assert second.axis_vector == pytest.approx((0, -1, 0), abs=1e-6)


# --- broken joints -----------------------------------------------------------------------------------


def trouble(reading) -> tuple[Joint, list[str]]:
    (found,) = reading.joints
    assert {note.code for note in reading.diagnostics} == {"joint"}
    assert {note.prim_path for note in reading.diagnostics} == {"/joint"}
    return found, [note.message for note in reading.diagnostics]


def test_missing_body_gives_the_nearest_above(read):
    found, messages = trouble(read(*world(revolute(axis("Z"), body1="/Door/Panel/Inner"))))
    assert found.body1 == "/Door"
    assert found.axis_vector == (0, 0, 1)
    assert messages == ["physics:body1 is </Door/Panel/Inner>, which is not on the stage; </Door> is used"]


def test_missing_body_without_existing_ancestors(read):
    found, messages = trouble(read(*world(revolute(body0="/Gone"))))
    assert found.body0 is None
    assert messages == ["physics:body0 is </Gone>, which is not on the stage; it is left out"]


def test_missing_body_does_not_lend_the_frame_of_what_is_above(read):
    # The axis comes from the other body, which is there.
    turned = ops(("float", "rotateX", 90))
    found, _ = trouble(read(*world(revolute(axis("Z"), body0="/Cabinet/Gone"), cabinet=[turned])))
    assert (found.body0, found.axis_vector) == ("/Cabinet", (0, 0, 1))


def test_inactive_body(read):
    door = xform("House", xform("Door", meta=["active = false"]))
    found, messages = trouble(read(xform("Cabinet"), door, revolute(body1="/House/Door")))
    assert found.body1 == "/House"
    assert messages == ["physics:body1 is </House/Door>, which is inactive; </House> is used"]


def test_target_that_is_a_property_means_its_prim(read):
    assert only(read(*world(revolute(body1="/Door.visibility")))).body1 == "/Door"


def test_several_targets(read):
    two = "rel physics:body1 = [</Door>, </Cabinet>]"
    found, messages = trouble(read(*world(revolute(two, body1=None))))
    assert found.body1 == "/Door"
    assert messages == ["physics:body1 has 2 targets, expected one; </Door> is used"]


def test_no_bodies_at_all(read):
    found, messages = trouble(read(revolute(axis("Y"), body0=None, body1=None)))
    assert (found.body0, found.body1, found.axis_vector) == (None, None, (0, 1, 0))
    assert messages == ["it connects no body on the stage; expected targets of physics:body0 and physics:body1"]


def test_both_bodies_missing(read):
    found, messages = trouble(read(revolute(body0="/a", body1="/b")))
    assert (found.body0, found.body1, found.axis_vector) == (None, None, None)
    assert len(messages) == 3


def test_invalid_axis(read):
    found, messages = trouble(read(*world(revolute(axis("x; drop table")))))
    assert (found.axis, found.axis_vector, found.direction) == (None, None, None)
    assert messages == ["physics:axis is 'x; drop table', expected X, Y or Z; it has no axis"]


def test_limits_the_wrong_way_round_are_kept(read):
    found, messages = trouble(read(*world(prismatic(limits(1, -1)))))
    assert (found.lower, found.upper) == (1, -1)
    assert messages == ["its lower limit 1 is above its upper limit -1; both are kept as authored"]


def test_mistyped_limit(read):
    found, messages = trouble(read(*world(prismatic(limits("nan", 1)))))
    assert (found.lower, found.upper) == (None, 1)
    assert messages == ["physics:lowerLimit is nan, expected a number; it is left out"]


def test_ignores_values_of_other_types(read):
    odd = ('string state:angular:physics:position = "wide open"', 'string physics:jointEnabled = "no"')
    found, messages = trouble(read(*world(revolute(*odd))))
    assert (found.value, found.is_enabled) == (None, True)
    assert messages == ["state:angular:physics:position is 'wide open', expected a number; it is left out"]


# --- real scenes --------------------------------------------------------------------------------------


def read_shared(relative):
    return read_file(shared_file(relative))


def test_apartment():
    reading = read_shared("scenes/iai_apartment/apartment.usdc")
    assert reading.diagnostics == ()
    assert Counter(found.type for found in reading.joints) == {"fixed": 66, "prismatic": 27, "revolute": 15}
    by_name = {found.prim_path.rpartition("/")[2]: found for found in reading.joints}
    left, right = by_name["wardrobe_door_left_joint"], by_name["wardrobe_door_right_joint"]
    # The two doors of a wardrobe open to opposite sides; both limits are 1.5708 in the URDF.
    assert (left.axis_vector, right.axis_vector) == ((0, 0, -1), (0, 0, 1))
    assert left.upper == right.upper == pytest.approx(1.5708, abs=1e-6)
    drawer = by_name["cabinet1_drawer_middle_joint"]
    assert (drawer.direction, drawer.lower, drawer.upper) == ("horizontal", 0, 0.45)
    assert drawer.body1.endswith("/cabinet1/cabinet1_drawer_middle")


def test_franka_kitchen():
    reading = read_shared("scenes/franka_kitchen/franka_kitchen.usdc")
    assert reading.diagnostics == ()
    assert Counter(found.type for found in reading.joints) == {"fixed": 19, "revolute": 15, "prismatic": 8}
    finger = next(found for found in reading.joints if "finger_joint1" in found.prim_path)
    assert (finger.type, finger.upper) == ("prismatic", 0.04)


def test_dlr_kitchen():
    reading = read_shared("scenes/dlr_kitchen/tagged_flattened.usda")
    by_body = {found.body1: found for found in reading.joints}
    assert Counter(found.type for found in reading.joints) == {"prismatic": 7, "revolute": 2}
    assert by_body["/dlr_kitchen/fridge_door"].direction == "vertical"
    assert by_body["/dlr_kitchen/oven_door"].direction == "horizontal"
    # The file also has the URDF's own axis (-1, 0, 0) in the kitchenette, which is turned by 90 degrees about z.
    drawer = by_body["/dlr_kitchen/drawer_02"]
    assert drawer.axis_vector == pytest.approx((0, -1, 0), abs=1e-5)
    assert (drawer.body0, drawer.upper) == ("/dlr_kitchen/kitchenette", 0.4)
