"""serve: run the endpoint as an HTTP server."""

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.endpoint.app_files import AppFile, read_app_files
from usd2kg.endpoint.endpoint_limits import EndpointLimits
from usd2kg.endpoint.listening import Address, open_socket, url_of
from usd2kg.endpoint.open_connections import Connections
from usd2kg.endpoint.pool import WorkerPool
from usd2kg.errors import GraphError, OutputError
from usd2kg.progress import show_steps
from usd2kg.query.dataset import Dataset
from usd2kg.query.graph_file import load_graph
from usd2kg.stores import EmbeddedStore

__all__ = ["ServeOptions", "page_files", "serve"]


@dataclass(frozen=True)
class ServeOptions:
    """Address, allowed clients and limits."""

    address: Address = field(default_factory=Address)
    origins: Sequence[str] = ()
    """Origins whose pages may send queries (CORS), such as https://my.lab, or *."""
    limits: EndpointLimits = field(default_factory=EndpointLimits)


def serve(place: str, options: ServeOptions, report: Callable[[str], None]) -> None:
    """Serve a graph, or a store folder, until the process is interrupted.

    The server answers from a copy made at the start, or from the index of a large file.

    Args:
        place: a graph file, or the folder of a store.
        options: address, allowed clients and limits.
        report: receives one line when the server is ready.

    Raises:
        GraphError: the graph cannot be read, or the extra `serve` is not installed.
        StoreError: the folder is not a store, or another process writes to it.
        OutputError: the port is in use.
    """
    try:
        from usd2kg.endpoint.application import make_app  # noqa: PLC0415
        from usd2kg.endpoint.bounded_server import BoundedServer  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise GraphError(f"serve: {error.name} is not installed; run: pip install 'usd2kg[serve]'") from error
    from usd2kg.endpoint.example_queries import make_examples  # noqa: PLC0415

    with (
        tempfile.TemporaryDirectory(prefix="usd2kg-serve-") as temporary,
        open_socket(options.address) as socket,
    ):
        with show_steps("parse"):
            folder, tables, _keeper = _prepare(place, Path(temporary) / "store")
        store = ox.Store.read_only(str(folder))
        connections = Connections()
        app = make_app(
            WorkerPool(folder, options.limits, tables),
            options.limits,
            connections,
            files=page_files(),
            title=Path(place).name,
            graphs=sorted(str(graph.value) for graph in store.named_graphs()),
            prefixes=Dataset(store).prefixes,
            examples=make_examples(store),
            when_ready=lambda: report(f"serves {place} at {url_of(socket)} (SPARQL at /sparql)"),
            hosts=options.address.served_names,
            origins=options.origins,
        )
        del store
        BoundedServer(app, connections, options.limits.shutdown_s).run(sockets=[socket])


def page_files() -> dict[str, AppFile]:
    """Return the query page; empty if it is not built, so that only the SPARQL Protocol is served."""
    try:
        return read_app_files("query.html")
    except OutputError:
        return {}


class _Served(NamedTuple):
    """The data that the workers read."""

    folder: Path
    tables: Path | None
    """Folder for tables derived from the graphs."""
    keeper: object = None
    """Object that keeps the index of a large file alive while it is read."""


def _prepare(place: str, folder: Path) -> _Served:
    """Return the graphs to serve: the index of a large file, or a copy in a folder."""
    if Path(place).is_dir():
        store = EmbeddedStore(place)
        store.snapshot(folder)
        return _Served(folder, store.tables())
    if "://" in place:
        raise GraphError(f"{place}: is already a server; expected a graph file or a store folder")
    graph = load_graph(place, is_indexed=True)
    if (indexed := graph.dataset.index) is not None:
        return _Served(indexed, graph.dataset.folder, graph)
    copy = ox.Store(str(folder))
    copy.bulk_extend(graph.store)
    copy.flush()
    return _Served(folder, None)
