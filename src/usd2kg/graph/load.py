"""Reading a graph from a file."""

from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.query import GraphStore

__all__ = ["load_graph"]

_INPUT_FORMATS = {
    ".ttl": ox.RdfFormat.TURTLE,
    ".nt": ox.RdfFormat.N_TRIPLES,
    ".rdf": ox.RdfFormat.RDF_XML,
    ".owl": ox.RdfFormat.RDF_XML,
    ".nq": ox.RdfFormat.N_QUADS,
    ".trig": ox.RdfFormat.TRIG,
    ".jsonld": ox.RdfFormat.JSON_LD,
}
"""File ending → format that can be read."""


def load_graph(path: Path | str) -> GraphStore:
    """Return the graph in a file, ready to be asked.

    Raises:
        GraphError: the file is missing, its ending names no RDF format, or it does not parse.
    """
    path = Path(path)
    rdf_format = _INPUT_FORMATS.get(path.suffix.lower())
    if path.is_dir():
        raise GraphError(f"{path}: is a folder; expected a graph that usd2kg build wrote")
    if not path.is_file():
        raise GraphError(f"{path}: no such file; expected a graph that usd2kg build wrote")
    if rdf_format is None:
        endings = ", ".join(_INPUT_FORMATS)
        raise GraphError(f"{path}: the ending {path.suffix!r} names no RDF format; expected one of {endings}")
    store = ox.Store()
    try:
        store.bulk_load(path=str(path), format=rdf_format)
    except (SyntaxError, OSError) as error:
        reason = " ".join(str(error).split())
        raise GraphError(f"{path}: does not parse as {rdf_format.name} ({reason}); build the graph again") from error
    return GraphStore(store, str(path))
