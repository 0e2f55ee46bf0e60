"""Measure the client overhead of a model request against a local server that answers at once.

Usage: python -m benchmarks.llm.overhead

The server runs in its own process and streams one event per token, in each of the three wire formats. Prints medians
per request: of a bare socket, of pydantic-ai above it, and of our client above pydantic-ai; milliseconds of wall time
and of processor time, which is more reliable on a busy machine.
"""

import argparse
import json
import multiprocessing
import socket
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

from pydantic_ai import direct
from pydantic_ai.messages import ModelRequest

from tests.grounding.llm import servers
from usd2kg.grounding.llm.adapter import make_parameters, make_settings
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.event_loop import EventLoopThread
from usd2kg.grounding.llm.model_reference import parse_model_reference
from usd2kg.grounding.llm.providers import closing_responses, make_provider_model, open_http

KEYS = {"OPENAI_API_KEY": "none", "GOOGLE_API_KEY": "none", "ANTHROPIC_API_KEY": "none"}
REPLIES = {
    "openai:m": servers.openai_reply,
    "google:gemini-2.5-flash": servers.gemini_reply,
    "anthropic:claude-haiku-4-5": servers.anthropic_reply,
}
CLASSES = [f"Class{number}" for number in range(200)]
ANSWER = {"type": "object", "properties": {"class": {"type": "string", "enum": CLASSES}}, "required": ["class"]}


def main() -> None:
    """Print a row for each format and size of prompt."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--requests", type=int, default=200, help="requests of each kind; default: 200")
    parser.add_argument("--objects", type=int, nargs="*", default=[1, 20], help="objects per prompt; default: 1 20")
    arguments = parser.parse_args()
    print(f"{'model':26} {'objects':>7} {'events':>6}   {'bare':>15} {'library':>15} {'ours':>15}")
    for model in REPLIES:
        for count in arguments.objects:
            text = json.dumps({str(number): {"class": "Class7"} for number in range(1, count + 1)})
            shown = " ".join(str(cost).rjust(15) for cost in measure(model, text, count, arguments.requests))
            print(f"{model:26} {count:7} {len(servers.pieces(text)):6}   {shown}", flush=True)


class Cost(NamedTuple):
    """Milliseconds of a request."""

    wall: float
    cpu: float

    def __sub__(self, other: "Cost") -> "Cost":
        return Cost(self.wall - other.wall, self.cpu - other.cpu)

    def __str__(self) -> str:
        return f"{self.wall:.2f} cpu {self.cpu:.2f}"


def measure(model: str, text: str, count: int, times: int) -> list[Cost]:
    """Return the median cost of a bare request, then the additional cost of the library and of our client."""
    schema = {"type": "object", "properties": {str(number): ANSWER for number in range(1, count + 1)}}
    request = Request("the classes\n" + "\n".join(CLASSES), "the objects", schema)
    with (
        running_server(model, text) as (port, sent),
        make_client(f"{model}@http://127.0.0.1:{port}", environment=KEYS) as client,
        asking_the_library(f"{model}@http://127.0.0.1:{port}", request) as ask_library,
    ):
        client.complete(request)
        ask_library()
        with asking_bare(port, sent()) as ask_bare:
            ways: list[Callable[[], object]] = [ask_bare, ask_library, lambda: client.complete(request)]
            # Alternately, so that other load on the machine affects all alike.
            rounds = [tuple(clock(ask) for ask in ways) for _ in range(times)]
    columns = zip(*((bare, library - bare, ours - library) for bare, library, ours in rounds), strict=True)
    return [Cost(*map(statistics.median, zip(*column, strict=True))) for column in columns]


@contextmanager
def asking_bare(port: int, raw: bytes) -> Iterator[Callable[[], object]]:
    """Yield a function that resends a recorded request over one connection and reads the whole answer."""
    with socket.create_connection(("127.0.0.1", port)) as connection:

        def ask() -> None:
            connection.sendall(raw)
            read = b""
            while not read.endswith(b"0\r\n\r\n"):
                read = read[-8:] + connection.recv(1 << 16)

        yield ask


@contextmanager
def asking_the_library(model: str, request: Request) -> Iterator[Callable[[], object]]:
    """Yield a function that sends the same request through pydantic-ai only."""
    address = parse_model_reference(model)
    http = open_http(address, 60)
    served = make_provider_model(address, "none", http)
    background = EventLoopThread()

    async def ask() -> str:
        settings: Any = make_settings(address, served, request, asks_logprobs=False)
        prompt = [ModelRequest.user_text_prompt(request.user, instructions=request.system)]
        parameters = make_parameters(served, request, address.is_openai_compatible)
        async with (
            closing_responses(),
            direct.model_request_stream(
                served, prompt, model_settings=settings, model_request_parameters=parameters, instrument=False
            ) as stream,
        ):
            async for _ in stream:
                pass
            return stream.get().text or ""

    try:
        yield lambda: background.run(ask())
    finally:
        background.stop(http.aclose)


def clock(work: Callable[[], object]) -> Cost:
    """Return the wall time and processor time of a call."""
    wall, cpu = time.perf_counter(), time.process_time()
    work()
    return Cost(1000 * (time.perf_counter() - wall), 1000 * (time.process_time() - cpu))


@contextmanager
def running_server(model: str, text: str) -> Iterator[tuple[int, Callable[[], bytes]]]:
    """Yield the port of a server in another process, and a function that returns its first request as bytes."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=serve, args=(model, text, theirs))
    process.start()

    def sent() -> bytes:
        ours.send("first")
        raw: bytes = ours.recv()
        return raw

    try:
        yield ours.recv(), sent
    finally:
        ours.send("end")
        process.join()


def serve(model: str, text: str, pipe: Connection) -> None:
    """Serve until the pipe requests the end; send the first request on demand."""
    with servers.serve(REPLIES[model](text)) as server:
        pipe.send(int(server.url.rpartition(":")[2]))
        while pipe.recv() == "first":
            first = server.received[0]
            body = json.dumps(first.body).encode()
            headers = {**first.headers, "content-length": str(len(body))}
            head = "".join(f"{name}: {value}\r\n" for name, value in headers.items())
            pipe.send(f"POST {first.path} HTTP/1.1\r\n{head}\r\n".encode() + body)


if __name__ == "__main__":
    main()
