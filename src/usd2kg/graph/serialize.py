"""Writing graphs to files: the same graph gives the same bytes."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.files import write_whole
from usd2kg.graph.instantiate import KnowledgeGraph

__all__ = ["GRAPH_FORMATS", "graph_format", "serialize_graph", "write_graph"]

GRAPH_FORMATS = {".ttl": ox.RdfFormat.TURTLE, ".nt": ox.RdfFormat.N_TRIPLES}
"""File ending → format that can be written."""

_CHUNK = 100_000
"""Triples that are serialised at a time."""


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


def _pieces(graph: KnowledgeGraph, rdf_format: ox.RdfFormat) -> Iterator[bytes | memoryview]:
    """Yield the file in pieces, so that a large one need not be in memory whole."""
    is_turtle = rdf_format == ox.RdfFormat.TURTLE
    prefixes = graph.prefixes if is_turtle else None
    if is_turtle:
        # The serialiser writes its prefixes in an order that changes from run to run.
        yield "".join(sorted(f"@prefix {name}: <{iri}> .\n" for name, iri in graph.prefixes.items())).encode()
    for triples in _chunks(graph.triples):
        data = _bytes(ox.serialize(triples, format=rdf_format, prefixes=prefixes))
        end = 0
        for _ in prefixes or ():
            end = data.index(b"\n", end) + 1
        yield memoryview(data)[end:]


def _chunks(triples: Sequence[ox.Triple]) -> Iterator[Sequence[ox.Triple]]:
    """Yield the triples in runs of some length, parted where the subject changes."""
    start = 0
    while start < len(triples):
        end = start + _CHUNK
        while end < len(triples) and triples[end].subject == triples[end - 1].subject:
            end += 1
        yield triples[start:end]
        start = end


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
    write_whole(path, _pieces(graph, graph_format(path)))
