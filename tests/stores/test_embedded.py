"""Store folders: atomic loads, one writer at a time, stable blank nodes."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyoxigraph as ox
import pytest

from usd2kg.errors import GraphError, StoreError
from usd2kg.folder_lock import lock_exclusive, lock_shared
from usd2kg.stores import EmbeddedStore, NamedGraph, open_graph, replacement, select_graphs
from usd2kg.stores.named_graph import stored_quads
from usd2kg.stores.pending import PENDING_NAME, write_pending
from usd2kg.stores.store_limits import FolderLimits

SHORT = FolderLimits(lock_wait_s=0.1)


def held(folder: Path) -> set[str]:
    return {str(quad) for quad in ox.Store.read_only(str(folder))}


def triples(graph: NamedGraph) -> int:
    return len(graph.triples)


def test_stores_and_queries_a_scene(tmp_path: Path, large: NamedGraph):
    store = EmbeddedStore(tmp_path / "store")
    store.load(large)
    (graph,) = store.graphs()
    assert (graph.iri, graph.name, graph.is_scene) == ("https://my.lab/k", "k", True)
    assert (graph.count_objects(store.select), graph.count_triples(store.select)) == (4, triples(large))
    assert [row[0] for row in open_graph(str(tmp_path / "store")).ask(["on", "table"]).rows] == [
        "Cup_1",
        "Cup_2",
        "Mug",
    ]


def test_reloading_gives_the_same_nodes(tmp_path: Path, large: NamedGraph, other: NamedGraph):
    store = EmbeddedStore(tmp_path)
    store.load(large)
    store.load(other)
    before = held(tmp_path)
    store.load(large)
    assert held(tmp_path) == before
    assert len(before) == triples(large) + triples(other)


def test_keeps_blank_nodes_of_two_graphs_apart(tmp_path: Path):
    store = EmbeddedStore(tmp_path)
    blank = ox.Triple(ox.BlankNode("x"), ox.NamedNode("urn:p"), ox.BlankNode("y"))
    store.load(NamedGraph("urn:a", (blank,)))
    store.load(NamedGraph("urn:b", (blank,)))
    nodes = {term for quad in ox.Store.read_only(str(tmp_path)) for term in (quad.subject, quad.object)}
    assert len(nodes) == 4


def test_replaces_a_graph_completely(tmp_path: Path, small: NamedGraph, large: NamedGraph):
    store = EmbeddedStore(tmp_path)
    store.load(large)
    store.load(small)
    assert len(held(tmp_path)) == triples(small)
    store.remove(small.iri)
    assert held(tmp_path) == set()


KILLED = """
import os, signal, sys
from pathlib import Path
from usd2kg.stores import EmbeddedStore, read_named_graph, replacement
graph = read_named_graph(Path(sys.argv[2]))
def die(*given, **kept):
    is_log = "LOG" in str(given[0])
    if not (is_log or kept.get("missing_ok")): os.kill(os.getpid(), signal.SIGKILL)
place = {"unnamed": (Path, "replace"), "named": (EmbeddedStore, "_finish"), "emptied": (replacement, "_add_missing"),
    "full": (Path, "unlink")}[sys.argv[3]]
setattr(*place, die)
EmbeddedStore(sys.argv[1]).load(graph)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
@pytest.mark.parametrize("is_alone", [True, False])
@pytest.mark.parametrize("moment", ["unnamed", "named", "emptied", "full"])
def test_the_next_reader_finishes_a_killed_load(
    tmp_path: Path, small: NamedGraph, large: NamedGraph, other: NamedGraph, moment: str, is_alone: bool
):
    folder, file = tmp_path / "store", tmp_path / "k.nt"
    EmbeddedStore(folder).load(small)
    if not is_alone:
        EmbeddedStore(folder).load(other)
    ox.serialize(large.triples, str(file), format=ox.RdfFormat.N_TRIPLES)
    done = subprocess.run([sys.executable, "-c", KILLED, str(folder), str(file), moment], check=False)
    assert done.returncode == -signal.SIGKILL
    assert list(folder.glob(f"{PENDING_NAME}*"))
    found = EmbeddedStore(folder).fetch([large.iri])
    # The load is committed when the pending file has its name.
    assert len(found) == (triples(small) if moment == "unnamed" else triples(large))
    EmbeddedStore(folder).load(large)
    assert len(held(folder)) == triples(large) + (0 if is_alone else triples(other))
    assert not list(folder.glob("usd2kg.pending*"))


@pytest.mark.parametrize("is_alone", [True, False])
@pytest.mark.parametrize("kept", [0, 30, 95, 100])
@pytest.mark.parametrize("collides", [False, True])
def test_a_graph_is_replaced_whatever_it_has_in_common_with_the_new_one(
    tmp_path: Path, other: NamedGraph, kept: int, is_alone: bool, collides: bool, monkeypatch: pytest.MonkeyPatch
):
    if collides:
        monkeypatch.setattr(replacement, "_hashes", lambda quads: np.zeros(len(quads), np.int64))
    store = EmbeddedStore(tmp_path)
    if not is_alone:
        store.load(other)

    def graph(start: int) -> NamedGraph:
        node = ox.NamedNode
        stated = (
            ox.Triple(ox.BlankNode(f"b{i}"), node("urn:p"), ox.Literal(str(i))) for i in range(start, start + 100)
        )
        return NamedGraph("urn:g", (*stated, ox.Triple(node("urn:s"), node("urn:p"), ox.BlankNode("b50"))))

    store.load(graph(0))
    store.load(graph(100 - kept))
    rest = set() if is_alone else set(map(str, stored_quads(other)))
    assert held(tmp_path) == rest | set(map(str, stored_quads(graph(100 - kept))))


KILLED_FIRST_LOAD = """
import sys
import pyoxigraph as ox
from usd2kg.stores import EmbeddedStore, NamedGraph
node = ox.NamedNode
triples = tuple(ox.Triple(node(f"urn:o{i}"), node("urn:p"), ox.BlankNode(f"b{i}")) for i in range(40_000))
print("ready", flush=True)
EmbeddedStore(sys.argv[1]).load(NamedGraph("urn:g", triples))
print("loaded", flush=True)
sys.stdin.read()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_a_first_load_killed_at_any_moment_leaves_all_or_nothing(tmp_path: Path, small: NamedGraph):
    counts = []
    for number, seconds in enumerate((0.05, 0.2, 0.4, None)):
        folder = tmp_path / str(number)
        EmbeddedStore(folder).load(small)
        command = [sys.executable, "-c", KILLED_FIRST_LOAD, str(folder)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as loading:
            assert loading.stdin is not None and loading.stdout is not None
            assert loading.stdout.readline() == "ready\n"
            if seconds is None:
                assert loading.stdout.readline() == "loaded\n"
            else:
                time.sleep(seconds)
            loading.kill()
        store = EmbeddedStore(folder)
        counts.append(len(store.fetch(["urn:g"])))
        assert len(store.fetch([small.iri])) == triples(small)
        store.check()
        assert not list(folder.glob("bulk-*")) + list(folder.glob(f"{PENDING_NAME}*"))
    assert set(counts) <= {0, 40_000}
    assert (counts[0], counts[-1]) == (0, 40_000)


def test_a_load_that_fails_halfway_changes_nothing(tmp_path: Path, small: NamedGraph):
    store = EmbeddedStore(tmp_path)
    store.load(small)
    good = ox.Triple(ox.NamedNode("urn:o"), ox.NamedNode("urn:p"), ox.Literal("x"))
    with pytest.raises(AttributeError):
        store.load(NamedGraph("urn:g", (good,) * 1000 + (None,)))  # type: ignore[arg-type]
    assert held(tmp_path) == {str(quad) for quad in stored_quads(small)}


def test_a_second_writer_waits_and_gives_up(tmp_path: Path, small: NamedGraph):
    EmbeddedStore(tmp_path).load(small)
    with (
        lock_exclusive(tmp_path, 1),
        pytest.raises(StoreError, match=r"another process still uses it after 0.1 s"),
    ):
        EmbeddedStore(tmp_path, limits=SHORT).load(small)
    with lock_shared(tmp_path, 1):
        assert len(EmbeddedStore(tmp_path, limits=SHORT).graphs()) == 1
        with pytest.raises(StoreError, match="wait for it, then try again"):
            EmbeddedStore(tmp_path, limits=SHORT).load(small)
    EmbeddedStore(tmp_path, limits=SHORT).load(small)


def test_reports_another_program_that_uses_the_folder(tmp_path: Path, small: NamedGraph):
    EmbeddedStore(tmp_path).load(small)
    opened = ox.Store(str(tmp_path))
    with pytest.raises(StoreError, match="is in use by another program, such as an Oxigraph server"):
        EmbeddedStore(tmp_path).load(small)
    del opened


def test_rejects_a_folder_with_other_files(tmp_path: Path, small: NamedGraph):
    (tmp_path / "thesis.tex").write_text("mine")
    with pytest.raises(StoreError, match="contains other files; expected a new folder or a store"):
        EmbeddedStore(tmp_path).load(small)
    with pytest.raises(StoreError, match="is a file; expected a folder"):
        EmbeddedStore(tmp_path / "thesis.tex").load(small)
    with pytest.raises(StoreError, match="is not a store; expected a folder that usd2kg build"):
        EmbeddedStore(tmp_path).graphs()
    assert list(tmp_path.iterdir()) == [tmp_path / "thesis.tex"]


def test_updates_are_atomic(tmp_path: Path, small: NamedGraph):
    store = EmbeddedStore(tmp_path)
    store.load(small)
    with pytest.raises(GraphError, match="update: not valid SPARQL"):
        store.update("DELETE NONSENSE")
    with pytest.raises(GraphError, match="nothing was changed"):
        store.update(f"DROP GRAPH <{small.iri}> ; CREATE GRAPH <urn:x> ; CREATE GRAPH <urn:x>")
    with pytest.raises(GraphError, match="LOAD and SERVICE contact another server"):
        store.update("LOAD <http://127.0.0.1:9/>")
    assert len(held(tmp_path)) == triples(small)
    store.update(f"INSERT DATA {{ GRAPH <{small.iri}> {{ <urn:x> u2k:note 'new' }} }}")
    assert len(held(tmp_path)) == triples(small) + 1


def test_selects_scenes_by_name_label_or_iri(tmp_path: Path, small: NamedGraph, other: NamedGraph):
    store = EmbeddedStore(tmp_path)
    with pytest.raises(StoreError, match="is not a store"):
        select_graphs(store, None)
    store.load(small)
    store.load(other)
    assert select_graphs(store, None) == ["https://my.lab/k", "https://my.lab/other"]
    for name in ("k", "https://my.lab/k", "https://my.lab/k/"):
        assert select_graphs(store, name) == ["https://my.lab/k"]
    with pytest.raises(GraphError, match=r"has no graph 'x'; expected one of https://my.lab/k, https://my.lab/other"):
        select_graphs(store, "x")
    with pytest.raises(GraphError, match=r"is ambiguous: https://my.lab/k, https://my.lab/other; expected the IRI"):
        select_graphs(store, store.graphs()[0].label)


@pytest.mark.parametrize("damage", ["garbage", "letters", "cut", "cut between triples", "folder", "other graph"])
def test_sets_a_damaged_load_aside_and_reads_the_store(
    tmp_path: Path, small: NamedGraph, caplog: pytest.LogCaptureFixture, damage: str
):
    store, pending = EmbeddedStore(tmp_path), tmp_path / PENDING_NAME
    store.load(small)
    write_pending(tmp_path, ox.NamedNode(small.iri), stored_quads(small))
    lines = pending.read_bytes().splitlines(keepends=True)
    damaged = {
        "garbage": b"not a graph\n",
        "letters": b"\xff\xfe\n",
        "cut": lines[0] + lines[1][:20],
        "cut between triples": b"".join(lines[:3]),
        "other graph": b"# <urn:x>\n" + b"".join(lines[1:]),
    }
    pending.unlink()
    if damage == "folder":
        pending.mkdir()
    else:
        pending.write_bytes(damaged[damage])
    assert len(store.fetch([small.iri])) == triples(small)
    assert "an interrupted load left a damaged file" in caplog.text
    assert "load that scene again" in caplog.text
    assert not pending.exists()
    assert len(list(tmp_path.glob("usd2kg.damaged.*"))) == 1


@pytest.mark.parametrize("name", ["CURRENT", "MANIFEST-*", "*.sst"])
def test_reports_a_damaged_store_in_one_line(tmp_path: Path, small: NamedGraph, name: str):
    store = EmbeddedStore(tmp_path)
    store.load(small)
    for path in tmp_path.glob(name):
        path.write_bytes(b"junk\n")
    for use in (store.graphs, store.check):
        with pytest.raises(StoreError, match=r"the store is damaged .*; restore the folder from a backup, or") as error:
            use()
        assert "\n" not in str(error.value)


def test_accepts_an_incomplete_store_but_no_other_files(tmp_path: Path, small: NamedGraph):
    (tmp_path / "usd2kg.lock").touch()
    (tmp_path / "thesis.tex").write_text("mine")
    with pytest.raises(StoreError, match="contains other files; expected a new folder or a store"):
        EmbeddedStore(tmp_path).load(small)
    assert {path.name for path in tmp_path.iterdir()} == {"thesis.tex", "usd2kg.lock"}
    (tmp_path / "thesis.tex").rename(tmp_path / "OPTIONS-000007")
    EmbeddedStore(tmp_path).load(small)
    assert len(held(tmp_path)) == triples(small)


def test_from_chooses_a_scene_of_the_store(tmp_path: Path, large: NamedGraph, other: NamedGraph):
    store = EmbeddedStore(tmp_path)
    store.load(large)
    store.load(other)
    everything = select_graphs(store, None)
    for graph in (large, other):
        query = f"SELECT (COUNT(*) AS ?n) FROM <{graph.iri}> WHERE {{ ?s ?p ?o }}"
        assert store.query(query, everything).values == ((triples(graph),),)
