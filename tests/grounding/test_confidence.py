"""Confidence of the lexical grounder, which depends on the predictions for the whole scene."""

import math
from dataclasses import replace

import pytest

from tests.grounding.ontologies import parse_outline
from tests.grounding.records import LAB
from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.class_posterior import NO_POSTERIOR
from usd2kg.grounding.lexical.confidence import calibrate, features_of, general_class_log_odds
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.scored_view import ScoredView
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.ontology import TBox, load_home_tbox

LABORATORY = parse_outline("Equipment\n  Microscope\n  Centrifuge\n  Pipette\n  Beaker\n  Flask\n  Balance")
KNOWN = ["microscope", "centrifuge", "pipette", "beaker", "flask"]
UNKNOWN = ["sofa", "guitar", "bicycle", "wardrobe", "toaster", "hammer"]


def predict(name: str | None, *evidence: str) -> Prediction:
    return Prediction("/x", LAB + name if name else None, 0.5, Status.GROUNDED, "lexical", "why", evidence)


def confidence_of(name: str, others: list[str], tbox: TBox) -> float:
    views = [(f"/{other}", ObjectView(name=other)) for other in [name, *others]]
    return LexicalGrounder().ground_views(views, tbox)[0].confidence or 0.0


@pytest.mark.parametrize(
    ("predictions", "odds"),
    [
        # Prior: 2 general classes in 10 pseudo-observations.
        ([], math.log(2 / 8)),
        ([predict("Beaker", "name")] * 10, math.log(2 / 18)),
        ([predict("Equipment", "name")] * 2 + [predict("Flask", "asset")] * 2, math.log(4 / 10)),
        # Only objects understood by their own evidence count.
        ([predict("Equipment"), predict("Equipment", "neighbours"), predict("Equipment", "geometry")], math.log(2 / 8)),
        ([predict(None, "name")], math.log(2 / 8)),
    ],
)
def test_log_odds_of_general_classes_in_a_scene(predictions: list[Prediction], odds: float):
    assert general_class_log_odds(predictions, LABORATORY.roots) == pytest.approx(odds)


def test_a_root_is_more_credible_in_a_scene_outside_the_ontologys_domain():
    assert confidence_of("sofa", KNOWN * 4, LABORATORY) + 0.2 < confidence_of("sofa", UNKNOWN * 4, LABORATORY)


def test_other_predictions_do_not_change_the_confidence_of_a_special_class():
    assert confidence_of("beaker", KNOWN, LABORATORY) == confidence_of("beaker", UNKNOWN, LABORATORY)


def test_other_predictions_do_not_change_the_confidence_of_a_home_root():
    home = load_home_tbox()
    assert confidence_of("sculpture", ["mug", "sofa"], home) == confidence_of("sculpture", ["statue"] * 9, home)


@pytest.mark.parametrize(
    ("tbox", "name", "foreign_margin"), [(LABORATORY, "Beaker", 0.5), (load_home_tbox(), "Cup", 0.0)]
)
def test_margin_has_a_feature_of_its_own_for_other_ontologies(tbox: TBox, name: str, foreign_margin: float):
    iri, other = tbox.resolve(name), tbox.classes[0].iri
    prediction = replace(predict(None, "name"), class_iri=iri, candidates=(Candidate(iri, 0.8), Candidate(other, 0.3)))
    features = features_of(ScoredView(prediction, NO_POSTERIOR), tbox, tbox.roots, log_odds=0.0)
    assert features["margin"] == pytest.approx(0.5)
    assert features["foreign_margin"] == pytest.approx(foreign_margin)


@pytest.mark.parametrize("tbox", [LABORATORY, load_home_tbox()])
def test_unknown_words_lower_the_confidence(tbox: TBox):
    general = frozenset(tbox.roots)
    iri = tbox.classes[-1].iri
    prediction = replace(predict(None, "name"), class_iri=iri, candidates=(Candidate(iri, 0.8),))
    known, partly = (
        calibrate(features_of(ScoredView(prediction, NO_POSTERIOR, unknown_share=share), tbox, general, log_odds=0.0))
        for share in (0.0, 0.5)
    )
    assert partly < known
