"""Concepts of objects, with their hypernyms, in SKOS."""

from collections.abc import Iterable, Iterator

import pyoxigraph as ox

from usd2kg.graph.vocabulary import RDF, SKOS, U2K, Triple, number, text
from usd2kg.grounding import Concept, Prediction

__all__ = ["concept_triples", "state_concept"]


def concept_triples(concepts: Iterable[Concept]) -> Iterator[Triple]:
    """Yield each concept with its label and its direct hypernyms."""
    for concept in concepts:
        node = ox.NamedNode(concept.iri)
        yield node, RDF.type, SKOS.Concept
        yield node, SKOS.prefLabel, text(concept.label)
        for broader in concept.broader:
            yield node, SKOS.broader, ox.NamedNode(broader)


def state_concept(node: ox.NamedNode, prediction: Prediction) -> Iterator[Triple]:
    """Yield the concept of an object and its confidence; nothing if it has none."""
    if prediction.concept is not None:
        yield node, U2K.concept, ox.NamedNode(prediction.concept)
        if prediction.concept_confidence is not None:
            yield node, U2K.conceptConfidence, number(prediction.concept_confidence)
