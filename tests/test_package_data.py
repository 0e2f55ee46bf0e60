"""The package data is what `make data` builds from `knowledge/`."""

from pathlib import Path

import pytest

from tools.build_data import BuiltFile, build_files, find_differences
from tools.source_error import SourceError
from tools.word_lists import convert_word_lists


def test_committed_data_is_what_the_sources_give():
    assert find_differences(list(build_files())) == []


def test_reports_files_that_differ_or_have_no_source(tmp_path):
    (tmp_path / "words").mkdir()
    (tmp_path / "words/old.json").write_text("{}")
    (tmp_path / "words/edited.json").write_text('{"a": ["b"]}')
    built = [BuiltFile("words/edited.json", b"{}"), BuiltFile("words/new.json", b"{}")]
    assert find_differences(built, tmp_path) == [
        "words/edited.json differs from its source",
        "words/new.json is missing",
        "words/old.json has no source in knowledge/",
    ]


def write_list(folder: Path, text: str) -> Path:
    path = folder / "colours.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_converts_lists_and_maps(tmp_path):
    table = '[{}]\ndescription = "d"\norigin = "chosen: o"\nwords = {}\n'
    text = table.format("plain", '["blue", "grün"]') + table.format("shades", '{ navy = "blue" }')
    assert convert_word_lists(write_list(tmp_path, text)).decode() == (
        '{\n "plain": [\n  "blue",\n  "grün"\n ],\n "shades": {\n  "navy": "blue"\n }\n}\n'
    )


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        ('["red", "blue"]', "'blue' follows 'red'; sort the words and name each once"),
        ('["red", "red"]', "'red' follows 'red'; sort the words and name each once"),
        ('["red "]', "'red '; expected a word without surrounding spaces"),
        ("[]", "words is []; expected a list of words or a map from word to word"),
        ("[1]", "1; expected a word without surrounding spaces"),
    ],
)
def test_rejects_words_out_of_order_or_malformed(tmp_path, words, problem):
    path = write_list(tmp_path, f'[plain]\ndescription = "d"\norigin = "o"\nwords = {words}\n')
    with pytest.raises(SourceError) as caught:
        convert_word_lists(path)
    assert str(caught.value) == f"{path}: [plain]: {problem}"


@pytest.mark.parametrize(
    "text",
    [
        '[plain]\nwords = ["red"]\n',
        '[plain]\ndescription = "d"\norigin = "o"\nwords = ["red"]\nnote = "n"\n',
        "a = 1\n",
    ],
)
def test_rejects_tables_with_missing_or_unknown_keys(tmp_path, text):
    with pytest.raises(SourceError, match="expected a table with the keys description, origin, words"):
        convert_word_lists(write_list(tmp_path, text))


def test_rejects_broken_toml(tmp_path):
    with pytest.raises(SourceError, match=r"/colours.toml: .*line 1"):
        convert_word_lists(write_list(tmp_path, "[plain\n"))
