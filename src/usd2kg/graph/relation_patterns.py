"""RDF properties of spatial relations in the soma and plain profiles."""

from collections.abc import Iterator, Mapping

import pyoxigraph as ox

from usd2kg.graph.iris import individual_iri
from usd2kg.graph.vocabulary import DUL, KNOWROB, OWL, RDF, RDFS, SOMA, SSSOM, U2K, Triple, number, text
from usd2kg.relations import SYMMETRIC_KINDS, Relation

__all__ = [
    "KIND_OF_INVERSE",
    "KIND_OF_PROPERTY",
    "describe_between",
    "describe_room",
    "plain_relation",
    "relation_annotations",
    "soma_relation",
]

_DECIMALS = 6
"""Decimals of measurements."""
_SOMA: Mapping[str, tuple[ox.NamedNode, ...]] = {
    "on": (SOMA.isOntopOf, SOMA.isSupportedBy),
    "inside": (SOMA.isInsideOf,),
    "attached-to": (U2K.attachedTo, SOMA.isLinkedTo),
    "above": (KNOWROB.isAboveOf,),
    "below": (KNOWROB.isBelowOf,),
    "touching": (DUL.hasCommonBoundary,),
    "next-to": (KNOWROB.isNextTo,),
    "near": (DUL.nearTo,),
    "room": (U2K.inRoom,),
    "connects": (U2K.connects,),
    "left": (KNOWROB.isLeftOf,),
    "right": (KNOWROB.isRightOf,),
    "front": (KNOWROB.isInFrontOf,),
    "behind": (KNOWROB.isBehindOf,),
}
_PLAIN: Mapping[str, ox.NamedNode] = {
    "on": U2K.on,
    "inside": U2K.inside,
    "attached-to": U2K.attachedTo,
    "above": U2K.above,
    "below": U2K.below,
    "touching": U2K.touching,
    "next-to": U2K.nextTo,
    "near": U2K.near,
    "room": U2K.inRoom,
    "connects": U2K.connects,
    "part-of": U2K.partOf,
    "left": U2K.leftOf,
    "right": U2K.rightOf,
    "front": U2K.inFrontOf,
    "behind": U2K.behind,
}

KIND_OF_PROPERTY: Mapping[ox.NamedNode, str] = {
    name: kind for kind, names in [*_SOMA.items(), *((k, (v,)) for k, v in _PLAIN.items())] for name in names
}
"""Property → kind, for properties from target to anchor, in both profiles."""
KIND_OF_INVERSE: Mapping[ox.NamedNode, str] = {SOMA.hasPhysicalComponent: "part-of"}
"""Property → kind, for properties from anchor to target."""


def soma_relation(relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
    """Return the triples of a relation in SOMA, DUL and KnowRob terms; the first one is annotated."""
    if relation.kind == "part-of":
        return [(anchor, SOMA.hasPhysicalComponent, target)]
    triples: list[Triple] = [(target, name, anchor) for name in _SOMA[relation.kind]]
    return [*triples, *_inverse(relation, _SOMA[relation.kind][0], target, anchor)]


def plain_relation(relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
    """Return the triples of a relation in u2k terms; the first one is annotated."""
    name = _PLAIN[relation.kind]
    return [(target, name, anchor), *_inverse(relation, name, target, anchor)]


def _inverse(relation: Relation, name: ox.NamedNode, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
    return [(anchor, name, target)] if relation.kind in SYMMETRIC_KINDS else []


def relation_annotations(relation: Relation) -> list[tuple[ox.NamedNode, ox.NamedNode | ox.Literal]]:
    """Return the rule, measurements and confidence of a relation as annotations.

    Measurements have six decimals, micrometres for lengths; smaller digits are rounding noise of 32-bit coordinates.
    """
    numbers = [(U2K[name], number(round(value, _DECIMALS))) for name, value in relation.numbers.items()]
    confidence = [] if relation.confidence is None else [(SSSOM.confidence, number(relation.confidence))]
    return [(U2K.rule, text(relation.rule)), *numbers, *confidence]


def describe_between(relation: Relation, base: str) -> Iterator[Triple]:
    """Yield an n-ary relation node for `between`, since OWL properties are binary."""
    assert relation.other_anchor is not None, "between has two anchors"
    node = ox.NamedNode(individual_iri(base, relation.target, "between"))
    yield node, RDF.type, OWL.NamedIndividual
    yield node, RDF.type, U2K.Between
    yield node, U2K.target, ox.NamedNode(individual_iri(base, relation.target))
    for path in (relation.anchor, relation.other_anchor):
        yield node, U2K.anchor, ox.NamedNode(individual_iri(base, path))
    for name, value in relation_annotations(relation):
        yield node, name, value


def describe_room(path: str, base: str) -> Iterator[Triple]:
    """Yield the individual of a group prim whose name makes it a room."""
    node = ox.NamedNode(individual_iri(base, path))
    yield node, RDF.type, OWL.NamedIndividual
    yield node, RDF.type, U2K.RoomGroup
    yield node, RDFS.label, text(path.rpartition("/")[2])
    yield node, U2K.primPath, text(path)
