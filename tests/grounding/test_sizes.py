"""Sizes of things: the table, densities worked by hand, and the likeliest things for a box."""

import math

import numpy as np
import pytest

from tests.grounding.records import ground_names, read_name
from usd2kg.grounding.lexical.concepts.sizes import everyday_nouns, log_likelihoods, size_log_likelihood_ratio
from usd2kg.knowledge import read_rows
from usd2kg.ontology import TBox

ROWS = read_rows("everyday_objects.csv")
BROAD = 0.02 * 6 / math.log(100 / 0.001) ** 3


def likelihood(noun: str, size: tuple[float, float, float]) -> float:
    return float(log_likelihoods(size)[everyday_nouns().index(noun)])


def likeliest(size: tuple[float, float, float], count: int = 10) -> list[str]:
    return [everyday_nouns()[row] for row in np.argsort(-log_likelihoods(size))[:count]]


def test_every_noun_is_read_as_written_and_names_a_class(home_tbox: TBox):
    predictions = ground_names(everyday_nouns(), home_tbox)
    # The taxonomy has mobile as an adjective too.
    unnamed = [noun for noun, found in zip(everyday_nouns(), predictions, strict=True) if found.evidence != ("name",)]
    assert unnamed == ["mobile"]
    assert [noun for noun in everyday_nouns() if read_name(noun).corrections] == []


def test_nouns_are_sorted_and_unique_with_or_without_spaces():
    nouns = everyday_nouns()
    assert list(nouns) == sorted(nouns) == [row["noun"] for row in ROWS]
    assert len({noun.replace(" ", "").replace("-", "") for noun in nouns}) == len(nouns) > 700


def test_extents_are_sorted_and_spreads_in_range():
    for row in ROWS:
        long, middle, short = (float(row[side]) for side in ("long_m", "middle_m", "short_m"))
        assert 30 > long >= middle >= short > 0, row
        assert 0.01 < float(row["spread"]) <= 0.8, row


def test_density_at_the_centre_worked_by_hand():
    # pallet: 1.2 × 0.9 × 0.145 m, spread 0.12. Scale² = 0.12² + 0.08² = 0.0208; the millimetre adds (1/1200)² = 6.9e-7,
    # (1/900)² = 1.2e-6 and (1/145)² = 4.76e-5.
    # ln(1.2/0.9) = 0.288 is 1.99 scales: the two long extents are in order with P(t4 - t4' < 1.99) ≈ 0.89.
    sigmas = [math.sqrt(0.0208 + (0.001 / extent) ** 2) for extent in (1.2, 0.9, 0.145)]
    unordered = 0.98 * 0.375**3 / math.prod(sigmas)
    density = math.exp(likelihood("pallet", (1.2, 0.9, 0.145))) - BROAD
    assert unordered / density == pytest.approx(0.89, abs=0.02)


def test_density_off_the_centre_is_students_t():
    # Two scales off in the long extent: (1 + 2²/4)^(-5/2) = 2^(-2.5) = 0.17678.
    sigma = math.sqrt(0.0208 + (0.001 / 1.2) ** 2)
    at = math.exp(likelihood("pallet", (1.2, 0.9, 0.145))) - BROAD
    off = math.exp(likelihood("pallet", (1.2 * math.exp(2 * sigma), 0.9, 0.145))) - BROAD
    assert off / at == pytest.approx(0.1767767, rel=1e-6)


def test_equal_extents_are_ordered_in_one_of_six_permutations():
    # tennis ball: 67 mm all round, spread 0.03.
    sigma = math.sqrt(0.03**2 + 0.08**2 + (1 / 67) ** 2)
    expected = 0.98 * 6 * (0.375 / sigma) ** 3 + BROAD
    assert likelihood("tennis ball", (0.067, 0.067, 0.067)) == pytest.approx(math.log(expected), abs=1e-6)


def test_the_density_integrates_to_one_over_ordered_triples():
    # A grid of ordered triples of log extents from 1 mm to 100 m; the tails of t beyond are below a thousandth.
    step = 0.25
    axis = np.arange(math.log(0.001) + step / 2, math.log(100), step)
    triples = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    triples = triples[(np.diff(triples, axis=1) <= 0).all(axis=1)]
    ties = (np.diff(triples, axis=1) == 0).sum(axis=1)
    weights = np.array([1.0, 1 / 2, 1 / 6])[ties] * step**3
    total = np.zeros(len(everyday_nouns()))
    for start in range(0, len(triples), 4000):
        part = slice(start, start + 4000)
        total += weights[part] @ np.exp(log_likelihoods(np.exp(triples[part])))
    for noun in ("box", "package", "stone", "vase"):
        assert total[everyday_nouns().index(noun)] == pytest.approx(1, abs=0.02), noun


def test_a_small_box_is_likelier_a_mug_than_a_refrigerator():
    assert likelihood("mug", (0.09, 0.09, 0.1)) > likelihood("refrigerator", (0.09, 0.09, 0.1)) + 5


@pytest.mark.parametrize(
    ("noun", "size"),
    [
        ("refrigerator", (0.6, 0.65, 1.8)),
        ("dishwasher", (0.6, 0.6, 0.85)),
        ("tennis ball", (0.066, 0.066, 0.066)),
        ("pallet", (1.2, 0.8, 0.144)),
        ("door", (0.9, 0.05, 2.05)),
        ("wine bottle", (0.075, 0.075, 0.3)),
        ("fork", (0.195, 0.025, 0.02)),
        ("banana", (0.19, 0.07, 0.04)),
        ("double bed", (2.05, 1.5, 0.9)),
        ("computer keyboard", (0.44, 0.14, 0.03)),
    ],
)
def test_a_thing_of_its_usual_size_is_among_the_ten_likeliest(noun, size):
    assert noun in likeliest(size)


def test_the_order_of_the_extents_makes_no_difference():
    expected = log_likelihoods((0.3, 0.02, 1.1))
    np.testing.assert_array_equal(log_likelihoods((1.1, 0.3, 0.02)), expected)
    np.testing.assert_array_equal(log_likelihoods((0.02, 1.1, 0.3)), expected)


def test_a_flat_box_counts_as_a_millimetre_thick():
    np.testing.assert_array_equal(log_likelihoods((0.3, 0.21, 0.0)), log_likelihoods((0.3, 0.21, 0.001)))
    assert "letter paper" in likeliest((0.297, 0.21, 0.0))


@pytest.mark.parametrize("size", [(0.0, 0.0, 0.0), (1e6, 1e6, 1e6), (1e9, 1e-9, 0.0)])
def test_no_size_is_impossible(size):
    found = log_likelihoods(size)
    assert np.isfinite(found).all()
    assert found.min() >= math.log(BROAD)


def test_boxes_in_one_call_give_the_same_as_each_alone():
    boxes = [(0.1, 0.09, 0.09), (1.8, 0.65, 0.6), (0.0, 0.2, 0.3)]
    together = log_likelihoods(boxes)
    assert together.shape == (3, len(everyday_nouns()))
    np.testing.assert_array_equal(together, [log_likelihoods(box) for box in boxes])
    assert log_likelihoods(np.empty((0, 3))).shape == (0, len(everyday_nouns()))


@pytest.mark.parametrize("wrong", [(0.1, 0.2), (0.1, 0.2, 0.3, 0.4), 0.1, [[[0.1, 0.2, 0.3]]]])
def test_rejects_other_than_three_extents(wrong):
    with pytest.raises(ValueError, match=r"expected \(3,\) or \(n, 3\)"):
        log_likelihoods(wrong)


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -0.1])
def test_rejects_negative_and_non_finite_extents(wrong):
    with pytest.raises(ValueError, match="negative or non-finite extent"):
        log_likelihoods((0.1, 0.2, wrong))


def test_the_likelihood_ratio_is_against_the_mean_over_all_things():
    mug = (0.12, 0.09, 0.1)
    mean = math.log(sum(math.exp(likelihood(noun, mug)) for noun in everyday_nouns()) / len(everyday_nouns()))
    assert size_log_likelihood_ratio(mug, "mug") == pytest.approx(likelihood("mug", mug) - mean)


def test_the_likelihood_ratio_is_positive_for_the_usual_size():
    assert size_log_likelihood_ratio((0.12, 0.09, 0.1), "mug") > 1
    assert size_log_likelihood_ratio((1.8, 0.7, 0.6), "mug") < -1
    assert size_log_likelihood_ratio((1.8, 0.7, 0.6), "refrigerator") > 1


def test_nouns_are_given_without_spaces_and_unknown_ones_have_no_likelihood_ratio():
    noun = next(noun for noun in everyday_nouns() if " " in noun)
    assert size_log_likelihood_ratio((0.1, 0.1, 0.1), noun.replace(" ", "")) is not None
    assert size_log_likelihood_ratio((0.1, 0.1, 0.1), "xqzv") is None
