"""How much likelier the words of a name are if all of them are shortened in one way."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.test_shortening import CUT, FIRST_VOWEL, FULL, KEPT, SKELETON
from usd2kg.grounding.lexical.reading.shortening_style import log_consistency

ALIKE, ANYHOW = 0.7, 0.3
"""How likely the words of one name are shortened in one way, or each in any way."""


def factor(letters: str, *words: str, whole: dict[int, str] | None = None) -> float:
    return math.exp(log_consistency(letters, words, whole or {}))


def test_two_words_shortened_in_one_way():
    # spn and frk are all consonants: either skeleton, with three letters or more kept.
    spoon = (SKELETON + FIRST_VOWEL) * (KEPT[3] + KEPT[4] + KEPT[5] + KEPT[6])
    assert factor("spnfrk", "spoon", "fork") == pytest.approx(ANYHOW + ALIKE / spoon)


def test_two_words_that_no_one_way_explains():
    # spn has lost its vowels, for is cut after three letters.
    assert factor("spnfor", "spoon", "fork") == pytest.approx(ANYHOW)


def test_one_word_narrows_the_ways_of_the_other():
    # Three letters of blender are kept; of spoon all consonants are there with three or more.
    blender, spoon = (SKELETON + FIRST_VOWEL) * KEPT[3], (SKELETON + FIRST_VOWEL) * (1 - KEPT[1] - KEPT[2])
    assert factor("blnspn", "blender", "spoon") == pytest.approx(ANYHOW + ALIKE * blender / (blender * spoon))


@pytest.mark.parametrize("letters", ["spn", "spoon"])
def test_a_single_word_is_as_likely_as_without(letters: str):
    assert factor(letters, "spoon") == pytest.approx(1)


def test_words_known_to_be_in_full_do_not_count():
    assert factor("butterknf", "butter", "knife", whole={0: "butter"}) == pytest.approx(1)
    # Otherwise one word is in full and the other is not.
    assert factor("butterknf", "butter", "knife") == pytest.approx(ANYHOW)
    # Both are in full, or cut after at least four letters.
    fork = FULL + CUT * (KEPT[4] + KEPT[5] + KEPT[6])
    assert factor("spoonfork", "spoon", "fork") == pytest.approx(ANYHOW + ALIKE / fork)


def test_conventional_abbreviations_do_not_count():
    assert factor("kbdspn", "keyboard", "spoon") == pytest.approx(1)


def test_unexplained_letters_between_words_are_skipped():
    alone = factor("spnfrk", "spoon", "fork")
    assert factor("spnxqfrk", "spoon", "fork") == pytest.approx(alone)
    assert factor("xqspnfrkxq", "spoon", "fork") == pytest.approx(alone)


@settings(deadline=None)
@given(st.text("abcdefgst", max_size=14), st.lists(st.sampled_from(["spoon", "fork", "oak", "a", "bed"]), max_size=4))
def test_any_letters_and_words_have_a_finite_factor(letters: str, words: list[str]):
    assert ANYHOW - 1e-9 <= factor(letters, *words) < math.inf
