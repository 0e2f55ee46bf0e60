"""Endpoints: where a server takes queries, updates and graphs."""

from dataclasses import dataclass
from urllib.parse import urlencode

from usd2kg.errors import StoreError
from usd2kg.stores.addresses import check_address, shown_address
from usd2kg.stores.http_client import HttpClient, HttpRequest

__all__ = ["FORM", "Endpoints", "find_query", "find_writing"]

FORM = "application/x-www-form-urlencoded"
_RESULTS = "application/sparql-results+json"
_QUERY_NAMES = ("query", "sparql", "")
"""Last parts of addresses where servers take queries: Oxigraph, Fuseki; others take them at the address itself."""
_UPDATE_NAMES = ("update", "statements", "")
"""Oxigraph and Fuseki; RDF4J and GraphDB; others."""
_DATA_NAMES = ("store", "data", "rdf-graphs/service", "get")
_ABSENT = frozenset({400, 404, 405, 406, 415, 501})
"""What servers answer at an address that does not do what was asked."""


@dataclass(frozen=True)
class Endpoints:
    """Addresses of one server that takes graphs."""

    query: str
    update: str
    data: str | None
    """Graph Store Protocol; None where the server has none: then graphs go by updates."""


def find_query(client: HttpClient, address: str) -> str:
    """Return where a server takes queries: the address itself or one below it.

    Raises:
        StoreError: the server cannot be reached, refuses, or takes queries nowhere there.
    """
    check_address(address)
    for url in _candidates(address, _QUERY_NAMES):
        call = HttpRequest(
            "POST", url, urlencode({"query": "ASK {}"}).encode(), {"Content-Type": FORM, "Accept": _RESULTS}
        )
        reply = client.send(call, _ABSENT)
        if reply.status == 200 and reply.content_type in {_RESULTS, "application/json"}:
            return url
    shown = shown_address(address)
    raise StoreError(f"{shown}: takes no SPARQL query, nor does {shown.rstrip('/')}/query; check the address")


def find_writing(client: HttpClient, query: str, update: str | None, data: str | None) -> Endpoints:
    """Return where a server takes updates and graphs, where that is not given.

    Raises:
        StoreError: the server cannot be reached, refuses, or takes no updates.
    """
    base = query.removesuffix("/query").removesuffix("/sparql")
    return Endpoints(
        query,
        check_address(update) if update is not None else _find_update(client, base),
        check_address(data) if data is not None else _find_data(client, base),
    )


def _find_update(client: HttpClient, base: str) -> str:
    for url in _candidates(base, _UPDATE_NAMES):
        # It changes nothing, but only one who may write can ask for it.
        call = HttpRequest("POST", url, urlencode({"update": "INSERT DATA {}"}).encode(), {"Content-Type": FORM})
        if client.send(call, _ABSENT).status < 300:
            return url
    shown = shown_address(base)
    raise StoreError(
        f"{shown}: takes no SPARQL update; check that it may be written to, or name it with --store-update"
    )


def _find_data(client: HttpClient, base: str) -> str | None:
    for name in _DATA_NAMES:
        url = f"{base.rstrip('/')}/{name}"
        # The default graph is always there; at an address that is none, nothing is.
        if client.send(HttpRequest("HEAD", f"{url}?default"), _ABSENT).status == 200:
            return url
    return None


def _candidates(address: str, names: tuple[str, ...]) -> list[str]:
    base = address.rstrip("/")
    if base.rpartition("/")[2] in names:
        return [base]
    return [f"{base}/{name}" if name else address for name in names]
