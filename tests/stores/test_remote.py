"""Stores on servers: each scene is loaded atomically, even if connections break."""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pyoxigraph as ox
import pytest

from tests.stores.conftest import open_remote
from tests.stores.servers import Proxy, fuseki, proxy_to
from usd2kg.errors import GraphError, StoreError
from usd2kg.stores import NamedGraph, open_store, select_graphs
from usd2kg.stores.remote import RemoteStore

ALL = "SELECT ?g (COUNT(*) AS ?n) WHERE { GRAPH ?g { ?s ?p ?o } } GROUP BY ?g"


@pytest.fixture
def store(server: str) -> Iterator[RemoteStore]:
    """An empty store, emptied again after the test."""
    opened = open_remote(server)
    yield opened
    opened.update("DROP ALL")


@pytest.fixture
def proxy(server: str) -> Iterator[Proxy]:
    with proxy_to(server) as opened:
        yield opened


def sizes(store: RemoteStore) -> dict[str | None, int]:
    return {row["g"]: int(row["n"] or 0) for row in store.select(ALL)}


def is_same(store: RemoteStore, graph: NamedGraph) -> bool:
    """Return whether a server's graph is isomorphic to a graph."""
    sent = ox.Store()
    # A store normalises numbers: 0.5 becomes 5.0E-1.
    sent.extend(ox.Quad(*triple) for triple in graph.triples)
    first, second = ox.Dataset(store.fetch([graph.iri]).store), ox.Dataset(sent)
    for dataset in (first, second):
        dataset.canonicalize(ox.CanonicalizationAlgorithm.UNSTABLE)
    return first == second


def test_uploads_a_scene_in_chunks(store: RemoteStore, large: NamedGraph):
    store.load(large)
    assert sizes(store) == {large.iri: len(large.triples)}
    assert is_same(store, large)


def test_reloading_replaces_only_the_same_scene(
    store: RemoteStore, large: NamedGraph, small: NamedGraph, other: NamedGraph
):
    for graph in (other, large, large, small):
        store.load(graph)
    assert sizes(store) == {small.iri: len(small.triples), other.iri: len(other.triples)}
    assert is_same(store, small)


def test_lists_queries_and_removes_scenes(store: RemoteStore, large: NamedGraph, other: NamedGraph):
    store.load(large)
    store.load(other)
    store.update("INSERT DATA { GRAPH <urn:theirs> { <urn:x> u2k:primPath '/x' } }")
    assert [(graph.name, graph.count_objects(store.select)) for graph in store.graphs()] == [("k", 4), ("other", 2)]
    count = "SELECT (COUNT(?p) AS ?n) WHERE { ?o u2k:primPath ?p }"
    assert store.query(count, select_graphs(store, None)).values == ((6,),)
    assert store.query(count, select_graphs(store, "other")).values == ((2,),)
    assert store.fetch(select_graphs(store, "k")).ask(["on", "table"]).rows[0][0] == "Cup_1"
    store.remove(large.iri)
    assert [graph.iri for graph in store.graphs()] == [other.iri]


def test_uploads_by_updates_without_the_graph_store_protocol(store: RemoteStore, proxy: Proxy, large: NamedGraph):
    proxy.fault = lambda method, path, _: "404" if method == "HEAD" else None
    open_remote(proxy.address).load(large)
    assert not any("graph=" in path for _, path, _ in proxy.requests)
    assert is_same(store, large)


@pytest.mark.parametrize("status", ["500", "503 0", "429 1"])
def test_retries_transient_failures(store: RemoteStore, proxy: Proxy, large: NamedGraph, status: str):
    failed = []

    def fault(method: str, path: str, body: bytes) -> str | None:
        if "graph=urn" in path and method == "POST" and len(failed) < 2:
            failed.append(path)
            return status
        return None

    proxy.fault = fault
    open_remote(proxy.address).load(large)
    assert len(failed) == 2
    assert is_same(store, large)


@pytest.mark.parametrize("kind", ["cut before", "cut after"])
def test_a_chunk_whose_response_is_lost_is_stored_once(store: RemoteStore, proxy: Proxy, large: NamedGraph, kind: str):
    # Repeating a chunk would duplicate its blank nodes.
    parts = []

    def fault(method: str, path: str, body: bytes) -> str | None:
        if "graph=urn" in path and method == "POST":
            parts.append(path)
            return kind if len(parts) == 2 else None
        return None

    proxy.fault = fault
    open_remote(proxy.address).load(large)
    assert is_same(store, large)
    assert sizes(store) == {large.iri: len(large.triples)}


@pytest.mark.parametrize("kind", ["cut before", "cut after"])
def test_a_move_whose_response_is_lost_is_done_once(store: RemoteStore, proxy: Proxy, large: NamedGraph, kind: str):
    moves = []

    def fault(method: str, path: str, body: bytes) -> str | None:
        if body.startswith(b"MOVE"):
            moves.append(path)
            return kind if len(moves) == 1 else None
        return None

    proxy.fault = fault
    open_remote(proxy.address).load(large)
    assert len(moves) == (2 if kind == "cut before" else 1)
    assert is_same(store, large)


def test_a_failed_upload_leaves_only_the_old_graph(
    store: RemoteStore, proxy: Proxy, small: NamedGraph, large: NamedGraph
):
    store.load(small)
    proxy.fault = lambda method, path, body: "400" if b"Cup_2" in body else None
    with pytest.raises(StoreError, match=r"answers 400 \(Bad Request\); check the address"):
        open_remote(proxy.address).load(large)
    assert is_same(store, small)
    assert sizes(store) == {small.iri: len(small.triples)}


def test_detects_lost_triples(store: RemoteStore, proxy: Proxy, small: NamedGraph, large: NamedGraph):
    store.load(small)
    proxy.fault = lambda method, path, body: "204" if b"Cup_2" in body and "graph=urn" in path else None
    with pytest.raises(StoreError, match=r"holds \d+ of the \d+ triples sent .* unchanged"):
        open_remote(proxy.address).load(large)
    assert sizes(store) == {small.iri: len(small.triples)}


@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_a_killed_upload_leaves_the_old_graph_unchanged(
    store: RemoteStore, proxy: Proxy, small: NamedGraph, large: NamedGraph, tmp_path: Path
):
    store.load(small)
    arrived, done = threading.Event(), threading.Event()

    def fault(method: str, path: str, body: bytes) -> str | None:
        if body.startswith(b"MOVE"):
            arrived.set()
            done.wait(60)
            return "cut before"
        return None

    proxy.fault = fault
    file = tmp_path / "k.nt"
    ox.serialize(large.triples, str(file), format=ox.RdfFormat.N_TRIPLES)
    command = [sys.executable, "-m", "usd2kg", "store", "load", str(file), "--store", proxy.address]
    with subprocess.Popen(command) as process:
        assert arrived.wait(120)
        os.kill(process.pid, signal.SIGKILL)
    done.set()
    assert is_same(store, small)
    assert [graph.iri for graph in store.graphs()] == [small.iri]
    # The unfinished upload is not part of the queried union; a load a day later removes it.
    assert len(sizes(store)) == 3
    mark = "GRAPH <urn:usd2kg:staging> { ?s dcterms:created ?t }"
    store.update(
        f"DELETE {{ {mark} }} INSERT {{ {mark.replace('?t', '?old')} }} "
        f'WHERE {{ {mark} BIND("2020-01-01T00:00:00Z" AS ?old) }}'
    )
    store.load(large)
    assert sizes(store) == {large.iri: len(large.triples)}


def test_concurrent_writers_leave_one_complete_graph(store: RemoteStore, small: NamedGraph, large: NamedGraph):
    writers = [threading.Thread(target=open_remote(store.address).load, args=(g,)) for g in (small, large)]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    assert is_same(store, small) or is_same(store, large)
    assert len(sizes(store)) == 1


def test_reports_syntax_errors_of_the_server(store: RemoteStore):
    with pytest.raises(StoreError, match="answers 400"):
        store.update("INSERT NONSENSE")
    with pytest.raises(StoreError, match="answers 400"):
        store.query("SELECT * WHERE {", [])


def test_refuses_load_and_service(store: RemoteStore):
    with pytest.raises(GraphError, match="LOAD and SERVICE contact another server"):
        store.update("LOAD <http://127.0.0.1:9/x>")
    with pytest.raises(GraphError, match="SERVICE contacts another server"):
        store.query("SELECT * { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }", [])


def test_authenticates_at_a_real_server(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, small: NamedGraph, caplog: pytest.LogCaptureFixture
):
    (tmp_path / "users").write_text("robot: s3cret\n")
    with fuseki(tmp_path, f"--passwd={tmp_path / 'users'}", "--auth=basic") as address:
        with pytest.raises(StoreError, match=r"denies access \(401\); set USD2KG_STORE_USER") as refused:
            open_store(address).load(small)
        monkeypatch.setenv("USD2KG_STORE_USER", "robot")
        monkeypatch.setenv("USD2KG_STORE_PASSWORD", "wrong-one")
        with pytest.raises(StoreError, match=r"denies access \(401\)") as wrong:
            open_store(address).load(small)
        monkeypatch.setenv("USD2KG_STORE_PASSWORD", "s3cret")
        caplog.set_level("INFO")
        open_store(address).load(small)
        assert [graph.name for graph in open_store(address).graphs()] == ["k"]
    assert "wrong-one" not in str(refused.value) + str(wrong.value)
    assert "s3cret" not in caplog.text


def test_from_chooses_a_scene_of_the_server(store: RemoteStore, large: NamedGraph, other: NamedGraph):
    store.load(large)
    store.load(other)
    query = f"SELECT (COUNT(*) AS ?n) FROM <{other.iri}> WHERE {{ ?s ?p ?o }}"
    assert store.query(query, [large.iri, other.iri]).values == ((len(other.triples),),)
