"""BoundedQueries: queries of strangers, in processes that are killed where one takes too long or too much memory."""

import asyncio
import tempfile
import threading
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Self

import pyoxigraph as ox

from usd2kg.endpoint.pool import Limits, TimeLimitError, WorkerLostError, WorkerPool
from usd2kg.errors import GraphError
from usd2kg.query.answer import Answer
from usd2kg.query.graph_store import GraphStore
from usd2kg.stores.query_results import parse_results

__all__ = ["BoundedQueries"]

_ACCEPT = "application/sparql-results+json, application/n-triples"


class BoundedQueries:
    """Runs queries over a copy of a graph, one after the other, within limits; to be closed, or used by `with`."""

    def __init__(self, graph: GraphStore, limits: Limits | None = None) -> None:
        self._limits = limits or Limits(workers=1)
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
        """Return the answer to a SPARQL query that only reads.

        Raises:
            GraphError: it does not parse, updates, asks another server, or breaks the limits.
        """
        request = {"query": query, "accept": _ACCEPT, "default_graphs": [], "named_graphs": []}
        try:
            told, body = asyncio.run_coroutine_threadsafe(self._pool.run(request), self._loop).result()
        except TimeLimitError as error:
            raise GraphError(f"query: stopped after {self._limits.seconds:g} s; ask for less") from error
        except WorkerLostError as error:
            raise GraphError(f"query: needs more than {self._limits.memory_mib} MiB; ask for less") from error
        if told["status"] != 200:
            raise GraphError(body.decode())
        return parse_results(body, query)

    def close(self) -> None:
        """Stop the processes and remove the copy."""
        asyncio.run_coroutine_threadsafe(self._pool.close(), self._loop).result()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()
        with suppress(OSError):
            # A process that was killed a moment ago may still hold a file where the system does not let go at once.
            self._temporary.cleanup()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
