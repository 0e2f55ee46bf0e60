"""RDF documents: ordered triples in named graphs, with prefixes; reading and format detection."""

import gzip
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NamedTuple, cast

import pyoxigraph as ox

from usd2kg.errors import GraphError, one_line
from usd2kg.graph.vocabulary import OWL, PREFIXES, RDF
from usd2kg.ontology.xml_entities import refuse_entity_bomb_in_file

if TYPE_CHECKING:
    from usd2kg.graph.abox import KnowledgeGraph

__all__ = [
    "RDF_FORMATS",
    "TOO_LARGE",
    "GraphDocument",
    "GraphPart",
    "document_of",
    "open_rdf",
    "rdf_format",
    "read_document",
    "refuse_rdf12",
]

RDF_FORMATS = {
    ".ttl": ox.RdfFormat.TURTLE,
    ".nt": ox.RdfFormat.N_TRIPLES,
    ".nq": ox.RdfFormat.N_QUADS,
    ".trig": ox.RdfFormat.TRIG,
    ".rdf": ox.RdfFormat.RDF_XML,
    ".owl": ox.RdfFormat.RDF_XML,
    ".jsonld": ox.RdfFormat.JSON_LD,
}
"""File extension → RDF syntax for reading and writing; each may be followed by .gz."""


TOO_LARGE = "holds a text that is too long to read, expected at most 16 MiB"
"""Error text for a literal beyond the limit of the parser."""
_READ_ELSEWHERE = {
    ".ofn": "graphs are not read from OWL functional syntax, which usd2kg ontology show and --ontology read as classes",
    ".graphml": "graphs are not read from GraphML, an export format",
}
"""Write-only file extension → reason."""


class GraphPart(NamedTuple):
    """The triples of one named graph."""

    iri: str
    """IRI or blank node label of the graph; empty for the default graph."""
    triples: Sequence[ox.Triple]


@dataclass(frozen=True)
class GraphDocument:
    """The contents of an RDF file."""

    parts: tuple[GraphPart, ...]
    prefixes: Mapping[str, str]
    source: str
    """File or graph IRI, for error messages."""

    @property
    def triples(self) -> Sequence[ox.Triple]:
        """The union of all graphs, without duplicates."""
        if len(self.parts) == 1:
            return self.parts[0].triples
        return tuple(dict.fromkeys(triple for part in self.parts for triple in part.triples))


def document_of(graph: "KnowledgeGraph") -> GraphDocument:
    """Return the document of a graph: one named graph with the ontology IRI as its name."""
    return GraphDocument((GraphPart(graph.iri, graph.triples),), graph.prefixes, graph.iri)


def rdf_format(path: Path) -> ox.RdfFormat:
    """Return the RDF syntax for a file name, ignoring a final .gz.

    Raises:
        GraphError: the extension names no RDF syntax.
    """
    name = path.with_suffix("") if path.suffix.lower() == ".gz" else path
    found = RDF_FORMATS.get(name.suffix.lower())
    if found is None:
        endings = ", ".join(RDF_FORMATS)
        if readers := _READ_ELSEWHERE.get(name.suffix.lower()):
            raise GraphError(f"{path}: {readers}; expected the same graph as one of {endings}")
        raise GraphError(f"{path}: the ending {name.suffix!r} names no RDF format; expected one of {endings}")
    return found


def open_rdf(path: Path) -> BinaryIO:
    """Return a file opened for reading, decompressed if its name ends in .gz.

    Raises:
        SyntaxError: the file is RDF/XML with an entity expansion attack.
        OSError, EOFError, zlib.error: the file cannot be read.
    """
    if rdf_format(path) == ox.RdfFormat.RDF_XML:
        with _open_binary(path) as file:
            refuse_entity_bomb_in_file(file)
    return _open_binary(path)


def _open_binary(path: Path) -> BinaryIO:
    return cast("BinaryIO", gzip.open(path)) if path.suffix.lower() == ".gz" else path.open("rb")


def read_document(path: Path) -> GraphDocument:
    """Return the contents of an RDF file in file order.

    Default-graph triples are assigned to the graph named by the ontology that the file declares, if any.

    Raises:
        GraphError: the file is missing, its extension names no RDF format, or it does not parse.
    """
    syntax = rdf_format(path)
    if not path.is_file():
        raise GraphError(f"{path}: no such file; expected a graph that usd2kg build wrote")
    try:
        with open_rdf(path) as file:
            parser = ox.parse(file, format=syntax)
            parts = tuple(_parts(parser))
            prefixes = dict(parser.prefixes)
    except MemoryError as error:
        # pyoxigraph's parser buffers at most 16 MiB per token.
        raise GraphError(f"{path}: {TOO_LARGE} ({error}); shorten its longest text") from error
    except (SyntaxError, OSError, EOFError, zlib.error) as error:
        reason = one_line(error)
        raise GraphError(f"{path}: does not parse as {syntax.name} ({reason}); build the graph again") from error
    base = _base(parts)
    return GraphDocument(parts, {**PREFIXES, **({"": base} if base else {}), **prefixes}, str(path))


def _parts(quads: Iterator[ox.Quad]) -> Iterator[GraphPart]:
    found: dict[str, dict[ox.Triple, None]] = {}
    for graph, run in groupby(quads, key=lambda quad: quad.graph_name):
        name = str(graph) if isinstance(graph, ox.BlankNode) else getattr(graph, "value", "")
        found.setdefault(name, {}).update((quad.triple, None) for quad in run)
    for name, triples in found.items():
        kept = tuple(triples)
        yield GraphPart(name or _ontology(kept), kept)


def _ontology(triples: Sequence[ox.Triple]) -> str:
    nodes = (t.subject for t in triples if t.predicate == RDF.type and t.object == OWL.Ontology)
    return next((node.value for node in nodes if isinstance(node, ox.NamedNode)), "")


def _base(parts: tuple[GraphPart, ...]) -> str:
    """Return the namespace of the individuals, which is a graph IRI with `/` or `#`; empty if there is none."""
    for part in parts:
        for end in "/#":
            base = part.iri + end
            if part.iri and any(getattr(triple.subject, "value", "").startswith(base) for triple in part.triples):
                return base
    return ""


def refuse_rdf12(triple: ox.Triple, syntax: str, source: str) -> None:
    """Raise GraphError for a triple that needs RDF 1.2: a triple term or a directional literal."""
    value = triple.object
    if isinstance(value, ox.Triple) or (isinstance(value, ox.Literal) and value.direction is not None):
        raise GraphError(
            f"{source}: a statement about {triple.subject} needs RDF 1.2, which {syntax} lacks; choose .ttl, .trig, "
            ".nt or .nq, or annotate statements as OWL does (--annotations owl)"
        )
