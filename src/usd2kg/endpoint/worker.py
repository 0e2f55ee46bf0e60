"""Worker process: answers one query at a time over a read-only store; can be killed at any time.

Usage: python -m usd2kg.endpoint.worker FOLDER LIMITS [TABLES]

LIMITS is `EndpointLimits` as JSON, TABLES a folder for tables derived from the store. Each line on stdin is
a request as a JSON object. Each answer on stdout is one line of JSON, whose `length` is the number of bytes after it.
"""

import json
import signal
import sys
from pathlib import Path
from typing import Any, BinaryIO

import pyoxigraph as ox

from usd2kg.endpoint.endpoint_limits import EndpointLimits
from usd2kg.endpoint.negotiation import negotiate
from usd2kg.endpoint.result_formats import GRAPH_TYPES, TABLE_TYPES, Rendered, render
from usd2kg.errors import GraphError, one_line
from usd2kg.query.bodies import BodyIndex
from usd2kg.query.complexity import check_complexity
from usd2kg.query.dataset import Dataset
from usd2kg.query.dataset_clause import names_dataset
from usd2kg.query.functions import make_functions
from usd2kg.query.remote_clauses import REMOTE_QUERY, has_remote_clause
from usd2kg.query.sparql_errors import describe_syntax_error

__all__ = ["NotAcceptableError", "answer", "main", "serve_requests"]


class NotAcceptableError(Exception):
    """No media type of the results is acceptable to the client."""


def main(arguments: list[str]) -> None:
    """Answer requests until stdin ends."""
    folder, settings, *tables = arguments
    limits = EndpointLimits(**json.loads(settings))
    store = ox.Store.read_only(folder)
    _limit_memory(limits.memory_mib)
    dataset = Dataset(store, folder=Path(tables[0]) if tables else None)
    serve_requests(dataset, limits, sys.stdin.buffer, sys.stdout.buffer)


def serve_requests(dataset: Dataset, limits: EndpointLimits, requests: BinaryIO, answers: BinaryIO) -> None:
    """Answer each request; the first line written reports that the process is ready."""
    functions = make_functions(dataset, BodyIndex(dataset))
    _write(answers, {"ready": True}, b"")
    for line in requests:
        _terminate_after(limits.seconds + limits.orphan_grace_s)
        try:
            media_type, rendered = answer(dataset, functions, json.loads(line), limits)
        except NotAcceptableError as error:
            _write(answers, {"status": 406}, str(error).encode())
        except GraphError as error:
            _write(answers, {"status": 400}, str(error).encode())
        else:
            header = {"status": 200, "type": media_type, "rows": rendered.rows, "cut": rendered.is_cut}
            _write(answers, header, rendered.body)
        _terminate_after(0)


def answer(dataset: Dataset, functions: Any, request: dict[str, Any], limits: EndpointLimits) -> tuple[str, Rendered]:
    """Return the media type and the results of a request with query, accept, default_graphs and named_graphs.

    Raises:
        GraphError: the query does not parse, is an update, is too complex, or contacts another server.
        NotAcceptableError: no media type is acceptable.
    """
    check_complexity(request["query"])
    if has_remote_clause(request["query"]):
        raise GraphError(REMOTE_QUERY)
    try:
        found = dataset.store.query(
            request["query"], prefixes=dataset.prefixes, custom_functions=functions, **_dataset(request)
        )
        offered = GRAPH_TYPES if isinstance(found, ox.QueryTriples) else TABLE_TYPES
        media_type = negotiate(request["accept"], offered)
        if media_type is None:
            raise NotAcceptableError(f"{request['accept']} cannot be written; expected one of {', '.join(offered)}")
        return media_type, render(found, media_type, limits)
    except SyntaxError as error:
        raise GraphError(describe_syntax_error(request["query"], error, dataset.prefixes)) from error
    except ValueError as error:
        raise GraphError(f"query: not valid ({one_line(error)}); expected IRIs of graphs") from error
    except (RuntimeError, OSError) as error:
        raise GraphError(f"query: cannot be answered ({one_line(error)})") from error


def _dataset(request: dict[str, Any]) -> dict[str, Any]:
    """Return the dataset of a request: its own (SPARQL 1.1 Protocol, section 2.1.4), else that of the query.

    Without either, it is the union of all graphs.
    """
    default, named = request["default_graphs"], request["named_graphs"]
    if not default and not named:
        return {} if names_dataset(request["query"]) else {"use_default_graph_as_union": True}
    return {
        "default_graph": [ox.NamedNode(iri) for iri in default],
        "named_graphs": [ox.NamedNode(iri) for iri in named],
    }


def _write(answers: BinaryIO, header: dict[str, Any], body: bytes) -> None:
    answers.write(json.dumps({**header, "length": len(body)}).encode() + b"\n" + body)
    answers.flush()


def _terminate_after(seconds: float) -> None:
    """Set an alarm that ends this process, in case the server that would kill it has died; 0 cancels it."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, seconds)


def _limit_memory(mebibytes: int) -> None:
    """Limit the memory that this process can allocate from now on; only on systems with procfs."""
    status = Path("/proc/self/status")
    if not status.exists():
        return
    import resource  # noqa: PLC0415 - not on every system

    used = next(int(line.split()[1]) * 1024 for line in status.read_text().splitlines() if line.startswith("VmData"))
    limit = used + mebibytes * 1024 * 1024
    resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))


if __name__ == "__main__":
    main(sys.argv[1:])
