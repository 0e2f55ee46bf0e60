"""Annotation of statements, as OWL 2 axiom annotations or RDF 1.2 reifiers."""

import hashlib
from collections.abc import Callable, Iterator, Sequence

import pyoxigraph as ox

from usd2kg.graph.vocabulary import OWL, RDF, Triple

__all__ = ["Annotate", "Annotation", "annotate_owl", "annotate_rdf12"]

Annotation = tuple[ox.NamedNode, ox.NamedNode | ox.Literal]
"""An annotation property and its value."""
Annotate = Callable[[Triple, Sequence[Annotation]], Iterator[Triple]]
"""Yields the triples that annotate a statement, without the statement itself."""


def annotate_owl(statement: Triple, annotations: Sequence[Annotation]) -> Iterator[Triple]:
    """Yield an owl:Axiom node with the annotations (OWL 2 Mapping to RDF Graphs, section 2.3)."""
    subject, predicate, value = statement
    axiom = _blank_node("axiom", statement)
    yield axiom, RDF.type, OWL.Axiom
    yield axiom, OWL.annotatedSource, subject
    yield axiom, OWL.annotatedProperty, predicate
    yield axiom, OWL.annotatedTarget, value
    for name, annotation in annotations:
        yield axiom, name, annotation


def annotate_rdf12(statement: Triple, annotations: Sequence[Annotation]) -> Iterator[Triple]:
    """Yield a reifier of the statement with the annotations (RDF 1.2 Concepts, section 1.5)."""
    reifier = _blank_node("reifier", statement)
    yield reifier, RDF.reifies, ox.Triple(*statement)
    for name, annotation in annotations:
        yield reifier, name, annotation


def _blank_node(kind: str, statement: Triple) -> ox.BlankNode:
    """Return a blank node labelled by a hash of the statement, stable under changes elsewhere."""
    key = "\n".join(map(str, statement)).encode()
    return ox.BlankNode(kind + hashlib.blake2b(key, digest_size=10).hexdigest())
