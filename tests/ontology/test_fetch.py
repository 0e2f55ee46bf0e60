"""Downloading known ontologies from a local server, with hashes and catalog."""

import hashlib
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from tests.conftest import shared_file
from usd2kg.errors import OntologyError, OutputError
from usd2kg.ontology import fetch_ontology, load_tbox, read_registry

LAB = b"""@prefix : <https://lab.example/onto#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
<https://lab.example/onto> a owl:Ontology ; owl:imports <https://lab.example/things> .
:Cup a owl:Class ; rdfs:subClassOf <https://lab.example/things#Thing> .
"""
THINGS = b"""@prefix owl: <http://www.w3.org/2002/07/owl#> .
<https://lab.example/things> a owl:Ontology .
<https://lab.example/things#Thing> a owl:Class .
"""


ANSWERS = {
    "/to-file": b"HTTP/1.0 302 Found\r\nLocation: file:///etc/hostname\r\n\r\n",
    "/to-ftp": b"HTTP/1.0 302 Found\r\nLocation: ftp://127.0.0.1:9/x\r\n\r\n",
    "/to-nowhere": b"HTTP/1.0 302 Found\r\nLocation: http://[x/\r\n\r\n",
    "/to-itself": b"HTTP/1.0 302 Found\r\nLocation: /to-itself\r\n\r\n",
    "/garbage": b"garbage\r\n\r\n",
    "/short": b"HTTP/1.0 200 OK\r\nContent-Length: 9999\r\n\r\n" + LAB,
}
"""Raw HTTP responses."""


@contextmanager
def server(pages: dict[str, bytes]) -> Iterator[str]:
    """Serve pages, with a redirect from `/moved` to the first; yield the address."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            if self.path == "/moved":
                self.send_response(302)
                self.send_header("Location", next(iter(pages)))
                self.end_headers()
                return
            if self.path in ANSWERS:
                self.wfile.write(ANSWERS[self.path])
                return
            data = pages.get(self.path.partition("?")[0])
            self.send_response(404 if data is None else 200)
            self.end_headers()
            self.wfile.write(data or b"")

        def log_message(self, *_):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as served:
        threading.Thread(target=served.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()
        yield f"http://127.0.0.1:{served.server_port}"
        served.shutdown()


def registry(folder: Path, address: str, *, lab: str = "/lab", sha256: str | None = None) -> Path:
    digest = hashlib.sha256(LAB).hexdigest() if sha256 is None else sha256
    path = folder / "registry.toml"
    path.write_text(
        f"""[[ontology]]
name = "lab"
title = "Things of a lab"
version = "1"
licence = "CC0"
[[ontology.document]]
iri = "https://lab.example/onto"
file = "lab.ttl"
address = "{address}{lab}"
sha256 = "{digest}"
[[ontology.document]]
iri = "https://lab.example/things"
file = "things-1.ttl"
address = "{address}/things"
sha256 = ""
""",
        encoding="utf-8",
    )
    return path


PAGES = {
    "/lab": LAB,
    "/things": THINGS,
    "/page": b"<!doctype html><html><p>Not found</p></html>",
    "/image": b"\x89PNG\r\n",
}


@pytest.mark.parametrize("lab", ["/lab", "/moved"])
def test_fetched_ontology_loads_with_its_imports(tmp_path: Path, lab: str):
    with server(PAGES) as address:
        known = read_registry(registry(tmp_path, address, lab=lab))["lab"]
        path = fetch_ontology(known, tmp_path / "new")
    tbox = load_tbox(path)
    assert path.read_bytes() == LAB
    assert tbox.imports == ("https://lab.example/things",)
    assert tbox.notes == ()


def test_skips_up_to_date_documents(tmp_path: Path):
    with server(PAGES) as address:
        known = read_registry(registry(tmp_path, address))["lab"]
        fetch_ontology(known, tmp_path)
    lines: list[str] = []
    with pytest.raises(OntologyError, match=r"things: cannot be reached .*is this machine online\?"):
        fetch_ontology(known, tmp_path, report=lines.append)
    assert lines == [f"{tmp_path / 'lab.ttl'}: up to date"]


def test_accepts_another_version_only_on_request(tmp_path: Path):
    with server(PAGES) as address:
        known = read_registry(registry(tmp_path, address, sha256="0" * 64))["lab"]
        with pytest.raises(OntologyError, match=f"sha256 is {hashlib.sha256(LAB).hexdigest()}, expected 0000"):
            fetch_ontology(known, tmp_path / "new")
        assert not (tmp_path / "new").exists()
        assert fetch_ontology(known, tmp_path / "new", accepts_changed=True).read_bytes() == LAB


@pytest.mark.parametrize(
    ("page", "message"),
    [("/gone", "answered 404"), ("/page", "expected an ontology; has"), ("/image", "expected an ontology; has")],
)
def test_rejects_responses_that_are_not_ontologies(tmp_path: Path, page: str, message: str):
    with server(PAGES) as address:
        known = read_registry(registry(tmp_path, address, lab=page, sha256=""))["lab"]
        with pytest.raises(OntologyError, match=message):
            fetch_ontology(known, tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_rejects_other_url_schemes(tmp_path: Path):
    known = read_registry(registry(tmp_path, "file:///etc"))["lab"]
    with pytest.raises(OntologyError, match="is not a web address"):
        fetch_ontology(known, tmp_path / "new")


def test_reports_a_folder_that_cannot_be_created(tmp_path: Path):
    (tmp_path / "taken").write_text("a file")
    with server(PAGES) as address:
        known = read_registry(registry(tmp_path, address))["lab"]
        with pytest.raises(OutputError, match="taken: cannot be created"):
            fetch_ontology(known, tmp_path / "taken")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("not toml", "is not a registry"),
        ("[[ontology]]\nname = 'x'", "is not a registry"),
        ("ontology = 3", "is not a registry"),
        ("ontology = " + "[" * 100_000, "is not a registry"),
    ],
)
def test_rejects_a_malformed_registry(tmp_path: Path, text: str, message: str):
    path = tmp_path / "r.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(OntologyError, match=message):
        read_registry(path)


@pytest.mark.parametrize("file", ["../up.ttl", "/etc/x", "a/b.ttl", "", ".hidden"])
def test_rejects_file_names_with_a_path(tmp_path: Path, file: str):
    path = registry(tmp_path, "http://127.0.0.1:1")
    path.write_text(path.read_text().replace('file = "lab.ttl"', f'file = "{file}"'))
    with pytest.raises(OntologyError, match="is not a plain file name"):
        read_registry(path)


def test_built_in_registry_has_all_hashes():
    for ontology in read_registry().values():
        assert [bool(ontology.documents), bool(ontology.website), bool(ontology.built_in)].count(True) == 1
        assert all(len(document.sha256) == 64 for document in ontology.documents)
        assert all(document.address.startswith(("https://", "http://")) for document in ontology.documents)


@pytest.mark.parametrize("name", ["home", "places"])
def test_a_built_in_ontology_is_written_without_network(tmp_path: Path, name: str):
    lines: list[str] = []
    path = fetch_ontology(read_registry()[name], tmp_path / "new", report=lines.append)
    assert lines == [f"{path}: {path.stat().st_size:,} bytes, built in"]
    assert {cls.iri for cls in load_tbox(path).classes} == {cls.iri for cls in load_tbox(name).classes}


def test_built_in_registry_matches_soma():
    for document in read_registry()["soma-home"].documents:
        data = shared_file(f"ontologies/soma/{document.file}").read_bytes()
        assert hashlib.sha256(data).hexdigest() == document.sha256


@pytest.mark.parametrize(
    ("page", "message"),
    [
        ("/to-file", "the server answered 302"),
        ("/to-ftp", r"redirects to ftp://127\.0\.0\.1:9/x, which is not a web address"),
        ("/to-nowhere", "is not a valid address"),
        ("/to-itself", "the server answered 302"),
        ("/garbage", r"the server did not answer in HTTP \(BadStatusLine\)"),
        ("/short", f"ended after {len(LAB)} of 9,999 bytes"),
    ],
)
def test_rejects_misleading_responses(tmp_path: Path, page: str, message: str):
    with server(PAGES) as address:
        known = read_registry(registry(tmp_path, address, lab=page, sha256=""))["lab"]
        with pytest.raises(OntologyError, match=message):
            fetch_ontology(known, tmp_path / "new")
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("address", ["http://[x", "http://a b", "http://127.0.0.1:abc", "http://", "https:"])
def test_rejects_invalid_addresses(tmp_path: Path, address: str):
    known = read_registry(registry(tmp_path, address, lab="/"))["lab"]
    with pytest.raises(OntologyError, match=r"is not a valid address|cannot be reached"):
        fetch_ontology(known, tmp_path / "new")


def test_hides_secrets_of_addresses(tmp_path: Path):
    lines: list[str] = []
    with server(PAGES) as address:
        known = read_registry(registry(tmp_path, address, lab="/lab?key=hidden"))["lab"]
        fetch_ontology(known, tmp_path / "new", report=lines.append)
        gone = read_registry(registry(tmp_path, address, lab="/gone?key=hidden"))["lab"]
        with pytest.raises(OntologyError, match=r"/gone: the server answered 404"):
            fetch_ontology(gone, tmp_path / "gone")
    assert f" bytes from {address}/lab, sha256 " in lines[0]
    known = read_registry(registry(tmp_path, "http://me:hidden@127.0.0.1:abc"))["lab"]
    with pytest.raises(OntologyError) as caught:
        fetch_ontology(known, tmp_path / "secret")
    assert str(caught.value).startswith("http://127.0.0.1:abc/lab: is not a valid address")
    assert "hidden" not in str(caught.value)


@pytest.mark.parametrize("file", ["catalog-v001.xml", "Catalog-v001.XML"])
def test_rejects_a_document_named_like_the_catalog(tmp_path: Path, file: str):
    path = registry(tmp_path, "http://127.0.0.1:1")
    path.write_text(path.read_text().replace('file = "lab.ttl"', f'file = "{file}"'))
    with pytest.raises(OntologyError, match="is reserved for the catalog"):
        read_registry(path)


def test_rejects_an_ontology_without_documents(tmp_path: Path):
    path = tmp_path / "r.toml"
    path.write_text('[[ontology]]\nname="n"\ntitle="t"\nversion="1"\nlicence="l"\ndocument=[]\n')
    with pytest.raises(OntologyError, match=r"'n' has no \[\[ontology\.document\]\] and no website; add one"):
        read_registry(path)


def test_an_ontology_with_a_website_only_is_not_fetched(tmp_path: Path):
    ontology = read_registry()["brick"]
    with pytest.raises(OntologyError, match=r"'brick' cannot be fetched by name; download it from https://brick"):
        fetch_ontology(ontology, tmp_path / "brick")
    assert not (tmp_path / "brick").exists()
