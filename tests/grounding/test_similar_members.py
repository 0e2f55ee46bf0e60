"""Similarity of whole names to the nouns that a language model named for each class."""

import math
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.grounding.records import LAB, make_class, make_object, make_scene, make_tbox
from usd2kg.grounding import Prediction, ground
from usd2kg.grounding.lexical.alignment.alignment_file import AlignmentFile
from usd2kg.grounding.lexical.alignment.member_rows import ClassMembers, rows_of_members
from usd2kg.grounding.lexical.alignment.terms import Term, TermKind
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.matching.head_matching import Match
from usd2kg.grounding.lexical.matching.similar_members import SimilarMembers
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase
from usd2kg.grounding.lexical.settings import MATCHING, SIMILARITY

TBOX = make_tbox(
    make_class("Thing", label="thing"),
    make_class("Outlet", "Thing", label="gas outlet"),
    make_class("Socket", "Thing", label="wall plug"),
    make_class("Scanner", "Thing", label="scanner"),
)
MEMBERS = (
    ClassMembers(LAB + "Outlet", ("oxygen wall outlet", "vacuum outlet"), ()),
    ClassMembers(LAB + "Socket", ("socket", "wall socket", "phone socket"), ()),
    ClassMembers(LAB + "Scanner", ("ultrasound machine", "sonography unit"), ()),
)
TERMS = tuple(Term(one.class_iri, noun, TermKind.MODEL) for one in MEMBERS for noun in one.belongs)


def similar(terms: tuple[Term, ...] = TERMS) -> SimilarMembers:
    return SimilarMembers(terms, load_taxonomy(), TBOX)


def own_match(name: str, score: float) -> Match:
    return Match(LAB + name, score, lambda: "by its head noun")


def predict(*names: str, members: tuple[ClassMembers, ...] = MEMBERS) -> list[Prediction]:
    rows = rows_of_members(members, "test:oracle", TBOX, load_taxonomy())
    text = LexicalGrounder().format_alignment(TBOX, rows)
    grounder = LexicalGrounder(alignment=AlignmentFile(Path("model.tsv"), text))
    scene = make_scene(*(make_object(f"/World/{name}") for name in names))
    return list(ground(scene, TBOX, grounder).predictions)


def cosine(one: str, other: str, terms: tuple[Term, ...]) -> float:
    """TF-IDF cosine over words and letter n-grams, written down a second time from the definition."""

    def features(text: str) -> dict[str, float]:
        padded = f" {text} "
        grams = {padded[at : at + SIMILARITY.letters] for at in range(len(padded) - SIMILARITY.letters + 1)}
        return {f"w:{word}": 1.0 for word in text.split()} | {f"l:{gram}": SIMILARITY.letters_value for gram in grams}

    counts = Counter(name for term in terms for name in features(term.text))

    def weighted(text: str) -> dict[str, float]:
        return {name: v * math.log((len(terms) + 1) / (counts[name] + 0.5)) for name, v in features(text).items()}

    first, second = weighted(one), weighted(other)
    dot = sum(value * second.get(name, 0.0) for name, value in first.items())
    return dot / math.sqrt(sum(v * v for v in first.values()) * sum(v * v for v in second.values()))


class TestRank:
    def test_without_a_head_noun_the_score_is_the_cosine_of_the_nearest_term(self):
        (best, *_) = similar().rank(NamePhrase(("oxygen", "outlet")), (), None, [])
        nearest = max(cosine("oxygen outlet", term.text, TERMS) for term in TERMS if term.class_iri == LAB + "Outlet")
        assert best.class_iri == LAB + "Outlet"
        assert best.score == pytest.approx(MATCHING.term_score * nearest)

    def test_a_whole_name_outweighs_its_head_noun(self):
        ranked = similar().rank(NamePhrase(("oxygen", "wall", "outlet")), (), None, [own_match("Socket", 0.8)])
        assert [match.class_iri for match in ranked] == [LAB + "Outlet", LAB + "Socket"]
        assert ranked[0].score == pytest.approx(MATCHING.term_score)
        assert "“oxygen wall outlet” is like “oxygen wall outlet”" in ranked[0].explanation

    def test_a_name_like_no_term_keeps_its_matches(self):
        matches = [own_match("Scanner", 0.8), own_match("Thing", 0.4)]
        assert similar().rank(NamePhrase(("garden", "gnome")), (), None, matches) == tuple(matches)

    def test_a_class_by_head_noun_and_similarity_keeps_its_explanation(self):
        (best, *_) = similar().rank(NamePhrase(("wall", "socket")), (), None, [own_match("Socket", 0.9)])
        assert best.explanation == "by its head noun"
        assert best.score == pytest.approx(MATCHING.term_score)

    def test_a_name_without_words_has_no_classes(self):
        assert similar().rank(NamePhrase(()), (), None, []) == ()

    def test_one_term_alone_is_found(self):
        assert (
            similar(TERMS[:1]).rank(NamePhrase(("oxygen", "wall", "outlet")), (), None, [])[0].class_iri
            == LAB + "Outlet"
        )

    @given(st.lists(st.text("abcdeé '<", min_size=1, max_size=6), max_size=5), st.floats(0, 1))
    def test_scores_are_shares_in_descending_order(self, words: list[str], score: float):
        ranked = similar().rank(NamePhrase(tuple(words)), (), None, [own_match("Thing", score)])
        scores = [match.score for match in ranked]
        assert scores == sorted(scores, reverse=True)
        assert all(0 <= value <= 1 for value in scores)
        assert len({match.class_iri for match in ranked}) == len(ranked)


class TestGrounder:
    def test_a_name_is_like_a_noun_with_other_words_in_it(self):
        (found,) = predict("UltrasoundTrolleyMachine")
        assert found.class_iri == LAB + "Scanner"
        assert "is like “ultrasound machine”" in found.explanation

    def test_a_listed_name_is_as_before(self):
        (found,) = predict("PhoneSocket")
        assert found.class_iri == LAB + "Socket"
        assert "for the language model a name for" in found.explanation

    def test_labels_alone_are_not_searched(self):
        scene = make_scene(make_object("/World/GasPipe"))
        (found,) = ground(scene, TBOX, LexicalGrounder()).predictions
        assert "is like" not in found.explanation

    def test_terms_are_data(self):
        hostile = (ClassMembers(LAB + "Outlet", ("<img src=x> outlet {0} %s", "oxygen outlet"), ()),)
        (found,) = predict("OxygenOutletLeft", members=hostile)
        assert found.class_iri == LAB + "Outlet"
