"""The words of names in scenes, and which follow one another."""

import math

import pytest

from benchmarks.names.lists import HOME_TABLE, ONTOLOGY_TABLE, PUBLIC_ONTOLOGIES, read_names
from tests.grounding.records import make_class, make_tbox
from tools import build_written_names
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.abbreviations import AbbreviationReader
from usd2kg.grounding.lexical.reading.name_bigrams import WrittenNames, load_written_names
from usd2kg.knowledge import read_text

NAMES = WrittenNames("pot lid\npot lid\npot\nlamp\n")


class TestWords:
    def test_a_words_share_is_that_of_all_words(self):
        # Six words, three of which are `pot`.
        assert NAMES.log_share("pot") == pytest.approx(math.log(3 / 6))
        assert NAMES.log_share("lamp") == pytest.approx(math.log(1 / 6))
        assert NAMES.log_share("spoon") == -math.inf

    def test_how_often_a_word_follows_another(self):
        # Two of the three pots are before a lid, and five more uses are taken to be before unseen words.
        assert NAMES.followers("pot") == {"lid": pytest.approx(2 / 8)}
        assert NAMES.followers("lid") == NAMES.followers("spoon") == {}

    def test_how_much_oftener_a_word_stands_last_than_before_another(self):
        # Half a use more of each kind is supposed; the pot that is a name by itself is neither.
        assert NAMES.odds_of_last("lid") == pytest.approx(2.5 / 0.5)
        assert NAMES.odds_of_last("pot") == pytest.approx(0.5 / 2.5)
        assert NAMES.odds_of_last("lamp") == NAMES.odds_of_last("spoon") == 1

    def test_materials_end_names_and_towels_do_not(self):
        odds = load_written_names().odds_of_last
        assert min(odds("oak"), odds("brass"), odds("marble")) > 1
        assert max(odds("towel"), odds("soap"), odds("milk")) < 0.2

    def test_nothing_is_written_without_names(self):
        empty = WrittenNames("")
        assert empty.log_share("pot") == -math.inf
        assert empty.followers("pot") == {}


class TestReading:
    """A reader of a TBox that knows none of these words."""

    reader = AbbreviationReader(build_lexicon(make_tbox(make_class("Thing")), load_taxonomy(), {}), load_taxonomy())

    @pytest.mark.parametrize(
        ("letters", "words"),
        [
            # Texts have stools, loads and likes as often; names have materials and parts.
            ("shlfstl", ("shelf", "steel")),
            ("bxld", ("box", "lid")),
            ("shlfk", ("shelf", "oak")),
            ("glssdr", ("glass", "door")),
        ],
    )
    def test_a_name_is_read_as_names_are_written(self, letters: str, words: tuple[str, ...]):
        assert self.reader.read([letters])[0].words == words


class TestFile:
    def test_what_ships_is_what_the_tool_writes(self):
        assert read_text("written_names.txt") == build_written_names.build_written_names()

    def test_no_list_that_is_a_test_is_read(self):
        read = set(build_written_names.names())
        tests = [
            names for table in (HOME_TABLE, ONTOLOGY_TABLE) for names in read_names(table) if names.split == "test"
        ]
        for listed in tests:
            names = {row["name"] for row in listed.rows}
            # Authors give some objects the same name; lists with public ontologies repeat names of the home table.
            assert len(names & read) < 0.15 * len(names) or listed.ontology in PUBLIC_ONTOLOGIES, listed.name

    @pytest.mark.parametrize(
        ("name", "runs"),
        [
            ("SM_SaladSpinner_Felco_02", ["salad spinner"]),
            ("CupBoard_left", ["cupboard left"]),
            ("chr_dining_oak", ["dining oak"]),
            ("spoons_matress_bed", ["spoon", "bed"]),
            ("Kuehlschrank_links", ["kuehlschrank links"]),
            ("LOD_01", []),
        ],
    )
    def test_names_are_parted_by_what_is_no_word(self, name: str, runs: list[str]):
        assert list(build_written_names.known_runs(name)) == runs

    def test_left_is_among_the_words_of_names(self):
        assert load_written_names().counts["left"] > load_written_names().counts["cup"]
