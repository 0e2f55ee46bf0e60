"""How an object is written: the `soma` profile by SOMA's, DUL's and USD.owl's patterns, and `plain` for any ontology.

Patterns and traps of the soma profile, checked against SOMA 5d27187 and DUL:
size is hasShape → Shape → hasRegion → BoxShape, with both hasLength and hasDepth for KnowRob; one quality node an
object, since a shared one is inconsistent; the stage has members, since a Stage with parts is inconsistent.
"""

from collections.abc import Iterator
from typing import ClassVar, Protocol

import pyoxigraph as ox

from usd2kg.graph.iris import individual_iri
from usd2kg.graph.relation_terms import (
    PLAIN_RELATIONS,
    RELATION_CLASSES,
    SOMA_RELATIONS,
    plain_relation,
    soma_relation,
)
from usd2kg.graph.relations import Relation
from usd2kg.graph.vocabulary import DUL, OWL, RDF, SOMA, U2K, USD, Namespace, number, text
from usd2kg.scene import Box, SceneObject

__all__ = ["PlainProfile", "Profile", "SomaProfile", "Triple", "uses_soma", "vector_text"]

Triple = tuple[ox.NamedNode | ox.BlankNode, ox.NamedNode, ox.NamedNode | ox.BlankNode | ox.Literal]

_REFERENCE_FRAME = "world"


class Profile(Protocol):
    """Writes what is known of objects in one vocabulary."""

    name: ClassVar[str]
    imports: ClassVar[tuple[str, ...]]
    """Ontologies whose terms it uses beside the user's own."""
    object_properties: ClassVar[tuple[ox.NamedNode, ...]]
    data_properties: ClassVar[tuple[ox.NamedNode, ...]]
    classes: ClassVar[tuple[ox.NamedNode, ...]]
    """Classes it uses, to be declared."""

    def describe(self, obj: SceneObject, base: str) -> Iterator[Triple]:
        """Yield an object's size, pose and mass."""
        ...

    def stage(self, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield what the stage is."""
        ...

    def member(self, stage: ox.NamedNode, obj: ox.NamedNode) -> Iterator[Triple]:
        """Yield how the stage and one of its objects belong together."""
        ...

    def relate(self, relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
        """Return the triples of a spatial relation; the first one takes the numbers."""
        ...


def vector_text(values: tuple[float, ...]) -> str:
    """Return numbers with seven significant digits, parted by blanks.

    >>> vector_text((1.0, -0.0, 0.33333333333))
    '1 0 0.3333333'
    """
    return " ".join(f"{value + 0.0:.7g}" for value in values)


class SomaProfile:
    """SOMA, DUL, USD.owl and KnowRob's habits."""

    name: ClassVar[str] = "soma"
    imports: ClassVar[tuple[str, ...]] = ("https://ease-crc.org/ont/USD.owl",)
    object_properties: ClassVar[tuple[ox.NamedNode, ...]] = (
        DUL.hasMember,
        DUL.hasRegion,
        SOMA.hasLocalization,
        SOMA.hasMassAttribute,
        SOMA.hasShape,
        *SOMA_RELATIONS,
    )
    data_properties: ClassVar[tuple[ox.NamedNode, ...]] = (
        SOMA.hasDepth,
        SOMA.hasHeight,
        SOMA.hasLength,
        SOMA.hasMassValue,
        SOMA.hasPositionData,
        SOMA.hasReferenceFrame,
        SOMA.hasWidth,
    )
    classes: ClassVar[tuple[ox.NamedNode, ...]] = (
        SOMA["6DPose"],
        SOMA.BoxShape,
        SOMA.Localization,
        SOMA.MassAttribute,
        SOMA.Shape,
        USD.Prim,
        USD.Stage,
        *RELATION_CLASSES,
    )

    def describe(self, obj: SceneObject, base: str) -> Iterator[Triple]:
        """Yield an object's size, pose and mass."""
        node = ox.NamedNode(individual_iri(base, obj.prim_path))
        yield node, RDF.type, USD.Prim
        if obj.box is not None:
            yield from self._shape(node, obj.box, obj.prim_path, base)
        if obj.position is not None and obj.orientation is not None:
            yield from self._pose(node, (*obj.position, *obj.orientation), obj.prim_path, base)
        if obj.mass_kg is not None:
            mass = _individual(base, obj.prim_path, "mass")
            yield node, SOMA.hasMassAttribute, mass
            yield from _typed(mass, SOMA.MassAttribute)
            yield mass, SOMA.hasMassValue, number(obj.mass_kg)

    def _shape(self, node: ox.NamedNode, box: Box, path: str, base: str) -> Iterator[Triple]:
        shape, region = _individual(base, path, "shape"), _individual(base, path, "box")
        width, depth, height = box.size
        yield node, SOMA.hasShape, shape
        yield from _typed(shape, SOMA.Shape)
        yield shape, DUL.hasRegion, region
        yield from _typed(region, SOMA.BoxShape)
        yield region, SOMA.hasWidth, number(width, "float")
        yield region, SOMA.hasLength, number(depth, "float")
        yield region, SOMA.hasDepth, number(depth, "float")
        yield region, SOMA.hasHeight, number(height, "float")
        yield region, U2K.boxCenter, text(vector_text(box.center))

    def _pose(self, node: ox.NamedNode, pose: tuple[float, ...], path: str, base: str) -> Iterator[Triple]:
        place, region = _individual(base, path, "place"), _individual(base, path, "pose")
        yield node, SOMA.hasLocalization, place
        yield from _typed(place, SOMA.Localization)
        yield place, DUL.hasRegion, region
        yield from _typed(region, SOMA["6DPose"])
        yield region, SOMA.hasPositionData, text(vector_text(pose))
        yield region, SOMA.hasReferenceFrame, text(_REFERENCE_FRAME)

    def stage(self, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield what the stage is."""
        yield from _typed(node, USD.Stage)

    def member(self, stage: ox.NamedNode, obj: ox.NamedNode) -> Iterator[Triple]:
        """Yield the object's membership; `hasPart` would make the stage inconsistent."""
        yield stage, DUL.hasMember, obj

    def relate(self, relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
        """Return the triples of a spatial relation."""
        return soma_relation(relation, target, anchor)


class PlainProfile:
    """Our own few properties, straight on the object: for any ontology."""

    name: ClassVar[str] = "plain"
    imports: ClassVar[tuple[str, ...]] = ()
    object_properties: ClassVar[tuple[ox.NamedNode, ...]] = (U2K.hasObject, *PLAIN_RELATIONS)
    data_properties: ClassVar[tuple[ox.NamedNode, ...]] = (
        U2K.depth,
        U2K.height,
        U2K.mass,
        U2K.orientation,
        U2K.position,
        U2K.width,
    )
    classes: ClassVar[tuple[ox.NamedNode, ...]] = (U2K.Object, U2K.Stage, *RELATION_CLASSES)

    def describe(self, obj: SceneObject, base: str) -> Iterator[Triple]:
        """Yield an object's size, pose and mass."""
        node = ox.NamedNode(individual_iri(base, obj.prim_path))
        yield node, RDF.type, U2K.Object
        if obj.box is not None:
            width, depth, height = obj.box.size
            yield node, U2K.width, number(width)
            yield node, U2K.depth, number(depth)
            yield node, U2K.height, number(height)
            yield node, U2K.boxCenter, text(vector_text(obj.box.center))
        if obj.position is not None:
            yield node, U2K.position, text(vector_text(obj.position))
        if obj.orientation is not None:
            yield node, U2K.orientation, text(vector_text(obj.orientation))
        if obj.mass_kg is not None:
            yield node, U2K.mass, number(obj.mass_kg)

    def stage(self, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield what the stage is."""
        yield from _typed(node, U2K.Stage)

    def member(self, stage: ox.NamedNode, obj: ox.NamedNode) -> Iterator[Triple]:
        """Yield the object's membership."""
        yield stage, U2K.hasObject, obj

    def relate(self, relation: Relation, target: ox.NamedNode, anchor: ox.NamedNode) -> list[Triple]:
        """Return the triples of a spatial relation."""
        return plain_relation(relation, target, anchor)


def _individual(base: str, path: str, part: str) -> ox.NamedNode:
    return ox.NamedNode(individual_iri(base, path, part))


def _typed(node: ox.NamedNode, cls: ox.NamedNode) -> Iterator[Triple]:
    yield node, RDF.type, OWL.NamedIndividual
    yield node, RDF.type, cls


def uses_soma(iris: tuple[str, ...]) -> bool:
    """Return whether any of the IRIs is a term of SOMA or DUL."""
    namespaces: tuple[Namespace, ...] = (SOMA, DUL)
    return any(iri.startswith(tuple(ns.iri for ns in namespaces)) for iri in iris)
