"""Unique and reversible tf2 frame ids from prim paths, without a lookup table."""

import re

from usd2kg.errors import GraphError
from usd2kg.graph.export.property_graph import PropertyGraph, PropertyNode

__all__ = ["check_frame", "frame_id_of", "read_frame_ids"]

_ESCAPED = re.compile(r"[^A-Za-z0-9_/]|_(?=u[0-9A-F]{4})")
"""Characters that are escaped; an underscore only where it would look like the start of an escape."""
_FRAME = re.compile(r"[A-Za-z0-9_]+(?:/[A-Za-z0-9_]+)*")


def frame_id_of(prim_path: str) -> str:
    """Return the frame id of a prim: its path without the first slash.

    Characters other than ASCII letters, digits, `_` and `/` become their code point in at least four hexadecimal
    digits between `_u` and `_`. The mapping is injective.

    >>> frame_id_of("/World/Table_1/Cup_3")
    'World/Table_1/Cup_3'
    >>> frame_id_of("/World/Books[7]"), frame_id_of("/World/Books_u005B_7")
    ('World/Books_u005B_7_u005D_', 'World/Books_u005F_u005B_7')
    """
    # tf2 rejects leading slashes.
    return _ESCAPED.sub(lambda found: f"_u{ord(found[0]):04X}_", prim_path.lstrip("/"))


def check_frame(frame: str) -> str:
    """Return `frame` unchanged.

    Raises:
        GraphError: `frame` is not a valid frame id.
    """
    if not _FRAME.fullmatch(frame):
        raise GraphError(
            f"frame {frame!r}: expected letters, digits, _ and /, without a slash at the ends, such as map or site/map"
        )
    return frame


def read_frame_ids(graph: PropertyGraph, frame: str) -> dict[str, str]:
    """Return IRI → frame id for all objects and rooms, in the order of the graph.

    Rooms without a prim get the id of the last part of their IRI.

    Raises:
        GraphError: the graph covers several scenes, whose world frames differ, or two frame ids are equal.
    """
    nodes = [node for node in graph.nodes if "Joint" not in node.labels[:2]]
    scenes = {str(node.properties["scene"]) for node in nodes if "scene" in node.properties}
    if len(scenes) > 1:
        raise GraphError(
            f"the graph is of {len(scenes)} scenes ({', '.join(sorted(scenes))}); expected one, since each has its own "
            "world frame"
        )
    found: dict[str, str] = {}
    owners = {frame: f"the frame {frame}; choose another --frame"}
    for node in nodes:
        name = frame_id_of(_path(node))
        if not name or name in owners:
            raise GraphError(f"{node.id}: the frame id {name!r} is also that of {owners.get(name, 'no valid frame')}")
        owners[name] = node.id
        found[node.id] = name
    return found


def _path(node: PropertyNode) -> str:
    path = str(node.properties.get("path", ""))
    # The path of a room without a prim is its label.
    return path if path.startswith("/") else re.split("[/#:]", node.id)[-1]
