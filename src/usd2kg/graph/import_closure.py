"""merge_imports: a graph that needs no other file, with the ontology, all that it imports and our vocabulary in it."""

from dataclasses import replace

import pyoxigraph as ox

from usd2kg.graph.declarations import VOCABULARY_IRI, vocabulary_triples
from usd2kg.graph.instantiate import KnowledgeGraph
from usd2kg.graph.vocabulary import DCTERMS, OWL, RDF
from usd2kg.ontology import Closure, without_header

__all__ = ["merge_imports"]


def merge_imports(graph: KnowledgeGraph, closure: Closure) -> KnowledgeGraph:
    """Return the graph with what its ontologies and our vocabulary state, and without imports.

    The header names each document that was merged in, as dcterms:source; what was not at hand is in
    `missing_imports`, and its terms are declared all the same.
    """
    node = ox.NamedNode(graph.iri)
    sources = (VOCABULARY_IRI, *(iri for iri in closure.documents if not iri.startswith("file:")))
    header = [ox.Triple(node, DCTERMS.source, ox.NamedNode(iri)) for iri in sources]
    header.append(ox.Triple(DCTERMS.source, RDF.type, OWL.AnnotationProperty))
    own = [triple for triple in graph.triples if triple.predicate != OWL.imports]
    # The header stands first, and stays together.
    start = next((place for place, triple in enumerate(own) if triple.subject != node), len(own))
    vocabulary = without_header(vocabulary_triples(), "v")
    merged = dict.fromkeys((*own[:start], *header, *own[start:], *closure.triples, *vocabulary))
    return replace(graph, triples=tuple(merged), imports=(), missing_imports=closure.missing)
