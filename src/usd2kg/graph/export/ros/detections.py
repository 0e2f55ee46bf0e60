"""A semantic map for ROS 2: a vision_msgs/Detection3DArray of all objects, and their relations."""

import math
from pathlib import Path

from usd2kg.graph.export.property_graph import PropertyGraph, PropertyNode
from usd2kg.graph.export.ros.frame_ids import check_frame, read_frame_ids
from usd2kg.graph.export.ros.message_text import json_text, write_files
from usd2kg.graph.export.ros.messages import Message, describe_node, header, named_axes
from usd2kg.graph.export.ros.rigid_transform import RigidTransform, read_pose

__all__ = ["ROS2_FILES", "read_detections", "read_relations", "write_ros2"]

ROS2_FILES = ("detections.json", "relations.json")

_BOX = ("centerX", "centerY", "centerZ", "width", "depth", "height")
_NOT_ROTATED = (0.0, 0.0, 0.0, 1.0)


def write_ros2(graph: PropertyGraph, folder: Path, frame: str = "map") -> tuple[int, int]:
    """Write detections and relations as JSON; return the number of each.

    Args:
        graph: the graph of one scene.
        folder: created if missing.
        frame: id of the world frame.

    Raises:
        GraphError: `frame` is not a frame id, or the graph has several scenes.
        OutputError: a file cannot be written.
    """
    detections, relations = read_detections(graph, frame), read_relations(graph, frame)
    write_files(folder, dict(zip(ROS2_FILES, (json_text(detections), json_text(relations)), strict=True)))
    return len(detections["detections"]), len(relations["relations"])


def read_detections(graph: PropertyGraph, frame: str = "map") -> Message:
    """Return a vision_msgs/Detection3DArray (version 4 or later) with a detection for each object with a pose.

    `id` is the frame id of the object in tf, `class_id` the IRI of its class, `score` the confidence, `results[].pose`
    the pose of the prim's own frame with an unknown covariance (zeros), `bbox` the axis-aligned box. Fields that
    the graph lacks are omitted and keep the default of the message: `results` without a class, `score` without a
    confidence, `bbox` without a box.

    Raises:
        GraphError: `frame` is not a frame id, or the graph has several scenes.
    """
    ids = read_frame_ids(graph, check_frame(frame))
    placed = ((node, read_pose(node.properties)) for node in graph.nodes if node.id in ids)
    found = [_detection(node, pose, ids[node.id], frame) for node, pose in placed if pose is not None]
    return {"header": header(frame), "detections": found}


def read_relations(graph: PropertyGraph, frame: str = "map") -> Message:
    """Return the objects and rooms by id, and the relations between them with their numbers.

    Relations are the edges of the property graph, in lower case: `on`, `inside`, `next_to`, `in_room`. Symmetric
    relations appear once.

    Raises:
        GraphError: `frame` is not a frame id, or the graph has several scenes.
    """
    ids = read_frame_ids(graph, check_frame(frame))
    things = [
        {"id": ids[node.id], "kind": node.labels[1].lower(), **describe_node(node), **_class_id(node)}
        for node in graph.nodes
        if node.id in ids
    ]
    relations = [
        {"subject": ids[edge.start], "relation": edge.type.lower(), "object": ids[edge.end], **edge.properties}
        for edge in graph.edges
        if edge.start in ids and edge.end in ids
    ]
    return {"frame_id": frame, "things": things, "relations": relations}


def _class_id(node: PropertyNode) -> Message:
    return {"class_id": str(node.properties["classIri"])} if "classIri" in node.properties else {}


def _detection(node: PropertyNode, pose: RigidTransform, name: str, frame: str) -> Message:
    return {"header": header(frame), **_results(node, pose), **_bbox(node), "id": name}


def _results(node: PropertyNode, pose: RigidTransform) -> Message:
    if "classIri" not in node.properties:
        return {}
    score = {"score": node.properties["confidence"]} if "confidence" in node.properties else {}
    placed = {"pose": _pose(pose), "covariance": [0.0] * 36}
    return {"results": [{"hypothesis": _class_id(node) | score, "pose": placed}]}


def _bbox(node: PropertyNode) -> Message:
    numbers = [float(value) for name in _BOX if isinstance(value := node.properties.get(name), float)]
    if len(numbers) != len(_BOX) or not all(map(math.isfinite, numbers)):
        return {}
    x, y, z, *size = numbers
    return {"bbox": {"center": _pose(RigidTransform((x, y, z), _NOT_ROTATED)), "size": named_axes(size)}}


def _pose(pose: RigidTransform) -> Message:
    return {"position": named_axes(pose.translation), "orientation": named_axes(pose.rotation)}
