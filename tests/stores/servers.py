"""Real SPARQL servers, and a proxy that injects faults."""

import http.client
import shutil
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import urlsplit

import pytest

ROOT = Path(__file__).parents[2]
FUSEKI = ROOT / "build/fuseki/jena-fuseki-server-5.6.0.jar"


def free_port() -> int:
    with socket.socket() as bound:
        bound.bind(("127.0.0.1", 0))
        return int(bound.getsockname()[1])


@contextmanager
def running(command: list[str], port: int, folder: Path) -> Iterator[None]:
    """Run a server until the block ends; it is ready when it accepts connections."""
    log = folder / "server.log"
    with log.open("wb") as written, subprocess.Popen(command, stdout=written, stderr=written, cwd=folder) as process:
        try:
            for _ in range(900):
                with suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
                    break
                assert process.poll() is None, log.read_text()
                time.sleep(0.1)
            else:
                pytest.fail(f"the server did not start: {log.read_text()}")
            yield
        finally:
            process.terminate()


@contextmanager
def oxigraph(folder: Path) -> Iterator[str]:
    program = Path(sys.executable).parent / "oxigraph"
    port = free_port()
    with running([str(program), "serve", "--bind", f"127.0.0.1:{port}"], port, folder):
        yield f"http://127.0.0.1:{port}"


@contextmanager
def fuseki(folder: Path, *options: str) -> Iterator[str]:
    if not FUSEKI.exists():
        pytest.skip("needs Apache Jena Fuseki: make fuseki-jar")
    if shutil.which("java") is None:
        pytest.skip("needs Java 17 for Apache Jena Fuseki")
    port = free_port()
    command = ["java", "-Xmx512m", "-jar", str(FUSEKI), "--localhost", f"--port={port}", *options]
    with running([*command, "--mem", "--update", "/ds"], port, folder):
        yield f"http://127.0.0.1:{port}/ds"


@dataclass
class Proxy:
    """A proxy in front of a server that injects faults."""

    target: str
    address: str = ""
    fault: Callable[[str, str, bytes], str | None] = lambda *_: None
    """(method, path, body) → fault. "STATUS" or "STATUS RETRY-AFTER" answers without the server; "cut before" and
    "cut after" break the connection before or after the server processed the request; None forwards the request."""
    requests: list[tuple[str, str, dict[str, str]]] = field(default_factory=list)


@contextmanager
def proxy_to(target: str) -> Iterator[Proxy]:
    proxy = Proxy(target)

    class Handler(BaseHTTPRequestHandler):
        def handle_all(self) -> None:
            body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
            proxy.requests.append((self.command, self.path, dict(self.headers)))
            fault = proxy.fault(self.command, self.path, body)
            if fault is not None and fault[0].isdigit():
                status, _, wait = fault.partition(" ")
                self.send_response(int(status))
                if wait:
                    self.send_header("Location" if int(status) < 400 else "Retry-After", wait)
                self.send_header("Content-Length", "0")
                self.end_headers()
                return
            if fault == "cut before":
                self.connection.shutdown(socket.SHUT_RDWR)
                return
            reply, answer = forward(proxy.target, self.command, self.path, body, dict(self.headers))
            if fault == "cut after":
                self.connection.shutdown(socket.SHUT_RDWR)
                return
            self.send_response(reply.status)
            if reply.getheader("Content-Type"):
                self.send_header("Content-Type", reply.getheader("Content-Type"))
            self.send_header("Content-Length", str(len(answer)))
            self.end_headers()
            if self.command != "HEAD":
                self.wfile.write(answer)

        do_GET = do_POST = do_HEAD = do_PUT = handle_all  # noqa: N815

        def log_message(self, *_: object) -> None:
            pass

    class Quiet(ThreadingHTTPServer):
        def handle_error(self, *_: object) -> None:
            pass

    with Quiet(("127.0.0.1", 0), Handler) as server:
        proxy.address = f"http://127.0.0.1:{server.server_port}{urlsplit(target).path}"
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
        thread.start()
        try:
            yield proxy
        finally:
            server.shutdown()
            thread.join()


def forward(
    target: str, method: str, path: str, body: bytes, headers: dict[str, str]
) -> tuple[http.client.HTTPResponse, bytes]:
    parts = urlsplit(target)
    assert parts.hostname is not None
    connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=60)
    kept = {name: value for name, value in headers.items() if name.lower() not in {"host", "accept-encoding"}}
    try:
        connection.request(method, path, body or None, kept)
        reply = connection.getresponse()
        return reply, reply.read()
    finally:
        connection.close()
