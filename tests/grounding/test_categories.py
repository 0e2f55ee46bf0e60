"""What people count among general categories, though the taxonomy has it elsewhere.

Which class single names are grounded to is scored in `regression.csv`, group `categories`.
"""

import re

import pytest

from tests.grounding.ontologies import load_ontology
from tests.grounding.records import ground_names
from tests.grounding.test_taxonomy import TINY
from tools import build_categories
from usd2kg.grounding.lexical.concepts.categories import find_synset, members_of
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.knowledge import read_rows


class TestMembers:
    def test_a_name_means_its_first_sense_unless_the_rank_is_given(self):
        assert find_synset("bun", TINY) == 6
        assert find_synset("bun#2", TINY) == 5
        assert find_synset("flower pot", TINY) == find_synset("flower-pot", TINY) == 6
        assert find_synset("bun#3", TINY) is None
        assert find_synset("ghost", TINY) is None

    def test_a_stapler_is_stationery(self):
        taxonomy = load_taxonomy()
        members = dict(members_of("stationery", taxonomy))
        assert {up for up, _ in taxonomy.walk_up(taxonomy.senses("stapler")[0].synset)} & members.keys()

    def test_members_share_the_size_of_their_category(self):
        assert len(set(dict(members_of("stationery", load_taxonomy())).values())) == 1

    def test_an_unknown_category_has_no_members(self):
        assert list(members_of("flurbl", load_taxonomy())) == []


class TestBuild:
    """`tools/build_categories.py` with the taxonomy of `test_taxonomy`."""

    def test_drops_members_below_the_category_or_below_another_member(self):
        # A knife is a cutter, so a tool; a bun is food.
        assert build_categories.find_informative_members(["tool"], ["cutter", "bun#2"], TINY) == ["bun#2"]
        assert build_categories.find_informative_members(["kit"], ["knife", "tool", "roll"], TINY) == ["tool", "roll"]
        assert build_categories.find_informative_members(["kit"], ["roll", "bun#2"], TINY) == ["roll"]

    def test_rejects_a_member_that_the_taxonomy_lacks(self):
        with pytest.raises(ValueError, match=r"kit\|set: 'ghost' is not a noun of the taxonomy"):
            build_categories.find_informative_members(["kit", "set"], ["tool", "ghost"], TINY)

    def test_merges_rows_whose_categories_share_a_first_sense(self):
        # Flower-pot, knife and the first sense of bun are one synset.
        rows = [(["flower-pot", "pot"], ["roll", "food"]), (["cutter"], ["bun"]), (["knife"], ["food", "tool"])]
        assert build_categories.merge_synonymous_kinds(rows, TINY) == [
            (["flower-pot", "pot", "xray", "knife"], ["roll", "food", "tool"]),
            (["cutter"], ["bun"]),
        ]

    def test_counts_a_hyponym_of_two_members_once(self):
        below = [[1, 3], [2, 6], [4], [5], [6], [], []]
        assert build_categories.count_hyponyms([1], below) == 4
        assert build_categories.count_hyponyms([2, 4, 5], below) == 4


def test_each_category_of_the_table_has_one_row():
    names = [name.replace("-", " ") for row in read_rows("categories.csv") for name in row["kinds"].split("|")]
    assert [name for name in names if not re.fullmatch(r"[a-z0-9][a-z0-9 '/&.()]*", name)] == []
    assert len({name.replace(" ", "") for name in names}) == len(names) > 2000


@pytest.mark.parametrize(
    ("ontology", "name", "explanation"),
    [
        ("office", "stapler", "“stapler” is a kind of “stationery item”, which counts as Stationery"),
        ("office equipment", "telephone", "“telephone” counts as OfficeEquipment"),
    ],
)
def test_explanation_names_the_category(ontology: str, name: str, explanation: str):
    assert ground_names([name], load_ontology(ontology))[0].explanation == explanation
