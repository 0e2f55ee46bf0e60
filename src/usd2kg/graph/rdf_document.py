"""RDF documents: ordered triples in named graphs, with prefixes; reading and format detection."""

import gzip
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NamedTuple, cast

import pyoxigraph as ox

from usd2kg.convert import STAGE_ENDINGS
from usd2kg.errors import GraphError, one_line
from usd2kg.garbage import paused_collection
from usd2kg.graph.vocabulary import OWL, PREFIXES, RDF
from usd2kg.ontology.nesting import refuse_deep_nesting_in_file
from usd2kg.ontology.xml_entities import refuse_entity_bomb_in_file
from usd2kg.tracing import traced

if TYPE_CHECKING:
    from usd2kg.graph.abox import KnowledgeGraph

__all__ = [
    "RDF_FORMATS",
    "GraphDocument",
    "GraphPart",
    "check_graph_file",
    "document_of",
    "open_rdf",
    "parse_errors_explained",
    "rdf_format",
    "read_document",
    "read_statements",
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

_TOO_LARGE = "holds a text that is too long to read, expected at most 16 MiB"
"""Error text for a literal beyond the limit of the parser."""
_NOT_READ = {
    ".ofn": "OWL functional syntax is read only as an ontology (--ontology, usd2kg ontology show), not as a graph",
    ".graphml": "graphs are not read from GraphML, an export format",
}
"""File extension of an unsupported input → reason."""


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
        ending, endings = name.suffix.lower(), ", ".join(RDF_FORMATS)
        if ending in STAGE_ENDINGS:
            raise GraphError(f"{path}: is a stage; expected its graph: usd2kg build {path} -o {path.stem}.ttl")
        if ending in _NOT_READ:
            raise GraphError(f"{path}: {_NOT_READ[ending]}; expected the same graph as one of {endings}")
        raise GraphError(f"{path}: the ending {name.suffix!r} names no RDF format; expected one of {endings}")
    return found


def check_graph_file(path: Path) -> ox.RdfFormat:
    """Return the RDF syntax of a graph file.

    Raises:
        GraphError: there is no such file, or its extension names no RDF syntax.
    """
    if path.is_dir():
        raise GraphError(f"{path}: is a folder; expected a graph that usd2kg build wrote")
    syntax = rdf_format(path)
    if not path.is_file():
        raise GraphError(f"{path}: no such file; expected a graph that usd2kg build wrote")
    return syntax


@contextmanager
def parse_errors_explained(path: Path, syntax: ox.RdfFormat) -> Iterator[None]:
    """Convert exceptions of reading and parsing a graph file to GraphError."""
    try:
        yield
    except MemoryError as error:
        # pyoxigraph raises this for a literal above 16 MiB, its parser's limit.
        raise GraphError(f"{path}: {_TOO_LARGE} ({error}); shorten its longest text") from error
    except (SyntaxError, OSError, EOFError, zlib.error) as error:
        reason = one_line(getattr(error, "strerror", None) or error)
        raise GraphError(f"{path}: does not parse as {syntax.name} ({reason}); build the graph again") from error


@traced("parse", lambda triples: {"triples": len(triples)})
def read_statements(path: Path) -> tuple[ox.Triple, ...]:
    """Return the distinct statements of all named graphs in a file, in file order.

    Literals keep their lexical form, unlike in a store, which normalizes it.

    Raises:
        GraphError: the file is missing, its extension names no RDF format, or it does not parse.
    """
    syntax = check_graph_file(path)
    with parse_errors_explained(path, syntax), paused_collection(), open_rdf(path) as file:
        return tuple(dict.fromkeys(quad.triple for quad in ox.parse(file, format=syntax)))


def open_rdf(path: Path) -> BinaryIO:
    """Return a file opened for reading, decompressed if its name ends in .gz.

    Raises:
        SyntaxError: the file is RDF/XML with an entity expansion attack, or nested too deeply.
        OSError, EOFError, zlib.error: the file cannot be read.
    """
    syntax = rdf_format(path)
    with _open_binary(path) as file:
        if syntax == ox.RdfFormat.RDF_XML:
            refuse_entity_bomb_in_file(file)
        else:
            refuse_deep_nesting_in_file(file, "jsonld" if syntax == ox.RdfFormat.JSON_LD else "ttl")
    return _open_binary(path)


def _open_binary(path: Path) -> BinaryIO:
    return cast("BinaryIO", gzip.open(path)) if path.suffix.lower() == ".gz" else path.open("rb")


@traced("parse", lambda document: {"triples": len(document.triples)})
def read_document(path: Path) -> GraphDocument:
    """Return the contents of an RDF file in file order.

    Default-graph triples are assigned to the graph named by the ontology that the file declares, if any.

    Raises:
        GraphError: the file is missing, its extension names no RDF format, or it does not parse.
    """
    syntax = check_graph_file(path)
    with parse_errors_explained(path, syntax), open_rdf(path) as file:
        parser = ox.parse(file, format=syntax)
        parts = tuple(_parts(parser))
        prefixes = dict(parser.prefixes)
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
