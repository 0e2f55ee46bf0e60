"""`usd2kg.knowledge` reads the package data."""

import pytest

from usd2kg.knowledge import read_bytes, read_rows, read_text, word_map, word_set


def test_reads_a_file_as_text_bytes_and_rows():
    assert read_bytes("abbreviations.csv").decode() == read_text("abbreviations.csv")
    assert {"short": "btl", "word": "bottle"} in read_rows("abbreviations.csv")


def test_word_set_is_read_once():
    words = word_set("identifiers", "production_tokens")
    assert {"sm", "lod", "geo"} <= words
    assert word_set("identifiers", "production_tokens") is words


def test_an_unknown_list_raises():
    with pytest.raises(KeyError, match="colours"):
        word_set("identifiers", "colours")


def test_a_list_is_no_map():
    with pytest.raises(TypeError, match=r"production_tokens in knowledge/words/identifiers.toml is a list"):
        word_map("identifiers", "production_tokens")
