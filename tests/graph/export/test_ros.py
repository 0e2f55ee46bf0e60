"""Exports for ROS 2: static transforms, detections and relations, read back by other parsers."""

import json
import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from tests.graph.records import build_graph, thing
from tests.kitchen import kitchen_graph
from usd2kg.errors import GraphError, OutputError
from usd2kg.graph import PropertyEdge, PropertyGraph, PropertyNode, document_of, read_property_graph
from usd2kg.graph import write_ros2 as write_detections
from usd2kg.graph import write_tf as write_transforms
from usd2kg.graph.export.ros.detections import read_detections, read_relations
from usd2kg.graph.export.ros.frame_ids import frame_id_of
from usd2kg.graph.export.ros.message_text import json_text, yaml_text
from usd2kg.graph.export.ros.transforms import read_transforms
from usd2kg.ontology import TBox

HALF = math.sqrt(0.5)
QUARTER_TURN = (0.0, 0.0, HALF, HALF)
"""90° about z."""

VISION_MSGS = {
    "vision_msgs/msg/ObjectHypothesis": "string class_id\nfloat64 score",
    "vision_msgs/msg/ObjectHypothesisWithPose": (
        "vision_msgs/ObjectHypothesis hypothesis\ngeometry_msgs/PoseWithCovariance pose"
    ),
    "vision_msgs/msg/BoundingBox3D": "geometry_msgs/Pose center\ngeometry_msgs/Vector3 size",
    "vision_msgs/msg/Detection3D": (
        "std_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n"
        "vision_msgs/BoundingBox3D bbox\nstring id"
    ),
    "vision_msgs/msg/Detection3DArray": "std_msgs/Header header\nvision_msgs/Detection3D[] detections",
}
"""The definitions of vision_msgs 4 (ROS 2 Humble to Kilted)."""


@pytest.fixture(scope="module")
def kitchen() -> PropertyGraph:
    return read_property_graph(document_of(kitchen_graph()))


def placed(path: str, at: tuple[float, ...] = (0, 0, 0), turn: tuple[float, ...] = (0, 0, 0, 1), **more: Any):
    """Return a node of an object with a pose."""
    pose = dict(zip(("x", "y", "z", "qx", "qy", "qz", "qw"), map(float, (*at, *turn)), strict=True))
    return PropertyNode(f"urn:{path}", ("Thing", "Object"), {"name": path[1:], "path": path, **pose, **more})


def parts(*pairs: tuple[str, str]) -> tuple[PropertyEdge, ...]:
    return tuple(PropertyEdge(f"urn:{part}", f"urn:{whole}", "PART_OF", {}) for part, whole in pairs)


def by_child(message: Mapping[str, Any]) -> dict[str, tuple[str, list[float], list[float]]]:
    """Return child → frame, translation, rotation; rounded."""
    return {
        each["child_frame_id"]: (
            each["header"]["frame_id"],
            [round(number, 6) + 0 for number in each["transform"]["translation"].values()],
            [round(number, 6) + 0 for number in each["transform"]["rotation"].values()],
        )
        for each in message["transforms"]
    }


class TestFrameIds:
    @given(st.lists(st.text("_uU0/A9é漢🫖-[]. ", max_size=12).map(lambda text: f"/a{text}"), unique=True))
    def test_are_valid_unique_and_reversible(self, paths: list[str]):
        names = [frame_id_of(path) for path in paths]
        assert len(set(names)) == len(paths)
        for path, name in zip(paths, names, strict=True):
            assert re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_/]*", name)
            decoded = re.sub("_u([0-9A-F]{4,6})_", lambda found: chr(int(found[1], 16)), name)
            assert f"/{decoded.replace('_u005F', '_')}" == path.replace("_u005F", "_")

    def test_of_rooms_without_a_prim_come_from_their_iri(self):
        room = PropertyNode("https://my.lab/k/-living-room", ("Thing", "Room"), {"name": "living room", "path": "x"})
        found = read_relations(PropertyGraph((room,), ()))
        assert [(each["id"], each["prim_path"]) for each in found["things"]] == [("_u002D_living_u002D_room", "")]

    @pytest.mark.parametrize("frame", ["", "/map", "map/", "my map", "a//b", "é"])
    def test_world_frame_must_be_one(self, frame: str):
        with pytest.raises(GraphError, match="such as map or site/map"):
            read_transforms(PropertyGraph((placed("/a"),), ()), frame)

    def test_world_frame_may_not_be_an_object(self):
        with pytest.raises(GraphError, match="frame id 'map' is also that of the frame map; choose another --frame"):
            read_transforms(PropertyGraph((placed("/map"),), ()))

    def test_several_scenes_have_no_common_frame(self):
        nodes = (placed("/a", scene="one.usd"), placed("/b", scene="two.usd"))
        with pytest.raises(GraphError, match=r"2 scenes \(one.usd, two.usd\); expected one"):
            read_transforms(PropertyGraph(nodes, ()))


class TestTransforms:
    def test_parts_are_relative_to_their_whole(self):
        cabinet, drawer = placed("/cab", (1, 2, 0), QUARTER_TURN), placed("/cab/drawer", (1, 5, 0.5), QUARTER_TURN)
        cup = placed("/cup", (4, 0, 1))
        graph = PropertyGraph((cabinet, drawer, cup), parts(("/cab/drawer", "/cab")))
        assert by_child(read_transforms(graph, "site/map")) == {
            "cab": ("site/map", [1, 2, 0], [0, 0, 0.707107, 0.707107]),
            # 3 m along the world's y are 3 m along the x of the cabinet.
            "cab/drawer": ("cab", [3, 0, 0.5], [0, 0, 0, 1]),
            "cup": ("site/map", [4, 0, 1], [0, 0, 0, 1]),
        }

    def test_each_part_has_one_whole_and_circles_are_cut(self):
        nodes = [placed(f"/{name}") for name in "abcd"]
        edges = parts(("/a", "/b"), ("/a", "/d"), ("/b", "/c"), ("/c", "/a"), ("/d", "/d"))
        found = by_child(read_transforms(PropertyGraph(tuple(nodes), edges)))
        assert {child: frame for child, (frame, *_) in found.items()} == {"a": "b", "b": "c", "c": "map", "d": "map"}

    def test_objects_without_a_valid_pose_have_no_frame(self):
        broken = [placed("/a", (math.nan, 0, 0)), placed("/b", turn=(0, 0, 0, 0)), placed("/c", (math.inf, 0, 0))]
        bare = PropertyNode("urn:/d", ("Thing", "Object"), {"path": "/d"})
        part = placed("/e", (1, 0, 0))
        graph = PropertyGraph((*broken, bare, part), parts(("/e", "/a")))
        assert by_child(read_transforms(graph)) == {"e": ("map", [1, 0, 0], [0, 0, 0, 1])}

    def test_a_long_chain_of_parts_takes_linear_time(self):
        nodes = tuple(placed(f"/n{number}") for number in range(5_000))
        chain = parts(*((f"/n{number}", f"/n{number + 1}") for number in range(4_999)))
        assert len(read_transforms(PropertyGraph(nodes, chain))["transforms"]) == 5_000

    def test_of_the_kitchen_compose_to_the_poses_of_the_graph(self, kitchen: PropertyGraph):
        found = by_child(read_transforms(kitchen))
        assert len(found) == 294
        poses = {frame_id_of(str(node.properties["path"])): node.properties for node in kitchen.nodes}
        inner = {child: frame for child, (frame, *_) in found.items() if frame != "map"}
        assert len(inner) == sum(edge.type == "PART_OF" for edge in kitchen.edges) > 10
        for child in inner:
            frame, where, _ = found[child]
            while frame != "map":
                turned = rotate(found[frame][2], where)
                where = [a + b for a, b in zip(found[frame][1], turned, strict=True)]
                frame = found[frame][0]
            assert where == pytest.approx([poses[child][name] for name in "xyz"], abs=1e-5)
        for _, _, rotation in found.values():
            assert math.hypot(*rotation) == pytest.approx(1, abs=1e-5)


def rotate(quaternion: list[float], vector: list[float]) -> list[float]:
    """Return a rotated vector, by the matrix of the quaternion."""
    x, y, z, w = quaternion
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    return [sum(a * b for a, b in zip(row, vector, strict=True)) for row in rows]


class TestDetections:
    def test_state_class_score_pose_and_box(self, home_tbox: TBox):
        pose = {"position": (1.0, 2.0, 0.5), "orientation": (0.0, 0.0, 0.0, 1.0)}
        cup = thing("/Room/cup", (1, 2, 0.5), (0.25, 0.5, 0.125), **pose)
        graph = read_property_graph(document_of(build_graph(home_tbox, [(cup, "Cup")])))
        (found,) = read_detections(graph, "odom")["detections"]
        assert found["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "odom"}
        assert found["id"] == "Room/cup"
        (result,) = found["results"]
        assert result["hypothesis"] == {"class_id": home_tbox.resolve("Cup"), "score": 0.75}
        assert result["pose"]["covariance"] == [0.0] * 36
        assert found["bbox"]["center"]["position"] == {"x": 1.125, "y": 2.25, "z": 0.5625}
        assert found["bbox"]["center"]["orientation"] == {"x": 0, "y": 0, "z": 0, "w": 1}
        assert found["bbox"]["size"] == {"x": 0.25, "y": 0.5, "z": 0.125}

    def test_leave_out_what_the_graph_does_not_state(self):
        nodes = (placed("/a"), placed("/b", classIri="urn:Cup"))
        bare, unsure = read_detections(PropertyGraph(nodes, ()))["detections"]
        assert set(bare) == {"header", "id"}
        assert unsure["results"][0]["hypothesis"] == {"class_id": "urn:Cup"}

    def test_relations_name_things_by_their_ids(self, kitchen: PropertyGraph):
        found = read_relations(kitchen)
        things = {each["id"]: each for each in found["things"]}
        assert {each["id"] for each in read_detections(kitchen)["detections"]} < set(things)
        assert things["KitchenDining"]["kind"] == "room"
        bowl = "KitchenDining/breakfastBar/fruitBowl"
        (on,) = (each for each in found["relations"] if (each["subject"], each["relation"]) == (bowl, "on"))
        assert on["object"] == "KitchenDining/breakfastBar/barTable"
        assert on["rule"].startswith("on/")
        assert 0 <= on["gap"] < 0.01
        assert {each[end] for each in found["relations"] for end in ("subject", "object")} <= set(things)


class TestFiles:
    def test_json_and_yaml_hold_the_same_message(self, kitchen: PropertyGraph, tmp_path: Path):
        assert write_transforms(kitchen, tmp_path) == 294
        texts = {path.name: path.read_text("utf-8") for path in tmp_path.iterdir()}
        message = json.loads(texts["tf_static.json"])
        assert yaml.safe_load(texts["tf_static.yaml"]) == yaml.safe_load(texts["tf_static.json"]) == message
        frames = json.loads(texts["frames.json"])
        assert [each["frame_id"] for each in frames["frames"]] == [t["child_frame_id"] for t in message["transforms"]]
        assert {each["prim_path"] for each in frames["frames"]} == {f"/{child}" for child in by_child(message)}

    def test_numbers_are_no_texts_in_yaml_1_1(self):
        value = {"a": [{"b": 1e-05, "c": -1e-12, "d": 1e20}], "e": [1, True, "no"], "f": []}
        expected = {"a": [{"b": 1e-05, "c": 0.0, "d": 1e20}], "e": [1, True, "no"], "f": []}
        assert yaml.safe_load(yaml_text(value)) == yaml.safe_load(json_text(value)) == json.loads(json_text(value))
        assert json.loads(json_text(value)) == expected

    def test_both_profiles_and_runs_give_the_same_files(self, kitchen: PropertyGraph, tmp_path: Path):
        plain = read_property_graph(document_of(kitchen_graph("plain")))
        for name, graph in (("soma", kitchen), ("plain", plain)):
            write_transforms(graph, tmp_path / name)
            write_detections(graph, tmp_path / name)
        for path in (tmp_path / "soma").iterdir():
            assert path.read_bytes() == (tmp_path / "plain" / path.name).read_bytes()

    @pytest.mark.parametrize("write", [write_transforms, write_detections])
    def test_a_file_is_no_folder(self, write: Callable[[PropertyGraph, Path], object], tmp_path: Path):
        (tmp_path / "out").touch()
        with pytest.raises(OutputError, match="choose another folder"):
            write(PropertyGraph((placed("/a"),), ()), tmp_path / "out")


class TestSerialisation:
    """With rosbags, which has the message definitions of ROS 2 and its wire format, CDR."""

    def test_transforms_are_a_tf_message(self, kitchen: PropertyGraph):
        message = read_transforms(kitchen)
        assert through_cdr("tf2_msgs/msg/TFMessage", message) == message

    def test_detections_are_a_detection_3d_array(self, kitchen: PropertyGraph):
        message = read_detections(kitchen)
        assert through_cdr("vision_msgs/msg/Detection3DArray", message) == message


def through_cdr(name: str, message: Mapping[str, Any]) -> Any:
    """Return a message after CDR: every field of the type must be in it, and no other."""
    typesys = pytest.importorskip("rosbags.typesys", reason="needs rosbags: pip install rosbags")
    store = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
    for known, definition in VISION_MSGS.items():
        store.register(typesys.get_types_from_msg(definition, known))
    data = store.serialize_cdr(_typed(store, name, message), name)
    return _untyped(store.deserialize_cdr(data, name))


def _typed(store: Any, name: str, value: Mapping[str, Any]) -> Any:
    fields = dict(store.fielddefs[name][1])
    assert set(value) == set(fields)
    return store.types[name](**{key: _field(store, fields[key], item) for key, item in value.items()})


def _field(store: Any, definition: Any, value: Any) -> Any:
    numpy = pytest.importorskip("numpy")
    kind, detail = definition
    if kind.name == "NAME":
        return _typed(store, detail, value)
    if kind.name == "BASE":
        return value
    element = detail[0]
    if element[0].name == "NAME":
        return [_typed(store, element[1], item) for item in value]
    return numpy.array(value, dtype=element[1][0])


def _untyped(value: Any) -> Any:
    if hasattr(value, "__dataclass_fields__"):
        names = (name for name in value.__dataclass_fields__ if not name.startswith("_"))
        return {name: _untyped(getattr(value, name)) for name in names}
    if hasattr(value, "tolist"):
        return value.tolist()
    return [_untyped(item) for item in value] if isinstance(value, list) else value
