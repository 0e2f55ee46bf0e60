"""The cache of indexes of large graph files."""

import logging
import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

import usd2kg
from tests.kitchen import kitchen_graph
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError, StoreError
from usd2kg.folder_lock import lock_exclusive
from usd2kg.query import GraphStore, graph_cache, load_graph
from usd2kg.query.graph_cache import GRAPH_CACHE_VARIABLE
from usd2kg.query.lookup import object_columns
from usd2kg.query.questions import list_questions
from usd2kg.stores import EmbeddedStore, embedded, read_named_graph, view_scenes

GIVEN = {
    "thing": "barTable",
    "other": "toaster",
    "class": "cup",
    "position": "-1.5 0.4 1.1",
}


@pytest.fixture(scope="module", params=["soma", "plain"])
def kitchen(request, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The graph of the demo kitchen in both profiles."""
    path = tmp_path_factory.mktemp("kitchen") / "kitchen.ttl"
    graph = kitchen_graph(request.param)
    usd2kg.write_graph(graph, path)
    return path


@pytest.fixture
def cache(tmp_path: Path, monkeypatch) -> Path:
    """An empty cache that indexes files of any size."""
    folder = tmp_path / "cache"
    monkeypatch.setenv(GRAPH_CACHE_VARIABLE, str(folder))
    monkeypatch.setattr(graph_cache, "CACHE", graph_cache.CACHE._replace(min_mib=0, lock_wait_s=0.1))
    return folder


@pytest.fixture
def graph_file(tmp_path: Path) -> Path:
    """A small graph."""
    path = tmp_path / "room.ttl"
    write_label(path, "cup")
    return path


def write_label(path: Path, label: str) -> None:
    path.write_text(
        f'@prefix u2k: <https://w3id.org/usd2kg#> . <urn:o> u2k:primPath "/A" ; '
        f'<http://www.w3.org/2000/01/rdf-schema#label> "{label}" .',
        encoding="utf-8",
    )


def labels(graph: GraphStore) -> list[str | None]:
    return [row[0] for row in graph.sparql("SELECT ?l { ?o rdfs:label ?l }").rows]


def entries(cache: Path) -> list[Path]:
    return sorted(cache.iterdir()) if cache.is_dir() else []


def test_all_questions_have_the_same_answers_from_the_index(kitchen: Path, cache: Path):
    memory = load_graph(kitchen)
    load_graph(kitchen, is_indexed=True)
    index = load_graph(kitchen, is_indexed=True)
    assert index.dataset.index is not None
    assert len(index) == len(memory)
    for question in list_questions():
        given = {p.name: GIVEN[p.name] for p in question.parameters if p.default is None}
        assert index.answer(question.id, given) == memory.answer(question.id, given), question.id
    for words in (
        "on bar table",
        "in refrigerator",
        "near toaster",
        "above bar table",
        "parts of Fridge_01",
        "all of cup",
    ):
        assert index.ask(words.split()) == memory.ask(words.split()), words
    # The table of bodies is read again from its file.
    again = load_graph(kitchen, is_indexed=True)
    assert again.answer("close-to", {"thing": "toaster"}) == memory.answer("close-to", {"thing": "toaster"})


def test_the_second_call_does_not_parse(graph_file: Path, cache: Path, monkeypatch):
    load_graph(graph_file, is_indexed=True)
    monkeypatch.setattr("usd2kg.query.graph_file.open_rdf", None)
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]


def test_a_changed_file_is_indexed_anew(graph_file: Path, cache: Path):
    load_graph(graph_file, is_indexed=True)
    write_label(graph_file, "mug")
    os.utime(graph_file, ns=(1, 1))
    assert labels(load_graph(graph_file, is_indexed=True)) == ["mug"]
    assert len(entries(cache)) == 2


def test_small_files_are_not_indexed(graph_file: Path, cache: Path, monkeypatch):
    monkeypatch.setattr(graph_cache, "CACHE", graph_cache.CACHE._replace(min_mib=1))
    assert load_graph(graph_file, is_indexed=True).dataset.index is None
    assert entries(cache) == []


def test_the_cache_can_be_switched_off(graph_file: Path, cache: Path, monkeypatch):
    monkeypatch.setenv(GRAPH_CACHE_VARIABLE, "OFF")
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]
    assert entries(cache) == []


def test_the_default_is_in_the_cache_folder(graph_file: Path, cache: Path, monkeypatch, tmp_path: Path):
    monkeypatch.delenv(GRAPH_CACHE_VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "mine"))
    index = load_graph(graph_file, is_indexed=True).dataset.index
    assert index is not None
    assert index.is_relative_to(tmp_path / "mine" / "usd2kg" / "graphs")


def test_without_a_usable_folder_the_file_is_parsed(graph_file: Path, cache: Path):
    cache.write_text("a file where the folder should be", encoding="utf-8")
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]


@pytest.mark.parametrize("part", ["index/CURRENT", "boxes.npz", "objects.npz"])
def test_a_damaged_entry_is_made_again(graph_file: Path, cache: Path, part: str, caplog):
    first = load_graph(graph_file, is_indexed=True)
    first.answer("reach", {"position": "0 0 0"})
    assert first.facts.labelled({"cup"}) == {"urn:o"}
    del first
    (entry,) = entries(cache)
    (entry / part).write_bytes(b"garbage")
    with caplog.at_level(logging.WARNING):
        again = load_graph(graph_file, is_indexed=True)
        assert labels(again) == ["cup"]
        assert again.answer("reach", {"position": "0 0 0"}).rows == ()
        assert again.facts.labelled({"cup"}) == {"urn:o"}
    assert "is damaged and is made again" in caplog.text


def test_a_file_that_does_not_parse_leaves_nothing(tmp_path: Path, cache: Path):
    path = tmp_path / "broken.ttl"
    path.write_text("<urn:a> <urn:b>", encoding="utf-8")
    with pytest.raises(GraphError, match="does not parse as Turtle"):
        load_graph(path, is_indexed=True)
    assert entries(cache) == []


def test_a_full_disk_does_not_hinder_the_answer(graph_file: Path, cache: Path, monkeypatch):
    def full(folder: Path, seconds: float):
        raise StoreError("no space left on device")

    monkeypatch.setattr(graph_cache, "lock_exclusive", full)
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]
    assert entries(cache) == []


def test_the_least_recently_used_entries_are_removed_unless_in_use(tmp_path: Path, cache: Path, monkeypatch):
    paths = [tmp_path / f"{name}.ttl" for name in ("first", "second", "third")]
    for age, path in enumerate(paths):
        write_label(path, path.stem)
        load_graph(path, is_indexed=True)
        os.utime(max(entries(cache), key=lambda entry: entry.stat().st_mtime), (age, age))
    used = load_graph(paths[0], is_indexed=True)
    monkeypatch.setattr(graph_cache, "CACHE", graph_cache.CACHE._replace(max_mib=0))
    new = tmp_path / "new.ttl"
    write_label(new, "new")
    assert labels(load_graph(new, is_indexed=True)) == ["new"]
    assert len(entries(cache)) == 2
    assert labels(used) == ["first"]


def test_what_killed_processes_left_is_removed(graph_file: Path, cache: Path):
    left, fresh = cache / ".new-old", cache / ".new-now"
    left.mkdir(parents=True)
    fresh.mkdir()
    os.utime(left, (1, 1))
    load_graph(graph_file, is_indexed=True)
    assert fresh in entries(cache)
    assert left not in entries(cache)


def test_an_entry_that_is_being_removed_is_not_waited_for_long(graph_file: Path, cache: Path):
    load_graph(graph_file, is_indexed=True)
    (entry,) = entries(cache)
    with lock_exclusive(entry, 0):
        assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]


def test_a_process_that_was_faster_wins(graph_file: Path, cache: Path, monkeypatch):
    load_graph(graph_file, is_indexed=True)
    (entry,) = entries(cache)
    other = cache.with_name("other")
    shutil.move(entry, other)

    @contextmanager
    def appears(folder: Path, seconds: float):
        with lock_exclusive(folder, seconds):
            yield
        if not entry.exists():
            shutil.copytree(other, entry)

    monkeypatch.setattr(graph_cache, "lock_exclusive", appears)
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]
    assert entries(cache) == [entry]


def test_a_changed_file_with_its_old_size_and_time_is_indexed_anew(graph_file: Path, cache: Path):
    load_graph(graph_file, is_indexed=True)
    before = graph_file.stat()
    with graph_file.open("r+", encoding="utf-8") as file:
        text = file.read()
        file.seek(0)
        file.write(text.replace("cup", "mug"))
    os.utime(graph_file, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert graph_file.stat().st_size == before.st_size
    assert labels(load_graph(graph_file, is_indexed=True)) == ["mug"]


def test_two_processes_index_a_file_at_once(graph_file: Path, cache: Path):
    script = (
        "import sys; from dataclasses import replace; from usd2kg.query import graph_cache, load_graph;"
        "graph_cache.CACHE = graph_cache.CACHE._replace(min_mib=0);"
        "graph = load_graph(sys.argv[1], is_indexed=True);"
        "print(graph.dataset.index is not None, graph.facts.labelled({'cup'}))"
    )
    command = [sys.executable, "-c", script, str(graph_file)]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    assert [process.communicate(timeout=120)[0] for process in running] == ["True {'urn:o'}\n"] * 3
    (entry,) = entries(cache)
    assert sorted(path.name for path in entry.iterdir()) == ["index", "objects.npz", "usd2kg.lock"]


def test_a_killed_process_leaves_no_half_index(graph_file: Path, cache: Path):
    script = (
        "import os, signal, sys; from dataclasses import replace; from usd2kg.query import graph_cache, load_graph;"
        "graph_cache.CACHE = graph_cache.CACHE._replace(min_mib=0);"
        "graph_cache.lock_exclusive = lambda *_: os.kill(os.getpid(), signal.SIGKILL);"
        "load_graph(sys.argv[1], is_indexed=True)"
    )
    done = subprocess.run([sys.executable, "-c", script, str(graph_file)], capture_output=True, check=False)
    assert done.returncode != 0
    assert [entry.name.startswith(".new-") for entry in entries(cache)] == [True]
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]


def test_tables_of_a_store_are_kept_until_it_changes(kitchen: Path, cache: Path, tmp_path: Path, monkeypatch):
    monkeypatch.setattr(embedded, "CACHE", graph_cache.CACHE._replace(min_mib=0))
    place = str(tmp_path / "store")
    store = EmbeddedStore(place)
    store.load(read_named_graph(kitchen))

    def count() -> int:
        (graph,) = view_scenes(place).values()
        return len(graph.facts.columns.iris)

    before = count()
    assert len(entries(cache)) == 1
    with monkeypatch.context() as patch:
        patch.setattr(object_columns, "_ColumnReader", None)
        assert count() == before
    store.update("INSERT { GRAPH ?g { <urn:new> u2k:primPath '/New' } } WHERE { GRAPH ?g { ?s a owl:Ontology } }")
    assert count() == before + 1
    assert len(entries(cache)) == 2


def test_a_question_about_ten_thousand_objects_takes_little_time(tmp_path: Path, cache: Path, monkeypatch):
    lines = ["@prefix u2k: <https://w3id.org/usd2kg#> .", "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> ."]
    lines += ['<urn:Cup> a <http://www.w3.org/2002/07/owl#Class> ; rdfs:label "cup" .']
    lines += [
        f'<urn:o{n}> a u2k:Object , <urn:Cup> ; u2k:primPath "/Flat/o{n}" ; rdfs:label "o{n}" ; '
        f'u2k:on <urn:o{n // 10}> ; u2k:boxCenter "{n} 0 0" ; u2k:width 1 ; u2k:depth 1 ; u2k:height 1 .'
        for n in range(1, 10_001)
    ]
    path = tmp_path / "cups.ttl"
    path.write_text("\n".join(lines), encoding="utf-8")
    load_graph(path, is_indexed=True)
    for question, least in (("how many cups are there?", 0), ("where is o7?", 0), ("what is on o1?", 1)):
        ask_offline(load_graph(path, is_indexed=True), question)
        start = time.process_time()
        found = ask_offline(load_graph(path, is_indexed=True), question)
        # Measured: 0.3 s, a quarter of it for the 10,000 rows of the first answer.
        assert time.process_time() - start < 2.0, question
        assert len(found.answer.rows) > least
