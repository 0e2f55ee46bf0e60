"""Abbreviated names: the forms a word may take, and the words behind a run of letters.

Which words single names are read as is scored in `readings.csv`, and which class they get in `regression.csv`.
"""

import math
import random
import time
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.ontologies import parse_outline
from tests.grounding.records import ground_view, local, scene_of
from usd2kg.grounding import NamingRegime, ObjectView, view_objects
from usd2kg.grounding.context import Neighbourhood, abbreviate
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.abbreviations import AbbreviationReader
from usd2kg.ontology import TBox, load_home_tbox

LEXICON = build_lexicon(load_home_tbox(), load_taxonomy(), {})
READER = AbbreviationReader(LEXICON, load_taxonomy())


def read(*tokens: str, neighbourhood: Neighbourhood | None = None) -> dict[tuple[str, ...], float]:
    return {reading.words: reading.probability for reading in READER.read(tokens, neighbourhood)}


def best(*tokens: str, neighbourhood: Neighbourhood | None = None) -> tuple[str, ...]:
    return next(iter(read(*tokens, neighbourhood=neighbourhood)))


def neighbourhood_of(*names: str) -> Neighbourhood:
    """Return the other objects of a scene, which have these names, as the neighbourhood of a nameless one."""
    scene = scene_of("/Room/obj_1", *(f"/Room/{name}" for name in names))
    neighbourhood = next(view for _, view in view_objects(scene, NamingRegime.OPAQUE)).neighbourhood
    assert neighbourhood is not None
    return neighbourhood


# --- readings ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("tokens", [["frdg"], ["cff", "mchn"], ["cpcbl"], ["b"], ["tbl", "lmp", "blk"]])
def test_readings_are_distinct_and_ranked_by_probability(tokens: list[str]):
    readings = READER.read(tokens)
    shares = [reading.probability for reading in readings]
    assert shares == sorted(shares, reverse=True)
    assert 0 < sum(shares) <= 1 + 1e-9
    assert len({reading.words for reading in readings}) == len(readings) > 0


def test_letters_that_no_word_explains_get_hardly_any_probability():
    assert sum(read("xqzv").values()) < 0.01


def test_no_word_spans_two_tokens():
    assert ("cupboard",) in read("cpbrd")
    assert all(len(words) > 1 for words in read("cp", "brd"))


def test_words_keep_the_order_of_the_tokens():
    assert ("machine", "coffee") not in read("cff", "mchn")
    assert best("mchn", "cff")[0] == "machine"


def test_a_token_in_full_is_read_as_itself():
    readings = READER.read(["cabinet", "dr"], spelled={"cabinet"})
    assert {reading.words[0] for reading in readings} == {"cabinet"}
    assert [(*reading.words, reading.probability) for reading in READER.read(["cup"], spelled={"cup"})] == [("cup", 1)]


def test_words_of_the_parent_are_likelier():
    assert READER.read(["thdlg"])[0].words[0] != "theodolite"
    assert READER.read(["thdlg"], parent="Theodolites_grp")[0].words[0] == "theodolite"
    assert READER.read(["thdlg"], neighbourhood_of("Chair"), parent="Theodolite")[0].words[0] == "theodolite"


class TestNeighbourhood:
    """Words in the names of the other objects."""

    def test_a_word_of_the_scene_is_likelier(self):
        alone, among_cuffs = read("cff"), read("cff", neighbourhood=neighbourhood_of("Cuff_1", "Cuff_2", "Cuff_3"))
        assert alone[("coffee",)] > alone[("cuff",)]
        assert among_cuffs[("cuff",)] > 0.9 > alone[("cuff",)]

    def test_a_compound_of_the_scene_is_likelier(self):
        neighbourhood = neighbourhood_of("Fridge", "CoffeeMachine")
        assert (
            read("cffmchn", neighbourhood=neighbourhood)[("coffee", "machine")] > read("cffmchn")[("coffee", "machine")]
        )

    def test_a_word_of_more_objects_is_likelier(self):
        few = read("cff", neighbourhood=neighbourhood_of("Cuff_1", *(f"Lamp_{i}" for i in range(30))))
        many = read("cff", neighbourhood=neighbourhood_of(*(f"Cuff_{i}" for i in range(30)), "Lamp_1"))
        assert many[("cuff",)] > few[("cuff",)]

    def test_words_that_no_dictionary_has_are_read(self):
        assert ("zorgblat",) not in read("zrgb")
        assert best("zrgb", neighbourhood=neighbourhood_of("Zorgblat_1", "Zorgblat_2")) == ("zorgblat",)

    def test_plurals_are_read_as_singulars(self):
        assert best("knvs", neighbourhood=neighbourhood_of("knives", "knives_2")) == ("knife",)

    def test_names_without_fitting_words_change_nothing(self):
        assert read("frdg", neighbourhood=neighbourhood_of("Lamp_1", "Oven")) == pytest.approx(read("frdg"))


# --- unusual input -----------------------------------------------------------------------------------


@pytest.mark.parametrize("tokens", [[], ["日本"], ["ß"], ["123"], ["_"], ["\u202e"], ["²"]])
def test_tokens_without_letters_have_no_readings(tokens: list[str]):
    assert READER.read(tokens) == []


def test_letters_beyond_ascii_are_letters():
    assert best("küche")[0].startswith("küche")


@pytest.mark.parametrize("text", ["a" * 200, "abcdefghij" * 20, "cffmchn" * 29, "bcdfgh" * 34, "zxq" * 67])
def test_long_runs_of_letters_have_no_readings_and_take_little_time(text: str):
    READER.read(sorted(set(text)))
    start = time.process_time()
    assert READER.read([text]) == []
    assert time.process_time() - start < 2


@settings(deadline=None, max_examples=60)
@given(st.lists(st.text("abcdlmnprstüz9", min_size=1, max_size=8), max_size=5))
def test_any_tokens_get_readings_with_words_and_probabilities(tokens: list[str]):
    readings = READER.read(tokens)
    assert sum(reading.probability for reading in readings) <= 1 + 1e-9
    assert all(reading.words and all(reading.words) for reading in readings)
    assert READER.read(tokens) == readings


def test_readers_know_the_words_of_their_ontology_and_keep_no_state():
    lexicon = build_lexicon(parse_outline("Jar\nJorgblat"), load_taxonomy(), {})
    used, fresh = (AbbreviationReader(lexicon, load_taxonomy()) for _ in range(2))
    used.read(["jgs"], neighbourhood_of("Jug_1"))
    for tokens in (["jr"], ["jgs"], ["jrgb"]):
        assert used.read(tokens) == fresh.read(tokens)
    assert fresh.read(["jrgb"])[0].words == ("jorgblat",)
    assert ("jorgblat",) not in read("jrgb")


# --- recall ------------------------------------------------------------------------------------------


def keep_first_vowel(word: str, length: int) -> str:
    return (word[0] + "".join(letter for letter in word[1:] if letter not in "aeiou"))[:length]


def truncate(word: str, length: int) -> str:
    return word[:length]


@pytest.mark.parametrize(
    ("shorten", "length", "among", "first"),
    [
        # Measured on 300 words: 72 % are among the readings and 23 % come first with 3 letters, 98 and 65 % with 4,
        # 100 and 89 % with 5.
        (abbreviate, 3, 0.6, 0.12),
        (abbreviate, 4, 0.9, 0.5),
        (abbreviate, 5, 0.93, 0.75),
        (keep_first_vowel, 4, 0.9, 0.5),
        (truncate, 4, 0.8, 0.25),
        (truncate, 5, 0.9, 0.5),
    ],
)
def test_most_words_are_among_the_readings_of_their_forms(
    shorten: Callable[[str, int], str], length: int, among: float, first: float
):
    pool = [
        word
        for word in sorted(LEXICON.vocabulary)
        if word.isascii() and word.isalpha() and shorten(word, length) != word
        if len(shorten(word, length)) == length and sum(letter not in "aeiou" for letter in word) >= length
    ]
    words = random.Random(7).sample(pool, 100)
    readings = {word: list(read(shorten(word, length))) for word in words}
    missed = [word for word in words if (word,) not in readings[word]]
    assert len(missed) <= (1 - among) * 100, f"missed {missed}"
    assert sum(readings[word][:1] == [(word,)] for word in words) >= first * 100


# --- end to end --------------------------------------------------------------------------------------


@pytest.mark.parametrize("is_masked", [True, False])
@pytest.mark.parametrize("name", ["frdg", "cffmchn", "kbd_2"])
def test_explanation_gives_the_words_behind_the_letters(home_tbox: TBox, name: str, is_masked: bool):
    prediction = ground_view(ObjectView(name=name, is_masked=is_masked), home_tbox)
    assert prediction.evidence == ("name",)
    assert f"“{name}” may be short for “" in prediction.explanation


def test_names_in_full_are_no_abbreviations(home_tbox: TBox):
    for name in ("Cup", "oven_door", "lamp"):
        assert "short for" not in ground_view(ObjectView(name=name), home_tbox).explanation


def test_a_masked_name_is_read_with_the_words_of_the_others(home_tbox: TBox):
    scene = scene_of("/Room/Cup_1", "/Room/Cup_2", "/Room/Cup_3", "/Room/Chair")
    views = [view for _, view in view_objects(scene, NamingRegime.ABBREVIATED)]
    assert [view.name for view in views] == ["cp1", "cp2", "cp3", "chr"]
    assert local(ground_view(views[0], home_tbox)) == "Cup"


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.sampled_from(["cup", "fan", "bld", "Xq", "ice", "ZZTOP", "wrkbnchs", "Tür", "_", "7"]), max_size=7),
    st.sampled_from(["_", ""]),
)
def test_any_mixture_of_words_and_abbreviations_is_grounded(parts: list[str], joint: str):
    prediction = ground_view(ObjectView(name=joint.join(parts)), load_home_tbox())
    assert prediction.confidence is not None and math.isfinite(prediction.confidence)
    assert 0 <= prediction.confidence <= 1
