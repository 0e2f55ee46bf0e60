"""Open a graph file, a store folder or a server by path or address."""

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Protocol

from usd2kg.errors import GraphError
from usd2kg.query.answer import Answer
from usd2kg.query.graph_file import load_graph
from usd2kg.query.graph_store import GraphStore
from usd2kg.stores.embedded import EmbeddedStore
from usd2kg.stores.http_client import SparqlClient
from usd2kg.stores.named_graph import NamedGraph
from usd2kg.stores.named_graphs import StoredGraph, choose_graph
from usd2kg.stores.remote import RemoteStore
from usd2kg.stores.server_addresses import read_credentials
from usd2kg.tracing import span

__all__ = ["SceneStore", "is_store", "open_graph", "open_store", "select_graphs", "view_scenes"]


class SceneStore(Protocol):
    """A store of named graphs, one for each scene."""

    @property
    def address(self) -> str:
        """Folder or address for messages."""
        ...

    def check(self) -> None:
        """Raise StoreError if graphs cannot be loaded; call it before expensive work."""
        ...

    def load(self, graph: NamedGraph) -> None:
        """Add or replace a graph atomically."""
        ...

    def remove(self, iri: str) -> None:
        """Remove a graph."""
        ...

    def update(self, sparql: str) -> None:
        """Run a SPARQL 1.1 update."""
        ...

    def graphs(self) -> tuple[StoredGraph, ...]:
        """Return the graphs of scenes and ontologies."""
        ...

    def select(self, sparql: str) -> list[dict[str, str | None]]:
        """Return the rows of a SELECT over all graphs."""
        ...

    def query(self, sparql: str, graphs: Sequence[str]) -> Answer:
        """Return the answer to a query over the union of the given graphs."""
        ...

    def fetch(self, graphs: Sequence[str]) -> GraphStore:
        """Return the union of the given graphs in memory."""
        ...

    def views(self, selections: Iterable[Sequence[str]]) -> list[GraphStore]:
        """Return the union of each selection of graphs for a few queries, in place if the store is local."""
        ...


def is_store(place: str) -> bool:
    """Return whether a place is a folder or an address, rather than a file."""
    return _is_address(place) or Path(place).is_dir()


def open_store(place: str, *, update: str | None = None, data: str | None = None) -> SceneStore:
    """Return the store in a folder or at an address; `update` and `data` override the discovery of endpoints.

    Raises:
        StoreError: the address or the credentials in the environment are invalid.
        GraphError: endpoints are given for a folder.
    """
    if _is_address(place):
        return RemoteStore(place, SparqlClient(read_credentials()), update=update, data=data)
    if update is not None or data is not None:
        raise GraphError(f"{place}: is a folder, which has no endpoints; expected the address of a server with --store")
    return EmbeddedStore(place)


def select_graphs(store: SceneStore, scene: str | None) -> list[str]:
    """Return the IRIs of the graphs to query: those of one scene and all ontologies, or all graphs.

    Raises:
        GraphError: the store contains no graph, or no graph or several graphs match `scene`.
    """
    graphs = store.graphs()
    if not graphs:
        raise GraphError(f"{store.address}: contains no usd2kg graph; load one with usd2kg build SCENE --store")
    if scene is None:
        return [graph.iri for graph in graphs]
    chosen = choose_graph(graphs, scene, store.address)
    return [chosen.iri, *(graph.iri for graph in graphs if not graph.is_scene and graph != chosen)]


def view_scenes(place: str, scene: str | None = None) -> dict[str, GraphStore]:
    """Return scene → its graph with the ontologies of the store, for a few queries; for a file, its only graph.

    Positions of two scenes cannot be compared, so a question is asked of each scene. A large file is indexed in the
    user's cache, and a folder is queried in place: writers wait until the graphs are no longer used.

    Raises:
        GraphError: the file cannot be read, or the scene is unknown.
        StoreError: the store is unreachable, denies access, or is locked by another process.
    """
    if not is_store(place):
        _refuse_scene(place, scene)
        return {Path(place).name: load_graph(place, is_indexed=True)}
    with span("parse"):
        return _view_scenes(open_store(place), scene)


def _view_scenes(store: SceneStore, scene: str | None) -> dict[str, GraphStore]:
    chosen = set(select_graphs(store, scene))
    graphs = [graph for graph in store.graphs() if graph.iri in chosen]
    shared = [graph.iri for graph in graphs if not graph.is_scene]
    found = [graph for graph in graphs if graph.is_scene]
    names = Counter(graph.name for graph in found)
    scenes = {graph.name if names[graph.name] == 1 else graph.iri: [graph.iri, *shared] for graph in found}
    if not scenes:
        scenes = {graphs[0].name: shared}
    return dict(zip(scenes, store.views(scenes.values()), strict=True))


def open_graph(place: str, scene: str | None = None) -> GraphStore:
    """Return the graph in a file, or one scene of a store, or the union of all its scenes, in memory.

    Raises:
        GraphError: the file cannot be read, or the scene is unknown.
        StoreError: the store is unreachable, refuses access, or is locked by another process.
    """
    if is_store(place):
        store = open_store(place)
        with span("parse"):
            return store.fetch(select_graphs(store, scene))
    _refuse_scene(place, scene)
    return load_graph(place)


def _refuse_scene(place: str, scene: str | None) -> None:
    if scene is not None:
        raise GraphError(f"{place}: is a single graph; --scene selects one of a store")


def _is_address(place: str) -> bool:
    return "://" in place
