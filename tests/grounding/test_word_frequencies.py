"""Word frequencies, and the prior that a word names a thing in a scene."""

import math
from functools import cache

import pytest

from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.word_frequencies import UNKNOWN_FREQUENCY, log_prior
from usd2kg.knowledge import read_bytes, read_compressed, read_text

COMMON_AND_RARE = """
    chair davenport, table tabor, cup chalice, lamp sconce, door wicket, window oriel, bottle demijohn, spoon skimmer,
    box coffer, desk escritoire, shelf etagere, sofa settee, clock clepsydra, oven kiln, bowl tureen, plate trencher,
    pan skillet, hammer mallet, bag reticule, basket pannier, screen reredos, car phaeton, truck dray, curtain arras,
    mirror speculum, carpet drugget, stove brazier, wheel cogwheel, ladder ratline, cabinet credenza, shovel mattock
"""


@cache
def shipped_lines() -> list[list[str]]:
    words, entries = read_compressed("frequencies.txt.gz").decode("ascii").splitlines()
    return [[word, *entry.split("/")] for word, entry in zip(words.split(), entries.split(), strict=True)]


def word_frequency(word: str) -> float:
    """Return the Zipf score of a word."""
    return _tenths().get(word, 10 * UNKNOWN_FREQUENCY) / 10


@cache
def _tenths() -> dict[str, int]:
    return {word: int(tenths) for word, tenths, *_ in shipped_lines()}


def test_common_artifacts_are_more_frequent_and_likelier_in_a_scene_than_rare_ones():
    for common, rare in map(str.split, COMMON_AND_RARE.split(",")):
        assert word_frequency(common) > word_frequency(rare)
        assert log_prior(common) > log_prior(rare)


@pytest.mark.parametrize(
    ("word", "low", "high"),
    [
        # Zipf scores; a chair is written about once in 12,000 words.
        ("time", 6.0, 6.6),
        ("house", 5.3, 6.1),
        ("chair", 4.5, 5.2),
        ("knife", 4.1, 4.8),
        ("toaster", 2.7, 3.7),
        ("forklift", 2.2, 3.2),
        ("wooden", 4.2, 4.9),
    ],
)
def test_frequencies_are_those_of_everyday_english(word: str, low: float, high: float):
    assert low <= word_frequency(word) <= high


@pytest.mark.parametrize("word", ["", "xqzt", "Chair", "chairs", "coffee table", "coffeetable", "the"])
def test_words_outside_the_vocabulary_have_the_lowest_frequency(word: str):
    assert word_frequency(word) == UNKNOWN_FREQUENCY == 1.0


def test_plurals_count_for_their_singular_unless_they_are_nouns_themselves():
    # `chopstick` itself is in none of the ranked lists.
    assert word_frequency("shoe") > word_frequency("wallet")
    assert word_frequency("chopstick") > word_frequency("forklift")
    assert word_frequency("scissors") > word_frequency("scissor")


def test_the_vocabulary_has_every_single_word_noun_and_adjective_of_the_taxonomy():
    words = [word for word, *_ in shipped_lines()]
    assert words == sorted(set(words))
    assert load_taxonomy().adjectives <= set(words)
    assert {"chair", "forklift", "apple", "dog", "water", "wooden", "flowerpot", "worktop"} <= set(words)


def test_shipped_scores_and_shares_are_in_range():
    tenths = [int(score) for _, score, _ in shipped_lines()]
    assert min(tenths) == 10 * UNKNOWN_FREQUENCY
    assert max(tenths) < 80
    shares = [int(share) for _, _, share in shipped_lines() if share != "-"]
    assert (min(shares), max(shares)) == (0, 100)


class TestThingPrior:
    def test_sums_to_one_over_the_vocabulary(self):
        assert math.fsum(math.exp(log_prior(word)) for word, *_ in shipped_lines()) == pytest.approx(1, abs=1e-9)

    @pytest.mark.parametrize("word", ["time", "people", "person", "way", "idea", "love", "can", "chef", "wooden"])
    def test_words_that_name_no_thing_come_after_a_chair(self, word: str):
        assert log_prior(word) < log_prior("chair")

    def test_at_equal_frequency_artifacts_come_before_food_and_food_before_persons(self):
        assert word_frequency("oven") == pytest.approx(word_frequency("onion"), abs=0.4)
        assert word_frequency("onion") == pytest.approx(word_frequency("chef"), abs=0.4)
        assert log_prior("oven") > log_prior("onion") > log_prior("chef")

    def test_a_past_tense_does_not_count_for_the_tool(self):
        assert word_frequency("saw") > word_frequency("hammer")
        assert log_prior("saw") < log_prior("hammer")

    def test_formula_for_artifacts_with_one_sense(self):
        # Only the frequencies differ.
        difference = word_frequency("forklift") - word_frequency("flowerpot")
        assert log_prior("forklift") - log_prior("flowerpot") == pytest.approx(0.75 * math.log(10) * difference)

    def test_words_of_the_home_ontology_that_the_taxonomy_lacks_weigh_half(self):
        difference = word_frequency("forklift") - word_frequency("worktop")
        expected = 0.75 * math.log(10) * difference + math.log(2)
        assert log_prior("forklift") - log_prior("worktop") == pytest.approx(expected)

    def test_unknown_words_have_the_lowest_prior(self):
        assert log_prior("xqzt") == pytest.approx(min(log_prior(word) for word, *_ in shipped_lines()))

    def test_a_compound_of_the_taxonomy_is_a_thing_of_unknown_frequency(self):
        assert log_prior("xqzt") < log_prior("coffeetable") < log_prior("flowerpot")


def test_the_notice_credits_the_sources():
    notice = read_text("FREQUENCIES-LICENSE.txt")
    assert "https://creativecommons.org/licenses/by/3.0/" in notice
    assert "Copyright 2000-2018 by Kevin Atkinson" in notice
    assert len(read_bytes("frequencies.txt.gz")) < 400 * 1024
