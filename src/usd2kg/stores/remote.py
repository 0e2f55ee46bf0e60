"""RemoteStore: scenes on a SPARQL 1.1 server, each replaced atomically."""

import logging
import uuid
from collections.abc import Iterable, Sequence
from contextlib import ExitStack, suppress
from datetime import UTC, datetime
from functools import cached_property
from urllib.parse import urlencode

import pyoxigraph as ox

from usd2kg.errors import GraphError, StoreError
from usd2kg.graph.vocabulary import DCTERMS
from usd2kg.query.answer import Answer
from usd2kg.query.dataset import Dataset, with_prefixes
from usd2kg.query.dataset_clause import names_dataset
from usd2kg.query.graph_store import GraphStore
from usd2kg.query.remote_clauses import REMOTE_QUERY, REMOTE_UPDATE, has_remote_clause
from usd2kg.stores.chunking import split_triples
from usd2kg.stores.endpoints import FORM, Endpoints, find_query, find_writing
from usd2kg.stores.http_client import HttpRequest, HttpResponse, OutcomeUnknownError, SparqlClient
from usd2kg.stores.named_graph import NamedGraph
from usd2kg.stores.named_graphs import StoredGraph, list_graphs, read_number
from usd2kg.stores.query_results import parse_results
from usd2kg.stores.server_addresses import check_address, redact_address
from usd2kg.stores.store_limits import UploadLimits

__all__ = ["RemoteStore"]

logger = logging.getLogger(__name__)

_STAGING = "urn:usd2kg:staging"
"""The graph that lists unfinished uploads, and the prefix of their graphs' IRIs."""
_TIME_FORMAT = "%Y-%m-%dT%H:%M:%SZ"
_RESULTS = "application/sparql-results+json"
_TRIPLES = "application/n-triples"


class _UploadLostError(StoreError):
    """The server does not hold exactly the triples that were sent; the upload must start again."""


class RemoteStore:
    """Scenes on a server. A graph is uploaded to a staging graph, counted, and moved to its name by one update.

    The server must run an update request as one transaction (SPARQL 1.1 Update, section 3), as Oxigraph and Fuseki do.
    Readers then see the old or the new graph, and the old one remains if the upload fails.
    """

    def __init__(
        self,
        address: str,
        client: SparqlClient,
        *,
        update: str | None = None,
        data: str | None = None,
        limits: UploadLimits | None = None,
    ) -> None:
        self._address = check_address(address)
        self._client = client
        self._given = (update, data)
        self._limits = limits or UploadLimits()

    @property
    def address(self) -> str:
        """The address for messages."""
        return redact_address(self._address)

    @cached_property
    def _query_url(self) -> str:
        return find_query(self._client, self._address)

    @cached_property
    def _endpoints(self) -> Endpoints:
        return find_writing(self._client, self._query_url, *self._given)

    def check(self) -> None:
        """Discover the endpoints of the server.

        Raises:
            StoreError: the server is unreachable, denies access, or has no endpoints for queries and updates.
        """
        logger.info("%s: update endpoint is %s", self.address, redact_address(self._endpoints.update))

    def load(self, graph: NamedGraph) -> None:
        """Add or replace a graph atomically.

        Raises:
            StoreError: the server is unreachable, denies access or loses triples; the old graph is unchanged.
        """
        self.check()
        self._drop_stale()
        for attempt in range(self._limits.attempts):
            staging = f"{_STAGING}:{uuid.uuid4()}"
            with ExitStack() as cleaning:
                cleaning.callback(self._drop_staging, staging)
                try:
                    self._load_once(graph, staging)
                except _UploadLostError:
                    if attempt == self._limits.attempts - 1:
                        raise
                    continue
                cleaning.pop_all()
                return

    def _load_once(self, graph: NamedGraph, staging: str) -> None:
        started = datetime.now(UTC).strftime(_TIME_FORMAT)
        entry = f'GRAPH <{_STAGING}> {{ <{staging}> <{DCTERMS.created.value}> "{started}" }}'
        self._update(f"INSERT DATA {{ {entry} }}")
        sent = 0
        for chunk in split_triples(graph.triples, self._limits.chunk_triples):
            self._send_chunk(staging, chunk, sent)
            sent += len(chunk)
            logger.info("%s: %d of %d triples of <%s>", self.address, sent, len(graph.triples), graph.iri)
        count = self._count(staging)
        if count != sent:
            raise _UploadLostError(
                f"{self.address}: holds {count} of the {sent} triples sent for <{graph.iri}>; the old graph is "
                "unchanged; check the server's log"
            )
        self._move(staging, graph.iri, entry)

    def _send_chunk(self, staging: str, chunk: Sequence[ox.Triple], before: int) -> None:
        """Send a chunk exactly once, even if the connection breaks, since a repetition duplicates blank nodes."""
        text = ox.serialize(chunk, format=ox.RdfFormat.N_TRIPLES)
        assert text is not None, "without an output file, serialize returns the bytes"
        for _ in range(self._limits.attempts):
            try:
                self._client.send(self._chunk_request(staging, text))
            except OutcomeUnknownError:
                count = self._count(staging)
                if count == before:
                    continue
                if count != before + len(chunk):
                    raise _UploadLostError(
                        f"{self.address}: the connection broke during the upload; the old graph is unchanged; try again"
                    ) from None
            return
        raise StoreError(f"{self.address}: breaks each upload; the old graph is unchanged; check the server's log")

    def _chunk_request(self, staging: str, text: bytes) -> HttpRequest:
        if self._endpoints.data is None:
            body = f"INSERT DATA {{ GRAPH <{staging}> {{\n".encode() + text + b"} }"
            return HttpRequest(
                "POST", self._endpoints.update, body, {"Content-Type": "application/sparql-update"}, False
            )
        url = f"{self._endpoints.data}?{urlencode({'graph': staging})}"
        return HttpRequest("POST", url, text, {"Content-Type": _TRIPLES}, False)

    def _move(self, staging: str, iri: str, entry: str) -> None:
        """Move an uploaded graph to its name, and remove its entry in the list of uploads."""
        update = f"MOVE GRAPH <{staging}> TO GRAPH <{iri}> ;\nDELETE DATA {{ {entry} }}"
        for _ in range(self._limits.attempts):
            try:
                self._update(update, is_idempotent=False)
            except OutcomeUnknownError:
                # The update is one transaction: if the entry is still there, nothing was moved.
                if self._is_listed(staging):
                    continue
            return
        raise StoreError(f"{self.address}: breaks the update that replaces <{iri}>, which is unchanged; try again")

    def remove(self, iri: str) -> None:
        """Remove a graph.

        Raises:
            StoreError: the server is unreachable or refuses the update.
        """
        self._update(f"DROP SILENT GRAPH <{iri}>")

    def update(self, sparql: str) -> None:
        """Run a SPARQL 1.1 update, sent once; the package's prefixes are predefined.

        Raises:
            GraphError: the update contacts another server.
            StoreError: the server is unreachable, or refuses the update, which may not parse.
        """
        if has_remote_clause(sparql):
            raise GraphError(REMOTE_UPDATE)
        self._update(with_prefixes(sparql), is_idempotent=False)

    def graphs(self) -> tuple[StoredGraph, ...]:
        """Return the graphs of scenes and ontologies, without graphs of other programs."""
        return list_graphs(self.select)

    def select(self, sparql: str) -> list[dict[str, str | None]]:
        """Return the rows of a SELECT over the server's dataset."""
        answer = parse_results(self._query(sparql, ()).body, sparql)
        return [dict(zip(answer.columns, row, strict=True)) for row in answer.rows]

    def query(self, sparql: str, graphs: Sequence[str]) -> Answer:
        """Return the server's answer to a query over the union of the given graphs.

        Raises:
            GraphError: the query contacts another server.
            StoreError: the server is unreachable, or refuses the query, which may not parse.
        """
        if has_remote_clause(sparql):
            raise GraphError(REMOTE_QUERY)
        return parse_results(self._query(with_prefixes(sparql), graphs).body, sparql)

    def fetch(self, graphs: Sequence[str]) -> GraphStore:
        """Return the union of the given graphs in memory.

        Raises:
            StoreError: the server is unreachable, denies access, or does not answer with triples.
        """
        copy = ox.Store()
        for iri in graphs:
            response = self._query("CONSTRUCT { ?s ?p ?o } WHERE { ?s ?p ?o }", (iri,))
            try:
                copy.bulk_load(input=response.body, format=ox.RdfFormat.N_TRIPLES)
            except SyntaxError as error:
                raise StoreError(
                    f"{self.address}: the answer for <{iri}> is not N-Triples ({error}); check the address"
                ) from error
        return GraphStore(Dataset(copy), self.address)

    def views(self, selections: Iterable[Sequence[str]]) -> list[GraphStore]:
        """Return the union of each selection of graphs in memory: the server lacks the functions of this package."""
        return [self.fetch(graphs) for graphs in selections]

    def _query(self, sparql: str, graphs: Sequence[str]) -> HttpResponse:
        # The parameters of the protocol override FROM.
        form = [("query", sparql), *(("default-graph-uri", iri) for iri in graphs if not names_dataset(sparql))]
        headers = {"Content-Type": FORM, "Accept": f"{_RESULTS}, {_TRIPLES};q=0.9"}
        return self._client.send(HttpRequest("POST", self._query_url, urlencode(form).encode(), headers))

    def _update(self, sparql: str, *, is_idempotent: bool = True) -> None:
        headers = {"Content-Type": "application/sparql-update"}
        self._client.send(HttpRequest("POST", self._endpoints.update, sparql.encode(), headers, is_idempotent))

    def _count(self, iri: str) -> int:
        return read_number(self.select(f"SELECT (COUNT(*) AS ?n) WHERE {{ GRAPH <{iri}> {{ ?s ?p ?o }} }}"))

    def _is_listed(self, staging: str) -> bool:
        return bool(self.select(f"SELECT ?t WHERE {{ GRAPH <{_STAGING}> {{ <{staging}> ?p ?t }} }}"))

    def _drop_staging(self, staging: str) -> None:
        """Remove an unfinished upload; if that fails, `_drop_stale` of a later upload removes it."""
        with suppress(StoreError):
            self._update(
                f"DROP SILENT GRAPH <{staging}> ;\nDELETE WHERE {{ GRAPH <{_STAGING}> {{ <{staging}> ?p ?t }} }}"
            )

    def _drop_stale(self) -> None:
        """Remove uploads that were started too long ago to be running."""
        limit = (datetime.now(UTC) - self._limits.stale_after).strftime(_TIME_FORMAT)
        for row in self.select(f"SELECT ?s ?t WHERE {{ GRAPH <{_STAGING}> {{ ?s ?p ?t }} }}"):
            name, started = row.get("s"), row.get("t")
            if name is None or started is None:
                raise StoreError(f"{self.address}: the answer has other columns than the query; check the address")
            if started < limit and name.startswith(f"{_STAGING}:") and ">" not in name:
                self._drop_staging(name)
