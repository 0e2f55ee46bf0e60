"""serve: the endpoint as a running server."""

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pyoxigraph as ox

from usd2kg.endpoint.pool import Limits, WorkerPool
from usd2kg.errors import GraphError
from usd2kg.query.load import load_graph
from usd2kg.stores import EmbeddedStore

__all__ = ["ServeOptions", "serve"]


@dataclass(frozen=True)
class ServeOptions:
    """Where to serve, and for whom."""

    host: str = "127.0.0.1"
    port: int = 7878
    """0 for one that is free."""
    hosts: Sequence[str] = ()
    origins: Sequence[str] = ()
    limits: Limits = field(default_factory=Limits)


def serve(place: str, options: ServeOptions, told: Callable[[str], None]) -> None:
    """Serve a graph or the folder of a store until the process is interrupted.

    What is served is the state at the start: a copy that does not change, and that workers only read.

    Args:
        place: a graph that `usd2kg build` wrote, or the folder of a store.
        options: where, for whom, within which limits.
        told: gets one line once the server is ready.

    Raises:
        GraphError: the graph cannot be read, or the package for serving is not installed.
        StoreError: the folder is no store, or another process writes to it.
        OutputError: the port is taken.
    """
    try:
        import uvicorn  # noqa: PLC0415

        from usd2kg.endpoint.application import make_app  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise GraphError(
            f"serving a graph needs the package {error.name}; install it with pip install 'usd2kg[serve]'"
        ) from error
    from usd2kg.endpoint.examples import make_examples  # noqa: PLC0415
    from usd2kg.endpoint.listening import open_socket  # noqa: PLC0415

    with tempfile.TemporaryDirectory(prefix="usd2kg-serve-") as temporary, open_socket(options) as socket:
        folder = Path(temporary) / "store"
        _copy(place, folder)
        host, port = socket.getsockname()[:2]
        address = f"http://{f'[{host}]' if ':' in host else host}:{port}/"
        store = ox.Store.read_only(str(folder))
        app = make_app(
            WorkerPool(folder, options.limits),
            options.limits,
            title=Path(place).name,
            graphs=sorted(str(graph.value) for graph in store.named_graphs()),
            examples=make_examples(store),
            when_ready=lambda: told(f"serves {place} at {address} (SPARQL at /sparql)"),
            hosts=[*options.hosts, options.host],
            origins=options.origins,
        )
        del store
        config = uvicorn.Config(app, log_level="warning", server_header=False, timeout_graceful_shutdown=3)
        uvicorn.Server(config).run(sockets=[socket])


def _copy(place: str, folder: Path) -> None:
    """Write what is to be served to a folder."""
    if Path(place).is_dir():
        EmbeddedStore(place).snapshot(folder)
        return
    if "://" in place:
        raise GraphError(f"{place}: is a server already; expected a graph or a folder to serve")
    read = load_graph(place)
    store = ox.Store(str(folder))
    store.bulk_extend(read.store)
    store.flush()
