"""Message parts shared by the exports, as JSON objects with the field names of ROS 2."""

from collections.abc import Iterable
from typing import Any

from usd2kg.graph.export.property_graph import PropertyNode

__all__ = ["Message", "describe_node", "header", "named_axes"]

Message = dict[str, Any]


def header(frame: str) -> Message:
    """Return a std_msgs/Header with time 0, since the statements of a graph hold at all times."""
    return {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": frame}


def named_axes(numbers: Iterable[float]) -> Message:
    """Return a geometry_msgs/Vector3, Point or Quaternion."""
    return dict(zip("xyzw", numbers, strict=False))


def describe_node(node: PropertyNode) -> Message:
    """Return prim path, IRI, name, and the label of the class if there is one; `prim_path` is empty without a prim."""
    path = str(node.properties.get("path", ""))
    known = {
        "prim_path": path if path.startswith("/") else "",
        "iri": node.id,
        "name": str(node.properties.get("name", "")),
    }
    return known | ({"class": node.properties["class"]} if "class" in node.properties else {})
