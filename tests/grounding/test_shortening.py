"""Forms that words are abbreviated to, and the words behind a form."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.grounding.lexical.reading.shortening import Expansion, FormIndex, find_range, forms_of, usual_abbreviations

FULL, SKELETON, FIRST_VOWEL, CUT = 0.15, 0.5, 0.15, 0.2
"""How likely a word is written in full, without vowels, without vowels after the first letter, or cut."""
KEPT = {1: 0.02, 2: 0.1, 3: 0.28, 4: 0.35, 5: 0.15, 6: 0.1}
"""Number of letters kept → probability."""
PRIORS = {word: -float(at % 5) for at, word in enumerate("cup cap coffee cupboard copper oven ear eau gym a".split())}
FORMS = sorted({form for word in PRIORS for form, _ in forms_of(word)})


def probabilities(word: str) -> dict[str, float]:
    return {form: math.exp(score) for form, score in forms_of(word)}


def choose_by_brute_force(form: str, most: int) -> list[Expansion]:
    """Return the likeliest words of a form, found by writing every word in every form."""
    forms = {word: dict(forms_of(word)) for word in PRIORS}
    every = [Expansion(PRIORS[word] + forms[word][form], word) for word in PRIORS if form in forms[word]]
    return sorted(every, reverse=True)[:most]


def test_forms_of_a_word_that_begins_with_a_consonant():
    # Both skeletons of cup are cp, complete with two letters or more; cut, it is c, cu, or cup.
    assert probabilities("cup") == pytest.approx(
        {
            "cp": (SKELETON + FIRST_VOWEL) * (1 - KEPT[1]),
            "c": (SKELETON + FIRST_VOWEL + CUT) * KEPT[1],
            "cu": CUT * KEPT[2],
            "cup": FULL + CUT * (1 - KEPT[1] - KEPT[2]),
        }
    )


def test_forms_of_a_word_that_begins_with_a_vowel():
    # oven is vn without vowels, ovn with its first letter kept.
    assert probabilities("oven") == pytest.approx(
        {
            "oven": FULL + CUT * (1 - KEPT[1] - KEPT[2] - KEPT[3]),
            "v": SKELETON * KEPT[1],
            "vn": SKELETON * (1 - KEPT[1]),
            "o": (FIRST_VOWEL + CUT) * KEPT[1],
            "ov": (FIRST_VOWEL + CUT) * KEPT[2],
            "ovn": FIRST_VOWEL * (1 - KEPT[1] - KEPT[2]),
            "ove": CUT * KEPT[3],
        }
    )


@pytest.mark.parametrize(
    ("word", "forms"),
    [
        ("refrigerator", {"rfrg", "rfrgr", "refr", "refrig", "rf", "refrigerator"}),
        ("keyboard", {"kybr", "kybrd", "keyb", "keyboard"}),
        ("gym", {"gym", "g", "gy"}),  # y is not a vowel
    ],
)
def test_forms_of_longer_words(word: str, forms: set[str]):
    assert forms <= set(probabilities(word))


@settings(deadline=None)
@given(st.text("abcdefghijklmnopqrstuvwxyzäñ", min_size=1, max_size=20))
def test_probabilities_of_all_forms_add_up_to_one(word: str):
    found = probabilities(word)
    assert all(0 < value <= 1 for value in found.values())
    assert all(form[0] in word and len(form) <= len(word) for form in found)
    # A word of vowels has no skeleton; no other form gets that share.
    expected = 1 if set(word) - set("aeiou") else 1 - SKELETON
    assert sum(found.values()) == pytest.approx(expected)
    assert len(found) == len(forms_of(word))


@pytest.mark.parametrize("most", [1, 3, 100])
def test_choices_are_the_likeliest_words_of_a_form(most: int):
    index = FormIndex(PRIORS, most)
    for form in FORMS:
        found, expected = index.choices(form), choose_by_brute_force(form, most)
        assert found is not None
        assert [choice.word for choice in found] == [choice.word for choice in expected]
        assert [choice.score for choice in found] == pytest.approx([choice.score for choice in expected])


@settings(deadline=None)
@given(st.text("aceopru", min_size=1, max_size=8))
def test_choices_are_none_where_no_form_begins_so(form: str):
    found = FormIndex(PRIORS, 100).choices(form)
    assert [choice.word for choice in found or []] == [choice.word for choice in choose_by_brute_force(form, 100)]
    if found is None:
        assert not any(known.startswith(form) for known in FORMS)


def test_a_word_in_full_is_likelier_than_a_longer_word_cut():
    index = FormIndex({"cup": 0.0, "cupboard": 0.0}, 5)
    scores = {choice.word: choice.score for choice in index.choices("cup") or []}
    expected = {"cup": math.log(FULL + CUT * (1 - KEPT[1] - KEPT[2])), "cupboard": math.log(CUT * KEPT[3])}
    assert scores == pytest.approx(expected)


@pytest.mark.parametrize(
    ("prefix", "places"),
    [("b", (1, 4)), ("ba", (1, 3)), ("bad", (2, 3)), ("c", (4, 5)), ("x", (5, 5)), ("", (0, 5))],
)
def test_find_range_of_a_prefix(prefix: str, places: tuple[int, int]):
    assert find_range(["a", "ba", "bad", "bz", "cup"], prefix) == places


def test_conventional_abbreviations():
    assert usual_abbreviations()["kbd"] == "keyboard"
