"""Facts of a COLLADA file that trimesh drops: the unit, and the geometries of named nodes."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from usd2kg.convert.sdf.collada_nodes import ColladaNode, check_nodes
from usd2kg.convert.sdf.xml_tree import parse_safely

__all__ = ["ColladaFacts", "read_collada"]


@dataclass
class ColladaFacts:
    """Facts of a COLLADA file (COLLADA 1.4.1)."""

    metres_per_unit: float = 1.0
    geometries: dict[str, set[str]] = field(default_factory=dict)
    """Name or id of a node → ids of the geometries in it and in the nodes below."""


class _Open(NamedTuple):
    """An open element, whose end tag has not been read."""

    names: tuple[str, ...] = ()
    """Name and id, if it is a node."""
    node: ColladaNode | None = None
    """The element itself or its innermost enclosing node."""
    is_in_scene: bool = False
    """Whether the element is a visual scene or inside one."""


def read_collada(path: Path) -> ColladaFacts:
    """Return facts of a file, which is safe to be parsed by trimesh and other XML parsers, too.

    Raises:
        XmlError: it is no XML, declares entities, is nested more than 100 deep, or its nodes repeat too often.
        OSError: it cannot be read.
    """
    facts = ColladaFacts()
    above = [_Open()]
    nodes: list[ColladaNode] = []

    def start(tag: str, attributes: Mapping[str, str], line: int) -> None:
        tag = tag.rpartition(":")[2]
        outer = above[-1]
        target = attributes.get("url", "").removeprefix("#")
        above.append(_Open((), outer.node, outer.is_in_scene or tag == "visual_scene"))
        if tag == "node":
            node = ColladaNode(attributes.get("id", ""), line, is_root=outer.is_in_scene and outer.node is None)
            nodes.append(node)
            if outer.node is not None:
                outer.node.children.append(node)
            names = tuple(attributes[key] for key in ("name", "id") if key in attributes)
            above[-1] = _Open(names, node, outer.is_in_scene)
        elif tag == "unit":
            facts.metres_per_unit = _positive(attributes.get("meter", "")) or 1.0
        elif tag == "instance_node" and outer.node is not None:
            outer.node.instances.append(target)
        elif tag in {"instance_geometry", "instance_controller"}:
            if outer.node is not None:
                outer.node.geometries += 1
            for name in {name for element in above for name in element.names}:
                facts.geometries.setdefault(name, set()).add(target)

    def end(_: str) -> None:
        above.pop()

    parse_safely(path, start, end)
    check_nodes(nodes)
    return facts


def _positive(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if 0 < value < 1e6 else None
