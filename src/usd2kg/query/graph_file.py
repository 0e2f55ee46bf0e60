"""load_graph: RDF file → graph."""

import zlib
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError, one_line
from usd2kg.graph.rdf_document import TOO_LARGE, open_rdf, rdf_format
from usd2kg.query.graph_store import GraphStore

__all__ = ["load_graph"]


def load_graph(path: Path | str) -> GraphStore:
    """Return the graph in a file.

    Raises:
        GraphError: the file is missing, its extension is not that of an RDF format, or it does not parse.
    """
    path = Path(path)
    if path.is_dir():
        raise GraphError(f"{path}: is a folder; expected a graph that usd2kg build wrote")
    if not path.is_file():
        raise GraphError(f"{path}: no such file; expected a graph that usd2kg build wrote")
    syntax = rdf_format(path)
    store = ox.Store()
    try:
        with open_rdf(path) as file:
            store.bulk_load(file, format=syntax)
    except MemoryError as error:
        # pyoxigraph raises this for a literal above 16 MiB, its parser's limit.
        raise GraphError(f"{path}: {TOO_LARGE} ({error}); shorten its longest text") from error
    except (SyntaxError, OSError, EOFError, zlib.error) as error:
        reason = one_line(error)
        raise GraphError(f"{path}: does not parse as {syntax.name} ({reason}); build the graph again") from error
    return GraphStore(store, str(path))
