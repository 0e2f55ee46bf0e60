"""Requests: what is repeated, what is refused, and that no secret gets out."""

import gzip
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from tests.stores.conftest import open_remote
from tests.stores.servers import free_port, way_to
from usd2kg.errors import StoreError
from usd2kg.stores import NamedGraph, http_client
from usd2kg.stores.addresses import check_address, read_credentials, shown_address
from usd2kg.stores.catalog import StoredGraph
from usd2kg.stores.http_client import HttpClient, HttpRequest, OutcomeUnknownError


def test_a_password_in_an_address_is_refused_and_not_repeated():
    with pytest.raises(StoreError, match=r"store https://…@my\.lab/ds: its address holds a user or password") as error:
        check_address("https://robot:s3cret@my.lab/ds")
    assert "s3cret" not in str(error.value)


@pytest.mark.parametrize(
    "url",
    [
        "http://user:S3CRET@host:notaport/",
        "http://user:S3CRET/x@host",
        "http://user:S3[CRET@host",
        "http://user:S3?CRET@host",
        "http://user:S3#CRET@host",
        "http://user:x@S3CRET/x@host",
        "user:S3CRET@http://host",
    ],
)
def test_a_password_in_a_broken_address_is_not_repeated(url: str):
    with pytest.raises(StoreError) as error:
        check_address(url)
    for secret in ("S3", "CRET", "user:"):
        assert secret not in str(error.value)


def test_a_query_string_is_not_shown():
    assert shown_address("http://my.lab/ds?key=S3CRET") == "http://my.lab/ds"
    with pytest.raises(StoreError, match=r"store 'http://my\.lab/é': is no address"):
        check_address("http://my.lab/é?key=S3CRET")
    with way_to("http://127.0.0.1:1") as way:
        way.fault = lambda *_: "404"
        with pytest.raises(StoreError, match="takes no SPARQL query") as error:
            open_remote(f"{way.address}/ds?key=S3CRET").check()
    assert "S3CRET" not in str(error.value)


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ({"TOKEN": "S3CRET\r"}, "TOKEN"),
        ({"TOKEN": "S3CRET\u00e9"}, "TOKEN"),
        ({"USER": "S3\nCRET", "PASSWORD": "S3CRET"}, "USER"),
        ({"USER": "S3:CRET", "PASSWORD": "S3CRET"}, "USER"),
        ({"USER": "S3CRET", "PASSWORD": "S3CRET\x00"}, "PASSWORD"),
        ({"USER": "S3CRET", "PASSWORD": "S3CRET\udcff"}, "PASSWORD"),
    ],
)
def test_credentials_that_no_header_can_carry_are_named_not_shown(given: dict[str, str], name: str):
    with pytest.raises(StoreError, match=f"^USD2KG_STORE_{name}: holds ") as error:
        read_credentials({f"USD2KG_STORE_{key}": value for key, value in given.items()})
    assert "S3" not in str(error.value)


@pytest.mark.parametrize("url", ["ftp://my.lab/", "http://", "http://my.lab:99999/", "http://my lab/", "http://[::1"])
def test_what_is_no_address_is_refused(url: str):
    with pytest.raises(StoreError, match="is no address of a server; expected one like http://localhost:7878"):
        check_address(url)


def test_credentials_come_from_the_environment():
    # RFC 7617, section 2: Aladdin's.
    given = {"USD2KG_STORE_USER": "Aladdin", "USD2KG_STORE_PASSWORD": "open sesame"}
    assert read_credentials(given) == "Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ=="
    assert read_credentials({"USD2KG_STORE_TOKEN": "abc"}) == "Bearer abc"
    assert read_credentials({}) is None
    for wrong in ({"USD2KG_STORE_USER": "a"}, {**given, "USD2KG_STORE_TOKEN": "abc"}):
        with pytest.raises(StoreError, match="expected USD2KG_STORE_USER with USD2KG_STORE_PASSWORD, or"):
            read_credentials(wrong)


def test_a_server_that_is_not_there_is_one_line():
    pauses: list[float] = []
    address = f"http://127.0.0.1:{free_port()}"
    with pytest.raises(StoreError, match=r"cannot be reached .*, 5 times; try again later"):
        HttpClient(sleep=pauses.append).send(HttpRequest("GET", address))
    assert len(pauses) == 4
    for pause, longest in zip(pauses, (0.5, 1, 2, 4), strict=True):
        assert longest / 2 <= pause <= longest


def test_the_wait_that_a_server_asks_for_is_kept_up_to_a_limit():
    pauses: list[float] = []
    answers = ["503 7", "429 100000", "503 Fri, 31 Dec 1999 23:59:59 GMT", "503 soon"]
    with way_to("http://127.0.0.1:1") as way:
        way.fault = lambda *_: answers.pop(0) if answers else "204"
        assert HttpClient(sleep=pauses.append).send(HttpRequest("GET", way.address)).status == 204
    assert pauses[:3] == [7, 30, 0]
    assert 2 <= pauses[3] <= 4


def test_what_must_not_be_done_twice_is_not_sent_twice():
    with way_to("http://127.0.0.1:1") as way:
        way.fault = lambda *_: "500"
        with pytest.raises(OutcomeUnknownError, match="it is not known what was done"):
            HttpClient(sleep=lambda _: None).send(HttpRequest("POST", way.address, b"x", is_idempotent=False))
        assert len(way.seen) == 1


def test_credentials_follow_no_redirect():
    with way_to("http://127.0.0.1:1") as elsewhere, way_to("http://127.0.0.1:1") as way:
        way.fault = lambda *_: f"307 {elsewhere.address}/x?secret=1"
        elsewhere.fault = lambda *_: "204"
        with pytest.raises(
            StoreError, match=r"redirects to http://127\.0\.0\.1:\d+/x, which is not followed; name that"
        ):
            HttpClient("Bearer abc").send(HttpRequest("POST", way.address, b"x"))
        assert way.seen[0][2]["Authorization"] == "Bearer abc"
        assert elsewhere.seen == []


def test_a_wrong_address_is_named():
    with way_to("http://127.0.0.1:1") as way:
        way.fault = lambda *_: "404"
        with pytest.raises(StoreError, match=r"takes no SPARQL query, nor does http.*/query; check the address"):
            open_remote(way.address).check()


def test_a_server_that_says_nothing_is_given_up():
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        silent.listen()
        client = HttpClient(timeout_s=0.2, sleep=lambda _: None)
        with pytest.raises(StoreError, match=r"the connection broke \(timed out\), 5 times"):
            client.send(HttpRequest("GET", f"http://127.0.0.1:{silent.getsockname()[1]}/"))


@contextmanager
def answering(body: bytes, headers: dict[str, str]) -> Iterator[str]:
    """Run a server that gives the same answer to all."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            self.rfile.read(int(self.headers.get("Content-Length") or 0))
            self.send_response(200)
            for name, value in {"Content-Length": str(len(body)), **headers}.items():
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(body)

        do_HEAD = do_POST  # noqa: N815

        def log_message(self, *_: object) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Handler) as server:
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/query"
        finally:
            server.shutdown()
            thread.join()


def test_an_answer_that_unpacks_to_too_much_is_not_unpacked(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(http_client, "_LARGEST", 3 << 20)
    for size, is_fine in ((3 << 20, True), ((3 << 20) + 1, False)):
        with answering(gzip.compress(bytes(size)), {"Content-Encoding": "gzip"}) as url:
            client = HttpClient(sleep=lambda _: None)
            if is_fine:
                assert client.send(HttpRequest("POST", url, b"x")).body == bytes(size)
                continue
            with pytest.raises(StoreError, match="the server's answer is over 3 MiB; ask for less of it"):
                client.send(HttpRequest("POST", url, b"x"))


@pytest.mark.parametrize("headers", [{"Content-Length": "999"}, {"Content-Encoding": "gzip"}])
def test_an_answer_that_is_cut_off_is_no_answer(headers: dict[str, str]):
    body = gzip.compress(b"x" * 100)[:-9] if "Content-Encoding" in headers else b"x" * 100
    with (
        answering(body, headers) as url,
        pytest.raises(StoreError, match="the connection broke"),
    ):
        HttpClient(sleep=lambda _: None).send(HttpRequest("POST", url, b"x"))


def test_a_redirect_to_nowhere_is_one_line():
    with way_to("http://127.0.0.1:1") as way:
        way.fault = lambda *_: "302 http://[x/?S3CRET"
        with pytest.raises(StoreError, match=r"redirects to http://\[x/, which is not followed"):
            HttpClient().send(HttpRequest("POST", way.address, b"x"))


@pytest.mark.parametrize(
    "answer",
    [
        b'{"head":{},"boolean":true}',
        b'{"head":{"vars":["x"]},"results":{"bindings":[{"x":{"type":"literal","value":"a"}}]}}',
        b'{"head":{"vars":["n"]},"results":{"bindings":[{"n":{"type":"literal","value":"abc"}}]}}',
        b'{"head":{"vars":["n"]},"results":{"bindings":[]}}',
        b'{"head":' + b"[" * 200_000,
    ],
)
def test_an_answer_to_another_question_is_one_line(answer: bytes, small: NamedGraph):
    with answering(answer, {"Content-Type": "application/sparql-results+json"}) as url:
        store = open_remote(url, update=url, data=url)
        graph = StoredGraph("urn:x", "", True)
        with pytest.raises(StoreError, match=r"where a number was asked for|neither SPARQL's JSON nor N-Triples"):
            graph.count_triples(store.select)
        with pytest.raises(StoreError, match=r"answers with other columns|where a number|neither SPARQL's JSON"):
            store.load(small)


def test_credentials_that_a_server_sends_back_are_not_shown():
    with way_to("http://127.0.0.1:1") as way:
        way.fault = lambda *_: "302 http://my.lab/x"
        with pytest.raises(StoreError) as error:
            HttpClient("Bearer S3CRET").send(HttpRequest("POST", f"{way.address}?S3CRET", b"x"))
    assert "S3CRET" not in str(error.value)
    assert http_client._without("Bearer S3CRET", "you sent Bearer S3CRET") == "you sent Bearer …"
