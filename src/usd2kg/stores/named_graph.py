"""NamedGraph: triples under the IRI that names them in a store, and how that IRI is found."""

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.declarations import VOCABULARY_IRI, vocabulary_triples
from usd2kg.graph.instantiate import KnowledgeGraph
from usd2kg.graph.vocabulary import DCTERMS, OWL, RDF, named_node
from usd2kg.ontology import Closure, TBox, without_header
from usd2kg.query.load import load_graph

__all__ = [
    "NamedGraph",
    "make_named_graph",
    "make_ontology_graph",
    "read_named_graph",
    "relabel_blank_nodes",
    "short_name",
]

_HEADERS = "SELECT ?g WHERE { ?g a owl:Ontology ; u2k:run ?run }"
_TRIPLES = "CONSTRUCT { ?s ?p ?o } WHERE { ?s ?p ?o }"


@dataclass(frozen=True)
class NamedGraph:
    """What a store keeps under one name, put there and replaced as a whole."""

    iri: str
    """IRI of the OWL ontology that the triples are: the scene's base without its last / or #."""
    triples: tuple[ox.Triple, ...]
    """Each once."""


def make_named_graph(graph: KnowledgeGraph) -> NamedGraph:
    """Return the graph of a scene as a store keeps it."""
    return NamedGraph(graph.iri, tuple(dict.fromkeys(graph.triples)))


def make_ontology_graph(tbox: TBox, closure: Closure) -> NamedGraph:
    """Return an ontology, all that it imports and our vocabulary, as one graph that all scenes of a store share."""
    iri = tbox.ontology_iri
    # A path on this machine says nothing to others, and is not theirs to know.
    iri = f"urn:usd2kg:ontology:{tbox.content_hash}" if iri.startswith("file:") else iri
    node = ox.NamedNode(iri)
    sources = (VOCABULARY_IRI, *(d for d in closure.documents if not d.startswith("file:")))
    header = [ox.Triple(node, RDF.type, OWL.Ontology)]
    header += [ox.Triple(node, DCTERMS.source, ox.NamedNode(source)) for source in sources]
    stated = (*header, *closure.triples, *without_header(vocabulary_triples(), "v"))
    return NamedGraph(iri, tuple(dict.fromkeys(stated)))


def read_named_graph(path: Path, iri: str | None = None) -> NamedGraph:
    """Return the graph in a file, named as it names itself, or by `iri`.

    Raises:
        GraphError: the file cannot be read, is empty, does not say whose graph it is, or `iri` is no IRI.
    """
    read = load_graph(path)
    if iri is None:
        found = [row[0] for row in read.sparql(_HEADERS).rows]
        if len(found) != 1 or found[0] is None:
            held = "names no graph" if not found else f"names {len(found)} graphs"
            raise GraphError(f"{path}: {held}; expected one that usd2kg build wrote, or its IRI with --scene")
        iri = found[0]
    if named_node(iri) is None:
        raise GraphError(f"graph {iri!r}: is no absolute IRI; expected one like https://my.lab/kitchen")
    found_triples = read.store.query(_TRIPLES, use_default_graph_as_union=True)
    assert isinstance(found_triples, ox.QueryTriples)
    triples = tuple(dict.fromkeys(found_triples))
    if not triples:
        raise GraphError(f"{path}: holds no triple; build the graph again")
    return NamedGraph(iri, triples)


def short_name(iri: str) -> str:
    """Return the last part of a graph's IRI, as a person writes it.

    >>> short_name("https://example.org/my%20kitchen")
    'my kitchen'
    """
    return unquote(iri.rstrip("/#").replace("#", "/").rpartition("/")[2])


def relabel_blank_nodes(graph: NamedGraph) -> Iterator[ox.Triple]:
    """Yield the triples with blank nodes whose names depend on the graph and their own name alone.

    In a store two scenes may use the same names for nodes that are not the same, and a graph that is loaded again
    must give the same nodes.
    """
    return _renamed(graph.triples, graph.iri)


def _renamed(triples: Iterable[ox.Triple], salt: str) -> Iterator[ox.Triple]:
    @cache
    def name(label: str) -> ox.BlankNode:
        return ox.BlankNode("b" + hashlib.blake2b(f"{salt}\n{label}".encode(), digest_size=12).hexdigest())

    def rename(term: Any) -> Any:
        if isinstance(term, ox.BlankNode):
            return name(term.value)
        if isinstance(term, ox.Triple):
            return ox.Triple(rename(term.subject), term.predicate, rename(term.object))
        return term

    for triple in triples:
        yield ox.Triple(rename(triple.subject), triple.predicate, rename(triple.object))
