"""Writing graphs to files: the same graph gives the same bytes."""

from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.files import write_whole
from usd2kg.graph.instantiate import KnowledgeGraph

__all__ = ["GRAPH_FORMATS", "graph_format", "serialize_graph", "write_graph"]

GRAPH_FORMATS = {".ttl": ox.RdfFormat.TURTLE, ".nt": ox.RdfFormat.N_TRIPLES}
"""File ending → format that can be written."""


def graph_format(path: Path) -> ox.RdfFormat:
    """Return the format that a file name asks for.

    Raises:
        GraphError: the ending is not known.
    """
    found = GRAPH_FORMATS.get(path.suffix.lower())
    if found is None:
        endings = ", ".join(GRAPH_FORMATS)
        raise GraphError(f"{path}: the ending {path.suffix!r} names no graph format; expected one of {endings}")
    return found


def serialize_graph(graph: KnowledgeGraph, rdf_format: ox.RdfFormat) -> bytes:
    """Return the graph in a format, deterministically."""
    return b"".join(_pieces(graph, rdf_format))


def _pieces(graph: KnowledgeGraph, rdf_format: ox.RdfFormat) -> list[bytes | memoryview]:
    """Return the file in pieces, so that a large one need not be copied."""
    if rdf_format != ox.RdfFormat.TURTLE:
        return [_bytes(ox.serialize(graph.triples, format=rdf_format))]
    data = _bytes(ox.serialize(graph.triples, format=rdf_format, prefixes=graph.prefixes))
    # The serialiser writes its prefixes in an order that changes from run to run.
    end = 0
    for _ in graph.prefixes:
        end = data.index(b"\n", end) + 1
    return [*sorted(data[:end].splitlines(keepends=True)), memoryview(data)[end:]]


def _bytes(data: bytes | None) -> bytes:
    assert data is not None, "without an output file, serialize returns the bytes"
    return data


def write_graph(graph: KnowledgeGraph, path: Path | str) -> None:
    """Write the graph to `path`, in the format of its ending, whole or not at all.

    Raises:
        GraphError: the ending is not known.
        OutputError: the file cannot be written.
    """
    path = Path(path)
    write_whole(path, *_pieces(graph, graph_format(path)))
