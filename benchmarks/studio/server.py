"""studio, ask: serve a scene in this process, and send requests to it."""

import json
import tempfile
import threading
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from usd2kg.endpoint.app_files import read_app_files
from usd2kg.endpoint.listening import Address, open_socket, url_of
from usd2kg.studio import ProjectSources, open_project
from usd2kg.studio.application import make_app
from usd2kg.studio.open_session import open_session
from usd2kg.studio.studio_server import StudioServer

KEY = "benchmark-of-the-studio"


@contextmanager
def studio(scene: Path) -> Iterator[str]:
    """Serve a scene from this process; yields the address of the page."""
    with (
        tempfile.TemporaryDirectory() as folder,
        open_project(Path(folder) / "project", ProjectSources(scene)) as project,
        open_socket(Address()) as socket,
    ):
        socket.listen()
        session = open_session(project)
        server = StudioServer(make_app(session, read_app_files("index.html"), key=KEY, reviewer="benchmark"))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [socket]}, daemon=True)
        thread.start()
        try:
            yield url_of(socket)
        finally:
            server.should_exit = True
            thread.join()
            session.close()


def fetch(address: str, path: str, body: Any = None) -> bytes:
    """Return the answer to a request."""
    request = urllib.request.Request(f"{address}api/{path}", data=None if body is None else json.dumps(body).encode())
    request.add_header("Authorization", f"Bearer {KEY}")
    request.add_header("Content-Type", "application/json")
    with urllib.request.urlopen(request, timeout=60) as response:
        content: bytes = response.read()
    return content


def ask(address: str, path: str, body: Any = None) -> Any:
    """Return the JSON answer to a request."""
    return json.loads(fetch(address, path, body))
