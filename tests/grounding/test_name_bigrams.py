"""Words of names in scenes, and which words follow which."""

import math

import pytest

from benchmarks.names.lists import HOME_TABLE, ONTOLOGY_TABLE, PUBLIC_ONTOLOGIES, read_names
from tools import build_written_names
from usd2kg.grounding.lexical.reading.name_bigrams import NameBigrams, load_name_bigrams
from usd2kg.knowledge import read_text

NAMES = NameBigrams("pot lid\npot lid\npot\nlamp\n")


class TestCounts:
    def test_share_of_a_word_among_all_words(self):
        # Six words, three of which are pot.
        assert NAMES.log_share("pot") == pytest.approx(math.log(3 / 6))
        assert NAMES.log_share("lamp") == pytest.approx(math.log(1 / 6))
        assert NAMES.log_share("spoon") == -math.inf

    def test_share_of_the_words_that_follow(self):
        # Two of three pots precede a lid; five pseudo-counts are left for unseen words.
        assert NAMES.followers("pot") == {"lid": pytest.approx(2 / 8)}
        assert NAMES.followers("lid") == NAMES.followers("spoon") == {}

    def test_odds_of_standing_last(self):
        # With half a pseudo-count of each; a name of one word counts as neither.
        assert NAMES.odds_of_last("lid") == pytest.approx(2.5 / 0.5)
        assert NAMES.odds_of_last("pot") == pytest.approx(0.5 / 2.5)
        assert NAMES.odds_of_last("lamp") == NAMES.odds_of_last("spoon") == 1

    def test_without_names_no_word_has_a_share(self):
        assert NameBigrams("").log_share("pot") == -math.inf
        assert NameBigrams("").followers("pot") == {}


class TestShippedNames:
    def test_materials_stand_last_more_often_than_goods(self):
        odds = load_name_bigrams().odds_of_last
        assert min(odds("oak"), odds("brass"), odds("marble")) > 1
        assert max(odds("towel"), odds("soap"), odds("milk")) < 0.2

    def test_file_is_what_the_tool_writes(self):
        assert read_text("written_names.txt") == build_written_names.build_written_names()

    def test_no_list_of_a_test_split_is_read(self):
        read = set(build_written_names.names())
        for listed in (names for table in (HOME_TABLE, ONTOLOGY_TABLE) for names in read_names(table)):
            names = {row["name"] for row in listed.rows}
            # Authors reuse some names; lists of public ontologies repeat those of the home table.
            is_separate = len(names & read) < 0.15 * len(names) or listed.ontology in PUBLIC_ONTOLOGIES
            assert listed.split != "test" or is_separate, listed.name

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
    def test_unknown_words_split_a_name_into_runs(self, name: str, runs: list[str]):
        assert list(build_written_names.known_runs(name)) == runs
