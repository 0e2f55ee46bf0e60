"""The noun taxonomy: senses by rank, paths of hypernyms, singulars."""

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tools.build_wordnet import Synset, build_columns, choose_label, count_nouns
from usd2kg.grounding.lexical.concepts.taxonomy import Sense, Taxonomy, load_taxonomy
from usd2kg.grounding.lexical.concepts.taxonomy_file import format_taxonomy, parse_taxonomy

# Synsets by number. A lemma is followed by the rank of its sense.
#
#   0 entity ── 1 artifact ── 2 tool ── 4 cutter ── 6 knife
#            └─ 3 food        └──────────────────────┘ (a knife is an artifact also directly)
#                └─ 5 bun
SYNSETS = [
    Synset("top", [], [("entity", 1)]),
    Synset("artifact", [0], [("artifact", 1)]),
    Synset("artifact", [1], [("tool", 1)]),
    Synset("food", [0], [("food", 1)]),
    Synset("artifact", [2], [("cutter", 1)]),
    Synset("food", [3], [("bun", 2), ("roll", 2)]),
    Synset("artifact", [4, 1], [("knife", 1), ("flower pot", 1), ("x-ray", 3), ("bun", 1)]),
]
WORDNET_KNIFE = "http://wordnet-rdf.princeton.edu/id/03628765-n"
TINY = Taxonomy(build_columns(["red", "wooden"], SYNSETS))


def test_columns_of_the_file():
    columns = build_columns(["red", "wooden"], SYNSETS)
    assert {name: cells.decode().split("\t") for name, cells in columns._asdict().items()} == {
        "adjectives": ["red", "wooden"],
        "domains": "top animal artifact body communication food group object phenomenon plant shape substance "
        "person".split(),
        "synset_names": ["entity", "artifact", "tool", "food", "cutter", "bun", "knife"],
        "synset_hypernyms": ["", "0", "1", "0", "2", "3", "4 1"],
        "synset_hyponym_counts": ["7", "4", "3", "2", "2", "1", "1"],
        "lemmas": ["artifact", "bun", "cutter", "entity", "flowerpot", "food", "knife", "roll", "tool", "xray"],
        "lemma_kinds": ["c1", "c1 f2", "c1", "a1", "c1", "f1", "c1", "f2", "c1", "c3"],
        "lemma_synsets": ["1", "6 5", "4", "0", "6", "3", "6", "5", "2", "6"],
        "lemma_is_one_word": ["1111011110"],
    }


def test_a_file_round_trips():
    columns = build_columns(["red", "wooden"], SYNSETS)
    text = format_taxonomy(columns)
    assert text.startswith(b"usd2kg noun taxonomy, format 3\n[adjectives]\nred\twooden\n[domains]\ntop\t")
    assert parse_taxonomy(text) == columns


@pytest.mark.parametrize(
    "text", [b"", b"usd2kg noun taxonomy, format 2\n", b"usd2kg noun taxonomy, format 3\n[lemmas]\n"]
)
def test_rejects_a_file_of_another_format(text):
    with pytest.raises(ValueError, match="expected 'usd2kg noun taxonomy, format 3' and its sections"):
        parse_taxonomy(text)


def test_senses_are_sorted_by_rank():
    assert TINY.senses("bun") == (Sense(6, 1, "artifact"), Sense(5, 2, "food"))


def test_the_size_of_a_synset_counts_itself_and_its_hyponyms():
    assert [TINY.size(synset) for synset in range(TINY.synset_count)] == [7, 4, 3, 2, 2, 1, 1]


def test_an_unknown_lemma_has_no_senses():
    assert TINY.senses("buns") == ()
    assert TINY.kinds("buns") == ""
    assert TINY.parse_kinds("") == []
    assert "buns" not in TINY
    assert "bun" in TINY


@pytest.mark.parametrize("lemma", ["", "bu", "bu\U0010ffff", "\udc80", "zz"])
def test_a_prefix_of_a_lemma_is_unknown(lemma: str):
    assert lemma not in TINY
    assert lemma not in load_taxonomy()


def test_every_lemma_of_the_package_is_found():
    taxonomy = load_taxonomy()
    assert list(taxonomy.lemmas) == sorted(set(taxonomy.lemmas))
    assert all(lemma in taxonomy for lemma in taxonomy.lemmas)


def test_compounds_are_looked_up_without_space_or_hyphen():
    assert TINY.senses("flowerpot") == (Sense(6, 1, "artifact"),)
    assert TINY.senses("xray") == (Sense(6, 3, "artifact"),)
    assert TINY.senses("flower pot") == ()


def test_kinds_encode_the_ranks_and_domains_of_the_senses():
    assert TINY.parse_kinds(TINY.kinds("bun")) == [(1, "artifact"), (2, "food")]
    assert TINY.kinds("knife") == TINY.kinds("tool")


def test_adjectives_are_listed():
    assert TINY.adjectives == {"red", "wooden"}


def test_the_name_of_a_synset_is_its_first_lemma():
    assert [TINY.name(synset) for synset in (5, 6)] == ["bun", "knife"]


def test_walk_up_yields_each_synset_once_at_its_shortest_distance():
    # 6 → {4, 1} in one hop; 4 → 2 and 1 → 0 in two; 2 → 1 is seen already, 0 has nothing above.
    assert list(TINY.walk_up(6)) == [(6, 0), (4, 1), (1, 1), (2, 2), (0, 2)]
    assert list(TINY.walk_up(0)) == [(0, 0)]


def test_path_up_is_a_shortest_path():
    assert TINY.path_up(6, 0) == [6, 1, 0]
    assert TINY.path_up(6, 2) == [6, 4, 2]
    assert TINY.path_up(6, 6) == [6]


@pytest.mark.parametrize(
    ("word", "singular"),
    [
        ("knives", "knife"),
        ("boxes", "box"),
        ("buses", "bus"),
        ("shelves", "shelf"),
        ("dishes", "dish"),
        ("cherries", "cherry"),
        ("toys", "toy"),
        ("women", "woman"),
        ("windows", "window"),
        ("taps", "tap"),
        # Nouns that end like plurals.
        ("glass", "glass"),
        ("glasses", "glasses"),
        ("lens", "lens"),
        ("gas", "gas"),
        # No nouns.
        ("qwertys", "qwertys"),
        ("us", "us"),
        ("", ""),
    ],
)
def test_singular(word: str, singular: str):
    assert load_taxonomy().singular(word) == singular


def test_words_lists_single_words_of_the_domains():
    assert TINY.words(frozenset({"food"})) == ["bun", "food", "roll"]
    # This taxonomy has it only as two words.
    assert "flowerpot" not in TINY.words(frozenset({"artifact"}))
    assert "flowerpot" in load_taxonomy().words(frozenset({"artifact"}))
    assert TINY.words(frozenset({"plant"})) == []


def test_the_shipped_taxonomy_knows_that_a_mug_is_an_artifact():
    taxonomy = load_taxonomy()
    (sense,) = [sense for sense in taxonomy.senses("mug") if sense.domain == "artifact"]
    above = [taxonomy.name(synset) for synset, _ in taxonomy.walk_up(sense.synset)]
    assert "vessel" in above
    assert "container" in above
    assert "furniture" not in above


def test_the_shipped_taxonomy_is_read_once():
    assert load_taxonomy() is load_taxonomy()


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(["cup", "crane", "table", "bass", "oven", "book", "palm", "mouse"]), st.data())
def test_path_up_agrees_with_walk_up(lemma: str, data: st.DataObject):
    taxonomy = load_taxonomy()
    start = data.draw(st.sampled_from(taxonomy.senses(lemma))).synset
    target, hops = data.draw(st.sampled_from(list(taxonomy.walk_up(start))))
    path = taxonomy.path_up(start, target)
    assert (path[0], path[-1], len(path)) == (start, target, hops + 1)
    for below, above in itertools.pairwise(path):
        assert (above, 1) in list(taxonomy.walk_up(below))


class TestConceptIri:
    TAXONOMY = Taxonomy(build_columns([], SYNSETS), lambda: "".join(f"{at:08}" for at in range(5)))

    def test_a_synset_of_wordnet_has_its_iri(self):
        assert self.TAXONOMY.concept_iri(4) == "http://wordnet-rdf.princeton.edu/id/00000004-n"

    def test_another_synset_has_one_of_this_project(self):
        assert self.TAXONOMY.concept_iri(6) == "https://w3id.org/usd2kg/concept/knife"

    @pytest.mark.parametrize(
        "iri",
        [
            "",
            "http://wordnet-rdf.princeton.edu/id/00000005-n",
            "http://wordnet-rdf.princeton.edu/id/00000004-v",
            "https://w3id.org/usd2kg/concept/",
            "https://w3id.org/usd2kg/concept/spoon",
            # WordNet has it, so its IRI is WordNet's.
            "https://w3id.org/usd2kg/concept/food",
        ],
    )
    def test_another_iri_is_no_synset(self, iri):
        assert self.TAXONOMY.find_concept(iri) is None

    def test_every_synset_of_the_package_has_an_iri_of_its_own(self):
        taxonomy = load_taxonomy()
        synsets = range(taxonomy.synset_count)
        assert [taxonomy.find_concept(taxonomy.concept_iri(synset)) for synset in synsets] == [*synsets]
        assert taxonomy.concept_iri(taxonomy.senses("knife")[0].synset) == WORDNET_KNIFE


class TestLabels:
    TAXONOMY = Taxonomy(build_columns([], SYNSETS), read_labels=lambda: b"\t\t\t\t\troll\t")

    def test_a_usual_noun_replaces_the_first_lemma(self):
        assert [self.TAXONOMY.label(synset) for synset in (4, 5, 6)] == ["cutter", "roll", "knife"]

    @pytest.mark.parametrize(
        ("names", "label"),
        [
            ([], "bun"),
            (["bun"], "bun"),
            (["sweet roll"], "roll"),
            # Five times as often is not enough.
            (["bun", *["roll"] * 5], "bun"),
            (["bun", *["roll"] * 6], "roll"),
            # It does not end the name.
            (["roll holder"], "bun"),
        ],
    )
    def test_the_usual_noun_ends_several_times_as_many_names(self, names: list[str], label: str):
        synset = Synset("food", [], [("bun", 1), ("roll", 1), ("bap", 2)])
        assert choose_label(synset, count_nouns(names)) == label

    def test_a_lemma_with_a_more_frequent_sense_is_no_label(self):
        synset = Synset("artifact", [], [("flannel", 1), ("white", 4)])
        assert choose_label(synset, count_nouns(["wall white"])) == "flannel"

    def test_a_trash_can_is_not_an_ashcan(self):
        taxonomy = load_taxonomy()
        synset = taxonomy.senses("ashcan")[0].synset
        assert (taxonomy.name(synset), taxonomy.label(synset)) == ("ashcan", "trash can")
