"""What words, company and look say against each other."""

import pytest

from usd2kg.grounding.lexical.evidence_combination import Finding, weigh


def said(iri: str, score: float, group: str = "name") -> Finding:
    return Finding(group, iri, score, lambda: f"{group} says {iri}")


def by_look(iri: str) -> str:
    return f"the look says {iri}"


def scores(found: list[Finding]) -> dict[str, float]:
    return {one.class_iri: one.score for one in found}


def test_words_alone_keep_their_score():
    (found,) = weigh([said("cup", 0.4)], [], {}, by_look, is_masked=False)
    assert (found.group, found.class_iri, found.score) == ("name", "cup", 0.4)
    assert found.explain() == "name says cup"


def test_words_and_company_worked_by_hand():
    found = weigh([said("cup", 0.5)], [said("pot", 0.6, "company")], {}, by_look, is_masked=False)
    # Half of what may be said is said, so that the company is heard with half of its power. Nothing is believed of
    # either, which leaves the root of 0.04, a fifth, of what the company says.
    cup = (0.5 + 0.02) * 0.01**0.5
    pot = 0.02 * (0.6 * 0.2 + 0.01) ** 0.5
    # Their sum is the larger of what the words and four fifths of what the company says.
    assert scores(found) == pytest.approx({"cup": cup / (cup + pot) * 0.5, "pot": pot / (cup + pot) * 0.5})
    assert [one.class_iri for one in found] == ["cup", "pot"]


def test_company_and_beliefs_are_a_mixture_worked_by_hand():
    found = weigh([], [said("cup", 0.6, "company")], {"jug": 0.7, "cup": 0.3}, by_look, is_masked=True)
    cup = 0.02 * (0.6 * 0.34**0.5 + 0.4 * 0.3 + 0.01)
    jug = 0.02 * (0.4 * 0.7 + 0.01)
    # Of what the company says four fifths are believed, and half of what the look says: 0.5 is more than 0.48.
    assert scores(found) == pytest.approx({"cup": cup / (cup + jug) * 0.5, "jug": jug / (cup + jug) * 0.5})
    assert [(one.class_iri, one.group, one.explain()) for one in found] == [
        ("cup", "company", "company says cup"),
        ("jug", "geometry", "the look says jug"),
    ]


def test_the_beliefs_speak_where_the_company_hardly_does():
    found = weigh([], [said("cup", 0.05, "company")], {"cup": 0.9, "jug": 0.1}, by_look, is_masked=True)
    assert (found[0].class_iri, found[0].group) == ("cup", "geometry")


def test_a_masked_name_leaves_the_company_its_full_power():
    words, company = [said("cup", 0.5)], [said("pot", 0.6, "company")]
    open_, masked = (weigh(words, company, {}, by_look, is_masked=it) for it in (False, True))
    assert scores(masked)["pot"] > scores(open_)["pot"]


def test_eight_classes_are_considered_for_the_look_alone():
    beliefs = {f"thing{at}": 0.2 - at / 100 for at in range(12)}
    found = weigh([], [], beliefs, by_look, is_masked=True)
    assert [one.class_iri for one in found] == [f"thing{at}" for at in range(8)]
    assert {one.group for one in found} == {"geometry"}
    assert sum(one.score for one in found) == pytest.approx(0.5)


def test_of_two_findings_of_a_class_the_better_one_is_told():
    found = weigh([said("cup", 0.1, "parts"), said("cup", 0.3)], [], {}, by_look, is_masked=False)
    assert [(one.group, one.class_iri) for one in found] == [("name", "cup")]


def test_nothing_said_is_nothing_found():
    assert weigh([], [], {}, by_look, is_masked=False) == []
