"""RemoteStore: scenes on a server that speaks SPARQL 1.1, each replaced as a whole or not at all."""

import logging
import uuid
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from datetime import UTC, datetime, timedelta
from functools import cached_property
from urllib.parse import urlencode

import pyoxigraph as ox

from usd2kg.errors import GraphError, StoreError
from usd2kg.graph.vocabulary import DCTERMS
from usd2kg.query.answer import Answer
from usd2kg.query.graph_store import GraphStore
from usd2kg.query.remote_clauses import has_remote_clause
from usd2kg.stores.addresses import check_address, shown_address
from usd2kg.stores.catalog import StoredGraph, list_graphs, read_number
from usd2kg.stores.chunking import split_triples
from usd2kg.stores.endpoints import FORM, Endpoints, find_query, find_writing
from usd2kg.stores.http_client import HttpClient, HttpRequest, HttpResponse, OutcomeUnknownError
from usd2kg.stores.named_graph import NamedGraph
from usd2kg.stores.query_results import declare_prefixes, parse_results

__all__ = ["RemoteStore"]

logger = logging.getLogger(__name__)

_CHUNK = 10_000
"""Triples in one request: about 2 MB."""
_TRIES = 3
_STAGING = "urn:usd2kg:staging"
"""The graph that lists uploads under way; each has a graph of its own, whose name begins like this."""
_STALE = timedelta(days=1)
"""Uploads that began earlier than this and still are not done never will be."""
_RESULTS = "application/sparql-results+json"
_TRIPLES = "application/n-triples"


class _UploadLostError(StoreError):
    """An upload holds other triples than were sent, and must begin anew."""


class RemoteStore:
    """A server. A graph is uploaded beside the one that it replaces, counted, and put in place by one update.

    The server must run an update request as one transaction, as SPARQL 1.1 Update asks for in section 3; Oxigraph and
    Fuseki do. Then readers see the old graph or the new one, and the old one stays if anything fails.
    """

    def __init__(
        self,
        address: str,
        client: HttpClient,
        *,
        update: str | None = None,
        data: str | None = None,
        chunk: int = _CHUNK,
    ) -> None:
        self._address = check_address(address)
        self._client = client
        self._given = (update, data)
        self._chunk = chunk

    @property
    def address(self) -> str:
        """The address, as messages may hold it."""
        return shown_address(self._address)

    @cached_property
    def _query_url(self) -> str:
        return find_query(self._client, self._address)

    @cached_property
    def _endpoints(self) -> Endpoints:
        return find_writing(self._client, self._query_url, *self._given)

    def check(self) -> None:
        """Find where the server takes queries, updates and graphs.

        Raises:
            StoreError: it is out of reach, refuses, or does not take them.
        """
        logger.info("%s: takes updates at %s", self.address, shown_address(self._endpoints.update))

    def load(self, graph: NamedGraph) -> None:
        """Put a graph under its name, in place of what was there: all of it, or nothing.

        Raises:
            StoreError: the server is out of reach, refuses or loses triples; the old graph stays.
        """
        self.check()
        self._drop_stale()
        for attempt in range(_TRIES):
            staging = f"{_STAGING}:{uuid.uuid4()}"
            with ExitStack() as cleaning:
                cleaning.callback(self._drop_staging, staging)
                try:
                    self._load_once(graph, staging)
                except _UploadLostError:
                    if attempt == _TRIES - 1:
                        raise
                    continue
                cleaning.pop_all()
                return

    def _load_once(self, graph: NamedGraph, staging: str) -> None:
        started = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
        mark = f'GRAPH <{_STAGING}> {{ <{staging}> <{DCTERMS.created.value}> "{started}" }}'
        self._update(f"INSERT DATA {{ {mark} }}")
        sent = 0
        for part in split_triples(graph.triples, self._chunk):
            self._send_part(staging, part, sent)
            sent += len(part)
            logger.info("%s: %d of %d triples of <%s>", self.address, sent, len(graph.triples), graph.iri)
        held = self._count(staging)
        if held != sent:
            raise _UploadLostError(
                f"{self.address}: holds {held} triples of the {sent} that were sent for <{graph.iri}>; what was there "
                "before is unchanged"
            )
        self._put_in_place(graph.iri, staging, mark)

    def _send_part(self, staging: str, part: Sequence[ox.Triple], before: int) -> None:
        """Send one part once, even where the connection breaks: its blank nodes must not be there twice."""
        text = ox.serialize(part, format=ox.RdfFormat.N_TRIPLES)
        assert text is not None, "without an output file, serialize returns the bytes"
        for _ in range(_TRIES):
            try:
                self._client.send(self._part_call(staging, text))
            except OutcomeUnknownError:
                held = self._count(staging)
                if held == before:
                    continue
                if held != before + len(part):
                    raise _UploadLostError(
                        f"{self.address}: the connection broke within a part of the upload; what was there before is "
                        "unchanged"
                    ) from None
            return
        raise StoreError(f"{self.address}: breaks the connection at each upload; what was there before is unchanged")

    def _part_call(self, staging: str, text: bytes) -> HttpRequest:
        if self._endpoints.data is None:
            body = f"INSERT DATA {{ GRAPH <{staging}> {{\n".encode() + text + b"} }"
            return HttpRequest(
                "POST", self._endpoints.update, body, {"Content-Type": "application/sparql-update"}, False
            )
        url = f"{self._endpoints.data}?{urlencode({'graph': staging})}"
        return HttpRequest("POST", url, text, {"Content-Type": _TRIPLES}, False)

    def _put_in_place(self, iri: str, staging: str, mark: str) -> None:
        move = f"MOVE GRAPH <{staging}> TO GRAPH <{iri}> ;\nDELETE DATA {{ {mark} }}"
        for _ in range(_TRIES):
            try:
                self._update(move, is_idempotent=False)
            except OutcomeUnknownError:
                # Both happen or neither does, so the mark tells.
                if self._is_marked(staging):
                    continue
            return
        raise StoreError(f"{self.address}: breaks the connection when <{iri}> is put in place; it is unchanged")

    def remove(self, iri: str) -> None:
        """Take a graph out.

        Raises:
            StoreError: the server is out of reach or refuses.
        """
        self._update(f"DROP SILENT GRAPH <{iri}>")

    def update(self, sparql: str) -> None:
        """Run a SPARQL 1.1 update; our usual prefixes need no declaration. It is sent once.

        Raises:
            GraphError: it would have the server ask another one.
            StoreError: the server is out of reach or refuses, or it does not parse.
        """
        if has_remote_clause(sparql):
            raise GraphError("update: LOAD and SERVICE ask another server, and none is asked; load a file instead")
        self._update(declare_prefixes(sparql), is_idempotent=False)

    def graphs(self) -> tuple[StoredGraph, ...]:
        """Return the graphs of scenes and ontologies on the server; what others keep there is left out."""
        return list_graphs(self.select)

    def select(self, sparql: str) -> list[dict[str, str | None]]:
        """Return the rows of a SELECT over the server's dataset as it is."""
        answer = parse_results(self._ask(sparql, ()).body, sparql)
        return [dict(zip(answer.columns, row, strict=True)) for row in answer.rows]

    def query(self, sparql: str, graphs: Sequence[str]) -> Answer:
        """Return the server's answer to a query over the union of these graphs.

        Raises:
            GraphError: the query would have the server ask another one.
            StoreError: the server is out of reach or refuses, or the query does not parse.
        """
        if has_remote_clause(sparql):
            raise GraphError("query: SERVICE asks another server, and no other is asked; take that part out")
        return parse_results(self._ask(declare_prefixes(sparql), graphs).body, sparql)

    def fetch(self, graphs: Sequence[str]) -> GraphStore:
        """Return these graphs as one, in memory.

        Raises:
            StoreError: the server is out of reach or refuses, or does not answer with triples.
        """
        copy = ox.Store()
        for iri in graphs:
            reply = self._ask("CONSTRUCT { ?s ?p ?o } WHERE { ?s ?p ?o }", (iri,))
            try:
                copy.bulk_load(input=reply.body, format=ox.RdfFormat.N_TRIPLES)
            except SyntaxError as error:
                raise StoreError(f"{self.address}: answers with no triples of <{iri}> ({error})") from error
        return GraphStore(copy, self.address)

    def _ask(self, sparql: str, graphs: Sequence[str]) -> HttpResponse:
        form = [("query", sparql), *(("default-graph-uri", iri) for iri in graphs)]
        headers = {"Content-Type": FORM, "Accept": f"{_RESULTS}, {_TRIPLES};q=0.9"}
        return self._client.send(HttpRequest("POST", self._query_url, urlencode(form).encode(), headers))

    def _update(self, sparql: str, *, is_idempotent: bool = True) -> None:
        headers = {"Content-Type": "application/sparql-update"}
        self._client.send(HttpRequest("POST", self._endpoints.update, sparql.encode(), headers, is_idempotent))

    def _count(self, iri: str) -> int:
        return read_number(self.select(f"SELECT (COUNT(*) AS ?n) WHERE {{ GRAPH <{iri}> {{ ?s ?p ?o }} }}"))

    def _is_marked(self, staging: str) -> bool:
        return bool(self.select(f"SELECT ?t WHERE {{ GRAPH <{_STAGING}> {{ <{staging}> ?p ?t }} }}"))

    def _drop_staging(self, staging: str) -> None:
        """Take the remains of an upload away; where that fails too, a later upload does it."""
        with suppress(StoreError):
            self._update(
                f"DROP SILENT GRAPH <{staging}> ;\nDELETE WHERE {{ GRAPH <{_STAGING}> {{ <{staging}> ?p ?t }} }}"
            )

    def _drop_stale(self) -> None:
        """Take away what uploads left that were killed, once they cannot be under way any more."""
        limit = (datetime.now(UTC) - _STALE).strftime("%Y-%m-%dT%H:%M:%SZ")
        for row in self.select(f"SELECT ?s ?t WHERE {{ GRAPH <{_STAGING}> {{ ?s ?p ?t }} }}"):
            name, started = row.get("s"), row.get("t")
            if name is None or started is None:
                raise StoreError(f"{self.address}: answers with other columns than it was asked for; check the address")
            if started < limit and name.startswith(f"{_STAGING}:") and ">" not in name:
                self._drop_staging(name)
