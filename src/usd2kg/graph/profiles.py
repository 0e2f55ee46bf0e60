"""Modelling profiles: `soma` with the patterns of SOMA, DUL and USD.owl, and `plain` for any ontology.

The soma profile was checked with HermiT against SOMA 5d27187, DUL and USD.owl: a Stage has members, since one with
parts is inconsistent, and quality nodes are never shared between objects.
"""

from collections.abc import Iterator
from typing import ClassVar, Protocol

import pyoxigraph as ox

from usd2kg.graph.color import knowrob_color, plain_color, usd_color
from usd2kg.graph.joint_patterns import JointIndividual, plain_joint, soma_joint
from usd2kg.graph.physical_properties import declare_individual, plain_properties, shared_properties, soma_properties
from usd2kg.graph.relation_patterns import plain_relation, soma_relation
from usd2kg.graph.vocabulary import DUL, SOMA, U2K, USD, Namespace, Triple
from usd2kg.relations import Relation
from usd2kg.scene import SceneObject

__all__ = ["PlainProfile", "Profile", "SomaProfile", "uses_soma"]


class Profile(Protocol):
    """Maps scene objects, joints and relations to the patterns of one vocabulary."""

    name: ClassVar[str]
    imports: ClassVar[tuple[str, ...]]
    """Ontologies to import in addition to the user's."""
    object_class: ClassVar[ox.NamedNode]
    """Class of every object."""
    has_joint: ClassVar[ox.NamedNode]
    """Property from an object to a joint within it."""

    def describe(self, obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield the size, pose, mass and colour of an object."""
        ...

    def join(self, linked: JointIndividual) -> Iterator[Triple]:
        """Yield the individual of a joint."""
        ...

    def stage(self, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield the type of the stage."""
        ...

    def member(self, stage: ox.NamedNode, obj: ox.NamedNode) -> Triple:
        """Return the membership of an object in the stage."""
        ...

    def relate(self, relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
        """Return the triples of a spatial relation; the first one is annotated."""
        ...


class SomaProfile:
    """Patterns of SOMA, DUL and USD.owl, with KnowRob's conventions."""

    name: ClassVar[str] = "soma"
    imports: ClassVar[tuple[str, ...]] = (
        "http://www.ease-crc.org/ont/SOMA-OBJ.owl",
        "https://ease-crc.org/ont/USD.owl",
    )
    object_class: ClassVar[ox.NamedNode] = USD.Prim
    has_joint: ClassVar[ox.NamedNode] = SOMA.hasPhysicalComponent

    def __init__(self, colors: str = "usd") -> None:
        """Set how colours are modelled, one of `options.COLORS`."""
        self._color = knowrob_color if colors == "knowrob" else usd_color

    def describe(self, obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield the size, pose, mass and colour of an object."""
        yield from soma_properties(obj, node)
        yield from shared_properties(obj, node)
        yield from self._color(obj, node)

    def join(self, linked: JointIndividual) -> Iterator[Triple]:
        """Yield the individual of a joint."""
        return soma_joint(linked)

    def stage(self, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield the type of the stage."""
        yield from declare_individual(node, USD.Stage)

    def member(self, stage: ox.NamedNode, obj: ox.NamedNode) -> Triple:
        """Return dul:hasMember; dul:hasPart would make the stage inconsistent."""
        return stage, DUL.hasMember, obj

    def relate(self, relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
        """Return the triples of a spatial relation."""
        return soma_relation(relation, target, anchor)


class PlainProfile:
    """Datatype properties of the u2k vocabulary directly on the object, for any ontology."""

    name: ClassVar[str] = "plain"
    imports: ClassVar[tuple[str, ...]] = ()
    object_class: ClassVar[ox.NamedNode] = U2K.Object
    has_joint: ClassVar[ox.NamedNode] = U2K.hasJoint

    def describe(self, obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield the size, pose, mass and colour of an object."""
        yield from plain_properties(obj, node)
        yield from shared_properties(obj, node)
        yield from plain_color(obj, node)

    def join(self, linked: JointIndividual) -> Iterator[Triple]:
        """Yield the individual of a joint."""
        return plain_joint(linked)

    def stage(self, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield the type of the stage."""
        yield from declare_individual(node, U2K.Stage)

    def member(self, stage: ox.NamedNode, obj: ox.NamedNode) -> Triple:
        """Return u2k:hasObject."""
        return stage, U2K.hasObject, obj

    def relate(self, relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
        """Return the triples of a spatial relation."""
        return plain_relation(relation, target, anchor)


def uses_soma(iris: tuple[str, ...]) -> bool:
    """Return whether any of the IRIs is a term of SOMA or DUL."""
    namespaces: tuple[Namespace, ...] = (SOMA, DUL)
    return any(iri.startswith(tuple(ns.iri for ns in namespaces)) for iri in iris)
