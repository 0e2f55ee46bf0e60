"""SDFormat files and Gazebo worlds are converted at reading: includes, frames, poses, shapes, masses, joints."""

import hashlib
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pxr import Usd, UsdGeom, UsdPhysics

from tests.graph.records import open_store
from usd2kg import build
from usd2kg.convert.sdf import budget as sdf_budget
from usd2kg.convert.sdf import meshes, xml_files
from usd2kg.convert.sdf.frames import Scope
from usd2kg.convert.sdf.model import Pose, SdfFrame, SdfWorld
from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.resources import ResourceError, Resources
from usd2kg.convert.sdf.values import pose_matrix, quaternion_matrix
from usd2kg.convert.sdf.xml_tree import read_xml
from usd2kg.convert.trimesh_files import load_scene
from usd2kg.convert.write import convert_file
from usd2kg.errors import SceneError
from usd2kg.scene import Scene, read_scene

HALF_PI = "1.5707963267948966"


@pytest.fixture(autouse=True)
def no_model_path(monkeypatch: pytest.MonkeyPatch):
    for name in ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH"):
        monkeypatch.delenv(name, raising=False)


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def sdf(body: str, version: str = "1.9") -> str:
    return f'<?xml version="1.0"?>\n<sdf version="{version}">\n{body}\n</sdf>\n'


def world(path: Path, body: str, version: str = "1.9") -> Path:
    return write(path, sdf(f'<world name="room">\n{body}\n</world>', version))


def visual(geometry: str, more: str = "", name: str = "visual") -> str:
    return f'<visual name="{name}"><geometry>{geometry}</geometry>{more}</visual>'


def box(x: float, y: float, z: float) -> str:
    return f"<box><size>{x} {y} {z}</size></box>"


def cube_model(name: str, pose: str, more: str = "") -> str:
    """Return a model that is a cube of 20 cm, with a pose element."""
    return f'<model name="{name}">{pose}{more}<link name="link">{visual(box(0.2, 0.2, 0.2))}</link></model>'


def notes_of(scene: Scene) -> list[str]:
    return [note.message for note in scene.diagnostics if note.code == "conversion"]


def center(scene: Scene, path: str) -> tuple[float, ...]:
    found = scene.by_path[path].box
    assert found is not None
    return tuple((low + high) / 2 for low, high in zip(found.lower, found.upper, strict=True))


def stage_of(source: Path, tmp_path: Path) -> Usd.Stage:
    convert_file(source, tmp_path / "converted.usda")
    return Usd.Stage.Open(str(tmp_path / "converted.usda"))


def to_world(stage: Usd.Stage, path: str) -> np.ndarray:
    """Return the matrix of a prim to the world, for column vectors."""
    return np.array(UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath(path))).T


KITCHEN = f"""
<include><uri>model://sun</uri></include>
<light name="lamp" type="point"><pose>0 0 3 0 0 0</pose></light>
<model name="Kitchen table">
  <static>true</static>
  <pose>2 1 0 0 0 {HALF_PI}</pose>
  <link name="link">
    <inertial><mass>25</mass></inertial>
    <collision name="hull"><geometry>{box(9, 9, 9)}</geometry></collision>
    {visual(box(1.2, 0.8, 0.04), "<pose>0 0 0.73 0 0 0</pose><material><diffuse>1 0 0 1</diffuse></material>", "top")}
    <sensor name="camera" type="camera"/>
  </link>
</model>
<model name="mug">
  <pose>2 1 0.8 0 0 0</pose>
  <link name="body">
    <inertial><pose>0 0 0.01 0 0 0</pose><mass>0.3</mass></inertial>
    {visual("<cylinder><radius>0.04</radius><length>0.1</length></cylinder>")}
  </link>
</model>
"""


class TestWorld:
    def test_models_are_objects_with_names_boxes_and_masses(self, tmp_path: Path):
        scene = read_scene(world(tmp_path / "kitchen.world", KITCHEN))
        assert [obj.prim_path for obj in scene.objects] == ["/room/Kitchen_table", "/room/mug"]
        table, mug = scene.objects
        assert (table.display_name, table.mass_kg, mug.mass_kg) == ("Kitchen table", 25, pytest.approx(0.3))
        assert (scene.frame.metres_per_unit, scene.frame.up_axis) == (1, "Z")
        assert table.box is not None
        # A quarter turn about z exchanges width and depth; the collision of 9 m is left out.
        assert table.box.lower == pytest.approx((1.6, 0.4, 0.71))
        assert table.box.upper == pytest.approx((2.4, 1.6, 0.75))
        assert table.display_color == pytest.approx((1, 0, 0))
        assert notes_of(scene) == []

    def test_a_world_becomes_a_graph_that_answers(self, tmp_path: Path):
        path = world(tmp_path / "kitchen.world", KITCHEN)
        result = build(path)
        on = [(relation.target, relation.anchor) for relation in result.graph.relations if relation.kind == "on"]
        assert ("/room/mug", "/room/Kitchen_table") in on
        found = open_store(result.graph).sparql(
            "SELECT ?name ?hash WHERE { ?stage prov:wasDerivedFrom ?file . "
            "?file rdfs:label ?name ; u2k:contentHash ?hash }"
        )
        assert found.rows == (("kitchen.world", f"sha256:{hashlib.sha256(path.read_bytes()).hexdigest()}"),)

    def test_states_what_the_stage_was_converted_from(self, tmp_path: Path):
        source = world(tmp_path / "kitchen.sdf", KITCHEN)
        origin = read_scene(source).origin
        assert origin is not None
        assert (origin.source, origin.format) == ("kitchen.sdf", "SDFormat")
        assert origin.converter.startswith("usd2kg ")
        convert_file(source, tmp_path / "kitchen.usdc")
        assert read_scene(tmp_path / "kitchen.usdc").origin == origin
        assert read_scene(tmp_path / "kitchen.usdc").objects == read_scene(source).objects

    def test_moving_links_are_rigid_bodies_and_static_ones_are_not(self, tmp_path: Path):
        stage = stage_of(world(tmp_path / "kitchen.world", KITCHEN), tmp_path)
        assert stage.GetDefaultPrim().GetPath() == "/room"
        assert not stage.GetPrimAtPath("/room/Kitchen_table/link").HasAPI(UsdPhysics.RigidBodyAPI)
        mug = stage.GetPrimAtPath("/room/mug/body")
        assert mug.HasAPI(UsdPhysics.RigidBodyAPI)
        assert tuple(UsdPhysics.MassAPI(mug).GetCenterOfMassAttr().Get()) == pytest.approx((0, 0, 0.01))

    def test_a_world_without_meshes_needs_no_package(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        for name in ("trimesh", "collada", "mapbox_earcut"):
            monkeypatch.setitem(sys.modules, name, None)
        assert len(read_scene(world(tmp_path / "kitchen.world", KITCHEN)).objects) == 2

    def test_a_file_with_one_model_is_one_object(self, tmp_path: Path):
        path = write(tmp_path / "model.sdf", sdf(cube_model("chair", "<pose>0 0 0.1 0 0 0</pose>")))
        (chair,) = read_scene(path).objects
        assert chair.prim_path == "/chair"
        assert chair.box is not None
        assert chair.box.lower == pytest.approx((-0.1, -0.1, 0))

    def test_a_file_with_several_models_has_them_below_its_name(self, tmp_path: Path):
        path = write(tmp_path / "set.sdf", sdf(cube_model("a", "") + cube_model("a", "<pose>2 0 0 0 0 0</pose>")))
        scene = read_scene(path)
        # Siblings with the same name get a number, and each keeps its own pose.
        assert [obj.prim_path for obj in scene.objects] == ["/set/a", "/set/a_1"]
        assert center(scene, "/set/a_1") == pytest.approx((2, 0, 0))

    def test_actors_are_people(self, tmp_path: Path):
        walk = "<skin><filename>walk.dae</filename></skin>"
        script = (
            "<script><trajectory id='0' type='walk'><waypoint><pose>3 4 1 0 0 0</pose></waypoint></trajectory></script>"
        )
        cart = f'<actor name="cart"><link name="l">{visual(box(1, 1, 1))}</link></actor>'
        body = f'<actor name="Anna">{walk}{script}</actor>{cart}'
        scene = read_scene(world(tmp_path / "cafe.world", body))
        anna, box_on_rails = scene.objects
        assert (anna.name, [label.value for label in anna.labels.own]) == ("Anna", ["person"])
        assert box_on_rails.labels.own == ()
        stage = stage_of(tmp_path / "cafe.world", tmp_path)
        assert to_world(stage, "/room/Anna")[:3, 3] == pytest.approx((3, 4, 1))
        assert notes_of(scene)[0].startswith("cafe.world, line 4: the mesh walk.dae is not read (it is neither in")

    def test_a_comment_before_the_xml_declaration_is_read_as_gazebo_does(self, tmp_path: Path):
        path = write(tmp_path / "cafe.world", "<!-- usage -->\n\n" + sdf('<world name="w"><joint></world>'))
        with pytest.raises(SceneError, match=r"\(line 5: mismatched tag\)"):
            read_scene(path)
        write(path, "<!-- usage -->\n" + sdf(cube_model("a", "")))
        assert [obj.name for obj in read_scene(path).objects] == ["a"]

    def test_things_that_are_left_out_are_noted(self, tmp_path: Path):
        hill = visual("<heightmap><uri>hill.png</uri></heightmap>", name="hill")
        body = f'<road name="r"/><model name="m"><link name="l">{hill}{visual("<empty/>")}</link></model>'
        scene = read_scene(world(tmp_path / "hills.world", body, "1.99"))
        assert notes_of(scene) == [
            "hills.world, line 2: the version of SDFormat is '1.99'; it is read as 1.12",
            "hills.world, line 4: <road> is left out",
            "hills.world, line 4: the visual 'hill' is a heightmap, which is left out",
        ]


class TestPoses:
    def test_angles_turn_about_fixed_x_then_y_then_z(self):
        # x goes to -z under the pitch and stays there; y goes to z under the roll, to x under the pitch, to y.
        matrix = pose_matrix(1, 2, 3, math.pi / 2, math.pi / 2, math.pi / 2)
        assert matrix @ (1, 0, 0, 1) == pytest.approx((1, 2, 2, 1))
        assert matrix @ (0, 1, 0, 1) == pytest.approx((1, 3, 3, 1))

    @given(st.tuples(*[st.floats(-10, 10)] * 3), st.tuples(*[st.floats(-7, 7)] * 3))
    def test_angles_are_the_product_of_three_turns(self, position, angles):
        def turn(axis: int, angle: float) -> np.ndarray:
            matrix = np.eye(4)
            i, j = (axis + 1) % 3, (axis + 2) % 3
            matrix[i, i] = matrix[j, j] = math.cos(angle)
            matrix[i, j], matrix[j, i] = -math.sin(angle), math.sin(angle)
            return matrix

        move = np.eye(4)
        move[:3, 3] = position
        roll, pitch, yaw = angles
        expected = move @ turn(2, yaw) @ turn(1, pitch) @ turn(0, roll)
        assert np.allclose(pose_matrix(*position, *angles), expected, atol=1e-9)

    def test_a_quaternion_is_the_same_turn(self):
        half = math.sin(math.pi / 4)
        found = quaternion_matrix((1, 2, 3), 0, 0, 2 * half, 2 * half)
        assert found is not None
        assert np.allclose(found, pose_matrix(1, 2, 3, 0, 0, math.pi / 2))
        assert quaternion_matrix((1, 2, 3), 0, 0, 0, 0) is None

    @pytest.mark.parametrize(
        "pose",
        [
            f"<pose>1 2 3 0 0 {HALF_PI}</pose>",
            "<pose degrees='true'>1 2 3 0 0 90</pose>",
            "<pose rotation_format='quat_xyzw'>1 2 3\n 0 0 0.7071067811865476 0.7071067811865476</pose>",
            f"<pose rotation_format='euler_rpy' relative_to=''>  1 2\t3 0 -0 {HALF_PI}  </pose>",
            # SDFormat 1.6
            f"<pose frame=''>1 2 3 0 0 {HALF_PI}</pose>",
        ],
    )
    def test_the_notations_of_a_pose_agree(self, tmp_path: Path, pose: str):
        stage = stage_of(world(tmp_path / "a.sdf", cube_model("m", pose)), tmp_path)
        assert np.allclose(to_world(stage, "/room/m/link"), pose_matrix(1, 2, 3, 0, 0, math.pi / 2))

    @pytest.mark.parametrize("text", ["1 2 3", "a b c d e f", "nan 0 0 0 0 0", "1e300 0 0 0 0 0", "0 0 0 0 0 0 1"])
    def test_a_broken_pose_is_noted(self, tmp_path: Path, text: str):
        scene = read_scene(world(tmp_path / "a.sdf", cube_model("m", f"<pose>{text}</pose>")))
        assert center(scene, "/room/m") == pytest.approx((0, 0, 0))
        assert notes_of(scene) == [
            f"a.sdf, line 4: the pose is {text!r}, expected 6 numbers; it is taken as zero",
        ]


class TestFrames:
    def test_poses_are_relative_to_named_frames(self, tmp_path: Path):
        body = (
            f'<frame name="corner"><pose>1 2 0 0 0 {HALF_PI}</pose></frame>'
            '<frame name="shelf" attached_to="corner"><pose>1 0 1 0 0 0</pose></frame>'
            + cube_model("a", '<pose relative_to="shelf">1 0 0 0 0 0</pose>')
            + cube_model("b", '<pose relative_to="a">0 1 0 0 0 0</pose>')
        )
        scene = read_scene(world(tmp_path / "a.sdf", body))
        # The corner turns x to y: 1 2 0, then 1 and 1 in y and 1 in z.
        assert center(scene, "/room/a") == pytest.approx((1, 4, 1))
        # y of the turned model is -x.
        assert center(scene, "/room/b") == pytest.approx((0, 4, 1))

    def test_links_and_visuals_follow_joints_and_frames(self, tmp_path: Path):
        body = f"""<model name="m"><pose>10 0 0 0 0 0</pose>
        <link name="base">{visual(box(0.1, 0.1, 0.1))}</link>
        <link name="arm"><pose relative_to="hinge"/>{visual(box(0.1, 0.1, 0.1), '<pose relative_to="tip"/>')}</link>
        <joint name="hinge" type="revolute"><pose relative_to="base">0 0 1 0 0 0</pose>
          <parent>base</parent><child>arm</child><axis><xyz>0 1 0</xyz></axis></joint>
        <frame name="tip" attached_to="arm"><pose>0.5 0 0 0 0 0</pose></frame></model>"""
        stage = stage_of(world(tmp_path / "a.sdf", body), tmp_path)
        assert to_world(stage, "/room/m/arm")[:3, 3] == pytest.approx((10, 0, 1))
        assert to_world(stage, "/room/m/arm/visual")[:3, 3] == pytest.approx((10.5, 0, 1))

    def test_the_placement_frame_is_what_the_pose_places(self, tmp_path: Path):
        body = (
            '<model name="m" placement_frame="top"><pose>0 0 2 0 0 0</pose>'
            f'<link name="link">{visual(box(0.2, 0.2, 0.2))}</link>'
            '<frame name="top" attached_to="link"><pose>0 0 0.5 0 0 0</pose></frame></model>'
            + cube_model("n", '<pose relative_to="m::top">0 0 1 0 0 0</pose>')
        )
        scene = read_scene(world(tmp_path / "a.sdf", body))
        assert center(scene, "/room/m") == pytest.approx((0, 0, 1.5))
        assert center(scene, "/room/n") == pytest.approx((0, 0, 3))

    @pytest.mark.parametrize(
        ("frames", "note"),
        [
            ('<frame name="f"><pose relative_to="g"/></frame>', "the frame 'g' is not in this scope"),
            (
                '<frame name="f"><pose relative_to="g"/></frame><frame name="g" attached_to="f"/>',
                "the frame 'f' is relative to itself",
            ),
        ],
    )
    def test_a_frame_that_leads_nowhere_is_noted(self, tmp_path: Path, frames: str, note: str):
        body = frames + cube_model("m", '<pose relative_to="f">1 0 0 0 0 0</pose>')
        scene = read_scene(world(tmp_path / "a.sdf", body))
        assert center(scene, "/room/m") == pytest.approx((1, 0, 0))
        assert notes_of(scene) == [f"a.sdf: {note}; world is used"]

    @given(st.data())
    def test_resolved_poses_are_the_products_of_the_chain(self, data):
        count = data.draw(st.integers(1, 12))
        numbers = st.floats(-3, 3, allow_nan=False)
        frames, expected = [], {}
        for index in range(count):
            matrix = pose_matrix(*data.draw(st.tuples(*[numbers] * 6)))
            above = data.draw(st.sampled_from(["world", *expected]))
            frames.append(SdfFrame(f"f{index}", Pose(matrix, above)))
            expected[f"f{index}"] = expected.get(above, np.eye(4)) @ matrix
        shuffled = data.draw(st.permutations(frames))
        scope = Scope(SdfWorld("w", (), tuple(shuffled)), Notes(), Path("w.sdf"))
        for name, matrix in expected.items():
            assert np.allclose(scope.pose(name), matrix, atol=1e-9)

    def test_a_long_chain_of_frames_needs_no_recursion(self):
        frames = [SdfFrame("f0", Pose(np.eye(4)))]
        step = pose_matrix(1, 0, 0, 0, 0, 0)
        frames += [SdfFrame(f"f{index}", Pose(step, f"f{index - 1}")) for index in range(1, 5000)]
        found = Scope(SdfWorld("w", (), tuple(frames)), Notes(), Path("w.sdf")).pose("f4999")
        assert found is not None
        assert found[0, 3] == pytest.approx(4999)


class TestNestedModels:
    def test_nested_models_are_parts_in_the_frame_of_the_model(self, tmp_path: Path):
        inner = cube_model("drawer", "<pose>0 0 1 0 0 0</pose>")
        body = f'<model name="desk"><pose>5 0 0 0 0 0</pose><link name="l">{visual(box(1, 1, 1))}</link>{inner}</model>'
        scene = read_scene(world(tmp_path / "a.sdf", body + cube_model("box", "")))
        assert [obj.prim_path for obj in scene.objects] == ["/room/desk", "/room/box"]
        assert to_world(stage_of(tmp_path / "a.sdf", tmp_path), "/room/desk/drawer")[:3, 3] == pytest.approx((5, 0, 1))

    def test_a_model_that_only_holds_models_is_a_group(self, tmp_path: Path):
        body = f'<model name="set"><pose>5 0 0 0 0 0</pose>{cube_model("a", "")}{cube_model("b", "")}</model>'
        scene = read_scene(world(tmp_path / "a.sdf", body))
        assert [obj.prim_path for obj in scene.objects] == ["/room/set/a", "/room/set/b"]

    def test_models_that_a_joint_connects_are_one_object(self, tmp_path: Path):
        joint = '<joint name="j" type="fixed"><parent>a::link</parent><child>b</child></joint>'
        body = f'<model name="robot">{cube_model("a", "")}{cube_model("b", "")}{joint}</model>'
        scene = read_scene(world(tmp_path / "a.sdf", body + cube_model("box", "")))
        assert [obj.prim_path for obj in scene.objects] == ["/room/robot", "/room/box"]
        (found,) = scene.joints
        assert (found.type, found.body0, found.body1) == ("fixed", "/room/robot/a/link", "/room/robot/b/link")


CHAIR = sdf(
    '<model name="aws_robomaker_residential_Chair_01"><pose>0 0 9 0 0 0</pose>'
    f'<link name="link"><pose>0 0 0.1 0 0 0</pose>{visual(box(0.2, 0.2, 0.2))}</link>'
    '<frame name="seat" attached_to="link"><pose>0 0 0.4 0 0 0</pose></frame></model>',
    "1.6",
)
CONFIG = (
    '<model><name>Dining chair</name><version>1.0</version><sdf version="1.4">old.sdf</sdf>'
    '<sdf version="1.6">model.sdf</sdf><description>A chair of oak.</description></model>'
)


def put_chair(folder: Path) -> Path:
    write(folder / "model.sdf", CHAIR)
    write(folder / "model.config", CONFIG)
    return folder


NAME = "aws_robomaker_residential_Chair_01"
INCLUDE = f"<include><uri>model://{NAME}</uri><name>Chair_01_001</name><pose>1 2 0 0 0 0</pose></include>"


class TestIncludes:
    @pytest.mark.parametrize("folder", ["worlds", "worlds/models", "models"])
    def test_models_are_found_beside_the_world(self, tmp_path: Path, folder: str):
        put_chair(tmp_path / folder / NAME)
        scene = read_scene(world(tmp_path / "worlds" / "house.world", INCLUDE))
        (chair,) = scene.objects
        assert (chair.prim_path, chair.asset) == ("/room/Chair_01_001", (NAME,))
        # The pose of the include replaces that of the model.
        assert center(scene, chair.prim_path) == pytest.approx((1, 2, 0.1))
        assert ("customData:sdf:description", "A chair of oak.") in chair.texts
        assert notes_of(scene) == []

    @pytest.mark.parametrize("variable", ["GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH"])
    def test_models_are_found_on_the_model_path(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, variable: str):
        put_chair(tmp_path / "elsewhere" / NAME)
        monkeypatch.setenv(variable, f"/no/such/folder::{tmp_path / 'elsewhere'}")
        assert notes_of(read_scene(world(tmp_path / "worlds" / "house.world", INCLUDE))) == []

    @pytest.mark.parametrize(
        "uri",
        [
            NAME,
            f"models/{NAME}",
            f"models/{NAME}/model.sdf",
            f"model://{NAME}/model.sdf",
            f"package://{NAME}",
            f"https://fuel.gazebosim.org/1.0/OpenRobotics/models/{NAME}/2",
        ],
    )
    def test_the_kinds_of_uris_lead_to_the_model(self, tmp_path: Path, uri: str):
        put_chair(tmp_path / "models" / NAME)
        scene = read_scene(world(tmp_path / "house.world", f"<include><uri>{uri}</uri></include>"))
        (chair,) = scene.objects
        assert (chair.name, chair.asset[0]) == (NAME, NAME)
        # Without a pose of the include, that of the model counts.
        assert center(scene, chair.prim_path) == pytest.approx((0, 0, 9.1))

    def test_a_model_that_wraps_an_include_has_its_asset(self, tmp_path: Path):
        put_chair(tmp_path / "models" / NAME)
        # As the worlds of AWS RoboMaker are written.
        body = (
            f'<model name="Chair_7"><include><uri>model://{NAME}</uri><pose>0 0 0 0 0 0</pose></include>'
            "<pose frame=''>1 0 0 0 0 0</pose></model>"
        )
        scene = read_scene(world(tmp_path / "house.world", body, "1.6"))
        (chair,) = scene.objects
        assert (chair.prim_path, chair.asset) == ("/room/Chair_7", (NAME,))
        assert center(scene, "/room/Chair_7") == pytest.approx((1, 0, 0.1))

    def test_a_missing_model_keeps_name_and_pose(self, tmp_path: Path):
        source = world(tmp_path / "house.world", INCLUDE)
        scene = read_scene(source)
        (chair,) = scene.objects
        assert (chair.name, chair.asset, chair.box) == ("Chair_01_001", (NAME,), None)
        assert to_world(stage_of(source, tmp_path), "/room/Chair_01_001")[:3, 3] == pytest.approx((1, 2, 0))
        assert notes_of(scene) == [
            f"house.world, line 4: the model model://{NAME} is not read (it is neither in the folder of the file "
            "nor in models nor in the folders of GZ_SIM_RESOURCE_PATH); it has no geometry"
        ]

    @pytest.mark.parametrize(
        ("text", "reason"),
        [
            ("<sdf version='1.6'>\n<model name='a'>\n</sdf>", "line 3: mismatched tag"),
            ("<?xml version='1.0' encoding='shift_jis'?>\n<sdf/>", "line 1: multi-byte encodings are not supported"),
        ],
    )
    def test_a_broken_model_is_noted(self, tmp_path: Path, text: str, reason: str):
        write(tmp_path / "models" / NAME / "model.sdf", text)
        scene = read_scene(world(tmp_path / "house.world", INCLUDE + cube_model("a", "")))
        assert [obj.name for obj in scene.objects] == ["Chair_01_001", "a"]
        (note,) = notes_of(scene)
        assert f"is not read ({reason}); it has no geometry" in note

    def test_a_broken_config_leaves_the_model(self, tmp_path: Path):
        folder = put_chair(tmp_path / "models" / NAME)
        write(folder / "model.config", "<model><name>Dining chair</model>")
        scene = read_scene(world(tmp_path / "house.world", INCLUDE))
        (chair,) = scene.objects
        assert center(scene, chair.prim_path) == pytest.approx((1, 2, 0.1))
        assert notes_of(scene) == [
            f"house.world, line 4: the model.config of model://{NAME} is not read (line 1: mismatched tag); "
            "its name and description are left out"
        ]

    def test_an_included_file_is_parsed_once(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        parsed: list[str] = []
        monkeypatch.setattr(xml_files, "read_xml", lambda path: parsed.append(path.name) or read_xml(path))
        put_chair(tmp_path / "models" / NAME)
        write(tmp_path / "models/broken/model.sdf", "<sdf>")
        source = world(tmp_path / "house.world", (INCLUDE + "<include><uri>model://broken</uri></include>") * 3)
        assert len(read_scene(source).objects) == 6
        assert sorted(parsed) == ["house.world", "model.config", "model.sdf", "model.sdf"]

    def test_placement_frame_and_static_of_an_include(self, tmp_path: Path):
        put_chair(tmp_path / "models" / NAME)
        placed = INCLUDE.replace("</include>", "<placement_frame>seat</placement_frame><static>true</static></include>")
        stage = stage_of(world(tmp_path / "house.world", placed), tmp_path)
        # The seat is 0.5 m above the model's origin.
        assert to_world(stage, "/room/Chair_01_001")[:3, 3] == pytest.approx((1, 2, -0.5))
        assert not stage.GetPrimAtPath("/room/Chair_01_001/link").HasAPI(UsdPhysics.RigidBodyAPI)

    def test_a_merged_include_has_its_links_in_the_model(self, tmp_path: Path):
        put_chair(tmp_path / "models" / NAME)
        body = f"""<model name="robot"><link name="base">{visual(box(1, 1, 1))}</link>
        <include merge="true"><uri>model://{NAME}</uri><pose relative_to="base">0 0 1 0 0 {HALF_PI}</pose></include>
        <joint name="j" type="fixed"><parent>base</parent><child>seat</child></joint></model>"""
        stage = stage_of(world(tmp_path / "a.sdf", body), tmp_path)
        assert [child.GetName() for child in stage.GetPrimAtPath("/room/robot").GetChildren()] == ["base", "link", "j"]
        assert np.allclose(to_world(stage, "/room/robot/link"), pose_matrix(0, 0, 1.1, 0, 0, math.pi / 2))
        joint = UsdPhysics.Joint(stage.GetPrimAtPath("/room/robot/j"))
        assert joint.GetBody1Rel().GetTargets() == ["/room/robot/link"]

    def test_the_centre_of_mass_of_a_merged_link_keeps_its_frame(self, tmp_path: Path):
        inertial = '<inertial><pose relative_to="__model__">0.5 0 0 0 0 0</pose><mass>1</mass></inertial>'
        link = f'<link name="a"><pose>0 1 0 0 0 0</pose>{inertial}</link>'
        write(tmp_path / "part.sdf", sdf(f'<model name="part">{link}</model>'))
        include = f'<include merge="true"><uri>part.sdf</uri><pose>0 0 5 0 0 {HALF_PI}</pose></include>'
        stage = stage_of(world(tmp_path / "a.sdf", f'<model name="m"><link name="base"/>{include}</model>'), tmp_path)
        mass = UsdPhysics.MassAPI(stage.GetPrimAtPath("/room/m/a"))
        # In the frame of the link, which is that of the part moved by 0 1 0.
        assert tuple(mass.GetCenterOfMassAttr().Get()) == pytest.approx((0.5, -1, 0))

    def test_lights_that_are_included_are_left_out(self, tmp_path: Path):
        write(tmp_path / "models/lamp/model.sdf", sdf('<light name="lamp" type="point"/>'))
        body = cube_model("a", "") + "<include><uri>model://lamp</uri></include>"
        scene = read_scene(world(tmp_path / "a.sdf", body))
        assert ([obj.name for obj in scene.objects], notes_of(scene)) == (["a"], [])


class TestShapes:
    @pytest.mark.parametrize(
        ("geometry", "size"),
        [
            (box(1, 2, 3), (1, 2, 3)),
            ("<sphere><radius>0.5</radius></sphere>", (1, 1, 1)),
            ("<cylinder><radius>0.5</radius><length>3</length></cylinder>", (1, 1, 3)),
            # The length of a capsule is without its caps.
            ("<capsule><radius>0.5</radius><length>3</length></capsule>", (1, 1, 4)),
            ("<cone><radius>0.5</radius><length>3</length></cone>", (1, 1, 3)),
            ("<ellipsoid><radii>0.5 1 1.5</radii></ellipsoid>", (1, 2, 3)),
            ("<plane><normal>0 0 1</normal><size>4 2</size></plane>", (4, 2, 0)),
            ("<plane><normal>0 1 0</normal><size>4 2</size></plane>", (4, 0, 2)),
            ("<plane><normal>0 0 -1</normal><size>4 2</size></plane>", (4, 2, 0)),
        ],
    )
    def test_shapes_have_their_sizes_about_their_origin(self, tmp_path: Path, geometry: str, size: tuple[float, ...]):
        body = f'<model name="m"><pose>1 0 0 0 0 0</pose><link name="l">{visual(geometry)}</link></model>'
        scene = read_scene(world(tmp_path / "a.sdf", body))
        found = scene.by_path["/room/m"].box
        assert found is not None
        assert found.size == pytest.approx(size, abs=1e-6)
        assert center(scene, "/room/m") == pytest.approx((1, 0, 0), abs=1e-6)
        assert notes_of(scene) == []

    def test_a_polyline_is_extruded_with_its_holes(self, tmp_path: Path):
        pytest.importorskip("mapbox_earcut", reason="needs the extra sdf")
        trimesh = pytest.importorskip("trimesh", reason="needs the extra sdf")
        outline = "".join(
            f"<point>{x} {y}</point>" for x, y in [(0, 0), (0, 3), (1, 3), (1, 1), (3, 1), (3, 0), (0, 0)]
        )
        hole = "".join(f"<point>{x} {y}</point>" for x, y in [(0.2, 0.2), (0.7, 0.2), (0.7, 0.7), (0.2, 0.7)])
        rings = "".join(f"<polyline>{ring}<height>2</height></polyline>" for ring in (outline, hole))
        stage = stage_of(
            world(tmp_path / "a.sdf", f'<model name="m"><link name="l">{visual(rings)}</link></model>'), tmp_path
        )
        mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/room/m/l/visual"))
        points = np.array(mesh.GetPointsAttr().Get())
        solid = trimesh.Trimesh(points, np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3))
        assert solid.is_watertight
        # An L of 5 m² without 0.25 m², 2 m high; positive, so that the faces look outwards.
        assert solid.volume == pytest.approx(9.5)
        assert points[:, 2].min() == 0

    def test_colour_opacity_and_named_material(self, tmp_path: Path):
        wood = "<script><name>Gazebo/Wood</name></script><diffuse>0.5 0.5 0.5 0.5</diffuse>"
        body = (
            f'<model name="m"><link name="l">'
            f"{visual(box(1, 1, 1), f'<transparency>0.5</transparency><material>{wood}</material>')}</link></model>"
            f'<model name="n"><link name="l">{visual(box(1, 1, 1), "<material><ambient>0 1 0 1</ambient></material>")}'
            "</link></model>"
        )
        source = world(tmp_path / "a.sdf", body)
        m, n = read_scene(source).objects
        assert m.materials == ("Wood",)
        # 0.5 of sRGB is 0.214 of the light.
        assert m.display_color == pytest.approx((0.214, 0.214, 0.214), abs=1e-3)
        assert (n.display_color, n.materials) == (pytest.approx((0, 1, 0)), ())
        stage = stage_of(source, tmp_path)
        gprim = UsdGeom.Gprim(stage.GetPrimAtPath("/room/m/l/visual"))
        assert list(gprim.GetDisplayOpacityAttr().Get()) == [0.25]


STL = """solid tetrahedron
facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet
facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet
facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet
facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet
endsolid tetrahedron
"""
DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="fx"><profile_COMMON><technique sid="t"><phong>
<diffuse><color>0 0 1 1</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="paint" name="paint"><instance_effect url="#fx"/></material></library_materials>
<library_geometries>{geometries}</library_geometries>
<library_visual_scenes><visual_scene id="scene">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>
"""


def dae(**nodes: float) -> str:
    """Return a COLLADA file in centimetres with a triangle with legs of 100 for each node, moved along x."""
    geometries = "".join(
        f'<geometry id="{name}-lib"><mesh><source id="{name}-p"><float_array id="{name}-a" count="9">'
        "0 0 0 100 0 0 0 100 0</float_array><technique_common>"
        f'<accessor source="#{name}-a" count="3" stride="3"><param name="X" type="float"/>'
        f'<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>'
        f'<vertices id="{name}-v">'
        f'<input semantic="POSITION" source="#{name}-p"/></vertices><triangles count="1" material="paint">'
        f'<input semantic="VERTEX" source="#{name}-v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>'
        for name in nodes
    )
    instances = "".join(
        f'<node id="{name}" name="{name}"><matrix>1 0 0 {x} 0 1 0 0 0 0 1 0 0 0 0 1</matrix>'
        f'<instance_geometry url="#{name}-lib"><bind_material><technique_common>'
        '<instance_material symbol="paint" target="#paint"/></technique_common></bind_material>'
        "</instance_geometry></node>"
        for name, x in nodes.items()
    )
    return DAE.format(geometries=geometries, nodes=instances)


class TestMeshes:
    @pytest.fixture(autouse=True)
    def needs_trimesh(self):
        pytest.importorskip("trimesh", reason="needs the extra sdf")

    def mesh_world(self, path: Path, mesh: str, more: str = "") -> Path:
        return world(path, f'<model name="m"><link name="l">{visual(f"<mesh>{mesh}</mesh>", more)}</link></model>')

    def test_a_mesh_is_scaled_and_painted(self, tmp_path: Path):
        write(tmp_path / "models/part/meshes/part.stl", STL)
        source = self.mesh_world(
            tmp_path / "a.sdf",
            "<uri>model://part/meshes/part.stl</uri><scale>0.1 0.2 -0.3</scale>",
            "<pose>1 0 0 0 0 0</pose><material><diffuse>0 1 0 1</diffuse></material>",
        )
        (found,) = read_scene(source).objects
        assert found.box is not None
        assert (found.box.lower, found.box.upper) == (pytest.approx((1, 0, -0.3)), pytest.approx((1.1, 0.2, 0)))
        assert found.display_color == pytest.approx((0, 1, 0))

    @pytest.mark.parametrize("uri", ["file://part/meshes/part.stl", "meshes/part.stl", "model://part/meshes/part.stl"])
    def test_a_mesh_is_found_from_the_folder_of_its_model(self, tmp_path: Path, uri: str):
        write(tmp_path / "models/part/meshes/part.stl", STL)
        mesh = visual(f"<mesh><uri>{uri}</uri></mesh>")
        write(tmp_path / "models/part/model.sdf", sdf(f'<model name="part"><link name="l">{mesh}</link></model>'))
        scene = read_scene(world(tmp_path / "a.sdf", "<include><uri>model://part</uri></include>"))
        assert notes_of(scene) == []
        assert scene.objects[0].box is not None
        # Alone, the model finds its own folder, too.
        if uri.startswith("model"):
            assert notes_of(read_scene(tmp_path / "models/part/model.sdf")) == []

    def test_collada_is_in_its_unit_and_not_turned(self, tmp_path: Path):
        pytest.importorskip("collada", reason="needs the extra sdf")
        write(tmp_path / "two.dae", dae(left=0, right=200))
        (found,) = read_scene(self.mesh_world(tmp_path / "a.sdf", "<uri>two.dae</uri>")).objects
        assert found.box is not None
        # Gazebo ignores up_axis.
        assert (found.box.lower, found.box.upper) == (pytest.approx((0, 0, 0)), pytest.approx((3, 1, 0)))
        assert found.display_color == pytest.approx((0, 0, 1))

    @pytest.mark.parametrize(("is_centered", "lower"), [("false", (2, 0, 0)), ("true", (-0.5, -0.5, 0))])
    def test_a_submesh_is_a_node_of_the_file(self, tmp_path: Path, is_centered: str, lower: tuple[float, ...]):
        pytest.importorskip("collada", reason="needs the extra sdf")
        write(tmp_path / "two.dae", dae(left=0, right=200))
        submesh = f"<submesh><name>right</name><center>{is_centered}</center></submesh>"
        (found,) = read_scene(self.mesh_world(tmp_path / "a.sdf", f"<uri>two.dae</uri>{submesh}")).objects
        assert found.box is not None
        assert found.box.lower == pytest.approx(lower)
        assert found.box.size == pytest.approx((1, 1, 0))

    def test_an_unknown_submesh_is_noted(self, tmp_path: Path):
        write(tmp_path / "part.stl", STL)
        source = self.mesh_world(tmp_path / "a.sdf", "<uri>part.stl</uri><submesh><name>lid</name></submesh>")
        assert notes_of(read_scene(source)) == [
            "a.sdf, line 4: the mesh part.stl has no submesh 'lid'; all of it is shown"
        ]

    @pytest.mark.parametrize(
        ("uri", "content", "reason"),
        [
            ("gone.stl", None, "it is neither in the folder of the file"),
            ("part.fbx", "", r"its ending is '.fbx'"),
            ("part.stl", "solid nothing\nendsolid nothing\n", "cannot be converted"),
            (".", None, "it is a folder"),
        ],
    )
    def test_a_mesh_that_cannot_be_read_is_noted(self, tmp_path: Path, uri: str, content: str | None, reason: str):
        if content is not None:
            write(tmp_path / uri, content)
        scene = read_scene(self.mesh_world(tmp_path / "a.sdf", f"<uri>{uri}</uri>"))
        (note,) = notes_of(scene)
        assert note.startswith(f"a.sdf, line 4: the mesh {uri} is not read (")
        assert reason in note
        assert [obj.name for obj in scene.objects] == ["m"]

    @pytest.mark.parametrize(("library", "materials"), [("../paint/red.mtl", ("red",)), ("../../../red.mtl", ())])
    def test_material_libraries_are_read_within_the_folders(
        self, tmp_path: Path, library: str, materials: tuple[str, ...]
    ):
        folder = tmp_path / "deep" / "part" / "meshes"
        write(folder / "part.obj", f"mtllib {library}\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        write(folder / library, "newmtl red\nKd 1 0 0\n")
        source = self.mesh_world(tmp_path / "deep" / "part" / "a.sdf", "<uri>meshes/part.obj</uri>")
        (found,) = read_scene(source).objects
        assert found.box is not None
        assert found.materials == materials

    def test_a_missing_package_names_its_install_command(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        write(tmp_path / "two.dae", dae(left=0))
        monkeypatch.setitem(sys.modules, "collada", None)
        source = self.mesh_world(tmp_path / "a.sdf", "<uri>two.dae</uri>")
        with pytest.raises(
            SceneError, match=r"needs collada, which is not installed; run: pip install 'usd2kg\[sdf\]'"
        ):
            read_scene(source)

    def test_collada_with_entities_is_not_read(self, tmp_path: Path):
        pytest.importorskip("collada", reason="needs the extra sdf")
        bomb = '<?xml version="1.0"?>\n<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n<COLLADA>&x;</COLLADA>'
        write(tmp_path / "bomb.dae", bomb)
        (note,) = notes_of(read_scene(self.mesh_world(tmp_path / "a.sdf", "<uri>bomb.dae</uri>")))
        assert "line 2: it declares the XML entity 'x'" in note

    @pytest.mark.parametrize(
        ("count", "repeats", "last", "reason"),
        [
            (40, 2, "<instance_geometry url='#a-lib'/>", "line 8: it has more than 10,000 nodes and geometries"),
            # Without geometries, the nodes alone are too many.
            (40, 2, "", "line 8: it has more than 10,000 nodes and geometries"),
            (3, 1, "<instance_node url='#n0'/>", "line 9: the node 'n0' contains itself"),
            (5000, 1, "", "its nodes are nested more than 100 deep"),
        ],
    )
    def test_collada_whose_nodes_multiply_is_not_read(
        self, tmp_path: Path, count: int, repeats: int, last: str, reason: str
    ):
        pytest.importorskip("collada", reason="needs the extra sdf")
        instances = [f"<instance_node url='#n{index + 1}'/>" * repeats for index in range(count)]
        nodes = "".join(f"<node id='n{index}'>{inner}</node>" for index, inner in enumerate([*instances, last]))
        root = "<node id='root'><instance_node url='#n0'/></node>"
        text = DAE.format(geometries="", nodes=root).replace(
            "<scene>", f"<library_nodes>{nodes}</library_nodes>\n<scene>"
        )
        write(tmp_path / "bomb.dae", text)
        (note,) = notes_of(read_scene(self.mesh_world(tmp_path / "a.sdf", "<uri>bomb.dae</uri>")))
        assert reason in note

    def test_collada_may_repeat_nodes(self, tmp_path: Path):
        pytest.importorskip("collada", reason="needs the extra sdf")
        text = dae(left=0).replace("<library_visual_scenes>", "<library_nodes>", 1)
        text = text.replace('<visual_scene id="scene">', "").replace("</visual_scene>", "")
        places = "".join(
            f"<node><translate>{x} 0 0</translate><instance_node url='#left'/></node>" for x in (0, 100, 200)
        )
        scene = f'</library_nodes><library_visual_scenes><visual_scene id="scene">{places}</visual_scene>'
        write(tmp_path / "row.dae", text.replace("</library_visual_scenes>", f"{scene}</library_visual_scenes>"))
        (found,) = read_scene(self.mesh_world(tmp_path / "a.sdf", "<uri>row.dae</uri>")).objects
        assert found.box is not None
        assert (found.box.lower, found.box.upper) == (pytest.approx((0, 0, 0)), pytest.approx((3, 1, 0)))

    def test_a_mesh_that_cannot_be_read_is_tried_once(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        loaded: list[Path] = []
        monkeypatch.setattr(
            meshes, "load_scene", lambda path, *_, **options: loaded.append(path) or load_scene(path, *_, **options)
        )
        write(tmp_path / "part.stl", "solid nothing\nendsolid nothing\n")
        visuals = "\n".join(visual("<mesh><uri>part.stl</uri></mesh>", name=name) for name in "abc")
        scene = read_scene(world(tmp_path / "a.sdf", f'<model name="m"><link name="l">{visuals}</link></model>'))
        assert (len(loaded), len(notes_of(scene))) == (1, 3)


def jointed(joint: str, turn: str = "0") -> str:
    cube = visual(box(0.1, 0.1, 0.1))
    return (
        f'<model name="m"><pose>1 0 0 0 0 {turn}</pose><link name="a">{cube}</link>'
        f'<link name="b"><pose>0 2 0 0 0 {HALF_PI}</pose>{cube}</link>{joint}</model>'
    )


class TestJoints:
    def test_a_revolute_joint_has_limits_axis_and_origin(self, tmp_path: Path):
        joint = """<joint name="hinge" type="revolute"><pose>0.5 0 0 0 0 0</pose><parent>a</parent><child>b</child>
        <axis><xyz>1 0 0</xyz><limit><lower>-1.5</lower><upper>1e16</upper></limit></axis></joint>"""
        (found,) = read_scene(world(tmp_path / "a.sdf", jointed(joint))).joints
        assert (found.type, found.body0, found.body1) == ("revolute", "/room/m/a", "/room/m/b")
        assert (found.lower, found.upper) == (pytest.approx(-1.5), None)
        # The pose is relative to the child at 1 2 0, whose x is y of the world.
        assert found.origin == pytest.approx((1, 2.5, 0))
        assert found.axis_vector == pytest.approx((0, 1, 0))

    @pytest.mark.parametrize(
        ("version", "axis"),
        [
            ("1.9", '<xyz expressed_in="__model__">1 1 0</xyz>'),
            ("1.6", "<xyz>1 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame>"),
            ("1.4", "<xyz>1 1 0</xyz>"),
        ],
    )
    def test_an_axis_may_be_in_the_frame_of_the_model(self, tmp_path: Path, version: str, axis: str):
        joint = (
            f'<joint name="slide" type="prismatic"><parent>a</parent><child>b</child><axis>{axis}'
            "<limit><lower>0</lower><upper>0.4</upper></limit></axis></joint>"
        )
        (found,) = read_scene(world(tmp_path / "a.sdf", jointed(joint, HALF_PI), version)).joints
        # The model is turned by a quarter: 1 1 0 becomes -1 1 0.
        half = math.sqrt(0.5)
        assert found.axis_vector == pytest.approx((-half, half, 0), abs=1e-6)
        assert (found.type, found.lower, found.upper) == ("prismatic", 0, pytest.approx(0.4))

    @pytest.mark.parametrize(
        ("kind", "found_kind"),
        [("fixed", "fixed"), ("ball", "spherical"), ("continuous", "revolute"), ("universal", "other")],
    )
    def test_the_types_of_joints(self, tmp_path: Path, kind: str, found_kind: str):
        joint = f'<joint name="j" type="{kind}"><parent>world</parent><child>b</child></joint>'
        scene = read_scene(world(tmp_path / "a.sdf", jointed(joint)))
        (found,) = scene.joints
        assert (found.type, found.body0, found.body1) == (found_kind, None, "/room/m/b")
        assert (found.lower, found.upper) == (None, None)
        expected = [
            "a.sdf, line 4: the joint 'j' is of the type 'universal', which USD lacks; it has no axis and no limits"
        ]
        assert notes_of(scene) == (expected if found_kind == "other" else [])

    def test_both_frames_of_a_joint_are_at_the_same_place(self, tmp_path: Path):
        joint = """<joint name="j" type="revolute"><pose>0.1 0.2 0.3 1 2 3</pose><parent>a</parent><child>b</child>
        <axis><xyz>1 2 3</xyz></axis></joint>"""
        stage = stage_of(world(tmp_path / "a.sdf", jointed(joint)), tmp_path)
        found = UsdPhysics.RevoluteJoint(stage.GetPrimAtPath("/room/m/j"))
        frames = []
        for side, body in enumerate("ab"):
            local = np.eye(4)
            rotation = getattr(found, f"GetLocalRot{side}Attr")().Get()
            matrix = quaternion_matrix((0, 0, 0), *rotation.GetImaginary(), rotation.GetReal())
            assert matrix is not None
            local[:3, :3] = matrix[:3, :3]
            local[:3, 3] = getattr(found, f"GetLocalPos{side}Attr")().Get()
            frames.append(to_world(stage, f"/room/m/{body}") @ local)
        assert np.allclose(frames[0], frames[1], atol=1e-6)

    @pytest.mark.parametrize("ends", [("a", "gone"), ("a", "a"), ("world", "world")])
    def test_a_joint_without_two_ends_is_noted(self, tmp_path: Path, ends: tuple[str, str]):
        joint = f'<joint name="j" type="fixed"><parent>{ends[0]}</parent><child>{ends[1]}</child></joint>'
        scene = read_scene(world(tmp_path / "a.sdf", jointed(joint)))
        assert scene.joints == ()
        found = f"{ends[0]!r} and {ends[1]!r}"
        note = f"a.sdf, line 4: the joint 'j' connects {found}, expected two links; it is left out"
        assert note in notes_of(scene)


BOMB = '<?xml version="1.0"?>\n<!DOCTYPE sdf [<!ENTITY a "aaaaaaaaaa">\n<!ENTITY b "&a;&a;&a;&a;">]>\n'


TOO_MANY = (
    "it has more than 500 models, links, visuals, joints, frames and parts of meshes, with those that it includes"
)


class TestHostileFiles:
    @pytest.mark.parametrize(
        ("text", "reason"),
        [
            (" ", "line 1: no element found"),
            ("<sdf version='1.9'><world name='w'>", "line 1: no element found"),
            (sdf("<world>\n</model>"), "line 4: mismatched tag"),
            ("not xml", "line 1: syntax error"),
            ("<?xml version='1.0' encoding='klingon'?>\n<sdf/>", "line 1: unknown encoding"),
            (sdf("<light name='a'/>"), "line 2: it has no world, model or actor"),
            ("<robot name='a'/>", "line 1: the root element is <robot>"),
            (BOMB + "<sdf version='1.9'>&b;</sdf>", "line 2: it declares the XML entity 'a'"),
            ("\n" * 3 + "<a>" * 101, "line 4: its elements are nested more than 100 deep"),
            ("<a>" * 100_000, "line 1: its elements are nested more than 100 deep"),
        ],
    )
    def test_what_is_no_sdformat_is_one_clear_error(self, tmp_path: Path, text: str, reason: str):
        path = write(tmp_path / "bad.sdf", text)
        with pytest.raises(SceneError) as caught:
            read_scene(path)
        assert str(caught.value).startswith(f"{path}: cannot be converted ({reason}")
        assert "expected an SDFormat file, whose root element is <sdf> and has a world or a model" in str(caught.value)
        assert len(str(caught.value).splitlines()) == 1

    def test_an_entity_in_an_included_model_is_noted(self, tmp_path: Path):
        write(tmp_path / "models/a/model.sdf", BOMB + "<sdf version='1.9'>&b;</sdf>")
        (note,) = notes_of(read_scene(world(tmp_path / "w.sdf", "<include><uri>model://a</uri></include>")))
        assert "it declares the XML entity 'a'" in note

    @pytest.mark.parametrize(
        "uri",
        [
            "../../etc/passwd",
            "model://../../secret",
            "model://a/../../../secret",
            "file:///etc/passwd",
            "/etc/passwd",
            "package://../secret",
        ],
    )
    def test_no_uri_leads_out_of_the_folders(self, tmp_path: Path, uri: str):
        put_chair(tmp_path / "secret")
        put_chair(tmp_path / "deep/worlds/a")
        source = tmp_path / "deep/worlds/w.sdf"
        mesh = visual(f"<mesh><uri>{uri}</uri></mesh>")
        world(source, f'<include><uri>{uri}</uri></include><model name="m"><link name="l">{mesh}</link></model>')
        scene = read_scene(source)
        assert all(obj.box is None for obj in scene.objects)
        assert len(notes_of(scene)) == 2
        with pytest.raises(ResourceError):
            Resources(source).find(uri, source.parent)

    def test_links_out_of_the_folders_are_not_followed(self, tmp_path: Path):
        put_chair(tmp_path / "secret")
        (tmp_path / "deep/worlds").mkdir(parents=True)
        (tmp_path / "deep/worlds/chair").symlink_to(tmp_path / "secret")
        source = world(tmp_path / "deep/worlds/w.sdf", "<include><uri>model://chair</uri></include>")
        (note,) = notes_of(read_scene(source))
        assert "it leads out of the folders of the file and of the model path" in note

    @pytest.mark.parametrize("uri", ["\0", "a" * 5000, "model://", "http://[", "::", "~root"])
    def test_odd_uris_lead_nowhere(self, tmp_path: Path, uri: str):
        with pytest.raises(ResourceError):
            Resources(tmp_path / "w.sdf").find(f"{uri}/x", tmp_path)

    def test_circular_includes_are_an_error(self, tmp_path: Path):
        for name, other in ("ab", "ba"):
            include = f"<include><uri>model://{other}</uri></include>"
            write(tmp_path / f"models/{name}/model.sdf", sdf(f'<model name="{name}">\n{include}\n</model>'))
        path = world(tmp_path / "w.sdf", "<include><uri>model://a</uri></include>")
        with pytest.raises(SceneError) as caught:
            read_scene(path)
        assert f"{path}: cannot be converted (model.sdf, line 4: model://a includes itself)" in str(caught.value)

    def test_models_are_not_nested_without_end(self, tmp_path: Path):
        path = write(tmp_path / "deep.sdf", sdf('<model name="m">' * 40 + "</model>" * 40))
        with pytest.raises(SceneError, match=r"deep\.sdf, line 3: it has models that are nested more than 32 deep"):
            read_scene(path)

    def test_includes_that_multiply_are_an_error(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setattr(sdf_budget, "_MAX_ELEMENTS", 500)
        for level in range(20):
            include = f"<include><uri>model://m{level + 1}</uri></include>"
            write(tmp_path / f"models/m{level}/model.sdf", sdf(f'<model name="m">{include}{include}</model>'))
        path = world(tmp_path / "w.sdf", "<include><uri>model://m0</uri></include>")
        with pytest.raises(SceneError, match=TOO_MANY):
            read_scene(path)

    @pytest.mark.parametrize(
        "content",
        [
            f'<model name="m"><link name="l">{visual(box(1, 1, 1)) * 60}</link></model>',
            f'<model name="m">{"<link/>" * 60}</model>',
            f'<model name="m">{"<frame/>" * 60}</model>',
            f'<model name="m">{"<joint/>" * 60}</model>',
            # Neither what is left out nor a light is free.
            f'<model name="m">{"<plugin/>" * 8000}</model>',
            f'<light name="m">{"<plugin/>" * 8000}</light>',
        ],
    )
    def test_everything_in_includes_is_counted(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: str):
        monkeypatch.setattr(sdf_budget, "_MAX_ELEMENTS", 500)
        write(tmp_path / "models/m/model.sdf", sdf(content))
        include = "<include><uri>model://m</uri></include>"
        read_scene(world(tmp_path / "w.sdf", cube_model("a", "") + include * 5))
        with pytest.raises(SceneError, match=TOO_MANY):
            read_scene(world(tmp_path / "w.sdf", include * 10))

    def test_includes_of_lights_are_counted(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setattr(sdf_budget, "_MAX_ELEMENTS", 500)
        path = world(tmp_path / "w.sdf", "<include><uri>model://sun</uri></include>" * 501)
        with pytest.raises(SceneError, match=TOO_MANY):
            read_scene(path)

    def test_the_parts_of_meshes_are_counted(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setattr(sdf_budget, "_MAX_ELEMENTS", 500)
        trimesh = pytest.importorskip("trimesh", reason="needs the extra sdf")
        boxes = trimesh.Scene()
        for index in range(100):
            boxes.add_geometry(trimesh.creation.box(), f"box {index}")
        boxes.export(tmp_path / "boxes.glb")
        mesh = "<mesh><uri>boxes.glb</uri></mesh>"
        assert read_scene(
            world(tmp_path / "w.sdf", f'<model name="m"><link name="l">{visual(mesh) * 4}</link></model>')
        )
        path = world(tmp_path / "w.sdf", f'<model name="m"><link name="l">\n{visual(mesh) * 5}</link></model>')
        with pytest.raises(SceneError, match=f"w.sdf, line 5: {TOO_MANY}"):
            read_scene(path)

    def test_the_triangles_of_repeated_meshes_are_counted(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setattr(sdf_budget, "_MAX_TRIANGLES", 50)
        trimesh = pytest.importorskip("trimesh", reason="needs the extra sdf")
        trimesh.creation.box().export(tmp_path / "box.stl")
        mesh = visual("<mesh><uri>box.stl</uri></mesh>")
        assert read_scene(
            world(tmp_path / "w.sdf", f'<model name="m"><link name="l">{mesh * 4}</link></model>')
        ).objects
        with pytest.raises(SceneError, match="it has more than 50 triangles, with repeated meshes"):
            read_scene(world(tmp_path / "w.sdf", f'<model name="m"><link name="l">{mesh * 5}</link></model>'))

    def test_many_notes_are_counted(self, tmp_path: Path):
        body = "\n".join(f"<include><uri>model://m{index}</uri></include>" for index in range(60))
        notes = notes_of(read_scene(world(tmp_path / "w.sdf", body)))
        assert (len(notes), notes[-1]) == (51, "10 more notes are not listed")

    def test_odd_names_and_uris_are_kept(self, tmp_path: Path):
        body = (
            '<include><uri>model://a\nb@@@c\x85"q"</uri><name>x"@@@\né</name></include>'
            + cube_model("Materials", "")
            + cube_model("a::b/&lt;c>", "")
        )
        source = world(tmp_path / "w.sdf", body)
        assert [obj.display_name or obj.name for obj in read_scene(source).objects] == [
            'x"@@@ é',
            "Materials",
            "a::b/<c>",
        ]
        stage = stage_of(source, tmp_path)
        info = stage.GetDefaultPrim().GetChildren()[0].GetAssetInfo()
        assert info["identifier"].path == 'model://a b@@@c "q"'

    def test_odd_values_do_not_stop_the_reader(self, tmp_path: Path):
        paint = "<material><diffuse>red</diffuse></material>"
        ground = "".join(visual(f"<plane><normal>{x} 0 0</normal></plane>\n") for x in ("0", "1e-200"))
        body = f"""<model><link>{visual("<box><size>1 1</size></box>", paint)}<visual name="v"/></link>
        <joint type="revolute"><parent/><child/></joint><include/></model>
        <model name="m"><link name="l"><inertial><mass>heavy</mass></inertial>{ground}</link></model>"""
        scene = read_scene(world(tmp_path / "w.sdf", body))
        assert [obj.prim_path for obj in scene.objects] == ["/room/model", "/room/m"]
        ground_box = scene.by_path["/room/m"].box
        assert ground_box is not None
        assert ground_box.size == pytest.approx((1, 1, 0))
        notes = notes_of(scene)
        assert len(notes) == 8
        assert sum("the normal of the plane is 0 0 0, expected a direction; it is" in note for note in notes) == 2
