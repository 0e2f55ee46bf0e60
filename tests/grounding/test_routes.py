"""All routes from a noun to the classes of an ontology that usd2kg was not made for."""

import json
import math
from pathlib import Path

import pytest
from usd2kg.grounding.lexical.alignment.naming import RULED, Match, Namer

from tests.grounding.records import LAB, ground_names, local, make_class, make_tbox
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon, home_names
from usd2kg.grounding.lexical.alignment.routes import Features, Route, Routes, shares_of, strength
from usd2kg.grounding.lexical.alignment.terms import Term
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.knowledge import read_text
from usd2kg.ontology import TBox

FITTED = json.loads(read_text("routes.json"))
WEIGHTS = FITTED["weights"]
KITCHEN = make_tbox(
    make_class("Artifact"),
    make_class("Equipment", "Artifact", label="catering appliance"),
    make_class("Dispenser", "Artifact"),
    make_class("Vessel", "Artifact"),
    make_class("Cup", "Vessel"),
)


def routes_of(*words: str, tbox: TBox = KITCHEN) -> list[Route]:
    taxonomy = load_taxonomy()
    return Routes(tbox, build_lexicon(tbox, taxonomy, {}), taxonomy).find(words)


def test_there_is_a_weight_for_each_feature_and_they_do_better_together_with_the_rules():
    assert WEIGHTS.keys() == set(Features._fields)
    assert FITTED["right_mixed_when_left_out"] > FITTED["right_by_rules"]


@pytest.mark.parametrize(
    ("name", "sign"),
    [("term", 1), ("label", 1), ("usual", 1), ("partial", -1), ("steps", -1), ("steps_to_root", -1), ("passed", -1)],
)
def test_what_was_learned_is_what_one_expects(name: str, sign: int):
    assert sign * WEIGHTS[name] > 0


def test_the_docs_tell_what_was_fitted():
    told = (
        f"likeliest noun of a name is right in {100 * FITTED['right_mixed_when_left_out']:.1f} % of "
        f"{FITTED['things']:,} names, by the rules alone in {100 * FITTED['right_by_rules']:.1f} %"
    )
    assert told in " ".join((Path(__file__).parents[2] / "docs/grounding.md").read_text("utf-8").split())


def test_a_share_is_the_sum_of_the_exponentials_of_the_weighted_sums():
    term = Term(LAB + "Cup", "cup", 1.0)
    routes = [
        Route(LAB + "Cup", Features(label=1.0), term),
        Route(LAB + "Cup", Features(partial=1.0), term),
        Route(LAB + "Vessel", Features(steps=2.0), term),
    ]
    cup = math.exp(WEIGHTS["label"]) + math.exp(WEIGHTS["partial"])
    vessel = math.exp(2 * WEIGHTS["steps"])
    assert shares_of(routes) == pytest.approx(
        {LAB + "Cup": cup / (cup + vessel), LAB + "Vessel": vessel / (cup + vessel)}
    )
    assert strength(Features()) == 1.0


def test_a_label_is_a_route_without_steps():
    route = next(route for route in routes_of("cup") if isinstance(route.origin, Term))
    assert route.class_iri == LAB + "Cup"
    assert route.features == Features(term=1.0, label=1.0, usual=1.0, log_below=0.0)


def test_a_class_that_is_passed_on_the_way_to_a_more_special_one_is_marked():
    passed = {route.class_iri: route.features.passed for route in routes_of("teacup")}
    assert passed[LAB + "Cup"] == 0.0
    assert passed[LAB + "Artifact"] == 1.0


def test_steps_are_counted_in_the_taxonomy_and_to_roots_apart():
    routes = [route for route in routes_of("teacup") if not route.features.counted]
    cup = next(route for route in routes if route.class_iri == LAB + "Cup")
    assert (cup.features.steps, cup.features.steps_to_root) == (1.0, 0.0)
    root = next(route for route in routes if route.class_iri == LAB + "Artifact")
    assert root.features.steps == 0.0
    assert root.features.steps_to_root > 1.0
    assert root.features.default == 1.0
    assert root.features.log_below == pytest.approx(math.log(5))


def test_the_end_of_a_noun_is_a_route_of_its_own():
    routes = [route for route in routes_of("cereal", "dispenser") if isinstance(route.origin, Term)]
    assert [(route.class_iri, route.features.partial) for route in routes] == [(LAB + "Dispenser", 1.0)]


def test_there_is_no_route_from_what_nobody_knows():
    assert routes_of("xqzv") == []
    assert shares_of([]) == {}


def matches_of(
    *words: str, tbox: TBox, heeds_routes: bool, uses_home_names: bool = False, places: tuple[str, ...] = ()
) -> tuple[Match, ...]:
    taxonomy = load_taxonomy()
    lexicon = build_lexicon(tbox, taxonomy, home_names() if uses_home_names else {})
    namer = Namer(tbox, lexicon, taxonomy, NameReader(lexicon, taxonomy), heeds_routes=heeds_routes)
    return namer.name(words, places)[1]


def test_of_two_kinds_of_a_thing_the_routes_may_tell_another_than_the_rules():
    # People count can openers among the cookware; what they are kinds of is nearer.
    drawer = make_tbox(
        make_class("Artifact"),
        make_class("Utensil", "Artifact", label="kitchen utensil"),
        make_class("Cookware", "Artifact"),
    )
    by_rules, by_both = (
        max(matches_of("can", "opener", tbox=drawer, heeds_routes=heeds), key=lambda match: match.score)
        for heeds in (False, True)
    )
    assert by_rules.class_iri == LAB + "Cookware"
    assert by_both.class_iri == LAB + "Utensil"
    assert by_both.explanation.endswith("is a kind of “kitchen utensil”, which is Utensil")
    assert local(ground_names(["can_opener"], drawer)[0]) == "Utensil"


def test_what_the_place_tells_stays_beside_what_routes_lead_to():
    galley = make_tbox(
        make_class("Artifact"),
        make_class("Furniture", "Artifact", synonyms=["cabinet"]),
        make_class("GalleyUnit", "Furniture", synonyms=["kitchen cabinet"]),
    )
    scores = {
        heeds: {
            match.class_iri: match.score
            for match in matches_of("cabinet", tbox=galley, heeds_routes=heeds, places=("kitchen",))
        }
        for heeds in (False, True)
    }
    assert scores[True][LAB + "GalleyUnit"] == scores[False][LAB + "GalleyUnit"] > 0.8


def test_what_no_route_leads_to_is_told_by_the_rules_alone():
    # The home vocabulary lends what it has above the thing that is called so.
    shop = make_tbox(make_class("Asset"), make_class("Appliance", "Asset"), make_class("Chair", "Asset"))
    by_rules, by_both = (
        matches_of("charger", tbox=shop, heeds_routes=heeds, uses_home_names=True) for heeds in (False, True)
    )
    best = max(by_rules, key=lambda match: match.score).class_iri
    assert best == LAB + "Appliance"
    assert best not in {route.class_iri for route in routes_of("charger", tbox=shop)}
    assert [(found.class_iri, found.score) for found in by_rules] == [
        (found.class_iri, found.score) for found in by_both
    ]


def test_the_likeliest_class_keeps_the_score_of_the_rules_where_both_say_the_same():
    rules, both = (matches_of("teacup", tbox=KITCHEN, heeds_routes=heeds) for heeds in (False, True))
    by_rules, by_both = max(rules, key=lambda match: match.score), both[0]
    assert (by_rules.class_iri, by_rules.score) == (by_both.class_iri, pytest.approx(by_both.score))


def test_of_two_classes_the_scores_are_as_the_root_of_their_odds():
    shares = shares_of(routes_of("teacup"))
    shares[LAB + "Cup"] *= RULED
    best, second = matches_of("teacup", tbox=KITCHEN, heeds_routes=True)[:2]
    assert best.class_iri == LAB + "Cup"
    assert second.score / best.score == pytest.approx(math.sqrt(shares[second.class_iri] / shares[best.class_iri]))


def test_classes_of_the_home_vocabulary_are_told_by_the_rules_alone(home_tbox: TBox):
    for words in (("cereal", "dispenser"), ("wardrobe",), ("soup", "pot")):
        by_rules, by_both = (
            matches_of(*words, tbox=home_tbox, heeds_routes=heeds, uses_home_names=True) for heeds in (False, True)
        )
        assert [(found.class_iri, found.score) for found in by_rules] == [
            (found.class_iri, found.score) for found in by_both
        ]
