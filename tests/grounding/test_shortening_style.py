"""Whether the words of a name are shortened alike."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.grounding.lexical.reading import shortening
from usd2kg.grounding.lexical.reading.shortening_style import log_consistency

SKELETON, FIRST_VOWEL, CUT = shortening._STYLES.values()
FULL = shortening._FULL
KEPT = dict(shortening._LENGTHS)


def factor(letters: str, *words: str, whole: dict[int, str] | None = None) -> float:
    return math.exp(log_consistency(letters, words, whole or {}))


def test_two_words_of_one_way_worked_by_hand():
    # `spn` and `frk` are all consonants of their words: by either style without vowels, three letters or more kept.
    spoon = (SKELETON + FIRST_VOWEL) * (KEPT[3] + KEPT[4] + KEPT[5] + KEPT[6])
    assert factor("spnfrk", "spoon", "fork") == pytest.approx(0.3 + 0.7 / spoon)


def test_two_words_of_different_ways_worked_by_hand():
    # `spn` has lost its vowels, `for` is cut after three letters, and no one way does both.
    assert factor("spnfor", "spoon", "fork") == pytest.approx(0.3)


def test_a_way_that_one_of_two_words_tells_apart():
    # Three letters are left of `blender`, so three were kept; all of `spoon` would be left had more been.
    blender, spoon = (SKELETON + FIRST_VOWEL) * KEPT[3], (SKELETON + FIRST_VOWEL) * (1 - KEPT[1] - KEPT[2])
    assert factor("blnspn", "blender", "spoon") == pytest.approx(0.3 + 0.7 * blender / (blender * spoon))


def test_a_word_alone_is_written_as_likely_as_ever():
    assert factor("spn", "spoon") == pytest.approx(1)
    assert factor("spoon", "spoon") == pytest.approx(1)


def test_words_in_full_for_certain_tell_nothing_of_the_others():
    assert factor("butterknf", "butter", "knife", whole={0: "butter"}) == pytest.approx(1)
    # Where that is not for certain, one is in full and the other is not.
    assert factor("butterknf", "butter", "knife") == pytest.approx(0.3)
    # In full, or cut after at least as many letters as it has; who leaves the spoon so leaves the fork so.
    fork = FULL + CUT * (KEPT[4] + KEPT[5] + KEPT[6])
    assert factor("spoonfork", "spoon", "fork") == pytest.approx(0.3 + 0.7 / fork)


def test_an_abbreviation_that_people_agreed_on_tells_nothing():
    assert factor("kbdspn", "keyboard", "spoon") == pytest.approx(1)


def test_letters_of_no_word_lie_between():
    alone = factor("spnfrk", "spoon", "fork")
    assert factor("spnxqfrk", "spoon", "fork") == pytest.approx(alone)
    assert factor("xqspnfrkxq", "spoon", "fork") == pytest.approx(alone)


def test_words_that_are_not_there_are_not_alike():
    assert factor("xqz", "spoon", "fork") == pytest.approx(0.3)


@given(st.text("abcdefgst", max_size=14), st.lists(st.sampled_from(["spoon", "fork", "oak", "a", "bed"]), max_size=4))
def test_any_letters_and_words_have_a_factor(letters: str, words: list[str]):
    assert 0.3 - 1e-9 <= factor(letters, *words) < math.inf
