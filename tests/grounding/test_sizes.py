"""Sizes of things: the table, a density worked by hand, and which things a box is likeliest to be."""

import math
import time

import numpy as np
import pytest

from usd2kg.grounding.lexical.concepts import sizes
from usd2kg.grounding.lexical.concepts.sizes import log_likelihoods, surprise, thing_nouns
from usd2kg.grounding.lexical.grounder import _run_for
from usd2kg.knowledge import read_rows
from usd2kg.ontology import TBox

ROWS = read_rows("everyday_objects.csv")
BROAD = 0.02 * 6 / math.log(100 / 0.001) ** 3


def likelihood(noun: str, size: tuple[float, float, float]) -> float:
    return float(log_likelihoods(size)[thing_nouns().index(noun)])


def likeliest(size: tuple[float, float, float], count: int = 10) -> list[str]:
    return [thing_nouns()[row] for row in np.argsort(-log_likelihoods(size))[:count]]


def test_every_noun_is_read_as_it_is_written_and_names_a_class(home_tbox: TBox):
    run = _run_for(home_tbox, True)
    # What the taxonomy has as an adjective too is no head of a name.
    assert [noun for noun in thing_nouns() if not run._match(noun, (), None)] == ["mobile"]
    assert [noun for noun in thing_nouns() if run._reader.read(noun).corrections] == []


def test_nouns_are_sorted_and_occur_once_however_they_are_joined():
    nouns = thing_nouns()
    assert list(nouns) == sorted(nouns) == [row["noun"] for row in ROWS]
    assert len({noun.replace(" ", "").replace("-", "") for noun in nouns}) == len(nouns) > 700


def test_extents_are_in_order_and_spreads_are_sensible():
    for row in ROWS:
        long, middle, short = (float(row[side]) for side in ("long_m", "middle_m", "short_m"))
        assert 30 > long >= middle >= short > 0, row
        assert 0.01 < float(row["spread"]) <= 0.8, row


def test_the_density_at_the_centre_is_the_one_worked_by_hand():
    # pallet: 1.2 × 0.9 × 0.145 m, spread 0.12. Scale² = 0.12² + 0.08² = 0.0208 for the long and the middle extent, the
    # millimetre adding (1/1200)² = 6.9e-7, (1/900)² = 1.2e-6 and (1/145)² = 4.76e-5.
    # ln(1.2/0.9) = 0.288 is 1.99 scales, so the two long extents are in order with P(t4 - t4' < 1.99) ≈ 0.89.
    sigmas = [math.sqrt(0.0208 + (0.001 / extent) ** 2) for extent in (1.2, 0.9, 0.145)]
    unordered = 0.98 * 0.375**3 / math.prod(sigmas)
    density = math.exp(likelihood("pallet", (1.2, 0.9, 0.145))) - BROAD
    assert unordered / density == pytest.approx(0.89, abs=0.02)


def test_off_the_centre_the_density_falls_as_students_t_does():
    # Two scales off in the long extent: (1 + 2²/4)^(-5/2) = 2^(-2.5) = 0.17678.
    sigma = math.sqrt(0.0208 + (0.001 / 1.2) ** 2)
    at = math.exp(likelihood("pallet", (1.2, 0.9, 0.145))) - BROAD
    off = math.exp(likelihood("pallet", (1.2 * math.exp(2 * sigma), 0.9, 0.145))) - BROAD
    assert off / at == pytest.approx(0.1767767, rel=1e-6)


def test_a_ball_comes_in_order_one_time_in_six():
    # tennis ball: 67 mm all round, spread 0.03.
    sigma = math.sqrt(0.03**2 + 0.08**2 + (1 / 67) ** 2)
    expected = 0.98 * 6 * (0.375 / sigma) ** 3 + BROAD
    assert likelihood("tennis ball", (0.067, 0.067, 0.067)) == pytest.approx(math.log(expected), abs=1e-6)


def test_the_density_integrates_to_one_over_ordered_triples():
    # Ordered triples of a grid in log extents from 1 mm to 100 m; the tails of the t beyond lie under a thousandth.
    step = 0.2
    axis = np.arange(math.log(0.001) + step / 2, math.log(100), step)
    triples = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    triples = triples[(np.diff(triples, axis=1) <= 0).all(axis=1)]
    ties = (np.diff(triples, axis=1) == 0).sum(axis=1)
    weights = np.array([1.0, 1 / 2, 1 / 6])[ties] * step**3
    total = np.zeros(len(thing_nouns()))
    for start in range(0, len(triples), 4000):
        part = slice(start, start + 4000)
        total += weights[part] @ np.exp(log_likelihoods(np.exp(triples[part])))
    for noun in ("box", "package", "stone", "vase"):
        assert total[thing_nouns().index(noun)] == pytest.approx(1, abs=0.02), noun


def test_the_distribution_function_is_students():
    # Quantiles of t with 4 degrees of freedom from tables: 0.95 at 2.132, 0.975 at 2.776, 0.995 at 4.604.
    found = sizes._cumulate(np.array([0.0, 2.131847, 2.776445, 4.604095, -2.776445]))
    np.testing.assert_allclose(found, [0.5, 0.95, 0.975, 0.995, 0.025], atol=1e-6)


def test_a_box_of_a_hand_is_a_mug_rather_than_a_refrigerator():
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
def test_a_box_of_known_size_is_among_the_likeliest(noun, size):
    assert noun in likeliest(size)


def test_the_order_of_the_extents_does_not_matter():
    expected = log_likelihoods((0.3, 0.02, 1.1))
    np.testing.assert_array_equal(log_likelihoods((1.1, 0.3, 0.02)), expected)
    np.testing.assert_array_equal(log_likelihoods((0.02, 1.1, 0.3)), expected)


def test_a_flat_thing_counts_as_a_millimetre_thick():
    np.testing.assert_array_equal(log_likelihoods((0.3, 0.21, 0.0)), log_likelihoods((0.3, 0.21, 0.001)))
    assert "letter paper" in likeliest((0.297, 0.21, 0.0))


@pytest.mark.parametrize("size", [(0.0, 0.0, 0.0), (1e6, 1e6, 1e6), (1e9, 1e-9, 0.0)])
def test_no_size_is_impossible(size):
    found = log_likelihoods(size)
    assert np.isfinite(found).all()
    assert found.min() >= math.log(BROAD)


def test_many_boxes_at_once_give_what_each_gives_alone():
    boxes = [(0.1, 0.09, 0.09), (1.8, 0.65, 0.6), (0.0, 0.2, 0.3)]
    together = log_likelihoods(boxes)
    assert together.shape == (3, len(thing_nouns()))
    np.testing.assert_array_equal(together, [log_likelihoods(box) for box in boxes])
    assert log_likelihoods(np.empty((0, 3))).shape == (0, len(thing_nouns()))


@pytest.mark.parametrize("wrong", [(0.1, 0.2), (0.1, 0.2, 0.3, 0.4), 0.1, [[[0.1, 0.2, 0.3]]]])
def test_anything_but_three_extents_is_refused(wrong):
    with pytest.raises(ValueError, match=r"expected \(3,\) or \(n, 3\)"):
        log_likelihoods(wrong)


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -0.1])
def test_an_extent_that_is_no_length_is_refused(wrong):
    with pytest.raises(ValueError, match="negative or non-finite extent"):
        log_likelihoods((0.1, 0.2, wrong))


def test_a_thousand_boxes_take_less_than_fifty_milliseconds():
    boxes = np.exp(np.random.default_rng(1).uniform(-5, 1, (1000, 3)))
    log_likelihoods(boxes[:1])
    took = []
    for _ in range(7):
        start = time.process_time()
        log_likelihoods(boxes)
        took.append(time.process_time() - start)
    assert min(took) < 0.05


# --- what a size says of one thing against all others ------------------------------------------------


def test_surprise_is_the_likelihood_against_the_mean_over_all_things():
    mug = (0.12, 0.09, 0.1)
    mean = math.log(sum(math.exp(likelihood(noun, mug)) for noun in thing_nouns()) / len(thing_nouns()))
    assert surprise(mug, "mug") == pytest.approx(likelihood("mug", mug) - mean)


def test_the_right_size_speaks_for_a_thing_and_the_wrong_one_against_it():
    assert surprise((0.12, 0.09, 0.1), "mug") > 1
    assert surprise((1.8, 0.7, 0.6), "mug") < -1
    assert surprise((1.8, 0.7, 0.6), "refrigerator") > 1


def test_spaces_are_left_out_of_nouns_and_unknown_ones_say_nothing():
    noun = next(noun for noun in thing_nouns() if " " in noun)
    assert surprise((0.1, 0.1, 0.1), noun.replace(" ", "")) is not None
    assert surprise((0.1, 0.1, 0.1), "xqzv") is None
