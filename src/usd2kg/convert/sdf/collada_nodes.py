"""Expansion count of the nodes of a COLLADA file, which repeat each other by `instance_node`."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from usd2kg.convert.sdf.xml_tree import XmlError

__all__ = ["ColladaNode", "check_nodes"]

_MAX_PARTS = 10_000
"""Nodes and geometries of the scenes of a file, counted with repetitions."""
_MAX_DEPTH = 100
"""Maximum nesting of nodes, as for elements; trimesh and pycollada recurse."""


@dataclass(eq=False)
class ColladaNode:
    """A `node` element."""

    id: str
    line: int
    is_root: bool = False
    """Whether the node is a child of a visual scene."""
    geometries: int = 0
    """Number of geometries and controllers directly in the node."""
    children: list["ColladaNode"] = field(default_factory=list)
    instances: list[str] = field(default_factory=list)
    """Ids of the nodes that this node instantiates."""


def check_nodes(nodes: Iterable[ColladaNode]) -> None:
    """Reject a file if following each `instance_node` would take practically forever.

    Raises:
        XmlError: a node contains itself, they are nested more than 100 deep, or the scenes have more than 10,000
            nodes and geometries.
    """
    nodes = tuple(nodes)
    counter = _Counter(nodes)
    parts = 0
    for node in nodes:
        found = counter.extent(node).parts
        parts += found if node.is_root else 0
        if parts > _MAX_PARTS:
            repeated = f"more than {_MAX_PARTS:,} nodes and geometries, with those that <instance_node> repeats"
            raise XmlError(f"line {node.line}: it has {repeated}")


class _Extent(NamedTuple):
    parts: int = 0
    """Nodes and geometries."""
    depth: int = 0
    """Depth of nested nodes."""


class _Counter:
    """Counts each node once, however often it is repeated."""

    def __init__(self, nodes: tuple[ColladaNode, ...]) -> None:
        self._by_id: dict[str, list[ColladaNode]] = {}
        for node in nodes:
            self._by_id.setdefault(node.id, []).append(node)
        self._extents: dict[int, _Extent] = {}
        self._extents_by_id: dict[str, _Extent] = {}
        self._open: set[int] = set()

    def extent(self, node: ColladaNode) -> _Extent:
        found = self._extents.get(id(node))
        if found is not None:
            return found
        if id(node) in self._open:
            raise XmlError(f"line {node.line}: the node {node.id!r} contains itself")
        self._open.add(id(node))
        self._check_depth(node, len(self._open))
        inner = [self.extent(child) for child in node.children]
        inner += [self._extent_of_id(name) for name in node.instances]
        parts = 1 + node.geometries + sum(extent.parts for extent in inner)
        depth = 1 + max((extent.depth for extent in inner), default=0)
        self._check_depth(node, depth)
        self._open.remove(id(node))
        # The counts grow exponentially.
        found = self._extents[id(node)] = _Extent(min(parts, _MAX_PARTS + 1), depth)
        return found

    def _extent_of_id(self, name: str) -> _Extent:
        """Return the largest extent of the nodes with an id, since the choice of a parser is unknown."""
        found = self._extents_by_id.get(name)
        if found is None:
            extents = [self.extent(node) for node in self._by_id.get(name, ())]
            parts, depth = (max((extent[index] for extent in extents), default=0) for index in range(2))
            found = self._extents_by_id[name] = _Extent(parts, depth)
        return found

    def _check_depth(self, node: ColladaNode, depth: int) -> None:
        if depth > _MAX_DEPTH:
            raise XmlError(f"line {node.line}: its nodes are nested more than {_MAX_DEPTH} deep")
