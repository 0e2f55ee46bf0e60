"""Merge the import closure into a graph, so that it needs no other file."""

from dataclasses import replace

import pyoxigraph as ox

from usd2kg.graph.abox import KnowledgeGraph
from usd2kg.graph.declarations import VOCABULARY_IRI, vocabulary_triples
from usd2kg.graph.vocabulary import DCTERMS, OWL, RDF
from usd2kg.ontology import Closure, without_header

__all__ = ["merge_imports"]


def merge_imports(graph: KnowledgeGraph, closure: Closure) -> KnowledgeGraph:
    """Return the graph merged with its import closure and the u2k vocabulary, without owl:imports.

    The header lists merged documents as dcterms:source. Unavailable ones are in `missing_imports`; their terms stay
    declared.
    """
    node = ox.NamedNode(graph.iri)
    sources = (VOCABULARY_IRI, *(iri for iri in closure.documents if not iri.startswith("file:")))
    header = [ox.Triple(node, DCTERMS.source, ox.NamedNode(iri)) for iri in sources]
    header.append(ox.Triple(DCTERMS.source, RDF.type, OWL.AnnotationProperty))
    own = [triple for triple in graph.triples if triple.predicate != OWL.imports]
    # Keep the ontology header together at the start.
    start = next((place for place, triple in enumerate(own) if triple.subject != node), len(own))
    vocabulary = without_header(vocabulary_triples(), "v")
    merged = dict.fromkeys((*own[:start], *header, *own[start:], *closure.triples, *vocabulary))
    return replace(graph, triples=tuple(merged), imports=(), missing_imports=closure.missing)
