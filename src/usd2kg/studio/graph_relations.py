"""The spatial relations that a graph states, with their measurements."""

import re
from collections.abc import Iterator
from typing import Any

import pyoxigraph as ox

from usd2kg.graph.literal_numbers import parse_numbers
from usd2kg.graph.relation_patterns import KIND_OF_INVERSE, KIND_OF_PROPERTY
from usd2kg.graph.vocabulary import RDF, RDFS, SSSOM, U2K
from usd2kg.relations import SYMMETRIC_KINDS, DerivedRoom, Relation
from usd2kg.studio.graph_index import GraphIndex

__all__ = ["relations_of_graph"]

_RING = re.compile(r"\(([^()]+)\)")
"""A ring of a polygon in well-known text."""


def relations_of_graph(index: GraphIndex) -> Iterator[Relation]:
    """Yield each relation between objects, or to a room, once."""
    rooms = {node: room for node, room in _derived_rooms(index) if room.name}
    paths = {node: str(values[0].value) for node, values in index.subjects_of(U2K.primPath)}
    paths |= {node: room.name for node, room in rooms.items()}
    by_name = {room.name: room for room in rooms.values()}
    found: set[tuple[str, frozenset[str] | tuple[str, str]]] = set()
    # An annotated statement states the direction of a symmetric relation, and its measurements.
    stated = sorted(_stated(index, paths), key=lambda each: each[3] is None)
    for kind, target, anchor, about in stated:
        key = kind, frozenset((target, anchor)) if kind in SYMMETRIC_KINDS else (target, anchor)
        if key not in found:
            found.add(key)
            yield _relation(index, kind, target, anchor, about)._replace(room=by_name.get(anchor))
    for node, anchors in index.subjects_of(U2K.anchor):
        ends = [paths.get(each) for each in (*index.values(node, U2K.target)[:1], *anchors)]
        match ends:
            case str(target), str(anchor), str(other):
                yield _relation(index, "between", target, anchor, node)._replace(other_anchor=other)


def _derived_rooms(index: GraphIndex) -> Iterator[tuple[Any, DerivedRoom]]:
    """Yield the node of each room without a prim. Missing or malformed values become empty or 0."""
    for node, types in index.subjects_of(RDF.type):
        if U2K.DerivedRoom in types:
            numbers = [
                next(iter(parse_numbers(index.text(node, name))), 0.0)
                for name in (U2K.floorArea, U2K.floorHeight, SSSOM.confidence)
            ]
            rings = _RING.findall(index.text(node, U2K.floorOutline))
            yield (
                node,
                DerivedRoom(
                    index.text(node, RDFS.label),
                    index.text(node, U2K.rule),
                    tuple(tuple(_corners(ring))[:-1] for ring in rings),
                    *numbers,
                ),
            )


def _corners(ring: str) -> Iterator[tuple[float, float]]:
    for corner in ring.split(","):
        match parse_numbers(corner):
            case [x, y]:
                yield x, y


def _stated(index: GraphIndex, paths: dict[Any, str]) -> Iterator[tuple[str, str, str, Any]]:
    """Yield kind, target, anchor and annotation of each statement of a relation, in both profiles."""
    for name, kind in (*KIND_OF_PROPERTY.items(), *KIND_OF_INVERSE.items()):
        for subject, values in index.subjects_of(name):
            for value in values:
                if subject in paths and value in paths:
                    ends = (value, subject) if name in KIND_OF_INVERSE else (subject, value)
                    yield kind, paths[ends[0]], paths[ends[1]], index.annotation((subject, name, value))


def _relation(index: GraphIndex, kind: str, target: str, anchor: str, about: Any) -> Relation:
    confidence = parse_numbers(index.text(about, SSSOM.confidence))
    return Relation(
        kind,
        target,
        anchor,
        index.text(about, U2K.rule),
        dict(_measurements(index.properties(about))),
        confidence[0] if confidence else None,
    )


def _measurements(properties: dict[ox.NamedNode, list[Any]]) -> Iterator[tuple[str, float]]:
    for name, values in properties.items():
        if name.value.startswith(U2K.iri) and isinstance(values[0], ox.Literal) and name != U2K.rule:
            numbers = parse_numbers(values[0].value)
            if len(numbers) == 1:
                yield name.value.removeprefix(U2K.iri), numbers[0]
