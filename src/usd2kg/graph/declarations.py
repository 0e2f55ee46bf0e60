"""What kind of OWL entity each term is, so that a graph declares all it uses and OWL tools read it without guessing."""

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
    SKOS,
    SOMA,
    SSSOM,
    USD,
    Namespace,
    Triple,
)

__all__ = ["VOCABULARY_IRI", "declare_terms", "vocabulary_text", "vocabulary_triples"]

VOCABULARY_IRI = "https://w3id.org/usd2kg"
"""IRI of the ontology of our own terms."""

_KINDS = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty)

_TERMS_OF_OTHERS: dict[ox.NamedNode, dict[Namespace, str]] = {
    OWL.Class: {
        SOMA: """
            6DPose BoxShape Color ColorRegion ContinuousJoint FixedJoint HingeJoint Joint JointLimit JointState
            Localization MassAttribute MeshShape MovableJoint PrismaticJoint RevoluteJoint Shape
        """,
        USD: "Color Prim Stage",
        PROV: "Activity Entity SoftwareAgent",
    },
    OWL.ObjectProperty: {
        SOMA: """
            containsObject hasChildLink hasColor hasJointLimit hasJointState hasLocalization hasMassAttribute
            hasParentLink hasPhysicalComponent hasShape isDepositOf isInsideOf isOntopOf isSupportedBy supports
        """,
        DUL: """
            hasCommonBoundary hasComponent hasLocation hasMember hasPart hasRegion isComponentOf isLocationOf isPartOf
            nearTo
        """,
        KNOWROB: "isAboveOf isBehindOf isBelowOf isInFrontOf isLeftOf isNextTo isRightOf",
        USD: "hasColor",
        PROV: "used wasAssociatedWith",
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
        SKOS: "altLabel",
        DCTERMS: "source",
    },
}
"""Kind → namespace → local names: the terms of SOMA, DUL, USD.owl, KnowRob, PROV-O, SSSOM and SKOS that are written."""

_BUILT_IN = tuple(namespace.iri for namespace in (RDF, RDFS, OWL))


def vocabulary_text() -> str:
    """Return the ontology of our own terms, as Turtle."""
    return (files("usd2kg.graph") / "vocabulary.ttl").read_text("utf-8")


def vocabulary_triples() -> list[ox.Triple]:
    """Return the ontology of our own terms as triples."""
    return [quad.triple for quad in ox.parse(vocabulary_text(), format=ox.RdfFormat.TURTLE)]


@cache
def _kinds() -> dict[ox.NamedNode, ox.NamedNode]:
    """Return the kind of each term that a graph may use beside the user's classes."""
    kinds = {
        namespace[name]: kind
        for kind, names in _TERMS_OF_OTHERS.items()
        for namespace, text in names.items()
        for name in text.split()
    }
    for triple in vocabulary_triples():
        subject, kind = triple.subject, triple.object
        if isinstance(subject, ox.NamedNode) and isinstance(kind, ox.NamedNode) and kind in _KINDS:
            kinds[subject] = kind
    return kinds


def declare_terms(properties: Iterable[ox.NamedNode], classes: Iterable[ox.NamedNode]) -> Iterator[Triple]:
    """Yield the declarations of the terms that a graph uses, sorted; the user's own classes are left to others.

    Raises:
        KeyError: a property is neither ours nor listed here.
    """
    kinds = _kinds()
    own = [node for node in properties if not node.value.startswith(_BUILT_IN)]
    for node in sorted({*own, *(node for node in classes if node in kinds)}, key=str):
        yield node, RDF.type, kinds[node]
