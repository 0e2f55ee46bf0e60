"""OWL entity types of all terms, so that each graph declares the terms it uses."""

from collections.abc import Iterable, Iterator
from functools import cache
from importlib.resources import files

import pyoxigraph as ox

from usd2kg.graph.vocabulary import (
    DCTERMS,
    DUL,
    KNOWROB,
    OWL,
    PROV,
    RDF,
    RDFS,
    SHACL,
    SKOS,
    SOMA,
    SSSOM,
    USD,
    Namespace,
    Triple,
    text,
)
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["VOCABULARY_IRI", "declare_classes", "declare_terms", "vocabulary_text", "vocabulary_triples"]

VOCABULARY_IRI = "https://w3id.org/usd2kg"
"""IRI of the ontology of the u2k terms."""

_ENTITY_TYPES = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty)

_EXTERNAL_TERMS: dict[ox.NamedNode, dict[Namespace, str]] = {
    OWL.Class: {
        SOMA: """
            6DPose BoxShape Color ColorRegion ContinuousJoint FixedJoint HingeJoint Joint JointLimit JointState
            Localization MassAttribute MeshShape MovableJoint PrismaticJoint RevoluteJoint Shape
        """,
        USD: "Color Prim Stage",
        PROV: "Activity Entity SoftwareAgent",
        SKOS: "Concept",
    },
    OWL.ObjectProperty: {
        SOMA: """
            containsObject hasChildLink hasColor hasJointLimit hasJointState hasLocalization hasMassAttribute
            hasParentLink hasPhysicalComponent hasShape isDepositOf isInsideOf isLinkedTo isOntopOf isSupportedBy
            supports
        """,
        DUL: """
            hasCommonBoundary hasComponent hasLocation hasMember hasPart hasRegion isComponentOf isLocationOf isPartOf
            nearTo
        """,
        KNOWROB: "isAboveOf isBehindOf isBelowOf isInFrontOf isLeftOf isNextTo isRightOf",
        USD: "hasColor",
        PROV: "used wasAssociatedWith wasDerivedFrom wasGeneratedBy",
    },
    OWL.DatatypeProperty: {
        SOMA: """
            hasDepth hasFilePath hasHeight hasJointPosition hasJointPositionMax hasJointPositionMin hasLength
            hasMassValue hasPositionData hasReferenceFrame hasRGBValue hasWidth
        """,
        USD: "primvars_displayColor",
        PROV: "endedAtTime",
    },
    OWL.AnnotationProperty: {
        SSSOM: "confidence mapping_justification reviewer_id reviewer_label",
        SKOS: "altLabel broader prefLabel",
        DCTERMS: "identifier source",
        SHACL: "declare namespace prefix",
    },
}
"""Entity type → namespace → local names of the external terms that graphs use."""

_BUILT_IN = tuple(namespace.iri for namespace in (RDF, RDFS, OWL))


def vocabulary_text() -> str:
    """Return the ontology of the u2k terms as Turtle."""
    return (files("usd2kg.graph") / "vocabulary.ttl").read_text("utf-8")


def vocabulary_triples() -> list[ox.Triple]:
    """Return the ontology of the u2k terms as triples."""
    return [quad.triple for quad in ox.parse(vocabulary_text(), format=ox.RdfFormat.TURTLE)]


@cache
def _entity_types() -> dict[ox.NamedNode, ox.NamedNode]:
    """Return the entity type of each term that a graph may use, except the user's classes."""
    kinds = {
        namespace[name]: kind
        for kind, names in _EXTERNAL_TERMS.items()
        for namespace, listed in names.items()
        for name in listed.split()
    }
    for triple in vocabulary_triples():
        subject, kind = triple.subject, triple.object
        if isinstance(subject, ox.NamedNode) and isinstance(kind, ox.NamedNode) and kind in _ENTITY_TYPES:
            kinds[subject] = kind
    return kinds


def declare_terms(properties: Iterable[ox.NamedNode], classes: Iterable[ox.NamedNode]) -> Iterator[Triple]:
    """Yield the sorted declarations of the terms in use; the user's own classes are not declared here.

    Raises:
        KeyError: a property is neither in the u2k vocabulary nor listed here.
    """
    kinds = _entity_types()
    own = [node for node in properties if not node.value.startswith(_BUILT_IN)]
    for node in sorted({*own, *(node for node in classes if node in kinds)}, key=str):
        yield node, RDF.type, kinds[node]


def declare_classes(used: Iterable[ClassIRI], tbox: TBox) -> Iterator[Triple]:
    """Yield the sorted superclass closure of classes, with labels, so that class queries need no ontology."""
    for iri in sorted({above for cls in used for above in tbox.closure(cls)}):
        node = ox.NamedNode(iri)
        yield node, RDF.type, OWL.Class
        yield node, RDFS.label, text(tbox.by_iri[iri].label)
        for parent in tbox.by_iri[iri].parents:
            yield node, RDFS.subClassOf, ox.NamedNode(parent)
