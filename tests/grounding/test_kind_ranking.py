"""Ranking of the classes of a foreign ontology by the kinds of what a name means."""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.grounding.records import LAB, make_class, make_object, make_scene, make_tbox
from usd2kg.grounding import ground
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.categories import find_synset, invert_categories
from usd2kg.grounding.lexical.concepts.extent import extent_of
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.matching.head_matching import Match
from usd2kg.grounding.lexical.matching.kind_ranking import KindFeatures, KindRanker
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase, NameReader
from usd2kg.grounding.lexical.settings import KIND_RANKING
from usd2kg.knowledge import read_text
from usd2kg.ontology import TBox

WEIGHTS = json.loads(read_text("kind_ranking.json"))["weights"]
BAKERY = make_tbox(
    make_class("Item", label="item"),
    make_class("Mould", "Item", label="baking mould", comment="Gives dough its form in the oven."),
    make_class("Shelf", "Item", label="shelf", comment="Holds goods."),
    make_class("Goods", "Item", label="baked goods", comment="Bread, cake, pastry and other food for sale."),
)


def make_ranker(tbox: TBox = BAKERY, kinds: dict[str, tuple[str, ...]] | None = None) -> tuple[KindRanker, NameReader]:
    taxonomy = load_taxonomy()
    lexicon = build_lexicon(tbox, taxonomy, {})
    reader = NameReader(lexicon, taxonomy)
    matcher = PhraseMatcher(TermMatcher(tbox, lexicon, taxonomy, reader), taxonomy, reader)
    named = {find_synset(noun, taxonomy): names for noun, names in (kinds or {}).items()}
    return KindRanker(tbox, lexicon, taxonomy, reader, matcher, lambda synset: named.get(synset, ())), reader


def own_match(name: str, score: float = 0.5) -> Match:
    return Match(LAB + name, score, lambda: "by its head noun")


def features_of(name: str, *matches: Match, parents: tuple[str, ...] = ()) -> dict[str, dict[str, float]]:
    ranker, reader = make_ranker(kinds={"muffin tin": ("baking mould",)})
    phrase = reader.read(name, parents)
    heads = ranker._matcher.head_shares(phrase, parents, None)
    found = ranker.features(phrase, parents, heads, ranker.find_kinds(heads), matches)
    classes = [iri.removeprefix(LAB) for iri in ranker.classes]
    return {key: dict(zip(classes, values.tolist(), strict=True)) for key, values in found._asdict().items()}


def test_there_is_a_weight_for_each_feature():
    assert WEIGHTS.keys() == set(KindFeatures._fields)


@pytest.mark.parametrize(
    "name", ["log_score", "label_kinds", "comment_kinds", "comment_name", "similar_label_kinds", "similar_label_name"]
)
def test_what_speaks_for_a_class_has_a_positive_weight(name: str):
    assert WEIGHTS[name] > 0


def test_the_words_of_a_category_count_for_a_label_that_has_them():
    found = features_of("muffin_tin", own_match("Item"))
    assert found["label_kinds"]["Mould"] > 0 == found["label_kinds"]["Shelf"]
    assert found["similar_label_kinds"]["Mould"] > found["similar_label_kinds"]["Shelf"]


def test_cosines_weigh_words_by_their_rarity():
    # Of the four classes one has “paper”, two have “tray”.
    tbox = make_tbox(
        make_class("Item", label="thing"),
        make_class("A1", "Item", label="paper tray"),
        make_class("A2", "Item", label="tray"),
        make_class("A3", "Item", label="chair"),
    )
    ranker, _ = make_ranker(tbox)
    rare, frequent = (math.log(5 / (count + 0.5)) + KIND_RANKING.least_idf for count in (1, 2))
    cosines = ranker._labels.cosines(ranker._unit_vector({"tray": 1.0}))
    expected = {"Item": 0.0, "A1": frequent / math.hypot(rare, frequent), "A2": 1.0, "A3": 0.0}
    assert dict(zip(ranker.classes, cosines, strict=True)) == pytest.approx(
        {LAB + name: value for name, value in expected.items()}
    )


def test_each_name_of_a_class_counts():
    tbox = make_tbox(
        make_class("Item", label="thing"), make_class("A1", "Item", label="chart holder", synonyms=["paper tray"])
    )
    ranker, _ = make_ranker(tbox)
    words = ("paper", "tray")
    own = ranker.classes.index(LAB + "A1")
    assert ranker._labels.cosines(ranker._unit_vector(dict.fromkeys(words, 1.0)))[own] == pytest.approx(1.0)
    assert ranker._near_labels.cosines(ranker._embed(words))[own] == pytest.approx(1.0, abs=1e-6)


def test_a_label_is_similar_to_another_word_for_the_same_thing():
    tbox = make_tbox(
        make_class("Item", label="thing"),
        make_class("A1", "Item", label="tapware"),
        make_class("A2", "Item", label="tower"),
    )
    ranker, reader = make_ranker(tbox)
    phrase = reader.read("faucet", ())
    heads = ranker._matcher.head_shares(phrase, (), None)
    found = ranker.features(phrase, (), heads, ranker.find_kinds(heads), [own_match("Item")])
    faucet, tower = ranker.classes.index(LAB + "A1"), ranker.classes.index(LAB + "A2")
    assert found.similar_label_name[faucet] > 0.5 > found.similar_label_name[tower]


def test_the_words_of_a_comment_and_of_the_names_above_count():
    found = features_of("bread_loaf", own_match("Item"), parents=("goods_shelf",))
    assert found["comment_name"]["Goods"] > found["comment_name"]["Shelf"] == 0
    assert found["label_parents"]["Shelf"] > found["label_parents"]["Mould"] == 0


def test_scores_of_the_head_noun_are_features():
    found = features_of("muffin_tin", own_match("Item", 0.6), own_match("Shelf", 0.3))
    assert found["score"] == {"Item": 0.6, "Mould": 0.0, "Shelf": 0.3, "Goods": 0.0}
    assert found["log_score"]["Mould"] == pytest.approx(math.log(KIND_RANKING.min_score))


def test_the_best_class_gets_the_highest_score_and_says_why():
    ranker, reader = make_ranker(kinds={"muffin tin": ("baking mould",)})
    ranked = ranker.rank(reader.read("muffin_tin", ()), (), None, [own_match("Item", 0.4)])
    assert ranked[0].class_iri == LAB + "Mould"
    assert ranked[0].score == pytest.approx(0.4)
    assert ranked[0].explanation == "“muffin tin” may be a kind of “baking mould”, which is like Mould"
    assert [match.score for match in ranked] == sorted((match.score for match in ranked), reverse=True)


def test_a_name_without_a_class_by_its_head_noun_is_left_to_other_evidence():
    ranker, _ = make_ranker()
    assert ranker.rank(NamePhrase(("flurbl",)), (), None, ()) == ()


@given(st.lists(st.text(max_size=12), max_size=4), st.text(max_size=20))
def test_any_name_and_any_names_above_give_finite_features(parents: list[str], name: str):
    ranker, reader = RANKER
    phrase = reader.read(name, tuple(parents))
    heads = ranker._matcher.head_shares(phrase, tuple(parents), extent_of((0.1, 0.2, 0.3)))
    kinds = ranker.find_kinds(heads)
    found = np.stack(ranker.features(phrase, tuple(parents), heads, kinds, [own_match("Item")]))
    assert np.isfinite(found).all()
    assert (found[1:] <= 1 + 1e-6).all()


RANKER = make_ranker()


class TestGrounder:
    def predict(self, name: str, tbox: TBox) -> str:
        scene = make_scene(make_object(f"/World/{name}"))
        prediction = ground(scene, tbox, LexicalGrounder()).predictions[0]
        return str(prediction.class_iri).removeprefix(LAB)

    def test_a_foreign_ontology_is_ranked_by_kinds(self):
        assert self.predict("muffin_tin_6", BAKERY) == "Mould"

    def test_an_ontology_of_another_domain_is_not_ranked(self):
        # Where most things are only items, a similar label is chance.
        tbox = make_tbox(
            make_class("Item", label="item"),
            make_class("Mould", "Item", label="baking form", comment="Tins in which dough is baked: bread and cake."),
        )
        others = [
            make_object(f"/World/{name}") for name in ("car", "guitar", "dog", "tractor", "anchor", "tent", "sofa")
        ]
        tin = make_object("/World/muffin_tin")
        alone, among_others = (
            ground(make_scene(*objects), tbox, LexicalGrounder()).by_path["/World/muffin_tin"].class_iri
            for objects in ([tin], [tin, *others])
        )
        assert (alone, among_others) == (LAB + "Mould", LAB + "Item")

    def test_categories_are_found_from_their_members(self):
        taxonomy = load_taxonomy()
        stapler = find_synset("stapler", taxonomy)
        assert stapler is not None
        kinds = invert_categories(taxonomy)
        assert any("stationery" in kinds.get(up, ()) for up, _ in taxonomy.walk_up(stapler))
