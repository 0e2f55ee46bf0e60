"""Static transforms for tf2: a tf2_msgs/TFMessage of all objects, and a description of its frames."""

from collections.abc import Mapping
from pathlib import Path

from usd2kg.graph.export.property_graph import PropertyGraph
from usd2kg.graph.export.ros.frame_ids import check_frame, read_frame_ids
from usd2kg.graph.export.ros.message_text import json_text, write_files, yaml_text
from usd2kg.graph.export.ros.messages import Message, describe_node, header, named_axes
from usd2kg.graph.export.ros.rigid_transform import RigidTransform, read_pose

__all__ = ["TF_FILES", "read_transforms", "write_tf"]

TF_FILES = ("tf_static.json", "tf_static.yaml", "frames.json")


def write_tf(graph: PropertyGraph, folder: Path, frame: str = "map") -> int:
    """Write the transforms of all objects as JSON and YAML, and a table of the frames; return the number of transforms.

    Args:
        graph: the graph of one scene.
        folder: created if missing.
        frame: id of the world frame.

    Raises:
        GraphError: `frame` is not a frame id, or the graph has several scenes.
        OutputError: a file cannot be written.
    """
    message = read_transforms(graph, frame)
    nodes = {node.id: node for node in graph.nodes}
    ids = {name: iri for iri, name in read_frame_ids(graph, frame).items()}
    children = [transform["child_frame_id"] for transform in message["transforms"]]
    table = {
        "frame_id": frame,
        "frames": [{"frame_id": name, **describe_node(nodes[ids[name]])} for name in children],
    }
    write_files(folder, dict(zip(TF_FILES, (json_text(message), yaml_text(message), json_text(table)), strict=True)))
    return len(children)


def read_transforms(graph: PropertyGraph, frame: str = "map") -> Message:
    """Return a tf2_msgs/TFMessage: a geometry_msgs/TransformStamped for each object with a pose.

    The transform of a part is relative to the first whole in the graph, that of any other object to the world frame.
    Axes are those of the prim, without scale.

    Raises:
        GraphError: `frame` is not a frame id, or the graph has several scenes.
    """
    ids = read_frame_ids(graph, check_frame(frame))
    found = ((node.id, read_pose(node.properties)) for node in graph.nodes if node.id in ids)
    poses = {iri: pose for iri, pose in found if pose is not None}
    wholes = _wholes(graph, poses)
    return {"transforms": [_stamped(iri, wholes.get(iri), frame, poses, ids) for iri in poses]}


def _stamped(
    iri: str, whole: str | None, frame: str, poses: Mapping[str, RigidTransform], ids: Mapping[str, str]
) -> Message:
    placed = poses[iri] if whole is None else poses[iri].seen_from(poses[whole])
    return {
        "header": header(frame if whole is None else ids[whole]),
        "child_frame_id": ids[iri],
        "transform": {"translation": named_axes(placed.translation), "rotation": named_axes(placed.rotation)},
    }


def _wholes(graph: PropertyGraph, poses: Mapping[str, RigidTransform]) -> dict[str, str]:
    """Return part → whole as a forest: the first whole with a pose that does not close a cycle."""
    wholes: dict[str, str] = {}
    for edge in graph.edges:
        if edge.type == "PART_OF" and edge.start in poses and edge.end in poses:
            wholes.setdefault(edge.start, edge.end)
    checked: set[str] = set()
    for start in tuple(wholes):
        chain: dict[str, None] = {}
        node = start
        while node in wholes and node not in checked:
            chain[node] = None
            if wholes[node] in chain:
                del wholes[node]
            else:
                node = wholes[node]
        checked.update(chain)
    return wholes
