"""The rules that `benchmarks/ablation` switches off exist, and come back."""

import pytest

from benchmarks.ablation.rules import RULES, Rule, find_target, switched_off
from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.matching import phrase_matching
from usd2kg.grounding.lexical.object_grounder import ObjectGrounder
from usd2kg.ontology import load_home_tbox


def test_rules_have_unique_names():
    assert len({rule.name for rule in RULES}) == len(RULES)


@pytest.mark.parametrize("rule", RULES, ids=[rule.name for rule in RULES])
def test_every_rule_can_be_switched_off(rule: Rule):
    owner, name = find_target(rule)
    before = getattr(owner, name)
    with switched_off([rule]):
        assert getattr(owner, name) is rule.replacement
    assert getattr(owner, name) is before is not rule.replacement


def test_a_rule_is_off_within_the_context_only():
    inverted = next(rule for rule in RULES if rule.name == "head noun: modifier behind the head")
    matched = phrase_matching.PhraseMatcher._inverted_compounds

    def ground(name: str) -> str:
        prediction = ObjectGrounder(load_home_tbox(), dict).predict(ObjectView(name=name)).prediction
        return str(prediction.class_iri)

    assert ground("plate_dinner").endswith("DinnerPlate")
    with switched_off([inverted]):
        assert not ground("plate_dinner").endswith("DinnerPlate")
    assert phrase_matching.PhraseMatcher._inverted_compounds is matched
