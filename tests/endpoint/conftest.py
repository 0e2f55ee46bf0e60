"""A running endpoint."""

import subprocess
import sys
import time
from collections.abc import Iterator
from http.client import HTTPConnection
from typing import NamedTuple
from urllib.parse import urlencode

import pyoxigraph as ox
import pytest

from tests.graph.records import build_graph, thing
from usd2kg.ontology import TBox
from usd2kg.stores import EmbeddedStore, make_named_graph

HOSTILE = "<script>document.title='owned'</script><img src=x onerror=\"document.title='owned'\">'\"\t=1+1"
ASK = "ASK { ?s ?p ?o }"
PATHS = "SELECT ?path { ?o u2k:primPath ?path } ORDER BY ?path"


class Reply(NamedTuple):
    status: int
    headers: dict[str, str]
    body: str


@pytest.fixture(scope="module")
def port(home_tbox: TBox, tmp_path_factory: pytest.TempPathFactory) -> Iterator[int]:
    """The port of an endpoint over two scenes, one with markup in an object's name."""
    folder = tmp_path_factory.mktemp("serve") / "store"
    store = EmbeddedStore(folder)
    table = (thing("/Table", (0, 0, 0), (1, 1, 1)), "Table")
    cups = [(thing(f"/{name}", (0.4, 0.4, 1), (0.1, 0.1, 0.1), name=name), "Cup") for name in ("Mug", HOSTILE)]
    for base, placed in (("https://my.lab/a/", [table, cups[0]]), ("https://my.lab/b/", [table, cups[1]])):
        store.load(make_named_graph(build_graph(home_tbox, placed, base=base)))
    # Also the label of a class, which sorts first.
    hostile = ox.Literal(HOSTILE)
    store.update(f"INSERT {{ GRAPH ?g {{ ?c rdfs:label {hostile} }} }} WHERE {{ GRAPH ?g {{ ?c rdfs:label 'cup' }} }}")
    options = ["--port", "0", "--time-limit", "2", "--max-rows", "50", "--max-body", "2000", "--memory-limit", "200"]
    command = [sys.executable, "-m", "usd2kg", "serve", str(folder), *options, "--allow-host", "graphs.lab"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        line = process.stderr.readline()
        assert "serves " in line, line
        found = int(line.partition("http://127.0.0.1:")[2].partition("/")[0])
        # It accepts connections when its workers are ready.
        for _ in range(600):
            try:
                ask(found, ASK)
                break
            except OSError:
                time.sleep(0.1)
        yield found
        process.terminate()


def request(port: int, method: str, path: str, body: bytes | None = None, **headers: str) -> Reply:
    connection = HTTPConnection("127.0.0.1", port, timeout=60)
    connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
    reply = connection.getresponse()
    text = reply.read().decode()
    connection.close()
    return Reply(reply.status, {name.lower(): value for name, value in reply.getheaders()}, text)


def ask(port: int, query: str, *more: tuple[str, str], **headers: str) -> Reply:
    return request(port, "GET", f"/sparql?{urlencode([('query', query), *more])}", **headers)
