"""Discovery of a server's endpoints for queries, updates and graphs."""

from dataclasses import dataclass
from urllib.parse import urlencode

from usd2kg.errors import StoreError
from usd2kg.stores.http_client import HttpRequest, SparqlClient
from usd2kg.stores.server_addresses import check_address, redact_address

__all__ = ["FORM", "Endpoints", "find_query", "find_writing"]

FORM = "application/x-www-form-urlencoded"
_RESULTS = "application/sparql-results+json"
_QUERY_NAMES = ("query", "sparql", "")
"""Last segments of query endpoints: Oxigraph and Fuseki; Fuseki; others, at the address itself."""
_UPDATE_NAMES = ("update", "statements", "")
"""Last segments of update endpoints: Oxigraph and Fuseki; RDF4J and GraphDB; others."""
_DATA_NAMES = ("store", "data", "rdf-graphs/service", "get")
"""Last segments of Graph Store Protocol endpoints: Oxigraph; Fuseki; RDF4J and GraphDB; Fuseki, read-only."""
_UNSUPPORTED = frozenset({400, 404, 405, 406, 415, 501})
"""Status codes of addresses that do not support a request."""


@dataclass(frozen=True)
class Endpoints:
    """Endpoints of one server."""

    query: str
    update: str
    data: str | None
    """Graph Store Protocol; None if unsupported: then graphs are uploaded by updates."""


def find_query(client: SparqlClient, address: str) -> str:
    """Return the query endpoint of a server: the address itself or one below it.

    Raises:
        StoreError: the server is unreachable, refuses access, or has no query endpoint there.
    """
    check_address(address)
    for url in _candidates(address, _QUERY_NAMES):
        call = HttpRequest(
            "POST", url, urlencode({"query": "ASK {}"}).encode(), {"Content-Type": FORM, "Accept": _RESULTS}
        )
        reply = client.send(call, _UNSUPPORTED)
        if reply.status == 200 and reply.content_type in {_RESULTS, "application/json"}:
            return url
    shown = redact_address(address)
    raise StoreError(f"{shown}: is not a SPARQL endpoint, nor is {shown.rstrip('/')}/query; check the address")


def find_writing(client: SparqlClient, query: str, update: str | None, data: str | None) -> Endpoints:
    """Return the endpoints of a server with a given query endpoint; discover those that are None.

    Raises:
        StoreError: the server is unreachable, refuses access, or has no update endpoint.
    """
    base = query.removesuffix("/query").removesuffix("/sparql")
    return Endpoints(
        query,
        check_address(update) if update is not None else _find_update(client, base),
        check_address(data) if data is not None else _find_data(client, base),
    )


def _find_update(client: SparqlClient, base: str) -> str:
    for url in _candidates(base, _UPDATE_NAMES):
        # An empty update changes nothing, but requires write access.
        call = HttpRequest("POST", url, urlencode({"update": "INSERT DATA {}"}).encode(), {"Content-Type": FORM})
        if client.send(call, _UNSUPPORTED).status < 300:
            return url
    shown = redact_address(base)
    raise StoreError(
        f"{shown}: has no SPARQL update endpoint; check that it is writable, or give the endpoint with --store-update"
    )


def _find_data(client: SparqlClient, base: str) -> str | None:
    for name in _DATA_NAMES:
        url = f"{base.rstrip('/')}/{name}"
        # The default graph always exists, so every Graph Store Protocol endpoint answers 200.
        if client.send(HttpRequest("HEAD", f"{url}?default"), _UNSUPPORTED).status == 200:
            return url
    return None


def _candidates(address: str, names: tuple[str, ...]) -> list[str]:
    base = address.rstrip("/")
    if base.rpartition("/")[2] in names:
        return [base]
    return [f"{base}/{name}" if name else address for name in names]
