"""Requests are retried if that is safe, and messages contain no secrets."""

import gzip
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from tests.stores.conftest import open_remote
from tests.stores.servers import free_port, proxy_to
from usd2kg.errors import StoreError
from usd2kg.stores import NamedGraph
from usd2kg.stores.http_client import HttpRequest, OutcomeUnknownError, SparqlClient
from usd2kg.stores.named_graphs import StoredGraph
from usd2kg.stores.server_addresses import check_address, read_credentials, redact_address
from usd2kg.stores.store_limits import HttpLimits


@pytest.mark.parametrize(
    "url",
    [
        "https://user:S3CRET@my.lab/ds",
        "http://user:S3CRET@host:notaport/",
        "http://user:S3CRET/x@host",
        "http://user:S3[CRET@host",
        "http://user:S3?CRET@host",
        "http://user:S3#CRET@host",
        "http://user:x@S3CRET/x@host",
        "user:S3CRET@http://host",
    ],
)
def test_rejects_a_password_in_an_address_without_showing_it(url: str):
    with pytest.raises(StoreError, match="its address contains a user or password") as error:
        check_address(url)
    for secret in ("S3", "CRET", "user:"):
        assert secret not in str(error.value)


def test_does_not_show_query_strings():
    assert redact_address("http://my.lab/ds?key=S3CRET") == "http://my.lab/ds"
    with pytest.raises(StoreError, match=r"store 'http://my\.lab/é': is not a server address"):
        check_address("http://my.lab/é?key=S3CRET")
    with proxy_to("http://127.0.0.1:1") as proxy:
        proxy.fault = lambda *_: "404"
        with pytest.raises(StoreError, match="is not a SPARQL endpoint") as error:
            open_remote(f"{proxy.address}/ds?key=S3CRET").check()
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
def test_rejects_credentials_that_no_header_can_contain(given: dict[str, str], name: str):
    with pytest.raises(StoreError, match=f"^USD2KG_STORE_{name}: contains ") as error:
        read_credentials({f"USD2KG_STORE_{key}": value for key, value in given.items()})
    assert "S3" not in str(error.value)


@pytest.mark.parametrize("url", ["ftp://my.lab/", "http://", "http://my.lab:99999/", "http://my lab/", "http://[::1"])
def test_rejects_malformed_addresses(url: str):
    with pytest.raises(StoreError, match="is not a server address; expected one like http://localhost:7878"):
        check_address(url)


def test_reads_credentials_from_the_environment():
    # The example of RFC 7617, section 2.
    given = {"USD2KG_STORE_USER": "Aladdin", "USD2KG_STORE_PASSWORD": "open sesame"}
    assert read_credentials(given) == "Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ=="
    assert read_credentials({"USD2KG_STORE_TOKEN": "abc"}) == "Bearer abc"
    assert read_credentials({}) is None
    for wrong in ({"USD2KG_STORE_USER": "a"}, {**given, "USD2KG_STORE_TOKEN": "abc"}):
        with pytest.raises(StoreError, match="expected USD2KG_STORE_USER with USD2KG_STORE_PASSWORD, or"):
            read_credentials(wrong)


def test_retries_an_unreachable_server_with_growing_pauses():
    pauses: list[float] = []
    address = f"http://127.0.0.1:{free_port()}"
    with pytest.raises(StoreError, match=r"is unreachable .*, 5 times; try again later"):
        SparqlClient(sleep=pauses.append).send(HttpRequest("GET", address))
    assert len(pauses) == 4
    for pause, longest in zip(pauses, (0.5, 1, 2, 4), strict=True):
        assert longest / 2 <= pause <= longest


def test_respects_retry_after_up_to_a_limit():
    pauses: list[float] = []
    answers = ["503 7", "429 100000", "503 Fri, 31 Dec 1999 23:59:59 GMT", "503 soon"]
    with proxy_to("http://127.0.0.1:1") as proxy:
        proxy.fault = lambda *_: answers.pop(0) if answers else "204"
        assert SparqlClient(sleep=pauses.append).send(HttpRequest("GET", proxy.address)).status == 204
    assert pauses[:3] == [7, 30, 0]
    assert 2 <= pauses[3] <= 4


def test_does_not_repeat_a_request_that_is_not_idempotent():
    with proxy_to("http://127.0.0.1:1") as proxy:
        proxy.fault = lambda *_: "500"
        with pytest.raises(OutcomeUnknownError, match="the outcome is unknown"):
            SparqlClient(sleep=lambda _: None).send(HttpRequest("POST", proxy.address, b"x", is_idempotent=False))
        assert len(proxy.requests) == 1


def test_does_not_follow_redirects():
    with proxy_to("http://127.0.0.1:1") as elsewhere, proxy_to("http://127.0.0.1:1") as proxy:
        proxy.fault = lambda *_: f"307 {elsewhere.address}/x?secret=1"
        elsewhere.fault = lambda *_: "204"
        with pytest.raises(
            StoreError, match=r"redirects to http://127\.0\.0\.1:\d+/x, which is not followed; use that address"
        ):
            SparqlClient("Bearer abc").send(HttpRequest("POST", proxy.address, b"x"))
        assert proxy.requests[0][2]["Authorization"] == "Bearer abc"
        assert elsewhere.requests == []


def test_times_out_on_a_silent_server():
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        silent.listen()
        client = SparqlClient(limits=HttpLimits(timeout_s=0.2), sleep=lambda _: None)
        with pytest.raises(StoreError, match=r"the connection broke \(timed out\), 5 times"):
            client.send(HttpRequest("GET", f"http://127.0.0.1:{silent.getsockname()[1]}/"))


@contextmanager
def answering(body: bytes, headers: dict[str, str], status: int = 200) -> Iterator[str]:
    """Run a server that gives the same response to all requests."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            self.rfile.read(int(self.headers.get("Content-Length") or 0))
            self.send_response(status)
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


def test_stops_decompressing_at_the_size_limit():
    limit = 3 << 20
    client = SparqlClient(limits=HttpLimits(max_response_bytes=limit), sleep=lambda _: None)
    with answering(gzip.compress(bytes(limit)), {"Content-Encoding": "gzip"}) as url:
        assert client.send(HttpRequest("POST", url, b"x")).body == bytes(limit)
    with (
        answering(gzip.compress(bytes(limit + 1)), {"Content-Encoding": "gzip"}) as url,
        pytest.raises(StoreError, match="the response is larger than 3 MiB; select fewer triples"),
    ):
        client.send(HttpRequest("POST", url, b"x"))


@pytest.mark.parametrize("headers", [{"Content-Length": "999"}, {"Content-Encoding": "gzip"}])
def test_rejects_truncated_responses(headers: dict[str, str]):
    body = gzip.compress(b"x" * 100)[:-9] if "Content-Encoding" in headers else b"x" * 100
    with (
        answering(body, headers) as url,
        pytest.raises(StoreError, match="the connection broke"),
    ):
        SparqlClient(sleep=lambda _: None).send(HttpRequest("POST", url, b"x"))


def test_reports_a_malformed_redirect():
    with proxy_to("http://127.0.0.1:1") as proxy:
        proxy.fault = lambda *_: "302 http://[x/?S3CRET"
        with pytest.raises(StoreError, match=r"redirects to http://\[x/, which is not followed"):
            SparqlClient().send(HttpRequest("POST", proxy.address, b"x"))


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
def test_rejects_responses_to_other_queries(answer: bytes, small: NamedGraph):
    with answering(answer, {"Content-Type": "application/sparql-results+json"}) as url:
        store = open_remote(url, update=url, data=url)
        graph = StoredGraph("urn:x", "", True)
        with pytest.raises(StoreError, match=r"expected a number|neither SPARQL results JSON nor N-Triples"):
            graph.count_triples(store.select)
        with pytest.raises(StoreError, match=r"has other columns|expected a number|neither SPARQL results JSON"):
            store.load(small)


def test_does_not_show_credentials_that_a_server_echoes():
    with (
        answering(b"you sent Bearer S3CRET", {}, status=400) as url,
        pytest.raises(StoreError, match=r"answers 400 \(you sent Bearer …\)"),
    ):
        SparqlClient("Bearer S3CRET").send(HttpRequest("POST", f"{url}?S3CRET", b"x"))
