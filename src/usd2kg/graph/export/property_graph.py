"""Property graph of a scene for Neo4j, Gephi or yEd: one node per object, one edge per relation.

Quality nodes (shape, pose, mass, colour) and axiom annotations become properties. Both profiles give the same property
graph. Symmetric and inverse relations are one edge.
"""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.export.property_terms import (
    EDGE_NUMBERS,
    EDGES,
    NUMBERS,
    OBJECT_CLASSES,
    PARTS,
    SYMMETRIC,
    TEXTS,
    VECTORS,
)
from usd2kg.graph.rdf_document import GraphDocument
from usd2kg.graph.vocabulary import DUL, OWL, RDF, RDFS, SKOS, SOMA, SSSOM, U2K, USD, XSD

__all__ = ["PropertyEdge", "PropertyGraph", "PropertyNode", "Value", "read_property_graph"]

Value = str | float | int | bool
_Resource = ox.NamedNode | ox.BlankNode
_Term = _Resource | ox.Literal | ox.Triple

_FLOOR = {U2K.floorArea: "floorArea", U2K.floorHeight: "floorHeight", SSSOM.confidence: "confidence"}
"""RDF property → number property of a room without a prim."""
_LIST_SEPARATOR = " | "

_MAX_CLASSES = 100
"""Maximum number of superclass labels of a node. Real hierarchies have fewer; it bounds the output for long chains."""


class PropertyNode(NamedTuple):
    """An object, a room or a joint."""

    id: str
    """IRI."""
    labels: tuple[str, ...]
    """`Thing`, then `Object`, `Room` or `Joint`, then the joint type, or superclasses and class, most general first."""
    properties: Mapping[str, Value]
    """Metres, kilograms and radians; world frame, z-up."""


class PropertyEdge(NamedTuple):
    """A relation between two nodes."""

    start: str
    end: str
    type: str
    properties: Mapping[str, Value]


@dataclass(frozen=True)
class PropertyGraph:
    """Nodes in file order; edges in the order of their start nodes."""

    nodes: tuple[PropertyNode, ...]
    edges: tuple[PropertyEdge, ...]

    def property_types(self, *, of_edges: bool) -> dict[str, type]:
        """Return property name → type for all nodes or edges, in order of first use."""
        elements: Iterable[PropertyNode | PropertyEdge] = self.edges if of_edges else self.nodes
        return {name: type(value) for element in elements for name, value in element.properties.items()}


def read_property_graph(document: GraphDocument) -> PropertyGraph:
    """Return the property graph of an RDF graph built by usd2kg, in either profile.

    Raises:
        GraphError: the graph has no object with a u2k:primPath.
    """
    graph = _Index(document)
    nodes = tuple(_NodeReader(graph).read())
    if not nodes:
        raise GraphError(f"{document.source}: holds no object with a u2k:primPath; expected a graph that usd2kg built")
    return PropertyGraph(nodes, tuple(_EdgeReader(graph, [node.id for node in nodes]).read()))


@dataclass
class _Index:
    """Index of triples by subject and predicate, and of annotations by statement."""

    document: GraphDocument
    of: dict[_Resource, dict[ox.NamedNode, list[_Term]]] = field(default_factory=dict)
    notes: dict[tuple[_Term, _Term, _Term], dict[ox.NamedNode, list[_Term]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for triple in self.document.triples:
            assert not isinstance(triple.subject, ox.Triple), "RDF 1.2 has no triple terms as subjects"
            self.of.setdefault(triple.subject, {}).setdefault(triple.predicate, []).append(triple.object)
        for known in self.of.values():
            for term in known.get(RDF.reifies, ()):
                if isinstance(term, ox.Triple):
                    self.notes[(term.subject, term.predicate, term.object)] = known
            if OWL.annotatedSource in known:
                names = (OWL.annotatedSource, OWL.annotatedProperty, OWL.annotatedTarget)
                subject, predicate, value = (known.get(name, [ox.Literal("")])[0] for name in names)
                self.notes[(subject, predicate, value)] = known

    def values(self, node: _Term, name: ox.NamedNode) -> list[_Term]:
        return [] if isinstance(node, ox.Literal | ox.Triple) else self.of.get(node, {}).get(name, [])

    def first(self, node: _Term, name: ox.NamedNode) -> str:
        return next((_text(value) for value in self.values(node, name)), "")


class _NodeReader:
    """Reads the nodes of a property graph."""

    def __init__(self, graph: _Index) -> None:
        self._graph = graph
        self._above: dict[_Term, list[_Term]] = {}
        stages = (node for node in graph.of if {USD.Stage, U2K.Stage} & {*graph.values(node, RDF.type)})
        self._scenes = {node: graph.first(node, RDFS.label) for node in stages}
        self._scene_of = {
            member: label
            for node, label in self._scenes.items()
            for name in (DUL.hasMember, U2K.hasObject)
            for member in graph.values(node, name)
        }

    def read(self) -> Iterator[PropertyNode]:
        for node, known in self._graph.of.items():
            if not isinstance(node, ox.NamedNode):
                continue
            if U2K.definingPrim in known:
                yield PropertyNode(node.value, ("Thing", "Joint", *self._joint_labels(node)), self._joint(node))
            elif U2K.DerivedRoom in known.get(RDF.type, ()):
                yield PropertyNode(
                    node.value, ("Thing", "Room"), self._named(node, RDFS.label) | _numbers(known, _FLOOR)
                )
            elif U2K.primPath in known and U2K.RoomGroup in known.get(RDF.type, ()):
                yield PropertyNode(node.value, ("Thing", "Room"), self._named(node, U2K.primPath))
            elif U2K.primPath in known:
                cls = next((c for c in known.get(RDF.type, ()) if c not in OBJECT_CLASSES), None)
                yield PropertyNode(node.value, ("Thing", "Object", *self._labels(cls)), self._object(node, cls))

    def _labels(self, cls: _Term | None) -> tuple[str, ...]:
        above = self._closure(cls) if cls is not None else []
        names = dict.fromkeys(re.sub(r"\W", "_", re.split("[#/]", _text(iri))[-1]) for iri in above)
        return tuple(name for name in names if name and name not in {"Thing", "Object"})

    def _closure(self, cls: _Term) -> list[_Term]:
        """Return a class and its superclasses, most general first; only the nearest ones if there are too many."""
        # Iterative, since a chain of classes may be longer than the stack; in a cycle, an open class is visited again.
        pending = [cls]
        while pending:
            below = pending[-1]
            parents = self._parents(below)
            if below not in self._above:
                self._above[below] = []
                pending.extend(parent for parent in reversed(parents) if parent not in self._above)
                continue
            pending.pop()
            if not self._above[below]:
                found = dict.fromkeys(iri for parent in parents for iri in self._above[parent])
                self._above[below] = [*(iri for iri in found if iri != below), below][-_MAX_CLASSES:]
        return self._above[cls]

    def _parents(self, cls: _Term) -> list[_Term]:
        parents = sorted(self._graph.values(cls, RDFS.subClassOf), key=str)
        return [parent for parent in parents if isinstance(parent, ox.NamedNode)]

    def _object(self, node: ox.NamedNode, cls: _Term | None) -> dict[str, Value]:
        properties = self._named(node, U2K.primPath)
        if cls is not None:
            properties["class"] = self._graph.first(cls, RDFS.label) or _text(cls)
            properties["classIri"] = _text(cls)
            notes = self._graph.notes.get((node, RDF.type, cls), {})
            properties.update(_numbers(notes, {SSSOM.confidence: "confidence"}))
            properties.update(_texts(notes, {U2K.status: "status", U2K.explanation: "explanation"}))
            reviewers = [_text(r) for n in (SSSOM.reviewer_id, SSSOM.reviewer_label) for r in notes.get(n, ())]
            if reviewers:
                properties["reviewer"] = _LIST_SEPARATOR.join(reviewers)
        for concept in self._graph.values(node, U2K.concept):
            properties["concept"] = self._graph.first(concept, SKOS.prefLabel) or _text(concept)
            properties["conceptIri"] = _text(concept)
            properties.update(_numbers(self._graph.of[node], {U2K.conceptConfidence: "conceptConfidence"}))
        return properties | self._measured(node)

    def _joint(self, node: ox.NamedNode) -> dict[str, Value]:
        return self._named(node, U2K.definingPrim) | self._measured(node)

    def _joint_labels(self, node: ox.NamedNode) -> tuple[str, ...]:
        """Return the joint type as at most one label that both profiles share."""
        kinds = {_text(kind).rpartition("#")[2] for kind in self._graph.values(node, RDF.type)}
        kinds = {"RevoluteJoint" if kind in {"HingeJoint", "ContinuousJoint"} else kind for kind in kinds}
        own = ("RevoluteJoint", "PrismaticJoint", "FixedJoint", "SphericalJoint", "DistanceJoint")
        return tuple(name for name in own if name in kinds)

    def _named(self, node: ox.NamedNode, path: ox.NamedNode) -> dict[str, Value]:
        found: dict[str, Value] = {
            "name": self._graph.first(node, RDFS.label),
            "path": self._graph.first(node, path),
        }
        scene = self._scene_of.get(node) or (next(iter(self._scenes.values())) if len(self._scenes) == 1 else "")
        return found | ({"scene": scene} if scene else {})

    def _measured(self, node: ox.NamedNode) -> dict[str, Value]:
        """Return the numbers and texts of a node and its quality nodes, in a fixed order."""
        found: dict[str, Value] = {}
        for part in self._described_by(node):
            known = self._graph.of.get(part, {})
            found.update(_numbers(known, NUMBERS))
            found.update(_texts(known, TEXTS))
            if "copies" in found:
                found["copies"] = int(found["copies"])
            for name, keys in VECTORS.items():
                for value in known.get(name, ()):
                    found.update(_vector(_text(value), keys))
            for value in known.get(USD.primvars_displayColor, ()):
                found.update(_vector(_plain_color(_text(value)), VECTORS[U2K.color]))
        order = [*NUMBERS.values(), *(key for keys in VECTORS.values() for key in keys), *TEXTS.values()]
        return {key: found[key] for key in dict.fromkeys(order) if key in found}

    def _described_by(self, node: _Resource) -> Iterator[_Resource]:
        yield node
        for name in PARTS:
            for part in self._graph.values(node, name):
                if isinstance(part, ox.NamedNode) and part != node:
                    yield from self._described_by(part) if name != DUL.hasRegion else (part,)


class _EdgeReader:
    """Reads the edges of a property graph."""

    def __init__(self, graph: _Index, ids: list[str]) -> None:
        self._graph = graph
        self._places = {iri: place for place, iri in enumerate(ids)}

    def read(self) -> Iterator[PropertyEdge]:
        found: dict[tuple[str, str, str], PropertyEdge] = {}
        for edge in (*self._stated(), *self._between()):
            if edge.start not in self._places or edge.end not in self._places:
                continue
            key = self._key(edge)
            # Keep the annotated direction.
            if key not in found or (edge.properties and not found[key].properties):
                found[key] = edge
        above = {(edge.start, edge.end) for edge in found.values() if edge.type == "ABOVE"}
        kept = [e for e in found.values() if e.type != "BELOW" or (e.end, e.start) not in above]
        return iter(sorted(kept, key=lambda e: (self._places[e.start], e.type, self._places[e.end])))

    def _key(self, edge: PropertyEdge) -> tuple[str, str, str]:
        if edge.type in SYMMETRIC:
            first, second = sorted((edge.start, edge.end))
            return first, edge.type, second
        return edge.start, edge.type, edge.end

    def _stated(self) -> Iterator[PropertyEdge]:
        for node, known in self._graph.of.items():
            for name, kind in EDGES.items():
                for value in known.get(name, ()):
                    yield PropertyEdge(node.value, _text(value), kind, self._numbers(node, name, value))
            for part in known.get(SOMA.hasPhysicalComponent, ()):
                notes = self._numbers(node, SOMA.hasPhysicalComponent, part)
                if self._graph.values(part, U2K.definingPrim):
                    yield PropertyEdge(node.value, _text(part), "HAS_JOINT", notes)
                else:
                    yield PropertyEdge(_text(part), node.value, "PART_OF", notes)

    def _numbers(self, subject: _Term, name: _Term, value: _Term) -> dict[str, Value]:
        return _measures(self._graph.notes.get((subject, name, value), {}))

    def _between(self) -> Iterator[PropertyEdge]:
        for known in self._graph.of.values():
            if U2K.Between in known.get(RDF.type, ()):
                for target in known.get(U2K.target, ()):
                    for anchor in known.get(U2K.anchor, ()):
                        yield PropertyEdge(_text(target), _text(anchor), "BETWEEN", _measures(known))


def _measures(notes: Mapping[ox.NamedNode, list[_Term]]) -> dict[str, Value]:
    numbers = {U2K[name]: name for name in EDGE_NUMBERS} | {SSSOM.confidence: "confidence"}
    return {**_numbers(notes, numbers), **_texts(notes, {U2K.rule: "rule"})}


def _numbers(known: Mapping[ox.NamedNode, list[_Term]], names: Mapping[ox.NamedNode, str]) -> dict[str, Value]:
    found = {key: _number(value) for name, key in names.items() for value in known.get(name, ())}
    return {key: value for key, value in found.items() if value is not None}


def _number(value: _Term) -> Value | None:
    """Return a number or Boolean; None for other terms."""
    if not isinstance(value, ox.Literal):
        return None
    try:
        if value.datatype == XSD.boolean:
            return value.value in {"true", "1"}
        return float(value.value)
    except ValueError:
        return None


def _texts(known: Mapping[ox.NamedNode, list[_Term]], names: Mapping[ox.NamedNode, str]) -> dict[str, Value]:
    found = {key: _LIST_SEPARATOR.join(map(_text, known[name])) for name, key in names.items() if name in known}
    return {key: text for key, text in found.items() if text}


def _text(term: _Term) -> str:
    return str(term) if isinstance(term, ox.Triple) else term.value


def _vector(text: str, keys: tuple[str, ...]) -> dict[str, Value]:
    try:
        numbers = [float(number) for number in text.split()]
    except ValueError:
        return {}
    return dict(zip(keys, numbers, strict=True)) if len(numbers) == len(keys) else {}


def _plain_color(text: str) -> str:
    """Return the colour of a USD.owl JSON array as three numbers; empty if malformed."""
    try:
        color = json.loads(text)[0]
        return " ".join(str(float(channel)) for channel in color)
    except (ValueError, TypeError, IndexError, KeyError):
        return ""
