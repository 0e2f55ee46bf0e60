"""NamedGraph: a scene or an ontology as a named graph of a store."""

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.declarations import VOCABULARY_IRI, vocabulary_triples
from usd2kg.graph.rdf_document import read_statements
from usd2kg.graph.vocabulary import DCTERMS, OWL, RDF, U2K, named_node

if TYPE_CHECKING:
    from usd2kg.graph.abox import KnowledgeGraph
    from usd2kg.ontology import Closure, TBox

__all__ = [
    "NamedGraph",
    "last_segment",
    "make_named_graph",
    "make_ontology_graph",
    "read_named_graph",
    "stored_quads",
]


@dataclass(frozen=True)
class NamedGraph:
    """Triples that a store keeps and replaces as a whole."""

    iri: str
    """IRI of the OWL ontology that the triples form: the scene's base without its last / or #."""
    triples: Sequence[ox.Triple]
    """Without duplicates."""


def make_named_graph(graph: "KnowledgeGraph") -> NamedGraph:
    """Return the named graph of a scene."""
    return NamedGraph(graph.iri, graph.triples)


def make_ontology_graph(tbox: "TBox", closure: "Closure") -> NamedGraph:
    """Return an ontology, its imports and the u2k vocabulary as one named graph that all scenes of a store share."""
    from usd2kg.ontology import without_header  # noqa: PLC0415 - loads the parsers of OWL

    iri = tbox.ontology_iri
    # Do not publish local paths.
    iri = f"urn:usd2kg:ontology:{tbox.content_hash}" if iri.startswith("file:") else iri
    node = ox.NamedNode(iri)
    sources = (VOCABULARY_IRI, *(d for d in closure.documents if not d.startswith("file:")))
    header = [ox.Triple(node, RDF.type, OWL.Ontology)]
    header += [ox.Triple(node, DCTERMS.source, ox.NamedNode(source)) for source in sources]
    stated = (*header, *closure.triples, *without_header(vocabulary_triples(), "v"))
    return NamedGraph(iri, tuple(dict.fromkeys(stated)))


def read_named_graph(path: Path, iri: str | None = None) -> NamedGraph:
    """Return the graph in a file, named by `iri` or by its own ontology IRI.

    Raises:
        GraphError: the file cannot be read, is empty, or states no single ontology IRI; or `iri` is invalid.
    """
    triples = read_statements(path)
    if iri is None:
        found = _headers(triples)
        if len(found) != 1:
            stated = f"{len(found)} graph IRIs" if found else "no graph IRI"
            raise GraphError(
                f"{path}: states {stated}; expected a graph that usd2kg build wrote, or its IRI with --scene"
            )
        iri = found[0]
    if named_node(iri) is None:
        raise GraphError(f"graph {iri!r}: is not an absolute IRI; expected one like https://my.lab/kitchen")
    if not triples:
        raise GraphError(f"{path}: contains no triples; build the graph again")
    return NamedGraph(iri, triples)


def _headers(triples: Iterable[ox.Triple]) -> list[str]:
    """Return the IRIs of the ontologies that are graphs of scenes: those that a run of this package wrote."""
    ontologies, written = set[str](), set[str]()
    run, kind = U2K.run, RDF.type
    for triple in triples:
        predicate = triple.predicate
        if predicate == run and isinstance(triple.subject, ox.NamedNode):
            written.add(triple.subject.value)
        elif predicate == kind and triple.object == OWL.Ontology and isinstance(triple.subject, ox.NamedNode):
            ontologies.add(triple.subject.value)
    return sorted(ontologies & written)


def last_segment(iri: str) -> str:
    """Return the last segment of a graph's IRI, percent-decoded.

    >>> last_segment("https://example.org/my%20kitchen")
    'my kitchen'
    """
    return unquote(iri.rstrip("/#").replace("#", "/").rpartition("/")[2])


def stored_quads(graph: NamedGraph) -> Iterator[ox.Quad]:
    """Yield the triples in their graph, with blank node labels derived from the graph's IRI and the original labels.

    Labels of two scenes must not collide in a store, and a reloaded graph must get the same nodes.
    """
    node = ox.NamedNode(graph.iri)
    is_label_free = (ox.NamedNode, ox.Literal)

    @cache
    def derive(label: str) -> ox.BlankNode:
        return ox.BlankNode("b" + hashlib.blake2b(f"{graph.iri}\n{label}".encode(), digest_size=12).hexdigest())

    def relabel(term: Any) -> Any:
        if isinstance(term, ox.BlankNode):
            return derive(term.value)
        if isinstance(term, ox.Triple):
            return ox.Triple(relabel(term.subject), term.predicate, relabel(term.object))
        return term

    for triple in graph.triples:
        # The engine creates a new object on each access to a term.
        subject, value = triple.subject, triple.object
        if not isinstance(subject, ox.NamedNode):
            subject = relabel(subject)
        if not isinstance(value, is_label_free):
            value = relabel(value)
        yield ox.Quad(subject, triple.predicate, value, node)
