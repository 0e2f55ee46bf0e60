"""A running studio on a small stage."""

import json
import os
import subprocess
import sys
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from usd2kg.endpoint.app_files import AppFile, read_app_files
from usd2kg.endpoint.listening import Address, open_socket, url_of
from usd2kg.studio import ProjectSources, open_project
from usd2kg.studio.application import make_app
from usd2kg.studio.open_session import open_session
from usd2kg.studio.other_version import read_other_version
from usd2kg.studio.studio_server import StudioServer

IS_BUILT = (files("usd2kg.endpoint") / "app" / "index.html").is_file()
"""Whether `make web` has built the page; the server is tested without it, too."""
APP_FILES = (
    read_app_files("index.html")
    if IS_BUILT
    else {"/": AppFile(b"<!doctype html><title>not built</title>", "text/html")}
)
needs_page = pytest.mark.skipif(not IS_BUILT, reason="needs the built page: make web")
KEY = "correct-horse-battery"
HOSTILE = "<img src=x onerror=\"document.title='owned'\">"

STAGE = f"""#usda 1.0
(
    defaultPrim = "Kitchen"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Kitchen" (kind = "group")
{{
    def Cube "Floor" (kind = "component")
    {{
        double size = 1
        double3 xformOp:translate = (0, 0, -0.05)
        float3 xformOp:scale = (5, 5, 0.1)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }}
    def Cube "Table" (kind = "component")
    {{
        double size = 1
        double3 xformOp:translate = (0, 0, 0.35)
        float3 xformOp:scale = (1.2, 0.8, 0.7)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }}
    def Cylinder "Cup_1" (
        kind = "component"
        displayName = {json.dumps(HOSTILE)}
    )
    {{
        double height = 0.1
        double radius = 0.04
        double3 xformOp:translate = (0.2, 0, 0.75)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
    def Cylinder "Cup_2" (kind = "component")
    {{
        double height = 0.1
        double radius = 0.04
        double3 xformOp:translate = (-0.2, 0, 0.75)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
    def Cube "Zxqv" (kind = "component")
    {{
        double size = 0.3
        double3 xformOp:translate = (1.5, 1.5, 0.15)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
}}
"""


class Reply(NamedTuple):
    status: int
    headers: dict[str, str]
    body: bytes

    def json(self) -> Any:
        return json.loads(self.body)


class Client:
    """Requests to a studio."""

    def __init__(self, address: str) -> None:
        self.address = address

    def ask(
        self, path: str, body: Any = None, *, key: str | None = KEY, headers: dict[str, str] | None = None
    ) -> Reply:
        request = urllib.request.Request(self.address + path)
        if key is not None:
            request.add_header("Authorization", f"Bearer {key}")
        if body is not None:
            request.data = body if isinstance(body, bytes) else json.dumps(body).encode()
            request.add_header("Content-Type", "application/json")
        for name, value in (headers or {}).items():
            request.add_header(name, value)
        try:
            with urllib.request.urlopen(request, timeout=60) as response:
                return Reply(response.status, dict(response.headers), response.read())
        except urllib.error.HTTPError as error:
            with error:
                return Reply(error.code, dict(error.headers), error.read())


class Studio(Client):
    """A process `usd2kg studio`."""

    def __init__(self, *arguments: str, key: str = KEY) -> None:
        command = [sys.executable, "-m", "usd2kg", "studio", *arguments, "--port", "0", "--no-browser"]
        environment = {**os.environ, "USD2KG_STUDIO_PASSWORD": key}
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=environment)
        assert self.process.stderr is not None
        line = self.process.stderr.readline()
        assert "studio at http://127.0.0.1:" in line, line + self.process.stderr.read()
        super().__init__(line.partition("studio at ")[2].strip())

    def stop(self) -> None:
        self.process.terminate()
        self._wait()

    def kill(self) -> None:
        self.process.kill()
        self._wait()

    def _wait(self) -> None:
        self.process.wait(30)
        assert self.process.stderr is not None
        self.process.stderr.close()


@contextmanager
def running_studio(
    stage: Path,
    folder: Path,
    *,
    compared: Path | None = None,
    mapping: Path | None = None,
    second: Path | None = None,
) -> Iterator[Client]:
    """A studio in this process, which starts at once since the grounder is loaded."""
    sources = ProjectSources(stage, mapping=mapping, second_mapping=second)
    with open_project(folder, sources) as project, open_socket(Address()) as socket:
        socket.listen()
        session = open_session(project)
        other = None if compared is None else read_other_version(compared, project.sources, session.tbox)
        app = make_app(session, APP_FILES, key=KEY, reviewer="Ann", other=other)
        server = StudioServer(app)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [socket]}, daemon=True)
        thread.start()
        try:
            yield Client(url_of(socket))
        finally:
            server.should_exit = True
            thread.join(20)
            session.close()


@pytest.fixture(scope="session")
def stage(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("stage") / "kitchen.usda"
    path.write_text(STAGE)
    return path


@pytest.fixture
def studio(stage: Path, tmp_path: Path) -> Iterator[Client]:
    with running_studio(stage, tmp_path / "project") as client:
        yield client
