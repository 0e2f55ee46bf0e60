"""BoundedQueries: run untrusted queries in a process that is killed if it exceeds its limits."""

import asyncio
import tempfile
import threading
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Self

import pyoxigraph as ox

from usd2kg.endpoint.endpoint_limits import EndpointLimits
from usd2kg.endpoint.pool import TimeLimitError, WorkerLostError, WorkerPool
from usd2kg.errors import GraphError
from usd2kg.query.answer import Answer
from usd2kg.query.graph_store import GraphStore
from usd2kg.stores.query_results import parse_results

__all__ = ["BoundedQueries"]

_ACCEPT = "application/sparql-results+json, application/n-triples"


class BoundedQueries:
    """Runs queries on a copy of a graph within limits of time and memory; a context manager."""

    def __init__(self, graph: GraphStore, limits: EndpointLimits | None = None) -> None:
        self._limits = limits or EndpointLimits(workers=1)
        self._temporary = tempfile.TemporaryDirectory(prefix="usd2kg-queries-")
        folder = Path(self._temporary.name) / "store"
        store = ox.Store(str(folder))
        store.bulk_extend(graph.store)
        store.flush()
        del store
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        self._pool = WorkerPool(folder, self._limits)

    def __call__(self, query: str) -> Answer:
        """Return the answer to a SPARQL query.

        Raises:
            GraphError: the query does not parse, is an update, contacts another server, or exceeds the limits.
        """
        request = {"query": query, "accept": _ACCEPT, "default_graphs": [], "named_graphs": []}
        try:
            header, body = asyncio.run_coroutine_threadsafe(self._pool.run(request), self._loop).result()
        except TimeLimitError as error:
            raise GraphError(f"query: stopped after {self._limits.seconds:g} s; simplify it") from error
        except WorkerLostError as error:
            raise GraphError(f"query: needs more than {self._limits.memory_mib} MiB; simplify it") from error
        if header["status"] != 200:
            raise GraphError(body.decode())
        return parse_results(body, query)

    def close(self) -> None:
        """Stop the process and remove the copy."""
        asyncio.run_coroutine_threadsafe(self._pool.close(), self._loop).result()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()
        with suppress(OSError):
            # Some systems release the files of a killed process with a delay.
            self._temporary.cleanup()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
