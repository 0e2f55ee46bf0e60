"""The names of things in bulk: what the table promises, and what it comes to in the default grounder."""

import re
import time
from collections import Counter

from usd2kg.grounding.lexical.alignment.lexicon import home_names
from usd2kg.knowledge import read_rows
from usd2kg.ontology import TBox
from usd2kg.words import split_identifier

ROWS = read_rows("home_names.csv")
SHORT = list(read_rows("abbreviations.csv"))


def key_of(text: str) -> str:
    return "".join(split_identifier(text)).lower()


def test_the_table_has_two_columns_and_nothing_is_blank():
    assert {tuple(row) for row in ROWS} == {("class", "name")}
    assert [row for row in ROWS if not row["class"] or not row["name"]] == []
    assert len(ROWS) > 8000


def test_every_class_is_one_of_the_home_tbox(home_tbox: TBox):
    assert {row["class"] for row in ROWS} - {cls.local_name for cls in home_tbox.classes} == set()


def test_no_name_stands_twice():
    assert [name for name, count in Counter(row["name"] for row in ROWS).items() if count > 1] == []


def test_rows_are_in_order():
    assert sorted(ROWS, key=lambda row: (row["class"], row["name"])) == ROWS


def test_names_are_lower_case_words_with_single_spaces():
    odd = [name for row in ROWS if not re.fullmatch(r"[^\W_]+(?:[ '&./-]+[^\W_]+)*", name := row["name"])]
    assert odd == []
    assert [row["name"] for row in ROWS if row["name"] != row["name"].lower()] == []


def test_no_name_is_the_label_of_another_class(home_tbox: TBox):
    labels = {key_of(text): cls.local_name for cls in home_tbox.classes for text in (cls.label, cls.local_name)}
    assert [row for row in ROWS if labels.get(key_of(row["name"]), row["class"]) != row["class"]] == []


def test_no_name_is_a_synonym_of_another_class(home_tbox: TBox):
    synonyms: dict[str, set[str]] = {}
    for cls in home_tbox.classes:
        for text in cls.alt_labels:
            synonyms.setdefault(key_of(text), set()).add(cls.local_name)
    assert [row for row in ROWS if row["class"] not in synonyms.get(key_of(row["name"]), {row["class"]})] == []


def test_a_name_written_in_one_word_or_two_is_of_one_class():
    classes: dict[str, set[str]] = {}
    for row in ROWS:
        classes.setdefault(key_of(row["name"]), set()).add(row["class"])
    assert {key: found for key, found in classes.items() if len(found) > 1} == {}


def test_the_names_join_those_of_the_tbox(home_tbox: TBox):
    names = home_names()
    for cls in home_tbox.classes:
        assert {cls.label, *cls.alt_labels} <= set(names[cls.iri])
    assert sum(map(len, names.values())) >= len(ROWS)
    cup = next(cls.iri for cls in home_tbox.classes if cls.local_name == "Cup")
    assert {row["name"] for row in ROWS if row["class"] == "Cup"} <= set(names[cup])


def test_they_load_fast():
    home_names()
    times = []
    for _ in range(3):
        home_names.cache_clear()
        start = time.perf_counter()
        home_names()
        times.append(time.perf_counter() - start)
    assert min(times) < 0.25


# --- the table of abbreviations ----------------------------------------------------------------------


def test_abbreviations_are_in_order_lower_case_and_stand_for_one_word():
    shorts = [row["short"] for row in SHORT]
    assert shorts == sorted(set(shorts))
    assert [short for short in shorts if not re.fullmatch("[a-z]+", short)] == []
    assert [row for row in SHORT if row["word"] != row["word"].lower()] == []
    assert [row for row in SHORT if row["short"][0] not in row["word"]] == []
    assert [row for row in SHORT if row["short"] == row["word"]] == []
