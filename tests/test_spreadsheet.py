"""Texts of CSV files that a spreadsheet must not evaluate."""

from hypothesis import given
from hypothesis import strategies as st

from usd2kg.spreadsheet import guard_formula, unguard_formula


@given(st.text("'=+-@\t a", max_size=6))
def test_a_guarded_text_is_no_formula_and_is_read_back(text: str):
    guarded = guard_formula(text)
    assert not guarded.startswith(("=", "+", "-", "@", "\t", "\r"))
    assert unguard_formula(guarded) == text


@given(st.text("ab'\" ", max_size=6))
def test_other_texts_stay(text: str):
    assert guard_formula(text) == unguard_formula(text) == text
