"""Combined evidence of words, neighbours, and the look of an object."""

import pytest

from usd2kg.grounding.lexical.evidence_combination import ScoredClass, combine_evidence


def said(iri: str, score: float, group: str = "name") -> ScoredClass:
    return ScoredClass(group, iri, score, lambda: f"{group} says {iri}")


def by_look(iri: str) -> str:
    return f"the look says {iri}"


def scores(found: list[ScoredClass]) -> dict[str, float]:
    return {one.class_iri: one.score for one in found}


def test_words_alone_keep_their_score():
    (found,) = combine_evidence([said("cup", 0.4)], [], {}, by_look, is_masked=False)
    assert (found.group, found.class_iri, found.score) == ("name", "cup", 0.4)
    assert found.explain() == "name says cup"


def test_product_of_words_and_neighbours():
    found = combine_evidence([said("cup", 0.5)], [said("pot", 0.6, "neighbours")], {}, by_look, is_masked=False)
    # Words that score 0.5 leave the neighbours half of their power. Nothing is known of the look, so the neighbours
    # count by the root of the floor 0.04, which is 0.2.
    cup = (0.5 + 0.02) * 0.01**0.5
    pot = 0.02 * (0.6 * 0.2 + 0.01) ** 0.5
    # The total is the larger of the words' score and 0.8 of the neighbours'.
    assert scores(found) == pytest.approx({"cup": cup / (cup + pot) * 0.5, "pot": pot / (cup + pot) * 0.5})
    assert [one.class_iri for one in found] == ["cup", "pot"]


def test_mixture_of_neighbours_and_look():
    found = combine_evidence([], [said("cup", 0.6, "neighbours")], {"jug": 0.7, "cup": 0.3}, by_look, is_masked=True)
    cup = 0.02 * (0.6 * 0.34**0.5 + 0.4 * 0.3 + 0.01)
    jug = 0.02 * (0.4 * 0.7 + 0.01)
    # The total is the larger of 0.8 of the neighbours' score, 0.48, and half of the look's, 0.5.
    assert scores(found) == pytest.approx({"cup": cup / (cup + jug) * 0.5, "jug": jug / (cup + jug) * 0.5})
    assert [(one.class_iri, one.group, one.explain()) for one in found] == [
        ("cup", "neighbours", "neighbours says cup"),
        ("jug", "geometry", "the look says jug"),
    ]


def test_the_look_decides_where_neighbours_say_little():
    found = combine_evidence([], [said("cup", 0.05, "neighbours")], {"cup": 0.9, "jug": 0.1}, by_look, is_masked=True)
    assert (found[0].class_iri, found[0].group) == ("cup", "geometry")


def test_neighbours_count_more_beside_a_masked_name():
    words, company = [said("cup", 0.5)], [said("pot", 0.6, "neighbours")]
    authored, masked = (combine_evidence(words, company, {}, by_look, is_masked=masked) for masked in (False, True))
    assert scores(masked)["pot"] > scores(authored)["pot"]


def test_the_look_alone_gives_at_most_eight_classes():
    beliefs = {f"thing{at}": 0.2 - at / 100 for at in range(12)}
    found = combine_evidence([], [], beliefs, by_look, is_masked=True)
    assert [one.class_iri for one in found] == [f"thing{at}" for at in range(8)]
    assert {one.group for one in found} == {"geometry"}
    assert sum(one.score for one in found) == pytest.approx(0.5)


def test_the_best_of_two_findings_of_one_class_is_kept():
    found = combine_evidence([said("cup", 0.1, "parts"), said("cup", 0.3)], [], {}, by_look, is_masked=False)
    assert [(one.group, one.class_iri) for one in found] == [("name", "cup")]


def test_without_evidence_there_are_no_findings():
    assert combine_evidence([], [], {}, by_look, is_masked=False) == []
