"""The words behind a short form: found without writing every word in every way."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.grounding.lexical.reading.shortening import Choice, FormIndex, find_range, forms_of, usual_abbreviations

PRIORS = {word: -float(at % 5) for at, word in enumerate("cup cap coffee cupboard copper oven ear eau gym a".split())}


def by_writing_all(form: str, most: int) -> list[Choice]:
    """Return the same by the ways in which each word is written."""
    every = [Choice(PRIORS[word] + dict(forms_of(word))[form], word) for word in PRIORS if form in dict(forms_of(word))]
    return sorted(every, reverse=True)[:most]


FORMS = sorted({form for word in PRIORS for form, _ in forms_of(word)})


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("most", [1, 3, 100])
def test_the_choices_are_the_likeliest_words_that_are_written_so(form: str, most: int):
    found, expected = FormIndex(PRIORS, most).choices(form), by_writing_all(form, most)
    assert found is not None
    assert [choice.word for choice in found] == [choice.word for choice in expected]
    assert [choice.score for choice in found] == pytest.approx([choice.score for choice in expected])


@settings(deadline=None)
@given(st.text("aceopru", min_size=1, max_size=8))
def test_none_means_that_nothing_begins_so(form: str):
    found = FormIndex(PRIORS, 100).choices(form)
    assert [choice.word for choice in found or []] == [choice.word for choice in by_writing_all(form, 100)]
    if found is None:
        assert not any(known.startswith(form) for known in FORMS)


def test_a_word_in_full_is_likelier_than_as_a_beginning():
    # cup is a form of cup, whole, and of cupboard, cut; both have the prior of their place.
    scores = {choice.word: choice.score for choice in FormIndex({"cup": 0.0, "cupboard": 0.0}, 5).choices("cup") or []}
    assert scores == pytest.approx({"cup": math.log(0.15 + 0.2 * 0.88), "cupboard": math.log(0.2 * 0.28)})


@pytest.mark.parametrize(
    ("beginning", "places"),
    [("b", (1, 4)), ("ba", (1, 3)), ("bad", (2, 3)), ("c", (4, 5)), ("x", (5, 5)), ("", (0, 5))],
)
def test_what_begins_alike_lies_together(beginning: str, places: tuple[int, int]):
    assert find_range(["a", "ba", "bad", "bz", "cup"], beginning) == places


def test_agreed_abbreviations():
    assert usual_abbreviations()["kbd"] == "keyboard"
