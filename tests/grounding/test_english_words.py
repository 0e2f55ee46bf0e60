"""Which runs of letters are English words."""

import gzip

import pytest

from tests.grounding.records import ground_names, local, make_class, make_tbox
from usd2kg.grounding.lexical.reading.english_words import SHORTEST_WORD, is_common_word, is_english_word
from usd2kg.knowledge import read_bytes, read_text
from usd2kg.ontology import TBox


@pytest.mark.parametrize("word", ["splash", "teaching", "exercise"])
def test_what_is_often_written_is_common(word: str):
    assert is_common_word(word)
    assert is_english_word(word)


@pytest.mark.parametrize("word", ["mossy", "telescopic", "disinfection", "schoolgirl", "tidied", "gherkins"])
def test_a_dictionary_has_rarer_and_inflected_words(word: str):
    assert is_english_word(word)
    assert not is_common_word(word)


@pytest.mark.parametrize("word", ["cuboard", "vinager", "drwrs", "tblspn", "", "a\nb", "mossy\n", "Mossy", "ossy"])
def test_no_misspelling_abbreviation_or_part_of_a_word_is_one(word: str):
    assert not is_english_word(word)


@pytest.mark.parametrize("word", ["over", "mile", "cab"])
def test_a_short_word_may_be_what_is_left_of_a_longer_one(word: str):
    assert len(word) < SHORTEST_WORD
    assert not is_english_word(word)


def test_the_dictionary_has_each_word_once_and_none_that_is_common():
    words = gzip.decompress(read_bytes("english_words.txt.gz")).decode("ascii").split("\n")
    assert words.pop() == ""
    assert words == sorted(set(words))
    assert all(word.isalpha() and word.islower() and len(word) >= SHORTEST_WORD for word in words)
    assert not any(map(is_common_word, words))


def test_the_notice_names_the_dictionary():
    assert "english_words.txt.gz" in read_text("FREQUENCIES-LICENSE.txt")


def test_words_of_the_dictionary_are_neither_misspelt_nor_short_for_others():
    # A telescopic stand is no telescope, and a rover no rock with an overall.
    park = make_tbox(make_class("Entity"), *(make_class(name, "Entity") for name in ("Telescope", "Rock", "Seating")))
    names = ["telescopicBleachers", "disinfection_rover", "mossy_boulder_zrw"]
    bleachers, rover, boulder = ground_names(names, park)
    assert list(map(local, (bleachers, rover))) == ["Seating", "Entity"]
    assert boulder.explanation.startswith("“mossy boulder” is a kind of “rock”")


def test_a_word_that_is_none_is_still_read_as_the_nearest(home_tbox: TBox):
    assert list(map(local, ground_names(["Cuboard", "Galss", "bottel"], home_tbox))) == ["Cupboard", "Glass", "Bottle"]
