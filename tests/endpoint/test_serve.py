"""The endpoint as a running server, queried over HTTP."""

import json
import os
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import urlencode

import pyoxigraph as ox
import pytest
from starlette.testclient import TestClient

from tests.endpoint.conftest import ASK, HOSTILE, PATHS, ask, request
from usd2kg.endpoint import EndpointLimits, serving
from usd2kg.endpoint.application import make_app
from usd2kg.endpoint.open_connections import Connections
from usd2kg.endpoint.pool import WorkerPool
from usd2kg.stores import open_store

CROSS = "SELECT (COUNT(*) AS ?n) { ?a ?b ?c . ?d ?e ?f . ?g ?h ?i . ?j ?k ?l }"


def test_accepts_queries_by_get_form_and_body(port: int):
    form = urlencode({"query": ASK}).encode()
    replies = [
        ask(port, ASK),
        request(port, "POST", "/sparql", form, Content_Type="application/x-www-form-urlencoded"),
        request(port, "POST", "/sparql", ASK.encode(), Content_Type="application/sparql-query; charset=utf-8"),
    ]
    for reply in replies:
        assert (reply.status, json.loads(reply.body)) == (200, {"head": {}, "boolean": True})
        assert reply.headers["content-type"] == "application/sparql-results+json"


@pytest.mark.parametrize("media_type", ["application/sparql-results+json", "application/sparql-results+xml"])
def test_tables_parse_with_pyoxigraph(port: int, media_type: str):
    query = "SELECT ?o ?label ?n { ?o u2k:primPath ?p ; rdfs:label ?label . OPTIONAL { ?o <urn:none> ?n } } ORDER BY ?p"
    reply = ask(port, query, Accept=media_type)
    assert reply.headers["content-type"] == media_type
    rdf_format = ox.QueryResultsFormat.JSON if media_type.endswith("json") else ox.QueryResultsFormat.XML
    found = ox.parse_query_results(reply.body, format=rdf_format)
    assert isinstance(found, ox.QuerySolutions)
    rows = list(found)
    assert len(rows) == 4
    assert {row["label"].value for row in rows} == {"Table", "Mug", HOSTILE}
    assert all(row["n"] is None for row in rows)


def test_csv_and_tsv_follow_the_standard(port: int):
    query = "SELECT * { VALUES (?a ?b) { ('x,\"y\"' 1) (<urn:z> UNDEF) ('tab\\there'@en true) } }"
    assert ask(port, query, Accept="text/csv").body == 'a,b\r\n"x,""y""",1\r\nurn:z,\r\ntab\there,true\r\n'
    tsv = ask(port, query, Accept="text/tab-separated-values").body.splitlines()
    assert tsv[:3] == ["?a\t?b", '"x,\\"y\\""\t"1"^^<http://www.w3.org/2001/XMLSchema#integer>', "<urn:z>\t"]
    assert tsv[3].startswith('"tab\\there"@en\t')


@pytest.mark.parametrize("kind", ["text/turtle", "application/n-triples", "application/rdf+xml", "application/ld+json"])
def test_graphs_parse_with_pyoxigraph(port: int, kind: str):
    reply = ask(port, "CONSTRUCT { ?o u2k:primPath ?p } WHERE { ?o u2k:primPath ?p }", Accept=kind)
    assert reply.headers["content-type"].partition(";")[0] == kind
    assert len(list(ox.parse(reply.body, format=ox.RdfFormat.from_media_type(kind)))) == 4


def test_graph_parameters_select_the_dataset(port: int):
    a, b = "https://my.lab/a", "https://my.lab/b"
    assert len(json.loads(ask(port, PATHS).body)["results"]["bindings"]) == 4
    assert ask(port, PATHS, ("default-graph-uri", a), Accept="text/csv").body == "path\r\n/Mug\r\n/Table\r\n"
    graphs = "SELECT DISTINCT ?g { GRAPH ?g { ?s ?p ?o } } ORDER BY ?g"
    assert ask(port, graphs, Accept="text/csv").body == f"g\r\n{a}\r\n{b}\r\n"
    assert ask(port, graphs, ("named-graph-uri", b), Accept="text/csv").body == f"g\r\n{b}\r\n"
    assert ask(port, ASK, ("named-graph-uri", b), Accept="text/csv").body == "false\n"
    assert ask(port, ASK, ("default-graph-uri", "no iri")).status == 400


@pytest.mark.parametrize(
    ("query", "text"),
    [
        ("SELECT * {", "not valid SPARQL"),
        ("INSERT DATA { <urn:a> <urn:b> 1 }", "expected SELECT, ASK, CONSTRUCT or DESCRIBE"),
        ("LOAD <http://127.0.0.1:9/>", "SERVICE contacts another server"),
        ("SELECT * { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }", "SERVICE contacts another server"),
        (" ", "expected one query"),
    ],
)
def test_a_refused_query_is_400_with_one_line(port: int, query: str, text: str):
    reply = ask(port, query)
    assert (reply.status, text in reply.body, reply.body.count("\n")) == (400, True, 1)
    assert json.loads(ask(port, query, Accept="application/json").body)["error"] == reply.body.rstrip("\n")


def test_other_refusals_have_the_status_of_the_protocol(port: int):
    assert ask(port, ASK, Accept="image/png").status == 406
    assert request(port, "POST", "/sparql", b"x", Content_Type="text/plain").status == 415
    assert (
        request(port, "POST", "/sparql", b"update=CLEAR+ALL", Content_Type="application/x-www-form-urlencoded").status
        == 400
    )
    assert request(port, "PUT", "/sparql", b"x").status == 405
    assert request(port, "POST", "/sparql", b"x" * 2001, Content_Type="application/sparql-query").status == 413
    assert ask(port, ASK, ("query", ASK)).status == 400


def test_cuts_answers_and_reports_the_number_of_rows(port: int):
    reply = ask(port, "SELECT * { ?s ?p ?o }", Accept="text/csv")
    assert (len(reply.body.splitlines()), reply.headers["x-sparql-maxrows"]) == (51, "50")
    assert "x-sparql-maxrows" not in ask(port, PATHS).headers
    graph = ask(port, "CONSTRUCT WHERE { ?s ?p ?o }", Accept="application/n-triples")
    assert (len(graph.body.splitlines()), graph.headers["x-sparql-maxrows"]) == (50, "50")


def test_stops_a_long_query_while_others_are_answered(port: int):
    with ThreadPoolExecutor(2) as threads:
        start = time.monotonic()
        hostile = threads.submit(ask, port, CROSS)
        time.sleep(0.3)
        assert ask(port, ASK).status == 200
        quick = time.monotonic() - start
        reply = hostile.result()
    assert quick < 2
    assert (reply.status, "took more than 2 s and was stopped" in reply.body) == (503, True)
    assert ask(port, ASK).status == 200


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the memory limit needs procfs")
def test_stops_a_query_that_exceeds_its_memory(port: int):
    grow = "BIND(CONCAT(?x0, ?x0, ?x0, ?x0, ?x0, ?x0, ?x0, ?x0) AS ?x1) "
    steps = "".join(grow.replace("x1", f"x{i + 1}").replace("x0", f"x{i}") for i in range(9))
    reply = ask(port, f"SELECT (STRLEN(?x9) AS ?n) {{ BIND('0123456789' AS ?x0) {steps} }}")
    assert (reply.status, "was stopped; simplify it" in reply.body) == (503, True)
    assert ask(port, ASK).status == 200


def test_refuses_what_other_sites_embed_but_not_links_to_the_page(port: int):
    cross = {"Sec_Fetch_Site": "cross-site", "Sec_Fetch_Mode": "no-cors"}
    assert ask(port, ASK, **cross).status == 403
    assert request(port, "GET", "/about", **cross).status == 403
    assert ask(port, ASK, **{**cross, "Sec_Fetch_Mode": "navigate"}).status == 403
    assert ask(port, ASK, Sec_Fetch_Site="same-origin").status == 200
    assert ask(port, ASK, Sec_Fetch_Site="none").status == 200
    assert request(port, "GET", "/", **{**cross, "Sec_Fetch_Mode": "navigate"}).status == 200


def test_refuses_unknown_hosts_and_other_origins(port: int):
    assert ask(port, ASK, Host="evil.example").status == 403
    assert ask(port, ASK, Host="127.0.0.1.evil.example").status == 403
    for host in ("localhost:1", "[::1]", "graphs.lab", "127.0.0.1"):
        assert ask(port, ASK, Host=host).status == 200
    other = ask(port, ASK, Origin="https://evil.example")
    assert (other.status, "access-control-allow-origin" in other.headers) == (403, False)
    assert ask(port, ASK, Origin=f"http://127.0.0.1:{port}").status == 200


def test_sends_security_headers(port: int):
    page = request(port, "GET", "/")
    policy = page.headers["content-security-policy"]
    assert policy.startswith("default-src 'none'")
    assert "unsafe" not in policy
    assert page.headers["x-content-type-options"] == "nosniff"
    assert ask(port, ASK).headers["content-security-policy"] == "default-src 'none'; frame-ancestors 'none'"
    assert "http://" not in page.body


def test_without_the_built_page_the_root_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    monkeypatch.setattr("usd2kg.endpoint.app_files.files", lambda _: tmp_path)
    limits, connections = EndpointLimits(), Connections()
    pool = WorkerPool(tmp_path, limits, None)
    files = serving.page_files()
    app = make_app(pool, limits, connections, files=files, title="g", graphs=(), examples=())
    reply = TestClient(app, base_url="http://localhost").get("/")
    assert (reply.status_code, reply.headers["content-type"]) == (200, "text/plain; charset=utf-8")
    assert "SPARQL 1.1 endpoint, at /sparql" in reply.text and "make web" in reply.text


def test_returns_a_service_description(port: int):
    reply = request(port, "GET", "/sparql", Accept="text/turtle")
    text = {
        str(triple.predicate.value).rpartition("#")[2] for triple in ox.parse(reply.body, format=ox.RdfFormat.TURTLE)
    }
    assert {"endpoint", "supportedLanguage", "resultFormat"} <= text
    assert request(port, "GET", "/sparql", Accept="text/html").headers["location"] == "/"


def test_remote_store_reads_the_endpoint(port: int):
    store = open_store(f"http://127.0.0.1:{port}")
    assert [graph.name for graph in store.graphs()] == ["a", "b"]


def test_every_example_of_the_page_runs(port: int):
    examples = json.loads(request(port, "GET", "/about").body)["examples"]
    assert len(examples) > 8
    assert [(e["title"], r.body) for e in examples if (r := ask(port, e["query"])).status != 200] == []


def test_listens_on_ipv4_loopback_only_by_default(port: int):
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(f"http://[::1]:{port}/", timeout=2)


@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_it_and_removes_the_copy(tmp_path: Path, sent: signal.Signals):
    graph, temporary = tmp_path / "a.nt", tmp_path / "temporary"
    graph.write_text("<urn:a> <urn:b> <urn:c> .\n")
    temporary.mkdir()
    command = [sys.executable, "-m", "usd2kg", "serve", str(graph), "--port", "0", "--workers", "1"]
    settings = {**os.environ, "TMPDIR": str(temporary)}
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=settings) as process:
        assert process.stderr is not None
        assert process.stderr.readline().startswith(f"serves {graph} at http://127.0.0.1:")
        assert len(list(temporary.iterdir())) == 1
        process.send_signal(sent)
        assert process.wait(60) == 0
        assert process.stderr.read() == "stopped\n"
    assert list(temporary.iterdir()) == []


def test_from_is_honoured_unless_the_request_has_a_dataset(port: int):
    query = "SELECT ?l FROM <https://my.lab/a> { ?o u2k:primPath ?p ; rdfs:label ?l } ORDER BY ?l"
    assert ask(port, query, Accept="text/csv").body.splitlines() == ["l", "Mug", "Table"]
    other = ask(port, query, ("default-graph-uri", "https://my.lab/b"), Accept="text/csv")
    assert "Mug" not in other.body
