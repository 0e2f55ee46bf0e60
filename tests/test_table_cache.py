"""The cache of tables that follow from an ontology alone."""

import json
import os
from pathlib import Path

import pytest

from usd2kg import table_cache
from usd2kg.table_cache import NO_CACHE, TABLE_CACHE_VARIABLE, TableCache, open_table_cache


@pytest.fixture
def folder(monkeypatch, tmp_path: Path) -> Path:
    folder = tmp_path / "tables"
    monkeypatch.setenv(TABLE_CACHE_VARIABLE, str(folder))
    return folder


def count_words(cache: TableCache, text: str, log: list[str]) -> dict[str, int]:
    """Return how often each word occurs, by a table of the cache; log each computation."""

    def compute() -> dict[str, int]:
        log.append(text)
        return {word: text.split().count(word) for word in text.split()}

    def decode(pairs: list[tuple[str, int]]) -> dict[str, int]:
        return {word: int(count) for word, count in pairs}

    return cache.get("words", decode, compute, lambda found: [*found.items()])


def test_a_table_is_computed_once(folder: Path):
    log: list[str] = []
    tables = [count_words(open_table_cache(["a b a"]), "a b a", log) for _ in range(2)]
    assert tables == [{"a": 2, "b": 1}] * 2
    assert log == ["a b a"]


def test_other_inputs_have_other_tables(folder: Path):
    log: list[str] = []
    for inputs in (["a b"], ["a", "b"], ["b"]):
        count_words(open_table_cache(inputs), " ".join(inputs), log)
    assert log == ["a b", "a b", "b"]


def test_a_table_of_another_version_of_the_program_is_not_used(folder: Path, monkeypatch):
    log: list[str] = []
    count_words(open_table_cache(["a"]), "a", log)
    monkeypatch.setattr(table_cache, "_program_state", lambda: ("changed",))
    count_words(open_table_cache(["a"]), "a", log)
    assert log == ["a", "a"]


def test_the_program_state_covers_code_settings_and_word_lists():
    state = "\n".join(table_cache._program_state())
    for file in ("grounding/lexical/alignment/lexicon.py", "data/settings/lexical.json", "data/wordnet.txt.gz"):
        assert file in state


@pytest.mark.parametrize("content", ["", "{", "[1]", '[["a", "x"]]', "null"])
def test_a_damaged_table_is_computed_again(folder: Path, content: str):
    log: list[str] = []
    count_words(open_table_cache(["a"]), "a", log)
    (file,) = folder.iterdir()
    file.write_text(content, encoding="utf-8")
    assert count_words(open_table_cache(["a"]), "a", log) == {"a": 1}
    assert log == ["a", "a"]
    assert json.loads(file.read_bytes()) == [["a", 1]]


def test_where_nothing_can_be_written_tables_are_computed(tmp_path: Path, monkeypatch):
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv(TABLE_CACHE_VARIABLE, str(tmp_path / "file" / "tables"))
    assert count_words(open_table_cache(["a"]), "a", []) == {"a": 1}


def test_it_can_be_switched_off(monkeypatch):
    monkeypatch.setenv(TABLE_CACHE_VARIABLE, "off")
    assert open_table_cache(["a"]) is NO_CACHE
    log: list[str] = []
    for _ in range(2):
        count_words(NO_CACHE, "a", log)
    assert log == ["a", "a"]


def test_beyond_its_size_the_least_recently_used_tables_are_removed(folder: Path, monkeypatch):
    log: list[str] = []
    for age, text in enumerate(("a", "b", "c")):
        count_words(open_table_cache([text]), text, log)
        for file in folder.iterdir():
            if json.loads(file.read_bytes()) == [[text, 1]]:
                os.utime(file, (1000 + age, 1000 + age))
    count_words(open_table_cache(["a"]), "a", log)  # used now
    monkeypatch.setattr(table_cache, "_MAX_BYTES", 2 * len('[["a",1]]'))
    count_words(open_table_cache(["d"]), "d", log)
    assert {file.read_text("utf-8") for file in folder.iterdir()} == {'[["a",1]]', '[["d",1]]'}
