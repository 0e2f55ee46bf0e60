"""How sure the lexical grounder says it is, by the answers to the whole stage."""

import math
from dataclasses import replace

import pytest
from usd2kg.grounding.lexical.concepts.object_likelihoods import NO_BELIEFS

from tests.grounding.records import LAB, make_class, make_tbox
from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.confidence import features_of, general_odds
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.ontology import TBox, load_home_tbox

LABORATORY = make_tbox(
    make_class("Equipment"),
    *(make_class(name, "Equipment") for name in ("Microscope", "Centrifuge", "Pipette", "Beaker", "Flask", "Balance")),
)
KNOWN = ["microscope", "centrifuge", "pipette", "beaker", "flask"]
UNKNOWN = ["sofa", "guitar", "bicycle", "wardrobe", "toaster", "hammer"]


def answer(name: str | None, *evidence: str) -> Prediction:
    return Prediction("/x", LAB + name if name else None, 0.5, Status.GROUNDED, "lexical", "why", evidence)


def confidence_of(name: str, beside: list[str], tbox: TBox) -> float:
    views = [(f"/{other}", ObjectView(name=other)) for other in [name, *beside]]
    return LexicalGrounder().ground_views(views, tbox)[0].confidence or 0.0


@pytest.mark.parametrize(
    ("answers", "odds"),
    [
        ([], math.log(2 / 8)),
        ([answer("Beaker", "name")] * 10, math.log(2 / 18)),
        # Of 10 + 4 things 2 + 2 are a root.
        ([answer("Equipment", "name")] * 2 + [answer("Flask", "asset")] * 2, math.log(4 / 10)),
        # What it is was not understood, or nobody knows.
        ([answer("Equipment"), answer("Equipment", "company"), answer("Equipment", "geometry")], math.log(2 / 8)),
        ([answer(None, "name")], math.log(2 / 8)),
    ],
)
def test_the_odds_of_a_root_worked_by_hand(answers: list[Prediction], odds: float):
    assert general_odds(answers, LABORATORY.roots) == pytest.approx(odds)


def test_a_root_is_believed_where_the_ontology_was_made_for_other_things():
    assert confidence_of("sofa", KNOWN * 4, LABORATORY) + 0.2 < confidence_of("sofa", UNKNOWN * 4, LABORATORY)


def test_other_answers_do_not_tell_how_sure_a_special_class_is():
    assert confidence_of("beaker", KNOWN, LABORATORY) == confidence_of("beaker", UNKNOWN, LABORATORY)


def test_nor_how_sure_a_root_of_the_home_tbox_is():
    home = load_home_tbox()
    assert confidence_of("sculpture", ["mug", "sofa"], home) == confidence_of("sculpture", ["statue"] * 9, home)


@pytest.mark.parametrize(
    ("tbox", "name", "is_foreign"), [(LABORATORY, "Beaker", True), (load_home_tbox(), "Cup", False)]
)
def test_the_margin_counts_apart_for_classes_of_other_ontologies(tbox: TBox, name: str, is_foreign: bool):
    iri, *others = [cls.iri for cls in tbox.classes if cls.local_name == name] + [tbox.classes[0].iri]
    said = replace(answer(None, "name"), class_iri=iri, candidates=(Candidate(iri, 0.8), Candidate(others[0], 0.3)))
    features = features_of(said, NO_BELIEFS, tbox, tbox.roots, odds=0.0)
    assert features["margin"] == pytest.approx(0.5)
    assert features["foreign_margin"] == pytest.approx(0.5 if is_foreign else 0.0)
