"""Questions in English and SPARQL queries of the page, answered from the current graph."""

import threading
import time
from typing import Any

from usd2kg.assistant import ask_offline
from usd2kg.endpoint import BoundedQueries, EndpointLimits
from usd2kg.endpoint.example_queries import make_examples
from usd2kg.query import Answer, GraphStore
from usd2kg.query.named_objects import prim_path_of_row
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.session import StudioSession

__all__ = ["Questions"]

_MAX_ROWS = 2000
"""Rows of a table that the page shows."""


class Questions:
    """Answers as JSON; see `web/src/api/types.ts`. Safe to use from several threads."""

    def __init__(self, session: StudioSession, indices: PageIndices) -> None:
        self._session = session
        self._indices = indices
        self._lock = threading.Lock()
        self._bounded: tuple[GraphStore, BoundedQueries] | None = None

    def ask(self, question: str) -> dict[str, Any]:
        """Return the answer to a question in English.

        Raises:
            GraphError: the question is not understood.
        """
        found = ask_offline(self._session.answers(), question)
        table = self._table(found.answer)
        return {"understood": found.understood, "sentence": found.sentence, **table}

    def sparql(self, query: str) -> dict[str, Any]:
        """Return the answer to a SPARQL query, run in a process with limits of time and memory.

        Raises:
            GraphError: the query does not parse, is an update, or exceeds the limits.
        """
        with self._lock:
            start = time.perf_counter()
            graph = self._session.answers()
            if self._bounded is None or self._bounded[0] is not graph:
                self._close()
                self._bounded = graph, BoundedQueries(graph, EndpointLimits(workers=1, rows=_MAX_ROWS))
            answer = self._bounded[1](query)
        milliseconds = round(1000 * (time.perf_counter() - start), 1)
        return {**self._table(answer), "milliseconds": milliseconds, "hints": graph.hints(query)}

    def examples(self) -> list[dict[str, str]]:
        """Return SPARQL queries about this scene."""
        return [
            {"title": example.title, "query": example.query} for example in make_examples(self._session.answers().store)
        ]

    def close(self) -> None:
        """Stop the process of queries."""
        with self._lock:
            self._close()

    def _close(self) -> None:
        if self._bounded is not None:
            self._bounded[1].close()
            self._bounded = None

    def _table(self, answer: Answer) -> dict[str, Any]:
        rows = answer.values[:_MAX_ROWS]
        return {
            "columns": answer.columns,
            "rows": rows,
            "objects": [self._object(row) for row in answer.rows[:_MAX_ROWS]],
            "is_cut": len(answer.rows) > len(rows),
        }

    def _object(self, row: tuple[str | None, ...]) -> int:
        """Return the object that a row names by its prim path or IRI, the first one if there are several."""
        return self._indices.object(prim_path_of_row(row, self._session.base, self._session.scene.by_path))
