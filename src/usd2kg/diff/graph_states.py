"""The objects that the statements of a graph describe, and the style in which they are written."""

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any, NamedTuple

import pyoxigraph as ox

from usd2kg.diff.object_state import Link, ObjectState, Quaternion, Vector
from usd2kg.errors import GraphError
from usd2kg.garbage import paused_collection
from usd2kg.graph.literal_numbers import parse_numbers
from usd2kg.graph.relation_patterns import KIND_OF_INVERSE, KIND_OF_PROPERTY
from usd2kg.graph.vocabulary import DUL, OWL, RDF, RDFS, SOMA, U2K, USD
from usd2kg.ontology import local_name
from usd2kg.relations import SYMMETRIC_KINDS

__all__ = [
    "GraphStyle",
    "as_vector",
    "detect_graph_style",
    "objects_of_graph",
]

_GENERAL_CLASSES = {OWL.NamedIndividual, USD.Prim, U2K.Object}
"""Types of all objects, which are not grounded classes."""
_READ_PROPERTIES = {
    *(RDF.type, RDFS.label, DUL.hasRegion),
    *(U2K.primPath, U2K.asset, U2K.boxCenter, U2K.orientedSize, U2K.target, U2K.anchor),
    *(SOMA.hasShape, SOMA.hasWidth, SOMA.hasDepth, SOMA.hasHeight, U2K.width, U2K.depth, U2K.height),
    *(SOMA.hasLocalization, SOMA.hasPositionData, U2K.position, U2K.orientation),
    *(SOMA.hasMassAttribute, SOMA.hasMassValue, U2K.mass),
    *KIND_OF_PROPERTY,
    *KIND_OF_INVERSE,
}
_RUN = "-run"
"""Suffix of the IRI of the grounding run; the rest is the base IRI."""


class GraphStyle(NamedTuple):
    """The options with which a graph was built."""

    base: str | None
    """Namespace of the individuals; None if the graph does not state it."""
    profile: str
    """`soma` or `plain`."""
    annotations: str
    """`owl` or `rdf12`."""


def detect_graph_style(statements: Iterable[ox.Triple]) -> GraphStyle:
    """Return the options with which a graph was built."""
    runs, is_soma, is_reified = set(), False, False
    for _, predicate, value in statements:
        if predicate == U2K.run and isinstance(value, ox.NamedNode) and value.value.endswith(_RUN):
            runs.add(value.value.removesuffix(_RUN))
        is_soma = is_soma or value == USD.Prim
        is_reified = is_reified or predicate == RDF.reifies
    return GraphStyle(min(runs, default=None), "soma" if is_soma else "plain", "rdf12" if is_reified else "owl")


def objects_of_graph(statements: Iterable[ox.Triple], source: str) -> tuple[ObjectState, ...]:
    """Return the objects of a graph of either profile, by prim path. Malformed numbers count as unknown.

    Args:
        statements: the graph.
        source: its name in error messages.

    Raises:
        GraphError: there is no object, or two have the same prim path.
    """
    with paused_collection():
        states = sorted(_StateReader(statements).states(), key=lambda state: (state.prim_path, state.iri))
    if not states:
        raise GraphError(f"{source}: contains no object; expected a graph written by usd2kg build, or a USD scene")
    for one, other in pairwise(states):
        if one.prim_path == other.prim_path:
            raise GraphError(
                f"{source}: <{one.iri}> and <{other.iri}> both have the prim path {one.prim_path}; "
                "expected the graph of one scene"
            )
    return tuple(states)


class _StateReader:
    """Reads object states from statements, which it indexes by property and subject."""

    def __init__(self, statements: Iterable[ox.Triple]) -> None:
        self._values: dict[ox.NamedNode, dict[Any, list[Any]]] = {name: {} for name in _READ_PROPERTIES}
        for subject, predicate, value in statements:
            if predicate in _READ_PROPERTIES:
                self._values[predicate].setdefault(subject, []).append(value)
        self._paths = {node: path for node in self._values[U2K.primPath] if (path := self._text(node, U2K.primPath))}
        # Rooms without a prim are known by their names.
        self._rooms = {
            node: name
            for node, types in self._values[RDF.type].items()
            if U2K.DerivedRoom in types and (name := self._text(node, RDFS.label))
        }
        self._paths |= self._rooms
        self._links: dict[Any, set[Link]] = {}
        for node, link in self._all_links():
            self._links.setdefault(node, set()).add(link)

    def states(self) -> Iterator[ObjectState]:
        for node, path in self._paths.items():
            types = self._values[RDF.type].get(node, [])
            if isinstance(node, ox.NamedNode) and U2K.RoomGroup not in types and node not in self._rooms:
                yield self._state(node, path, types)

    def _state(self, node: ox.NamedNode, path: str, types: list[Any]) -> ObjectState:
        classes = sorted({c.value for c in types if isinstance(c, ox.NamedNode) and c not in _GENERAL_CLASSES})
        shapes = self._follow(node, SOMA.hasShape, DUL.hasRegion)
        box = next((region for region in shapes if self._text(region, U2K.boxCenter)), node)
        regions = self._follow(node, SOMA.hasLocalization, DUL.hasRegion)
        pose = [number for region in regions for number in self._numbers(region, SOMA.hasPositionData)]
        mass_owners = [node, *self._follow(node, SOMA.hasMassAttribute)]
        masses = [n for owner in mass_owners for n in self._numbers(owner, SOMA.hasMassValue, U2K.mass)]
        return ObjectState(
            path,
            node.value,
            tuple(classes),
            " and ".join(self._text(ox.NamedNode(cls), RDFS.label) or local_name(cls) for cls in classes),
            size=as_vector(self._numbers(node, U2K.orientedSize) or self._sides(box)),
            box_size=as_vector(self._sides(box)),
            center=as_vector(self._numbers(box, U2K.boxCenter)),
            position=as_vector(pose[:3] or self._numbers(node, U2K.position)),
            orientation=_quaternion(pose[3:] or self._numbers(node, U2K.orientation)),
            mass_kg=masses[0] if masses else None,
            assets=frozenset(str(getattr(value, "value", "")) for value in self._values[U2K.asset].get(node, ())),
            links=frozenset(self._links.get(node, ())),
        )

    def _all_links(self) -> Iterator[tuple[Any, Link]]:
        for name, kind in KIND_OF_PROPERTY.items():
            for target, anchor in self._pairs(name):
                yield target, Link(kind, self._paths[anchor])
                if kind in SYMMETRIC_KINDS:
                    yield anchor, Link(kind, self._paths[target])
        for name, kind in KIND_OF_INVERSE.items():
            for anchor, target in self._pairs(name):
                yield target, Link(kind, self._paths[anchor])
        for node, targets in self._values[U2K.target].items():
            for anchor in self._values[U2K.anchor].get(node, ()):
                if anchor in self._paths:
                    yield targets[0], Link("between", self._paths[anchor])

    def _pairs(self, name: ox.NamedNode) -> Iterator[tuple[Any, Any]]:
        """Yield the pairs of objects that a property relates."""
        for subject, values in self._values[name].items():
            if subject in self._paths:
                yield from ((subject, value) for value in values if value in self._paths)

    def _follow(self, node: Any, *names: ox.NamedNode) -> list[Any]:
        """Return the ends of a property path."""
        nodes = [node]
        for name in names:
            nodes = [value for each in nodes for value in self._values[name].get(each, ())]
        return nodes

    def _text(self, node: Any, name: ox.NamedNode) -> str:
        values = [value for value in self._values[name].get(node, ()) if isinstance(value, ox.NamedNode | ox.Literal)]
        return str(min(values, key=str).value) if values else ""

    def _numbers(self, node: Any, *names: ox.NamedNode) -> tuple[float, ...]:
        """Return the numbers of the first of these properties that the node has."""
        return parse_numbers(next(filter(None, (self._text(node, name) for name in names)), ""))

    def _sides(self, box: Any) -> list[float]:
        extents = ((SOMA.hasDepth, U2K.width), (SOMA.hasWidth, U2K.depth), (SOMA.hasHeight, U2K.height))
        return [side for names in extents for side in self._numbers(box, *names)]


def as_vector(values: Iterable[float]) -> Vector | None:
    """Return three numbers as a vector; None if there are not three."""
    match tuple(values):
        case x, y, z:
            return x, y, z
        case _:
            return None


def _quaternion(values: Iterable[float]) -> Quaternion | None:
    match tuple(values):
        case x, y, z, w if x or y or z or w:
            return x, y, z, w
        case _:
            return None
