"""The package data is what `make data` builds from `knowledge/`."""

from pathlib import Path

import pytest

from tools.build_data import BuiltFile, build_files, check_listed, convert_files, find_differences, list_licences
from tools.data_files import DATA, KNOWLEDGE, SourceError
from tools.settings_files import convert_settings
from tools.source_schema import Column, Schema, Source, read_schema, validate_source
from tools.word_lists import convert_word_lists
from usd2kg.knowledge import read_rows


def test_committed_data_matches_the_sources():
    schema = read_schema(KNOWLEDGE / "schema.toml")
    converted = [*convert_files()]
    licences = list_licences(schema, [file.name for file in converted])
    assert find_differences([*converted, licences, *build_files(schema)], schema.data) == []


def test_every_file_of_the_data_has_a_licence():
    listed = {row["file"]: row["licence"] for row in read_rows("licences.csv")}
    assert set(listed) == {path.relative_to(DATA).as_posix() for path in DATA.rglob("*") if path.is_file()}
    assert listed["places.ttl"] == "CC0-1.0"
    assert listed["wordnet.txt.gz"].startswith("WordNet-3.0")


def test_reports_files_that_differ_or_have_no_source(tmp_path):
    (tmp_path / "words").mkdir()
    (tmp_path / "words/old.json").write_text("{}")
    (tmp_path / "kept.txt").write_text("kept")
    (tmp_path / "words/edited.json").write_text('{"a": ["b"]}')
    built = [BuiltFile("words/edited.json", b"{}"), BuiltFile("words/new.json", b"{}")]
    assert find_differences(built, {"kept.txt": {}, "fitted.json": {}}, tmp_path) == [
        "words/edited.json differs from its source",
        "words/new.json is missing",
        "fitted.json is missing; its command is in knowledge/schema.toml",
        "words/old.json has no source and is not in knowledge/schema.toml",
    ]


def test_rejects_a_source_that_the_schema_does_not_list(tmp_path):
    (tmp_path / "colours.csv").write_text("name\nred\n")
    with pytest.raises(SourceError, match=r"schema.toml: colours.csv is only in the schema or only in the folder"):
        check_listed(Schema({}, {}), tmp_path)


def test_every_source_and_data_file_has_a_description_an_origin_and_a_licence(tmp_path):
    path = tmp_path / "schema.toml"
    path.write_text('[source."colours.toml"]\ndescription = "Colours."\nlicence = "Apache-2.0"\n[data]\n')
    with pytest.raises(SourceError, match=r"schema.toml: colours.toml: origin missing"):
        read_schema(path)


SIZES = Source(
    "sizes.csv",
    {},
    ("sizes.csv",),
    ("noun",),
    (
        Column("noun", "text", "", pattern="[a-z ]+"),
        Column("height_m", "number", "", above=0),
        Column("stands", "names", "", allowed=("floor", "wall"), optional=True),
    ),
)


def validate(folder: Path, rows: str) -> None:
    path = folder / "sizes.csv"
    path.write_text(rows, encoding="utf-8")
    validate_source(path, SIZES)


def test_accepts_rows_that_match_the_schema(tmp_path):
    rows = "noun,height_m,stands\ncup,0.1,\nfloor lamp,1.5,floor|wall\n"
    validate(tmp_path, rows)
    with pytest.raises(SourceError, match=r":4: column height_m: '0'"):
        validate(tmp_path, f"{rows}rug,0,\n")


@pytest.mark.parametrize(
    ("rows", "problem"),
    [
        ("noun,height\n", ":1: header is noun,height; expected noun,height_m,stands"),
        ("noun,height_m,stands\ncup,0.1\n", ":2: 2 cells; expected 3"),
        ("noun,height_m,stands\n,0.1,\n", ":2: column noun: is empty"),
        ("noun,height_m,stands\nCup,0.1,\n", ":2: column noun: 'Cup'; expected a match of [a-z ]+"),
        (
            "noun,height_m,stands\ncup ,1,\n",
            ":2: column noun: 'cup ' has stray spaces",
        ),
        ("noun,height_m,stands\ncup,tall,\n", ":2: column height_m: 'tall' is not a number"),
        ("noun,height_m,stands\ncup,0,\n", ":2: column height_m: '0'; expected a number above 0"),
        ("noun,height_m,stands\ncup,nan,\n", ":2: column height_m: 'nan'; expected a number above 0"),
        ("noun,height_m,stands\ncup,1,desk\n", ":2: column stands: 'desk'; expected one of floor, wall"),
        ("noun,height_m,stands\ncup,1,wall|wall\n", ":2: column stands: 'wall|wall' repeats a name"),
        ("noun,height_m,stands\ncup,1,\ncup,2,\n", ":3: noun ('cup',) is in line 2 already"),
        ('noun,height_m,stands\n"cup,1,\n', ": unexpected end of data"),
    ],
)
def test_rejects_rows_that_do_not_match_the_schema(tmp_path, rows, problem):
    with pytest.raises(SourceError) as caught:
        validate(tmp_path, rows)
    assert str(caught.value) == f"{tmp_path / 'sizes.csv'}{problem}"


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


def write_settings(folder: Path, text: str) -> Path:
    path = folder / "shapes.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_converts_settings_with_an_origin_for_each_value(tmp_path):
    text = "[gap]\nleast = 0.5  # metres [chosen: a hand's width]\nnames = ['a']  # names [fitted by tools/fit.py]\n"
    assert convert_settings(write_settings(tmp_path, text)).decode() == (
        '{\n "gap": {\n  "least": 0.5,\n  "names": [\n   "a"\n  ]\n }\n}\n'
    )


@pytest.mark.parametrize("comment", ["", "# metres", "# metres [guessed]", "# [chosen: no meaning]"])
def test_rejects_settings_without_meaning_or_origin(tmp_path, comment):
    path = write_settings(tmp_path, f"[gap]\nleast = 0.5  {comment}\n")
    with pytest.raises(SourceError, match=r"shapes.toml:2: least has no origin; expected a comment"):
        convert_settings(path)


def test_rejects_settings_outside_a_section(tmp_path):
    with pytest.raises(SourceError, match=r"shapes.toml: least is in no section"):
        convert_settings(write_settings(tmp_path, "least = 0.5  # metres [chosen]\n"))
