"""A process that answers one query at a time over a store that is only read; it may be killed at any moment.

Usage: python -m usd2kg.endpoint.worker FOLDER MOST_ROWS MEMORY_MIB SECONDS

Reads one JSON object a line on stdin; writes for each one line of JSON on stdout, then as many bytes as it says.
"""

import json
import signal
import sys
from pathlib import Path
from typing import Any, BinaryIO

import pyoxigraph as ox

from usd2kg.endpoint.formats import GRAPH_TYPES, TABLE_TYPES, Rendered, render
from usd2kg.endpoint.negotiation import negotiate
from usd2kg.errors import GraphError
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.query.complexity import check_complexity
from usd2kg.query.functions import FUNCTION_NAMESPACE, make_functions
from usd2kg.query.remote_clauses import has_remote_clause

__all__ = ["NotAcceptableError", "answer", "main", "serve_requests"]

_GRACE_S = 5.0
_PREFIXES = {**PREFIXES, "u2kf": FUNCTION_NAMESPACE}


class NotAcceptableError(Exception):
    """The results have no form that the client accepts."""


def main(arguments: list[str]) -> None:
    """Answer queries until stdin ends."""
    folder, most, memory, seconds = arguments
    store = ox.Store.read_only(folder)
    _limit_memory(int(memory))
    serve_requests(store, int(most), float(seconds), sys.stdin.buffer, sys.stdout.buffer)


def serve_requests(store: ox.Store, most: int, seconds: float, requests: BinaryIO, replies: BinaryIO) -> None:
    """Answer each request; the first line written says that the process is ready."""
    functions = make_functions(store)
    _reply(replies, {"ready": True}, b"")
    for line in requests:
        _die_after(seconds + _GRACE_S)
        try:
            media_type, rendered = answer(store, functions, json.loads(line), most)
        except NotAcceptableError as error:
            _reply(replies, {"status": 406}, str(error).encode())
        except GraphError as error:
            _reply(replies, {"status": 400}, str(error).encode())
        else:
            told = {"status": 200, "type": media_type, "rows": rendered.rows, "cut": rendered.is_cut}
            _reply(replies, told, rendered.body)
        _die_after(0)


def answer(store: ox.Store, functions: Any, request: dict[str, Any], most: int) -> tuple[str, Rendered]:
    """Return the media type and the results of a request: query, accept, default_graphs, named_graphs.

    Raises:
        GraphError: the query does not parse, updates, is nested too deep, or asks another server.
        NotAcceptableError: no media type fits.
    """
    check_complexity(request["query"])
    if has_remote_clause(request["query"]):
        raise GraphError("query: SERVICE asks another server, and no query leaves this machine; take that part out")
    try:
        found = store.query(request["query"], prefixes=_PREFIXES, custom_functions=functions, **_dataset(request))
        offered = GRAPH_TYPES if isinstance(found, ox.QueryTriples) else TABLE_TYPES
        media_type = negotiate(request["accept"], offered)
        if media_type is None:
            raise NotAcceptableError(
                f"none of {request['accept']} can be written; expected one of {', '.join(offered)}"
            )
        return media_type, render(found, media_type, most)
    except (SyntaxError, ValueError) as error:
        raise GraphError(
            f"query: not valid SPARQL ({_line(error)}); only SELECT, ASK, CONSTRUCT and DESCRIBE run here"
        ) from error
    except (RuntimeError, OSError) as error:
        raise GraphError(f"query: cannot be answered ({_line(error)})") from error


def _dataset(request: dict[str, Any]) -> dict[str, Any]:
    """Return the dataset of a request (SPARQL 1.1 Protocol, section 2.1.4); all graphs where it names none."""
    default, named = request["default_graphs"], request["named_graphs"]
    if not default and not named:
        return {"use_default_graph_as_union": True}
    return {
        "default_graph": [ox.NamedNode(iri) for iri in default],
        "named_graphs": [ox.NamedNode(iri) for iri in named],
    }


def _line(error: BaseException) -> str:
    return " ".join(str(error).split())


def _reply(replies: BinaryIO, told: dict[str, Any], body: bytes) -> None:
    replies.write(json.dumps({**told, "length": len(body)}).encode() + b"\n" + body)
    replies.flush()


def _die_after(seconds: float) -> None:
    """Have the system end this process then, should the server that would kill it be gone; never, where 0."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, seconds)


def _limit_memory(mebibytes: int) -> None:
    """Keep this process from taking more than so much more memory; only where the system can say what it has."""
    status = Path("/proc/self/status")
    if not status.exists():
        return
    import resource  # noqa: PLC0415 - not on every system

    used = next(int(line.split()[1]) * 1024 for line in status.read_text().splitlines() if line.startswith("VmData"))
    limit = used + mebibytes * 1024 * 1024
    resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))


if __name__ == "__main__":
    main(sys.argv[1:])
