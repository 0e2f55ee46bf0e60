"""Opening what a user names: a file with one graph, a folder with many, or the address of a server."""

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from usd2kg.errors import GraphError
from usd2kg.query.answer import Answer
from usd2kg.query.graph_store import GraphStore
from usd2kg.query.load import load_graph
from usd2kg.stores.addresses import read_credentials
from usd2kg.stores.catalog import StoredGraph, choose_graph
from usd2kg.stores.embedded import EmbeddedStore
from usd2kg.stores.http_client import HttpClient
from usd2kg.stores.named_graph import NamedGraph
from usd2kg.stores.remote import RemoteStore

__all__ = ["SceneStore", "is_store", "open_graph", "open_store", "select_graphs"]


class SceneStore(Protocol):
    """Where graphs of many scenes are kept, each under its name."""

    @property
    def address(self) -> str:
        """Where it is, as the user named it."""
        ...

    def check(self) -> None:
        """Raise StoreError now if graphs could not be loaded later, before any work is spent."""
        ...

    def load(self, graph: NamedGraph) -> None:
        """Put a graph under its name, in place of what was there: all of it, or nothing."""
        ...

    def remove(self, iri: str) -> None:
        """Take a graph out."""
        ...

    def update(self, sparql: str) -> None:
        """Run a SPARQL 1.1 update."""
        ...

    def graphs(self) -> tuple[StoredGraph, ...]:
        """Return the graphs of scenes and ontologies."""
        ...

    def select(self, sparql: str) -> list[dict[str, str | None]]:
        """Return the rows of a SELECT over all graphs as they are."""
        ...

    def query(self, sparql: str, graphs: Sequence[str]) -> Answer:
        """Return the answer to a query over the union of these graphs."""
        ...

    def fetch(self, graphs: Sequence[str]) -> GraphStore:
        """Return these graphs as one, in memory."""
        ...


def is_store(place: str) -> bool:
    """Return whether a place is a folder or an address, not a file."""
    return _is_address(place) or Path(place).is_dir()


def open_store(place: str, *, update: str | None = None, data: str | None = None) -> SceneStore:
    """Return the store in a folder or at an address; `update` and `data` are further addresses of that server.

    Raises:
        StoreError: the address or the credentials in the environment are none.
    """
    if _is_address(place):
        return RemoteStore(place, HttpClient(read_credentials()), update=update, data=data)
    if update is not None or data is not None:
        raise GraphError(f"{place}: is a folder, which has no addresses to update; expected an address with --store")
    return EmbeddedStore(place)


def select_graphs(store: SceneStore, scene: str | None) -> list[str]:
    """Return the IRIs of the graphs to ask: those of a scene and of the ontologies beside it, or all.

    Raises:
        GraphError: no graph is there, or none or several are called so.
    """
    graphs = store.graphs()
    if not graphs:
        raise GraphError(f"{store.address}: holds no graph of ours; load one with usd2kg build SCENE --store")
    if scene is None:
        return [graph.iri for graph in graphs]
    chosen = choose_graph(graphs, scene, store.address)
    return [chosen.iri, *(graph.iri for graph in graphs if not graph.is_scene and graph != chosen)]


def open_graph(place: str, scene: str | None = None) -> GraphStore:
    """Return a graph in a file; or of a store, one scene's or the union of all, in memory.

    Raises:
        GraphError: the file or the folder is none, or no scene is called so.
        StoreError: the store is out of reach, refuses, or is held by another process.
    """
    if is_store(place):
        store = open_store(place)
        return store.fetch(select_graphs(store, scene))
    if scene is not None:
        raise GraphError(f"{place}: is one graph; --scene chooses among those of a store")
    return load_graph(place)


def _is_address(place: str) -> bool:
    return "://" in place
