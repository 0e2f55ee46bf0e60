"""Clients that are slow or many: the server stays up, closes them, bounds what it holds, and stops when asked to."""

import asyncio
import logging
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace

import pytest
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from usd2kg.endpoint.bounded_server import BoundedServer, _RateFilter
from usd2kg.endpoint.http_limits import HTTP_LIMITS
from usd2kg.endpoint.open_connections import Connections

LIMITS = replace(HTTP_LIMITS, head_s=0.4, body_s=0.8, write_s=0.4, connections=20, held_bytes=20 << 20)
LARGE = 16 << 20
GET = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"


async def answer(request: Request) -> Response:
    if request.method == "POST":
        return Response(str(len(await request.body())))
    return Response("x" * int(request.query_params.get("bytes", 2)))


@pytest.fixture
def server() -> Iterator[tuple[int, BoundedServer, Connections]]:
    """A server with short limits: its port, itself, and its connections."""
    app = Starlette(routes=[Route("/", answer, methods=["GET", "POST"])])
    connections = Connections(LIMITS)
    found = BoundedServer(app, connections, 1, LIMITS)
    with socket.create_server(("127.0.0.1", 0)) as listening:
        thread = threading.Thread(target=found.run, kwargs={"sockets": [listening]})
        thread.start()
        while not found.started:
            time.sleep(0.01)
        yield listening.getsockname()[1], found, connections
        found.should_exit = True
        thread.join(10)
        assert not thread.is_alive()


@contextmanager
def connected(port: int) -> Iterator[socket.socket]:
    with socket.create_connection(("127.0.0.1", port), timeout=10) as client:
        yield client


def fetch(port: int, request: bytes = GET) -> bytes:
    with connected(port) as client:
        client.sendall(request)
        return client.recv(1 << 16)


def seconds_until_closed(client: socket.socket) -> float:
    start = time.monotonic()
    try:
        while client.recv(1 << 16):
            pass
    except ConnectionError:
        pass
    return time.monotonic() - start


@pytest.mark.parametrize("sent", [b"", b"GET / HTTP/1.1\r\nHost: local"])
def test_a_request_without_the_end_of_its_head_is_closed(server, sent: bytes):
    with connected(server[0]) as client:
        client.sendall(sent)
        assert seconds_until_closed(client) < 3


def test_a_head_that_trickles_in_is_closed(server):
    with connected(server[0]) as client:
        start = time.monotonic()
        try:
            while time.monotonic() - start < 5:
                client.sendall(b"G")
                time.sleep(0.05)
        except ConnectionError:
            pass
        assert time.monotonic() - start < 3


def test_a_request_without_the_end_of_its_body_is_closed(server):
    with connected(server[0]) as client:
        client.sendall(b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100\r\n\r\nabc")
        assert 0.5 < seconds_until_closed(client) < 4


def test_a_body_in_time_and_further_requests_are_answered(server):
    with connected(server[0]) as client:
        for _ in range(3):
            client.sendall(b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\na")
            time.sleep(0.3)
            client.sendall(b"bc")
            reply = client.recv(1 << 16)
            while not reply.endswith(b"\r\n\r\n3"):
                received = client.recv(1 << 16)
                assert received, f"the connection was closed after {reply!r}"
                reply += received
            # Longer than the limit of a head: the connection is kept alive.
            time.sleep(0.6)


def test_a_client_that_does_not_take_its_answer_is_closed(server):
    port, _, connections = server
    with connected(port) as client:
        client.sendall(f"GET /?bytes={LARGE} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        deadline = time.monotonic() + 5
        while connections.can_hold(LARGE) and time.monotonic() < deadline:
            time.sleep(0.01)
        # The budget of held answers is used up until the client is given up.
        assert not connections.can_hold(LARGE)
        while not connections.can_hold(LARGE) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert connections.can_hold(LARGE)


def test_a_client_that_takes_its_answer_slowly_gets_all_of_it(server):
    with connected(server[0]) as client:
        client.sendall(f"GET /?bytes={LARGE} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
        received = 0
        while data := client.recv(1 << 20):
            received += len(data)
            time.sleep(0.04)
        assert received > LARGE


def test_connections_beyond_the_limit_are_closed_and_the_rest_is_answered_later(server):
    port = server[0]
    with ExitStack() as clients:
        held = [clients.enter_context(connected(port)) for _ in range(LIMITS.connections + 30)]
        closed = [client for client in held[LIMITS.connections :] if seconds_until_closed(client) < 5]
        assert len(closed) == 30
    deadline = time.monotonic() + 5
    while time.monotonic() < deadline:
        try:
            if fetch(port).startswith(b"HTTP/1.1 200"):
                return
        except ConnectionError:
            time.sleep(0.1)
    pytest.fail("the server does not answer any more")


def test_the_server_stops_although_clients_are_slow(server):
    port, found, _ = server
    with connected(port) as reader, connected(port):
        reader.sendall(f"GET /?bytes={LARGE} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        time.sleep(0.1)
        found.should_exit = True
        start = time.monotonic()
        assert seconds_until_closed(reader) < 4
        assert time.monotonic() - start < 4


def test_open_files_limit_the_connections(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("usd2kg.endpoint.open_connections._open_files", lambda: 300)
    connections = Connections()
    transports = [asyncio.Transport() for _ in range(45)]
    assert [connections.add(transport) for transport in transports] == [True] * 44 + [False]


def test_a_period_has_a_few_messages_and_their_number():
    now = [0.0]
    rate = _RateFilter(2, 60, clock=lambda: now[0])
    records = [logging.LogRecord("uvicorn.error", logging.WARNING, "", 0, "odd", (), None) for _ in range(6)]
    assert [rate.filter(record) for record in records[:5]] == [True, True, False, False, False]
    now[0] = 61
    assert rate.filter(records[5])
    assert records[5].getMessage() == "odd (3 earlier messages suppressed)"
