"""What words, company and size say against each other."""

import pytest

from usd2kg.grounding.embedded.weighing import Finding, weigh


def said(iri: str, score: float, group: str = "name") -> Finding:
    return Finding(group, iri, score, lambda: f"{group} says {iri}")


def by_size(iri: str) -> str:
    return f"the size says {iri}"


def test_words_alone_keep_their_score():
    (found,) = weigh([said("cup", 0.4)], [], {}, by_size, is_masked=False, has_company=False)
    assert (found.group, found.class_iri, found.score) == ("name", "cup", 0.4)
    assert found.explain() == "name says cup"


def test_the_weights_of_two_classes_worked_by_hand():
    words, company = [said("cup", 0.5)], [said("pot", 0.6, "company")]
    found = weigh(words, company, {}, by_size, is_masked=False, has_company=True)
    # Half of what may be said is said, so that the company is heard with half of its power of 0.7.
    cup = (0.5 + 0.02) * (0.0 + 0.01 * 0.3) ** 0.35
    pot = 0.02 * (0.6 + 0.01 * 0.3) ** 0.35
    # Their sum is the larger of what the words and four fifths of what the company says; the size is alike for both.
    expected = {"cup": cup / (cup + pot) * 0.5, "pot": pot / (cup + pot) * 0.5}
    assert {one.class_iri: one.score for one in found} == pytest.approx(expected)
    assert [one.class_iri for one in found] == ["cup", "pot"]


def test_a_masked_name_leaves_the_company_its_full_power():
    words, company = [said("cup", 0.5)], [said("pot", 0.6, "company")]
    open_, masked = (weigh(words, company, {}, by_size, is_masked=it, has_company=True) for it in (False, True))
    shares = [next(one.score for one in found if one.class_iri == "pot") for found in (open_, masked)]
    assert shares[1] > shares[0]


def test_three_classes_are_considered_for_their_size_alone():
    sizes = {iri: (1.0, 0.4 - at / 10) for at, iri in enumerate(["lamp", "vase", "jug", "mug"])}
    found = weigh([], [], sizes, by_size, is_masked=True, has_company=False)
    assert [one.class_iri for one in found] == ["lamp", "vase", "jug"]
    assert {one.group for one in found} == {"geometry"}
    assert found[0].explain() == "the size says lamp"
    assert sum(one.score for one in found) == pytest.approx(0.3)


def test_of_two_findings_of_a_class_the_better_one_is_told():
    found = weigh([said("cup", 0.1, "parts"), said("cup", 0.3)], [], {}, by_size, is_masked=False, has_company=False)
    assert [(one.group, one.class_iri) for one in found] == [("name", "cup")]


def test_nothing_said_is_nothing_found():
    assert weigh([], [], {}, by_size, is_masked=False, has_company=False) == []
