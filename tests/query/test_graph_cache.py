"""The cache of indexes of large graph files."""

import logging
import os
import shutil
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

import usd2kg
from usd2kg.demo import demo_scene
from usd2kg.errors import GraphError, StoreError
from usd2kg.folder_lock import lock_exclusive
from usd2kg.query import GraphStore, graph_cache, load_graph
from usd2kg.query.graph_cache import GRAPH_CACHE_VARIABLE
from usd2kg.query.questions import list_questions

GIVEN = {
    "thing": "barTable",
    "class": "cup",
    "position": "-1.5 0.4 1.1",
}


@pytest.fixture(scope="module", params=["soma", "plain"])
def kitchen(request, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The graph of the demo kitchen in both profiles."""
    path = tmp_path_factory.mktemp("kitchen") / "kitchen.ttl"
    graph = usd2kg.build(demo_scene(), profile=request.param).graph
    usd2kg.write_graph(graph, path)
    return path


@pytest.fixture
def cache(tmp_path: Path, monkeypatch) -> Path:
    """An empty cache that indexes files of any size."""
    folder = tmp_path / "cache"
    monkeypatch.setenv(GRAPH_CACHE_VARIABLE, str(folder))
    monkeypatch.setattr(graph_cache, "CACHE", replace(graph_cache.CACHE, min_mib=0, lock_wait_s=0.1))
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
    monkeypatch.setattr(graph_cache, "CACHE", replace(graph_cache.CACHE, min_mib=1))
    assert load_graph(graph_file, is_indexed=True).dataset.index is None
    assert entries(cache) == []


def test_the_cache_can_be_switched_off(graph_file: Path, cache: Path, monkeypatch):
    monkeypatch.setenv(GRAPH_CACHE_VARIABLE, "OFF")
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]
    assert entries(cache) == []


def test_the_default_is_in_the_cache_folder(graph_file: Path, cache: Path, monkeypatch, tmp_path: Path):
    monkeypatch.delenv(GRAPH_CACHE_VARIABLE)
    monkeypatch.setattr(graph_cache, "cache_folder", lambda: tmp_path / "mine")
    index = load_graph(graph_file, is_indexed=True).dataset.index
    assert index is not None
    assert index.is_relative_to(tmp_path / "mine" / "graphs")


def test_without_a_usable_folder_the_file_is_parsed(graph_file: Path, cache: Path):
    cache.write_text("a file where the folder should be", encoding="utf-8")
    assert labels(load_graph(graph_file, is_indexed=True)) == ["cup"]


@pytest.mark.parametrize("part", ["index/CURRENT", "boxes.npz"])
def test_a_damaged_entry_is_made_again(graph_file: Path, cache: Path, part: str, caplog):
    load_graph(graph_file, is_indexed=True).answer("reach", {"position": "0 0 0"})
    (entry,) = entries(cache)
    (entry / part).write_bytes(b"garbage")
    with caplog.at_level(logging.WARNING):
        again = load_graph(graph_file, is_indexed=True)
        assert labels(again) == ["cup"]
        assert again.answer("reach", {"position": "0 0 0"}).rows == ()
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
    monkeypatch.setattr(graph_cache, "CACHE", replace(graph_cache.CACHE, max_mib=0))
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
