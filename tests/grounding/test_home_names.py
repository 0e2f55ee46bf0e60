"""The tables of object names and abbreviations of the home vocabulary."""

import re

from usd2kg.grounding.lexical.concepts.home_names import home_names, home_words
from usd2kg.knowledge import read_rows
from usd2kg.ontology import TBox
from usd2kg.words import split_identifier

TABLE = read_rows("home_names.csv")
ROWS = [{"class": row["class"], "name": name} for row in TABLE for name in row["names"].split("|")]
ABBREVIATIONS = list(read_rows("abbreviations.csv"))


def key_of(text: str) -> str:
    return "".join(split_identifier(text)).lower()


def test_every_row_has_a_class_of_the_home_ontology_and_a_name(home_tbox: TBox):
    assert {tuple(row) for row in TABLE} == {("class", "names")}
    assert len({row["class"] for row in TABLE}) == len(TABLE)
    assert {row["class"] for row in ROWS} <= {cls.local_name for cls in home_tbox.classes}
    assert len(ROWS) > 8000


def test_rows_are_sorted_and_names_unique():
    assert sorted(ROWS, key=lambda row: (row["class"], row["name"])) == ROWS
    names = [row["name"] for row in ROWS]
    assert len(names) == len(set(names))


def test_names_are_lower_case_words_with_single_spaces():
    names = [row["name"] for row in ROWS]
    assert [name for name in names if not re.fullmatch(r"[^\W_]+(?:[ '&./-]+[^\W_]+)*", name)] == []
    assert [name for name in names if name != name.lower()] == []


def test_no_name_is_a_label_or_synonym_of_another_class(home_tbox: TBox):
    classes: dict[str, set[str]] = {}
    for cls in home_tbox.classes:
        for text in (cls.label, cls.local_name, *cls.alt_labels):
            classes.setdefault(key_of(text), set()).add(cls.local_name)
    assert [row for row in ROWS if row["class"] not in classes.get(key_of(row["name"]), {row["class"]})] == []


def test_spellings_of_a_name_with_and_without_spaces_have_one_class():
    classes: dict[str, set[str]] = {}
    for row in ROWS:
        classes.setdefault(key_of(row["name"]), set()).add(row["class"])
    assert {key: found for key, found in classes.items() if len(found) > 1} == {}


def test_names_add_to_the_labels_and_synonyms_of_the_ontology(home_tbox: TBox):
    names = home_names()
    for cls in home_tbox.classes:
        assert {cls.label, *cls.alt_labels} <= set(names[cls.iri])
    assert {row["name"] for row in ROWS if row["class"] == "Cup"} <= set(names[home_tbox.resolve("Cup")])


def test_abbreviations_are_sorted_and_shorten_one_lower_case_word():
    short = [row["short"] for row in ABBREVIATIONS]
    assert short == sorted(set(short))
    assert [form for form in short if not re.fullmatch("[a-z]+", form)] == []
    for row in ABBREVIATIONS:
        assert row["word"] == row["word"].lower()
        assert row["short"][0] in row["word"]
        assert row["short"] != row["word"]


def test_the_words_of_the_names_are_kept_between_commands(tmp_path, monkeypatch):
    monkeypatch.setenv("USD2KG_TABLE_CACHE", str(tmp_path))
    home_words.cache_clear()
    computed = home_words()
    home_words.cache_clear()
    monkeypatch.setattr("usd2kg.grounding.lexical.concepts.home_names._count_words", None)
    assert home_words() == computed
    assert computed.last_counts["table"] > 0
    assert computed.before_counts["coffee"] > 0
    assert {"diningtable", "table"} & computed.compounds == {"diningtable"}
    assert "tv" in computed.short_names
