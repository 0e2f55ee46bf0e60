"""Routes from a noun to the classes of an ontology, and the logit over them."""

import json
import math

import pytest

from tests.grounding.ontologies import parse_outline
from tests.grounding.records import LAB
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.alignment.terms import Term
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.matching.routes import Route, RouteFeatures, Routes, class_shares, route_strength
from usd2kg.knowledge import read_text

FITTED = json.loads(read_text("routes.json"))
WEIGHTS = FITTED["weights"]
KITCHEN = parse_outline('Artifact\n  Equipment "catering appliance"\n  Dispenser\n  Vessel\n    Cup')


def routes_of(*words: str) -> list[Route]:
    taxonomy = load_taxonomy()
    return Routes(KITCHEN, build_lexicon(KITCHEN, taxonomy, {}), taxonomy).find(words)


def test_there_is_a_weight_for_each_feature():
    assert WEIGHTS.keys() == set(RouteFeatures._fields)


@pytest.mark.parametrize(
    ("name", "sign"),
    [
        ("term", 1),
        ("label", 1),
        ("usual", 1),
        ("partial", -1),
        ("steps", -1),
        ("steps_to_general", -1),
        ("has_more_specific", -1),
    ],
)
def test_weights_have_the_expected_sign(name: str, sign: int):
    assert sign * WEIGHTS[name] > 0


def test_the_share_of_a_class_sums_over_its_routes():
    term = Term(LAB + "Cup", "cup", 1.0)
    routes = [
        Route(LAB + "Cup", RouteFeatures(label=1.0), term),
        Route(LAB + "Cup", RouteFeatures(partial=1.0), term),
        Route(LAB + "Vessel", RouteFeatures(steps=2.0), term),
    ]
    cup = math.exp(WEIGHTS["label"]) + math.exp(WEIGHTS["partial"])
    vessel = math.exp(2 * WEIGHTS["steps"])
    assert class_shares(routes) == pytest.approx(
        {LAB + "Cup": cup / (cup + vessel), LAB + "Vessel": vessel / (cup + vessel)}
    )
    assert route_strength(RouteFeatures()) == 1.0


def test_a_label_is_a_route_without_steps():
    route = next(route for route in routes_of("cup") if isinstance(route.origin, Term))
    assert route.class_iri == LAB + "Cup"
    assert route.features == RouteFeatures(term=1.0, label=1.0, usual=1.0, log_below=0.0)


def test_superclasses_of_a_reached_class_have_a_more_specific_class():
    passed = {route.class_iri: route.features.has_more_specific for route in routes_of("teacup")}
    assert (passed[LAB + "Cup"], passed[LAB + "Artifact"]) == (0.0, 1.0)


def test_steps_to_general_classes_are_a_feature_of_their_own():
    routes = [route for route in routes_of("teacup") if not route.features.by_category]
    cup = next(route for route in routes if route.class_iri == LAB + "Cup")
    assert (cup.features.steps, cup.features.steps_to_general) == (1.0, 0.0)
    root = next(route for route in routes if route.class_iri == LAB + "Artifact")
    assert root.features.steps == 0.0
    assert root.features.steps_to_general > 1.0
    assert root.features.default == 1.0
    assert root.features.log_below == pytest.approx(math.log(5))


def test_the_end_of_a_compound_is_a_partial_route():
    routes = [route for route in routes_of("cereal", "dispenser") if isinstance(route.origin, Term)]
    assert [(route.class_iri, route.features.partial) for route in routes] == [(LAB + "Dispenser", 1.0)]


def test_an_unknown_word_has_no_route():
    assert routes_of("xqzv") == []
    assert class_shares([]) == {}
