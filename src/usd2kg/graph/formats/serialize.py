"""Deterministic serialisation of graphs to files."""

import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.files import write_whole
from usd2kg.graph.abox import KnowledgeGraph
from usd2kg.graph.packed_triples import PackedTriples, subject_chunks
from usd2kg.graph.rdf_document import RDF_FORMATS, GraphDocument, document_of, refuse_rdf12
from usd2kg.graph.turtle_text import TurtleText
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.ontology import write_functional_syntax
from usd2kg.tracing import traced

__all__ = ["GRAPH_FORMATS", "GraphFormat", "graph_format", "serialize_graph", "write_graph"]

_CHUNK = 100_000
"""Triples per serialised chunk."""

Chunks = Iterator[bytes | memoryview]


class GraphFormat(NamedTuple):
    """A file format for graphs."""

    name: str
    write: Callable[[GraphDocument], Chunks]
    """Yields the file in chunks."""


def graph_format(path: Path) -> GraphFormat:
    """Return the format for a file name, ignoring a final .gz.

    Raises:
        GraphError: the extension is unknown.
    """
    name = path.with_suffix("") if _is_compressed(path) else path
    found = GRAPH_FORMATS.get(name.suffix.lower())
    if found is None:
        endings = ", ".join(GRAPH_FORMATS)
        raise GraphError(f"{path}: the ending {name.suffix!r} names no graph format; expected one of {endings}")
    return found


def serialize_graph(graph: KnowledgeGraph | GraphDocument, rdf_format: ox.RdfFormat) -> bytes:
    """Return the graph in an RDF syntax; the same graph gives the same bytes.

    Raises:
        GraphError: the syntax cannot represent the graph.
    """
    ending = next(ending for ending, syntax in RDF_FORMATS.items() if syntax == rdf_format)
    return b"".join(_chunks_of(graph, GRAPH_FORMATS[ending]))


@traced("write")
def write_graph(graph: KnowledgeGraph | GraphDocument, path: Path | str) -> None:
    """Write the graph atomically, in the format of the file extension; compressed if it ends in .gz.

    Raises:
        GraphError: the extension is unknown, or the format cannot represent the graph.
        OutputError: the file cannot be written.
    """
    path = Path(path)
    pieces = _chunks_of(graph, graph_format(path))
    write_whole(path, _compressed(pieces) if _is_compressed(path) else pieces)


def _chunks_of(graph: KnowledgeGraph | GraphDocument, chosen: GraphFormat) -> Chunks:
    return chosen.write(document_of(graph) if isinstance(graph, KnowledgeGraph) else graph)


def _is_compressed(path: Path) -> bool:
    return path.suffix.lower() == ".gz"


def _compressed(pieces: Iterable[bytes | memoryview]) -> Iterator[bytes]:
    # Python's gzip module writes a time stamp; zlib does not.
    compressor = zlib.compressobj(wbits=31)
    for piece in pieces:
        yield compressor.compress(piece)
    yield compressor.flush()


def _turtle(document: GraphDocument) -> Chunks:
    yield _prefix_lines(document.prefixes)
    yield from _statements(document.triples, document.prefixes)


def _trig(document: GraphDocument) -> Chunks:
    yield _prefix_lines(document.prefixes)
    for part in document.parts:
        if part.iri:
            yield f"{_graph_name(part.iri)} {{\n".encode()
        yield from _statements(part.triples, document.prefixes)
        if part.iri:
            yield b"}\n"


def _prefix_lines(prefixes: Mapping[str, str]) -> bytes:
    # The serialiser's prefix order varies between runs.
    return "".join(sorted(f"@prefix {name}: <{iri}> .\n" for name, iri in prefixes.items())).encode()


def _statements(triples: Sequence[ox.Triple], prefixes: Mapping[str, str]) -> Chunks:
    """Yield Turtle statements without prefix declarations."""
    if isinstance(triples, PackedTriples) and triples.prefixes == prefixes:
        yield from triples.turtle()
    else:
        text = TurtleText(prefixes)
        yield from (text.statements(chunk).encode() for chunk in subject_chunks(triples, _CHUNK))


def _n_triples(document: GraphDocument) -> Chunks:
    return _lines(document.triples)


def _n_quads(document: GraphDocument) -> Chunks:
    for part in document.parts:
        end = f" {_graph_name(part.iri)} .\n".encode() if part.iri else b" .\n"
        for lines in _lines(part.triples):
            # N-Triples escapes line feeds in literals.
            yield lines.replace(b" .\n", end)


def _graph_name(name: str) -> str:
    return name if name.startswith("_:") else f"<{name}>"


def _lines(triples: Sequence[ox.Triple]) -> Iterator[bytes]:
    for chunk in subject_chunks(triples, _CHUNK):
        yield _bytes(ox.serialize(chunk, format=ox.RdfFormat.N_TRIPLES))


def _bytes(data: bytes | None) -> bytes:
    assert data is not None, "without an output file, serialize returns the bytes"
    return data


def _rdf_xml(document: GraphDocument) -> Chunks:
    # The XML writers of the standard library import the HTTP client.
    from usd2kg.graph.formats.rdf_xml import rdf_xml_pieces  # noqa: PLC0415

    return rdf_xml_pieces(document.triples, document.prefixes, document.source)


def _json_ld(document: GraphDocument) -> Chunks:
    for triple in document.triples:
        refuse_rdf12(triple, "JSON-LD", document.source)
    yield _bytes(ox.serialize(document.triples, format=ox.RdfFormat.JSON_LD))


def _functional(document: GraphDocument) -> Chunks:
    for triple in document.triples:
        refuse_rdf12(triple, "OWL", document.source)
    rdf = b"".join(_lines(document.triples)).decode()
    # The scene's prefix would give illegal abbreviated IRIs in functional syntax, such as :-stage.
    yield write_functional_syntax(rdf, PREFIXES, document.source).encode()


def _graphml(document: GraphDocument) -> Chunks:
    from usd2kg.graph.export.graphml import graphml_pieces  # noqa: PLC0415
    from usd2kg.graph.export.property_graph import read_property_graph  # noqa: PLC0415

    return graphml_pieces(read_property_graph(document))


GRAPH_FORMATS = {
    ".ttl": GraphFormat("Turtle", _turtle),
    ".nt": GraphFormat("N-Triples", _n_triples),
    ".trig": GraphFormat("TriG", _trig),
    ".nq": GraphFormat("N-Quads", _n_quads),
    ".rdf": GraphFormat("RDF/XML", _rdf_xml),
    ".owl": GraphFormat("RDF/XML", _rdf_xml),
    ".jsonld": GraphFormat("JSON-LD", _json_ld),
    ".ofn": GraphFormat("OWL functional syntax", _functional),
    ".graphml": GraphFormat("GraphML", _graphml),
}
"""File extension → output format; each may be followed by .gz."""
