"""Identifiers split into words."""

import unicodedata

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.words import is_content_word, split_identifier, words_of


@pytest.mark.parametrize(
    ("identifier", "parts"),
    [
        ("SM_CupCBlue_01", ("SM", "Cup", "C", "Blue", "01")),
        ("coffeeTable", ("coffee", "Table")),
        ("TVCabinet2b", ("TV", "Cabinet", "2", "b")),
        ("HTMLParser", ("HTML", "Parser")),
        ("aTV", ("a", "TV")),
        ("drawer-03.handle", ("drawer", "03", "handle")),
        ("__x__", ("x",)),
        ("", ()),
        ("___", ()),
        ("2x4", ("2", "x", "4")),
        ("KücheÖl", ("Küche", "Öl")),
        ("мебельСтол", ("мебель", "Стол")),
        ("椅子_3", ("椅子", "3")),
        ("tn__knob1_f5", ("knob", "1")),
        ("tn__1", ("1",)),
        ("btn__knob1_f5", ("btn", "knob", "1", "f", "5")),  # the escape of an exporter is a prefix
    ],
)
def test_split_identifier(identifier, parts):
    assert split_identifier(identifier) == parts


def test_a_letter_with_a_combining_mark_is_one_letter():
    assert split_identifier(unicodedata.normalize("NFD", "Küchentür")) == ("Küchentür",)


@pytest.mark.parametrize("word", ["मेज", "कुर्सी", "เก้าอี้"])
def test_vowel_signs_do_not_split_a_word(word):
    # Table and chair in Hindi, chair in Thai; their vowel signs have no precomposed letters.
    assert split_identifier(word) == (word,)


@settings(max_examples=300, deadline=None)
@given(st.text(max_size=30).filter(lambda text: not unicodedata.normalize("NFC", text).startswith("tn__")))
def test_splitting_keeps_all_letters_and_digits(text):
    kept = "".join(char for char in unicodedata.normalize("NFC", text) if char.isalnum())
    joined = "".join(char for part in split_identifier(text) for char in part if char.isalnum())
    assert joined == kept


@settings(max_examples=300, deadline=None)
@given(st.text(alphabet="aBcD12_- ", max_size=30))
def test_parts_are_words_or_numbers_and_are_not_split_further(text):
    for part in split_identifier(text):
        assert part.isalpha() or part.isdigit()
        assert split_identifier(part) == (part,)


@settings(max_examples=100, deadline=None)
@given(st.lists(st.from_regex(r"[a-z]{2,8}", fullmatch=True), min_size=1, max_size=5))
def test_snake_camel_and_spaced_words_are_split_alike(words):
    expected = tuple(words)
    for joined in ("_".join(words), "".join(word.capitalize() for word in words), " ".join(words)):
        assert tuple(part.lower() for part in split_identifier(joined)) == expected


@pytest.mark.parametrize(
    ("identifier", "words"),
    [
        ("SM_CupCBlue_01", ("cup", "blue")),
        ("geo_01", ()),
        ("Kitchen_Table_LOD0", ("kitchen", "table")),
        ("aws_robomaker_warehouse_ShelfE_01", ("aws", "robomaker", "warehouse", "shelf")),
        ("LowTable", ("table",)),
        ("Lowboard", ("lowboard",)),  # low is a production token only as a word
        ("椅", ("椅",)),  # an ideograph can be a word
        ("a", ()),
    ],
)
def test_words_of(identifier, words):
    assert words_of(identifier) == words


@pytest.mark.parametrize(
    ("word", "expected"), [("cup", True), ("tv", True), ("sm", False), ("c", False), ("12", False), ("ü", True)]
)
def test_is_content_word(word, expected):
    assert is_content_word(word) is expected


@settings(max_examples=100, deadline=None)
@given(st.text(max_size=20))
def test_words_are_lower_case_and_telling(text):
    for word in words_of(text):
        assert word == word.lower()
        assert is_content_word(word)
