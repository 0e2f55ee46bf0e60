"""load_graph: RDF file → graph."""

from pathlib import Path

import pyoxigraph as ox

from usd2kg.graph.rdf_document import check_graph_file, open_rdf, parse_errors_explained
from usd2kg.query.dataset import Dataset
from usd2kg.query.graph_cache import open_cached
from usd2kg.query.graph_store import GraphStore
from usd2kg.tracing import traced

__all__ = ["load_graph"]


@traced("parse")
def load_graph(path: Path | str, *, is_indexed: bool = False) -> GraphStore:
    """Return the graph in a file.

    Args:
        path: the file.
        is_indexed: whether to keep the index of a large file in the user's cache, and to open it there the next time.
            Questions about single objects are then answered at once; reading the whole graph is slower than in memory.

    Raises:
        GraphError: the file is missing, its extension is not that of an RDF format, or it does not parse.
    """
    path = Path(path)
    syntax = check_graph_file(path)

    def load(store: ox.Store) -> None:
        with open_rdf(path) as file:
            store.bulk_load(file, format=syntax)

    with parse_errors_explained(path, syntax):
        if is_indexed and (found := open_cached(path, load)) is not None:
            index, folder, keeper = found
            return GraphStore(Dataset(index, folder=folder), str(path), keeper)
        store = ox.Store()
        load(store)
    return GraphStore(Dataset(store), str(path))
