"""make_app: the ASGI application of a read-only SPARQL 1.1 Protocol endpoint with a query page."""

import time
from collections.abc import AsyncIterator, Callable, Iterable, Mapping
from contextlib import asynccontextmanager
from dataclasses import asdict
from typing import Any
from urllib.parse import parse_qsl

import pyoxigraph as ox
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route

from usd2kg.endpoint.app_files import AppFile
from usd2kg.endpoint.endpoint_limits import EndpointLimits
from usd2kg.endpoint.example_queries import ExampleQuery
from usd2kg.endpoint.guard import Guard
from usd2kg.endpoint.negotiation import negotiate
from usd2kg.endpoint.open_connections import Connections
from usd2kg.endpoint.pool import BusyError, TimeLimitError, WorkerLostError, WorkerPool
from usd2kg.endpoint.result_formats import GRAPH_TYPES, render
from usd2kg.graph.vocabulary import named_node
from usd2kg.query.dataset import QUERY_PREFIXES

__all__ = ["RefusedRequestError", "make_app"]

_FORM = "application/x-www-form-urlencoded"
_QUERY = "application/sparql-query"
_DESCRIPTION = """
PREFIX sd: <http://www.w3.org/ns/sparql-service-description#>
CONSTRUCT {
  [] a sd:Service ; sd:endpoint ENDPOINT ; sd:supportedLanguage sd:SPARQL11Query ; sd:feature sd:UnionDefaultGraph ;
    sd:resultFormat <http://www.w3.org/ns/formats/SPARQL_Results_JSON>, <http://www.w3.org/ns/formats/SPARQL_Results_XML>,
      <http://www.w3.org/ns/formats/SPARQL_Results_CSV>, <http://www.w3.org/ns/formats/SPARQL_Results_TSV>,
      <http://www.w3.org/ns/formats/Turtle>, <http://www.w3.org/ns/formats/N-Triples>,
      <http://www.w3.org/ns/formats/RDF_XML>, <http://www.w3.org/ns/formats/JSON-LD>
} WHERE {}"""

_NO_PAGE = (
    "This is a SPARQL 1.1 endpoint, at /sparql. Its query page is not built: install usd2kg from a wheel, or run "
    "make web (it needs Node.js).\n"
)


class RefusedRequestError(Exception):
    """A rejected request, with its HTTP status and a message."""

    def __init__(self, status: int, text: str) -> None:
        super().__init__(text)
        self.status = status


def make_app(
    pool: WorkerPool,
    limits: EndpointLimits,
    connections: Connections,
    *,
    files: Mapping[str, AppFile],
    title: str,
    graphs: Iterable[str],
    prefixes: Mapping[str, str] = QUERY_PREFIXES,
    examples: Iterable[ExampleQuery],
    when_ready: Callable[[], None] = lambda: None,
    hosts: Iterable[str] = (),
    origins: Iterable[str] = (),
) -> Starlette:
    """Return the ASGI application.

    Args:
        pool: the workers that answer queries.
        limits: limits on each request.
        connections: the open connections, for the budget of unsent answers.
        files: the query page by URL path; without files, `/` explains how to build it.
        title: heading of the page.
        graphs: IRIs of the named graphs.
        prefixes: prefixes that are predefined in queries.
        examples: example queries on the page.
        when_ready: called once all workers have started.
        hosts: host names to accept in addition to localhost and IP addresses.
        origins: origins whose pages may send queries, such as https://my.lab, or *.
    """
    about = {
        "title": title,
        "graphs": list(graphs),
        "limits": asdict(limits),
        "prefixes": dict(prefixes),
        "examples": [asdict(example) for example in examples],
    }

    async def show_file(request: Request) -> Response:
        file = files.get(request.url.path)
        if file is None:
            return PlainTextResponse(_NO_PAGE)
        return Response(file.content, media_type=file.media_type, headers=file.headers(request.url.path))

    async def show_about(_: Request) -> Response:
        return JSONResponse(about)

    async def handle(request: Request) -> Response:
        return await _handle(request, pool, limits, connections)

    @asynccontextmanager
    async def lifespan(_: Starlette) -> AsyncIterator[None]:
        await pool.warm()
        when_ready()
        yield
        await pool.close()

    methods = ["GET", "POST", "OPTIONS"]
    return Starlette(
        routes=[
            *(Route(path, show_file) for path in {"/", *files}),
            Route("/about", show_about),
            Route("/sparql", handle, methods=methods),
            Route("/query", handle, methods=methods),
        ],
        middleware=[Middleware(Guard, hosts=tuple(hosts), origins=tuple(origins))],
        lifespan=lifespan,
    )


async def _handle(request: Request, pool: WorkerPool, limits: EndpointLimits, connections: Connections) -> Response:
    """Return the response to one request of the SPARQL 1.1 Protocol (section 2.1)."""
    if request.method == "OPTIONS":
        return Response(status_code=204, headers={"Allow": "GET, POST, OPTIONS"})
    try:
        query = await _read_request(request, limits)
        if query is None:
            return _describe(request)
        return await _answer(query, pool, limits, connections)
    except RefusedRequestError as error:
        return _refusal(request, error)


async def _answer(
    query: dict[str, Any], pool: WorkerPool, limits: EndpointLimits, connections: Connections
) -> Response:
    start = time.perf_counter()
    try:
        header, body = await pool.run(query)
    except BusyError as error:
        raise RefusedRequestError(503, "too many queries are waiting; try again in a moment") from error
    except TimeLimitError as error:
        raise RefusedRequestError(
            503, f"the query took more than {limits.seconds:g} s and was stopped; simplify it, or raise --time-limit"
        ) from error
    except WorkerLostError as error:
        raise RefusedRequestError(
            503, f"the query needed more than {limits.memory_mib} MiB and was stopped; simplify it, or add a LIMIT"
        ) from error
    if header["status"] != 200:
        raise RefusedRequestError(header["status"], body.decode())
    if not connections.can_hold(len(body)):
        raise RefusedRequestError(503, "too many answers are waiting for slow clients; try again in a moment")
    milliseconds = 1000 * (time.perf_counter() - start)
    charset = "; charset=utf-8" if header["type"].startswith("text/") else ""
    headers = {
        "Usd2kg-Rows": str(header["rows"]),
        "Server-Timing": f"query;dur={milliseconds:.1f}",
        "Content-Type": header["type"] + charset,
        "Vary": "Accept",
    }
    if header["cut"]:
        headers["X-SPARQL-MaxRows"] = str(header["rows"])
    return Response(body, headers=headers)


async def _read_request(request: Request, limits: EndpointLimits) -> dict[str, Any] | None:
    """Return the request for a worker; None if there is no query, which requests the service description."""
    fields = parse_qsl(request.url.query, keep_blank_values=True)
    if request.method == "POST":
        body = await _read_body(request, limits.body_bytes)
        content_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        if content_type == _FORM:
            fields += parse_qsl(body, keep_blank_values=True)
        elif content_type == _QUERY:
            fields.append(("query", body))
        else:
            raise RefusedRequestError(
                415, f"content type {content_type or 'none'} is not supported; expected {_QUERY} or {_FORM}"
            )
    elif not fields:
        return None
    if any(name in {"update", "using-graph-uri", "using-named-graph-uri"} for name, _ in fields):
        raise RefusedRequestError(400, "this endpoint is read-only; updates are not supported")
    queries = [value for name, value in fields if name == "query"]
    if len(queries) != 1 or not queries[0].strip():
        raise RefusedRequestError(400, f"expected one query, found {len(queries) if any(queries) else 'none'}")
    return {
        "query": queries[0],
        "accept": request.headers.get("accept"),
        "default_graphs": _graphs(fields, "default-graph-uri"),
        "named_graphs": _graphs(fields, "named-graph-uri"),
    }


def _graphs(fields: list[tuple[str, str]], name: str) -> list[str]:
    found = [value for field, value in fields if field == name]
    for value in found:
        if named_node(value) is None:
            raise RefusedRequestError(400, f"{name}={value}: expected an absolute IRI")
    return found


async def _read_body(request: Request, max_bytes: int) -> str:
    body = b""
    try:
        async for piece in request.stream():
            body += piece
            if len(body) > max_bytes:
                raise RefusedRequestError(413, f"the request is larger than {max_bytes} bytes; send a shorter query")
        return body.decode()
    except UnicodeDecodeError as error:
        raise RefusedRequestError(400, "the request is not UTF-8") from error
    except ClientDisconnect as error:
        raise RefusedRequestError(400, "the request is incomplete") from error


def _describe(request: Request) -> Response:
    """Return the SPARQL 1.1 Service Description, or a redirect to the page for browsers."""
    accept = request.headers.get("accept")
    media_type = negotiate(accept, (*GRAPH_TYPES, "text/html"))
    if media_type == "text/html":
        return RedirectResponse("/", 303)
    # Guard has validated the host; NamedNode escapes the rest.
    endpoint = str(ox.NamedNode(str(request.url.replace(query=""))))
    found = ox.Store().query(_DESCRIPTION.replace("ENDPOINT", endpoint))
    assert isinstance(found, ox.QueryTriples), "the description is a CONSTRUCT"
    chosen = media_type or GRAPH_TYPES[0]
    return Response(render(found, chosen, EndpointLimits()).body, media_type=chosen)


def _refusal(request: Request, error: RefusedRequestError) -> Response:
    """Return the message of an error, as JSON for clients that accept JSON."""
    headers = {"Retry-After": "1"} if isinstance(error.__cause__, BusyError) else {}
    accept = request.headers.get("accept", "")
    if "json" in accept and "text/plain" not in accept:
        return JSONResponse({"error": str(error)}, error.status, headers=headers)
    return PlainTextResponse(str(error) + "\n", error.status, headers=headers)
