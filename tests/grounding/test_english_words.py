"""Which runs of letters are English words."""

import pytest

from usd2kg.grounding.lexical.reading.english_words import SHORTEST_WORD, is_common_word, is_english_word
from usd2kg.knowledge import read_compressed, read_text


@pytest.mark.parametrize("word", ["splash", "teaching", "exercise"])
def test_frequent_words_are_common(word: str):
    assert is_common_word(word)
    assert is_english_word(word)


@pytest.mark.parametrize("word", ["mossy", "telescopic", "disinfection", "schoolgirl", "tidied", "gherkins"])
def test_the_dictionary_adds_rare_and_inflected_words(word: str):
    assert is_english_word(word)
    assert not is_common_word(word)


@pytest.mark.parametrize("word", ["cuboard", "vinager", "drwrs", "tblspn", "", "a\nb", "mossy\n", "Mossy", "ossy"])
def test_misspellings_abbreviations_and_fragments_are_no_words(word: str):
    assert not is_english_word(word)


@pytest.mark.parametrize("word", ["over", "mile", "cab"])
def test_short_words_may_be_abbreviations(word: str):
    assert len(word) < SHORTEST_WORD
    assert not is_english_word(word)


def test_the_dictionary_lists_each_word_once_and_no_common_one():
    words = read_compressed("english_words.txt.gz").decode("ascii").split("\n")
    assert words.pop() == ""
    assert words == sorted(set(words))
    assert all(word.isalpha() and word.islower() and len(word) >= SHORTEST_WORD for word in words)
    assert not any(map(is_common_word, words))


def test_the_notice_names_the_dictionary():
    assert "english_words.txt.gz" in read_text("FREQUENCIES-LICENSE.txt")
