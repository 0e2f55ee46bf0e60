"""usd2kg serve: a graph or a store, for others to ask."""

import ipaddress
import signal
from typing import Annotated

import typer

from usd2kg.cli.output import talk

__all__ = ["serve_command"]


def serve_command(
    graph: Annotated[
        str, typer.Argument(metavar="GRAPH|FOLDER", help="A graph that usd2kg build wrote, or the folder of a store.")
    ],
    host: Annotated[
        str, typer.Option("--host", help="Address to serve on; the default, 127.0.0.1, is reached from here only.")
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option("--port", min=0, max=65535, help="Port; 0 takes a free one; default: 7878.")
    ] = 7878,
    time_limit: Annotated[
        float, typer.Option("--time-limit", min=0.1, help="Seconds after which a query is stopped; default: 10.")
    ] = 10.0,
    max_rows: Annotated[
        int, typer.Option("--max-rows", min=1, help="Rows or triples of an answer; the rest is cut; default: 10000.")
    ] = 10_000,
    max_body: Annotated[
        int, typer.Option("--max-body", min=1, help="Bytes of a request; default: 1048576.")
    ] = 1_048_576,
    memory_limit: Annotated[
        int, typer.Option("--memory-limit", min=16, help="MiB that one query may take, on Linux; default: 1024.")
    ] = 1024,
    workers: Annotated[
        int, typer.Option("--workers", min=1, max=256, help="Queries that run at the same time; default: 2.")
    ] = 2,
    cors: Annotated[
        list[str] | None,
        typer.Option(
            "--cors", metavar="ORIGIN", help="A site whose pages may ask, like https://my.lab, or *; default: none."
        ),
    ] = None,
    allow_host: Annotated[
        list[str] | None,
        typer.Option(
            "--allow-host", metavar="NAME", help="A name of this machine that it may be asked by, besides localhost."
        ),
    ] = None,
) -> None:
    """Serve a graph: a read-only SPARQL 1.1 endpoint, with a page to ask from. Ends with Ctrl+C."""
    from usd2kg.endpoint import EndpointLimits, ServeOptions, serve  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    limits = EndpointLimits(time_limit, max_rows, max_body, memory_limit, workers)
    if not _is_loopback(host):
        talk(f"{host}: anyone who reaches this machine may ask; nobody is asked for a password")
    # A service manager ends it by SIGTERM; as with Ctrl+C, the copy that is served has to go then.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        serve(graph, ServeOptions(host, port, allow_host or (), cors or (), limits), talk)
    except KeyboardInterrupt:
        talk("stopped")


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
