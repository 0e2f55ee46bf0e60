"""Lexicons as JSON, and grounding by tables of an earlier process."""

import json
from dataclasses import fields
from pathlib import Path

import pytest

from benchmarks.names.lists import ontology_path
from tests.grounding.ontologies import load_ontology
from tests.grounding.records import ground_names
from usd2kg.grounding.lexical import grounder as lexical
from usd2kg.grounding.lexical.alignment.built_alignment import build_alignment
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.lexicon_json import lexicon_as_json, lexicon_of_json
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.ontology import TBox, load_tbox
from usd2kg.table_cache import TABLE_CACHE_VARIABLE


def build(tbox: TBox) -> tuple[TBox, Lexicon]:
    built = build_alignment(tbox, load_taxonomy(), home_names())
    return built.tbox, built.edited(load_taxonomy())


def as_lists(lexicon: Lexicon) -> dict[str, object]:
    """Return the fields of a lexicon with the order of their entries."""
    values = {field.name: getattr(lexicon, field.name) for field in fields(lexicon)}
    return {name: [*value.items()] if hasattr(value, "items") else value for name, value in values.items()}


def check_round_trip(tbox: TBox) -> Lexicon:
    rooted, lexicon = build(tbox)
    read = lexicon_of_json(json.loads(json.dumps(lexicon_as_json(lexicon))), rooted)
    assert as_lists(read) == as_lists(lexicon)
    return lexicon


def test_the_lexicon_of_the_home_tbox_survives(home_tbox: TBox):
    assert len(check_round_trip(home_tbox).terms) > 10_000


@pytest.mark.parametrize("name", ["ward", "store", "garage"])
def test_the_lexicon_of_another_ontology_survives(name: str):
    assert check_round_trip(load_tbox(ontology_path(name))).category_members


def test_what_a_shipped_list_excludes_survives():
    path = ontology_path("DogOnt")
    if not path.exists():
        pytest.skip(f"needs the shared input {path.name}, which is not part of the project")
    lexicon = check_round_trip(load_tbox(path))
    assert lexicon.listed_synsets
    assert lexicon.excluded_classes


@pytest.mark.parametrize("ontology", ["laboratory", "posts"])
def test_names_are_grounded_alike_by_the_tables_of_an_earlier_process(ontology: str, monkeypatch, tmp_path: Path):
    monkeypatch.setenv(TABLE_CACHE_VARIABLE, str(tmp_path))
    names = ["beaker", "SM_newel_02", "garrison", "spoon", "thing"]
    tbox = load_ontology(ontology)
    lexical._make_object_grounder.cache_clear()
    first = ground_names(names, tbox)
    assert any(file.name.endswith("-lexicon.json") for file in tmp_path.iterdir())
    # Building again would fail.
    monkeypatch.setattr("usd2kg.grounding.lexical.alignment.built_alignment.build_alignment", None)
    lexical._make_object_grounder.cache_clear()
    assert ground_names(names, tbox) == first
    lexical._make_object_grounder.cache_clear()
