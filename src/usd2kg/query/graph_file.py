"""load_graph: RDF file → graph."""

import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError, one_line
from usd2kg.garbage import paused_collection
from usd2kg.graph.rdf_document import TOO_LARGE, open_rdf, rdf_format
from usd2kg.query.dataset import Dataset
from usd2kg.query.graph_cache import open_cached
from usd2kg.query.graph_store import GraphStore

__all__ = ["load_graph", "read_triples"]


def load_graph(path: Path | str, *, is_indexed: bool = False) -> GraphStore:
    """Return the graph in a file.

    Args:
        path: the file.
        is_indexed: whether to keep the index of a large file in the user's cache, and to open it there the next time.
            Questions about single objects are then answered at once; reading the whole graph is slower than in memory.

    Raises:
        GraphError: the file is missing, its extension is not that of an RDF format, or it does not parse.
    """
    path, syntax = _check(Path(path))

    def load(store: ox.Store) -> None:
        with open_rdf(path) as file:
            store.bulk_load(file, format=syntax)

    with _damage_reported(path, syntax):
        if is_indexed and (found := open_cached(path, load)) is not None:
            index, folder, keeper = found
            return GraphStore(Dataset(index, folder=folder), str(path), keeper)
        store = ox.Store()
        load(store)
    return GraphStore(Dataset(store), str(path))


def read_triples(path: Path) -> tuple[ox.Triple, ...]:
    """Return the triples of all graphs in a file, each once.

    Raises:
        GraphError: as for `load_graph`.
    """
    path, syntax = _check(path)
    with _damage_reported(path, syntax), paused_collection(), open_rdf(path) as file:
        return tuple(dict.fromkeys(quad.triple for quad in ox.parse(file, format=syntax)))


def _check(path: Path) -> tuple[Path, ox.RdfFormat]:
    if path.is_dir():
        raise GraphError(f"{path}: is a folder; expected a graph that usd2kg build wrote")
    if not path.is_file():
        raise GraphError(f"{path}: no such file; expected a graph that usd2kg build wrote")
    return path, rdf_format(path)


@contextmanager
def _damage_reported(path: Path, syntax: ox.RdfFormat) -> Iterator[None]:
    try:
        yield
    except MemoryError as error:
        # pyoxigraph raises this for a literal above 16 MiB, its parser's limit.
        raise GraphError(f"{path}: {TOO_LARGE} ({error}); shorten its longest text") from error
    except (SyntaxError, OSError, EOFError, zlib.error) as error:
        reason = one_line(error)
        raise GraphError(f"{path}: does not parse as {syntax.name} ({reason}); build the graph again") from error
