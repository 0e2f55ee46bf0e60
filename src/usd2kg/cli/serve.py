"""usd2kg serve: a SPARQL endpoint for a graph or a store."""

import signal
from typing import Annotated

from typer import Argument, Option

from usd2kg.cli.options.address import AddressOptions, Port
from usd2kg.cli.options.bundles import expand_bundles
from usd2kg.cli.options.queries import QueryTimeLimit
from usd2kg.cli.output import notify

__all__ = ["serve_command"]


@expand_bundles
def serve_command(
    graph: Annotated[
        str, Argument(metavar="GRAPH|FOLDER", help="Graph written by usd2kg build, or folder of a store.")
    ],
    where: AddressOptions,
    port: Port = 7878,
    time_limit: QueryTimeLimit = 10.0,
    max_rows: Annotated[
        int, Option("--max-rows", min=1, help="Maximum rows or triples of an answer; further ones are cut off.")
    ] = 10_000,
    max_body: Annotated[int, Option("--max-body", min=1, help="Maximum size of a request in bytes.")] = 1_048_576,
    memory_limit: Annotated[
        int, Option("--memory-limit", min=16, help="Maximum memory of a query in MiB; Linux only.")
    ] = 1024,
    workers: Annotated[int, Option("--workers", min=1, max=256, help="Queries that run in parallel.")] = 2,
    cors: Annotated[
        list[str] | None,
        Option(
            "--cors",
            metavar="ORIGIN",
            help="Web origin that may send requests, like https://my.lab, or *. Repeatable; default: none.",
        ),
    ] = None,
) -> None:
    """Serve a graph as a read-only SPARQL 1.1 endpoint with a query page, until Ctrl+C."""
    from usd2kg.endpoint import EndpointLimits, ServeOptions, serve  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    limits = EndpointLimits(time_limit, max_rows, max_body, memory_limit, workers)
    address = where.address(port)
    if not address.is_local:
        notify(f"{address.host}: the endpoint has no authentication; anyone who reaches this machine can query it")
    # Service managers stop the server with SIGTERM. As after Ctrl+C, the temporary copy of the graph must be removed.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        serve(graph, ServeOptions(address, cors or (), limits), notify)
    except KeyboardInterrupt:
        notify("stopped")
