"""Downloading labelled scenes from a local server."""

import hashlib
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from usd2kg.errors import EvaluationError, OutputError
from usd2kg.evaluation import read_matrix
from usd2kg.evaluation.fetch import fetch_scenes
from usd2kg.evaluation.manifest import read_manifest

STAGE = b'#usda 1.0\n( metersPerUnit = 1 )\ndef Xform "Room" ( kind = "component" )\n{\n    def Cube "Cup_1" {}\n}\n'
GOLD = b"path,class\n/Room,Cup\n"
FILES = {"/room.usda": STAGE, "/gold.csv": GOLD}


class Server:
    """Serves files; `/short` breaks off, `/moved` redirects to the stage, `/to-file` to a local file."""

    def __init__(self) -> None:
        asked: list[str] = []

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                asked.append(self.path)
                path = self.path.partition("?")[0]
                if path in ("/moved", "/to-file"):
                    self.send_response(302)
                    self.send_header("Location", "/room.usda" if path == "/moved" else "file:///etc/hostname")
                    self.end_headers()
                    return
                data = STAGE if path == "/short" else FILES.get(path)
                self.send_response(404 if data is None else 200)
                self.send_header("Content-Length", "9999" if path == "/short" else str(len(data or b"")))
                self.end_headers()
                self.wfile.write(data or b"")

            def log_message(self, *_: object) -> None:
                pass

        self.asked = asked
        self._http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self._http.server_port}"
        threading.Thread(target=self._http.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()

    def close(self) -> None:
        self._http.shutdown()
        self._http.server_close()


@pytest.fixture
def server() -> Iterator[Server]:
    server = Server()
    yield server
    server.close()


Write = Callable[..., Path]


@pytest.fixture
def manifest(tmp_path: Path, server: Server) -> Write:
    """Return a function that writes a manifest of one scene, with replacements."""

    def write(*replacements: tuple[str, str]) -> Path:
        text = f"""[[scene]]
name = "room"
licence = "CC0-1.0"
note = 'made for "tests"'
stage = "stage/room.usda"
gold = "gold.csv"

[[scene.file]]
file = "stage/room.usda"
address = "{server.url}/room.usda"
sha256 = "{hashlib.sha256(STAGE).hexdigest()}"

[[scene.file]]
file = "gold.csv"
address = "{server.url}/gold.csv"
sha256 = "{hashlib.sha256(GOLD).hexdigest()}"
"""
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new, 1)
        path = tmp_path / "manifest.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_fetched_scenes_are_a_matrix(manifest: Write, server: Server, tmp_path: Path) -> None:
    lines: list[str] = []
    matrix = fetch_scenes(read_manifest(manifest()), tmp_path / "scenes", report=lines.append)
    (scene,) = read_matrix(matrix).scenes
    assert (scene.name, scene.note) == ("room", 'made for "tests"; licence CC0-1.0')
    assert (scene.path.read_bytes(), scene.gold.read_bytes()) == (STAGE, GOLD)
    assert lines[0] == "room: 2 files, licence CC0-1.0"
    digest = hashlib.sha256(GOLD).hexdigest()
    folder = tmp_path / "scenes/room"
    assert lines[2] == f"{folder / 'gold.csv'}: {len(GOLD)} bytes from {server.url}/gold.csv, sha256 {digest}"


def test_files_with_the_right_hash_are_not_downloaded_again(manifest: Write, server: Server, tmp_path: Path) -> None:
    scenes = read_manifest(manifest())
    fetch_scenes(scenes, tmp_path / "scenes")
    (tmp_path / "scenes/room/gold.csv").unlink()
    server.asked.clear()
    lines: list[str] = []
    fetch_scenes(scenes, tmp_path / "scenes", report=lines.append)
    assert server.asked == ["/gold.csv"]
    assert lines[1] == f"{tmp_path / 'scenes/room/stage/room.usda'}: up to date"


def test_a_redirect_is_followed(manifest: Write, tmp_path: Path) -> None:
    fetch_scenes(read_manifest(manifest(('/room.usda"\nsha', '/moved"\nsha'))), tmp_path / "scenes")
    assert (tmp_path / "scenes/room/stage/room.usda").read_bytes() == STAGE


@pytest.mark.parametrize("changed", ["room/gold.csv", "matrix.toml"])
def test_existing_files_that_differ_are_kept(manifest: Write, server: Server, tmp_path: Path, changed: str) -> None:
    scenes = read_manifest(manifest())
    fetch_scenes(scenes, tmp_path / "scenes")
    (tmp_path / "scenes" / changed).write_text("mine")
    server.asked.clear()
    with pytest.raises(EvaluationError, match=f"{changed}: exists and differs from the manifest; .* with --force"):
        fetch_scenes(scenes, tmp_path / "scenes")
    assert (tmp_path / "scenes" / changed).read_text() == "mine"
    assert server.asked == [], "nothing is downloaded before"
    fetch_scenes(scenes, tmp_path / "scenes", overwrites=True)
    assert (tmp_path / "scenes" / changed).read_text() != "mine"


@pytest.mark.parametrize(
    ("page", "message"),
    [
        ("gold.csv", f"sha256 is {hashlib.sha256(GOLD).hexdigest()}, expected {hashlib.sha256(STAGE).hexdigest()}"),
        ("short?key=hidden", f"/short: ended after {len(STAGE)} of 9,999 bytes; try again"),
        ("gone", "/gone: the server answered 404; expected 200"),
        ("to-file", "/to-file: the server answered 302"),
    ],
)
def test_wrong_answers_leave_no_file(manifest: Write, tmp_path: Path, page: str, message: str) -> None:
    scenes = read_manifest(manifest(('/room.usda"\nsha', f'/{page}"\nsha')))
    with pytest.raises(EvaluationError) as caught:
        fetch_scenes(scenes, tmp_path / "scenes")
    assert message in str(caught.value)
    assert "hidden" not in str(caught.value)
    assert [path for path in (tmp_path / "scenes").rglob("*") if path.is_file()] == []


def test_says_so_without_a_network(manifest: Write, server: Server, tmp_path: Path) -> None:
    scenes = read_manifest(manifest())
    server.close()
    with pytest.raises(EvaluationError, match=r"room\.usda: cannot be reached .*; is this machine online\?"):
        fetch_scenes(scenes, tmp_path / "scenes")


def test_says_so_if_the_folder_cannot_be_created(manifest: Write, tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("a file")
    with pytest.raises(OutputError, match=r"taken/room/stage: cannot be created"):
        fetch_scenes(read_manifest(manifest()), tmp_path / "taken")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[[scene]]", "[[scene", "is not a manifest"),
        ("[[scene]]", "[[scenes]]", "is not a manifest"),
        ('licence = "CC0-1.0"', "", "is not a manifest .*licence.*; expected .* docs/evaluation.md"),
        ('licence = "CC0-1.0"', 'licence = " "', "scene 'room': its licence is empty"),
        ('licence = "CC0-1.0"', 'licence = "CC0-1.0"\nlicense = "x"', "has the unknown key 'license'"),
        ('gold = "gold.csv"', 'gold = "labels.csv"', "its gold 'labels.csv' is not among its files"),
        ('gold = "gold.csv"', 'gold = "gold.csv"\nontology = "o.owl"', "its ontology 'o.owl' is not among its files"),
        ('name = "room"', 'name = "../room"', r"'\.\./room' is not a valid file or folder name"),
        ('file = "gold.csv"', 'file = "../gold.csv"', r"'\.\.' is not a valid file or folder name"),
        ('file = "gold.csv"', 'file = "/etc/gold.csv"', "'' is not a valid file or folder name"),
        ('file = "gold.csv"', 'file = "stage/Room.usda"', "two files are called"),
        (f'sha256 = "{hashlib.sha256(GOLD).hexdigest()}"', 'sha256 = ""', "gold.csv: sha256 is ''; expected 64"),
    ],
)
def test_rejects_a_malformed_manifest(manifest: Write, old: str, new: str, message: str) -> None:
    with pytest.raises(EvaluationError, match=message):
        read_manifest(manifest((old, new)))


def test_rejects_a_manifest_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(EvaluationError, match=r"none\.toml: cannot be read as a manifest"):
        read_manifest(tmp_path / "none.toml")
