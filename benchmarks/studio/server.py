"""studio, ask, fetch, listen: serve a scene in this process, and send requests to it."""

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
def studio(scene: Path, folder: Path | None = None) -> Iterator[str]:
    """Serve a scene from this process; yields the address of the page.

    Args:
        scene: the stage or graph.
        folder: folder of the project; None for a temporary one.
    """
    with (
        tempfile.TemporaryDirectory() as temporary,
        open_project(folder or Path(temporary) / "project", ProjectSources(scene)) as project,
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
    with urllib.request.urlopen(_request(address, path, body), timeout=60) as response:
        content: bytes = response.read()
    return content


def listen(address: str) -> None:
    """Open the stream of changes, as a page that is up to date, and close it."""
    with urllib.request.urlopen(_request(address, "events"), timeout=60):
        pass


def _request(address: str, path: str, body: Any = None) -> urllib.request.Request:
    request = urllib.request.Request(f"{address}api/{path}", data=None if body is None else json.dumps(body).encode())
    request.add_header("Authorization", f"Bearer {KEY}")
    request.add_header("Content-Type", "application/json")
    return request


def ask(address: str, path: str, body: Any = None) -> Any:
    """Return the JSON answer to a request."""
    return json.loads(fetch(address, path, body))
