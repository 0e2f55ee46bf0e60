"""Metrics against values computed by hand, including near misses."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.metrics import f1_score

from tests.evaluation.records import PARENTS, E, label, score, small_tbox
from usd2kg.evaluation.metrics.accuracy import accept_also, exact_match
from usd2kg.evaluation.metrics.agreement import agreement
from usd2kg.evaluation.metrics.calibration import (
    accuracy_at_coverage,
    calibration_error,
    chance_calibration_error,
    mean_absolute_deviation,
    reliability_bins,
    risk_coverage_curve,
)
from usd2kg.evaluation.metrics.confusion import class_reports, confusion
from usd2kg.evaluation.metrics.hierarchical import hierarchical_f1, hierarchical_score, mean_hierarchical_score
from usd2kg.evaluation.metrics.intervals import bootstrap_interval, mcnemar, mean_and_deviation, mean_interval
from usd2kg.evaluation.metrics.misses import Miss, classify_miss, count_misses
from usd2kg.evaluation.metrics.selection_scores import score_selection

TBOX = small_tbox()
CLASSES = sorted(PARENTS)


def test_exact_match_counts_missing_answers_as_wrong() -> None:
    scores = [score("Cup", "Cup"), score("Cup", "Bowl"), score("Wall", None), score("Spoon", "Spoon")]
    assert exact_match(scores) == 2 / 4


def test_exact_match_of_no_scores_raises() -> None:
    with pytest.raises(ValueError, match="no samples"):
        exact_match([])


def test_accept_also_counts_second_labels_only() -> None:
    scores = [
        score("Cup", "Bowl", also="Bowl|Spoon"),
        score("Cup", "Wall", also="Bowl"),
        score("Cup", None, also="Bowl"),
    ]
    assert exact_match(scores) == 0
    assert accept_also(scores) == 1 / 3


def test_hierarchical_score_by_closure_overlap() -> None:
    # ↑Cup = {Cup, Container, Tableware, Thing}; ↑Bowl = {Bowl, Container, Thing}; common: Container, Thing.
    one = hierarchical_score(E + "Bowl", E + "Cup", TBOX)
    assert one.precision == 2 / 3
    assert one.recall == 2 / 4
    assert one.f1 == pytest.approx(2 * (2 / 3) * (1 / 2) / (2 / 3 + 1 / 2))
    # ↑Container = {Container, Thing}, both common: precision 1, recall 1/2, F1 2/3.
    assert hierarchical_score(E + "Container", E + "Cup", TBOX) == pytest.approx((1.0, 0.5, 2 / 3))
    assert hierarchical_score(E + "Cup", E + "Cup", TBOX) == (1.0, 1.0, 1.0)
    assert hierarchical_score(E + "Wall", E + "Cup", TBOX) == (0.0, 0.0, 0.0), "no common superclass"
    assert hierarchical_score(None, E + "Cup", TBOX) == (0.0, 0.0, 0.0)


def test_hierarchical_f1_is_the_mean_over_objects() -> None:
    scores = [score("Cup", "Container"), score("Wall", "Cup")]
    assert hierarchical_f1(scores, TBOX) == pytest.approx((2 / 3 + 0) / 2)
    means = mean_hierarchical_score(scores, TBOX)
    assert (means.precision, means.recall) == (0.5, 0.25)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(CLASSES), st.sampled_from(CLASSES)), min_size=1, max_size=12))
def test_hierarchical_f1_agrees_with_sklearn_on_closure_vectors(pairs: list[tuple[str, str]]) -> None:
    def vector(name: str) -> list[int]:
        return [int(E + other in TBOX.closure(E + name)) for other in CLASSES]

    true = np.array([vector(target) for target, _ in pairs])
    given_ = np.array([vector(answer) for _, answer in pairs])
    expected = f1_score(true, given_, average="samples", zero_division=0)
    assert hierarchical_f1([score(t, a) for t, a in pairs], TBOX) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("target", "answer", "kind"),
    [
        ("Cup", "Cup", None),
        ("Cup", None, Miss.UNANSWERED),
        ("Cup", "Container", Miss.SUPERCLASS_COLLAPSE),
        ("Cup", "Thing", Miss.SUPERCLASS_COLLAPSE),
        ("Container", "Thing", Miss.TOO_GENERAL),
        ("Container", "Bowl", Miss.TOO_SPECIFIC),
        ("Cup", "Bowl", Miss.SIBLING),
        ("Spoon", "Cup", Miss.SIBLING),
        ("Container", "Tableware", Miss.SIBLING),
        ("Bowl", "Spoon", Miss.FAR_OFF),
        ("Cup", "Wall", Miss.FAR_OFF),
    ],
)
def test_classifies_misses(target: str, answer: str | None, kind: Miss | None) -> None:
    assert classify_miss(score(target, answer), TBOX) is kind


def test_miss_counts_sum_to_the_wrong_answers() -> None:
    scores = [score("Cup", "Container"), score("Cup", "Cup"), score("Bowl", None), score("Cup", "Bowl")]
    counts = count_misses(scores, TBOX)
    assert counts[Miss.SUPERCLASS_COLLAPSE] == counts[Miss.UNANSWERED] == counts[Miss.SIBLING] == 1
    assert sum(counts.values()) == 3
    assert counts[Miss.FAR_OFF] == 0


def test_class_reports_and_confusions() -> None:
    scores = [
        score("Cup", "Cup"),
        score("Cup", "Bowl"),
        score("Cup", "Bowl"),
        score("Bowl", "Bowl"),
        score("Wall", None),
    ]
    reports = {report.class_iri.removeprefix(E): report for report in class_reports(scores)}
    # Cup: 3 objects, answered once, correctly. Bowl: answered 3 times, once correctly. Wall: never answered.
    assert (reports["Cup"].precision, reports["Cup"].recall) == (1.0, 1 / 3)
    assert (reports["Bowl"].precision, reports["Bowl"].recall) == (1 / 3, 1.0)
    assert (reports["Wall"].precision, reports["Wall"].recall) == (None, 0.0)
    assert confusion(scores) == ((E + "Cup", E + "Bowl", 2), (E + "Wall", None, 1))


@pytest.mark.parametrize(
    ("count", "probability", "expected"),
    [
        # One answer deviates by 1 - p with probability p, and by p otherwise.
        (1, 0.3, 2 * 0.3 * 0.7),
        # 0, 1 or 2 of two: 2 · 1/4 · 1.
        (2, 0.5, 0.5),
        # 0.064 · 1.8 + 0.288 · 0.8 + 0.432 · 0.2 + 0.216 · 1.2.
        (3, 0.6, 0.6912),
        (5, 0.0, 0.0),
        (5, 1.0, 0.0),
    ],
)
def test_mean_absolute_deviation_of_binomials(count: int, probability: float, expected: float) -> None:
    assert mean_absolute_deviation(count, probability) == pytest.approx(expected)


def test_mean_absolute_deviation_of_many_is_that_of_a_normal_distribution() -> None:
    spread = math.sqrt(2 / math.pi * 100_000 * 0.2 * 0.8)
    assert mean_absolute_deviation(100_000, 0.2) == pytest.approx(spread, rel=1e-3)


def test_chance_calibration_error_by_bins() -> None:
    scores = [score("Cup", "Cup", confidence) for confidence in (0.62, 0.68, 0.3)]
    # Two answers at .65 and one at .3: (2 · 2 · .65² · .35 + 2 · .3 · .7) / 3.
    assert chance_calibration_error(scores) == pytest.approx((4 * 0.65**2 * 0.35 + 0.42) / 3)
    assert chance_calibration_error([score("Cup", None)]) is None


def test_calibration_error_by_bins() -> None:
    # Bin [0.9, 1]: confidences 0.95 and 0.91, one right: |0.5 - 0.93| = 0.43, weight 2/3.
    # Bin [0.2, 0.3): confidence 0.25, wrong: 0.25, weight 1/3. The object without an answer has no confidence.
    scores = [score("Cup", "Cup", 0.95), score("Cup", "Bowl", 0.91), score("Cup", "Bowl", 0.25), score("Cup", None)]
    assert [b.count for b in reliability_bins(scores)] == [1, 2]
    assert calibration_error(scores) == pytest.approx((2 * 0.43 + 1 * 0.25) / 3)
    assert calibration_error([score("Cup", None)]) is None


def test_confidence_one_is_in_the_last_bin() -> None:
    (only,) = reliability_bins([score("Cup", "Cup", 1.0)])
    assert (only.lower, only.upper, only.accuracy) == (0.9, 1.0, 1.0)


def test_risk_coverage_curve_groups_equal_confidences() -> None:
    scores = [
        score("Cup", "Cup", 0.9),
        score("Cup", "Bowl", 0.7),
        score("Cup", "Cup", 0.7),
        score("Cup", "Bowl", 0.1),
        score("Cup", None),
    ]
    # Threshold 0.9: 1 of 5 covered, 0 wrong; 0.7: 3 of 5, 1 of 3 wrong; 0.1: 4 of 5, 2 of 4 wrong.
    assert risk_coverage_curve(scores) == ((1 / 5, 0.0), (3 / 5, 1 / 3), (4 / 5, 2 / 4))
    assert accuracy_at_coverage(scores, 0.6) == pytest.approx(2 / 3)
    assert accuracy_at_coverage(scores, 0.61) == pytest.approx(1 / 2)
    assert accuracy_at_coverage(scores, 0.9) is None, "an object without an answer is never covered"


def test_accepting_second_labels_reduces_the_risk() -> None:
    scores = [score("Cup", "Bowl", 0.9, also="Bowl"), score("Cup", "Bowl", 0.7)]
    assert risk_coverage_curve(scores) == ((1 / 2, 1.0), (1.0, 1.0))
    assert risk_coverage_curve(scores, accepting=True) == ((1 / 2, 0.0), (1.0, 1 / 2))
    assert accuracy_at_coverage(scores, 0.5, accepting=True) == 1.0


def test_bootstrap_interval_matches_the_normal_approximation() -> None:
    values = [1.0] * 70 + [0.0] * 30
    first, again = bootstrap_interval(values), bootstrap_interval(values)
    assert first == again
    assert first.lower < 0.7 < first.upper
    # The normal approximation gives 0.7 ± 1.96 * sqrt(0.7 * 0.3 / 100) = 0.610 to 0.790.
    assert first.lower == pytest.approx(0.610, abs=0.02)
    assert first.upper == pytest.approx(0.790, abs=0.02)


def test_clustered_copies_widen_the_interval() -> None:
    values = [1.0] * 90 + [0.0] * 10
    clusters = ["cup"] * 90 + [f"thing {i}" for i in range(10)]
    by_object, by_name = bootstrap_interval(values), bootstrap_interval(values, clusters)
    assert by_name.upper - by_name.lower > 3 * (by_object.upper - by_object.lower)


def test_singleton_clusters_give_the_interval_over_objects() -> None:
    values = [1.0, 0.0, 1.0, 1.0, 0.0, 1.0]
    assert bootstrap_interval(values, list("abcdef")) == bootstrap_interval(values)


def test_interval_at_either_end_is_wilsons() -> None:
    # Wilson's interval of 0 of n is 0 to z² / (n + z²), with z = 1.96: 3.84 / (87 + 3.84) = 0.0423.
    assert mean_interval([0.0] * 87, highest=100) == pytest.approx((0.0, 4.23), abs=0.01)
    assert mean_interval([1.0] * 26) == pytest.approx((26 / (26 + 3.8415), 1.0), abs=1e-4)
    assert mean_interval([0.0]) == pytest.approx((0.0, 3.8415 / 4.8415), abs=1e-4)
    # Three names: 3.84 / (3 + 3.84) = 0.5615.
    assert mean_interval([0.0] * 4, ["cup", "cup", "bowl", "wall"]) == pytest.approx((0.0, 0.5615), abs=1e-4)
    assert mean_interval([0.0, 1.0, 1.0]) == bootstrap_interval([0.0, 1.0, 1.0])


def test_interval_of_no_values_raises() -> None:
    for interval in (bootstrap_interval, mean_interval):
        with pytest.raises(ValueError, match="no samples"):
            interval([])


def test_mcnemar_exact_p_value() -> None:
    first = [score("Cup", "Cup", name=str(i)) for i in range(8)]
    second = [score("Cup", "Cup" if i >= 5 else "Bowl", name=str(i)) for i in range(8)]
    test = mcnemar(first, second)
    assert (test.only_first, test.only_second) == (5, 0)
    # Five discordant pairs, all for the first: 2 * C(5, 0) / 2**5.
    assert test.p_value == 2 / 32
    assert mcnemar(first, first).p_value == 1.0


def test_mcnemar_pairs_scores_by_id() -> None:
    first = [score("Cup", "Cup", name="a"), score("Cup", "Bowl", name="b")]
    assert mcnemar(first, first[::-1]) == (0, 0, 1.0)
    with pytest.raises(ValueError, match="no object in common"):
        mcnemar(first, [score("Cup", "Cup", name="z")])


def test_mean_and_deviation_of_repeats() -> None:
    assert mean_and_deviation([90.0, 94.0]) == (92.0, pytest.approx(math.sqrt(8)))
    assert mean_and_deviation([90.0]) == (90.0, None)


def test_scores_object_selection() -> None:
    found = score_selection(["/a", "/b", "/x"], ["/a", "/b", "/c", "/d"])
    assert (found.recall, found.precision) == (2 / 4, 2 / 3)
    assert (found.missed, found.unlabelled) == (("/c", "/d"), ("/x",))
    assert score_selection([], ["/a"]).precision is None


def test_agreement_of_two_annotators() -> None:
    first = [
        label("/a", "Cup"),
        label("/b", "Cup"),
        label("/c", "Bowl", also="Cup"),
        label("/d", "Wall"),
        label("/e", "Cup"),
    ]
    second = [label("/a", "Cup"), label("/b", "Bowl"), label("/c", "Cup"), label("/d", "Wall"), label("/z", "Cup")]
    found = agreement(first, second, TBOX)
    assert found.n == 4
    assert found.exact == 2 / 4
    # Chance agreement: Cup 2/4 * 2/4, Bowl 1/4 * 1/4, Wall 1/4 * 1/4 = 6/16; kappa = (8/16 - 6/16) / (10/16).
    assert found.kappa == pytest.approx(2 / 10)
    assert found.accepted == 3 / 4, "only /c has Cup as a second label"
    bowl_for_cup = 2 * (2 / 3) * (1 / 2) / (2 / 3 + 1 / 2)
    assert found.hierarchical_f1 == pytest.approx((1 + bowl_for_cup + bowl_for_cup + 1) / 4)
    assert [a.prim_path for a, _ in found.disagreements] == ["/b", "/c"]
    assert (found.only_first, found.only_second) == (("/e",), ("/z",))


def test_kappa_is_undefined_if_chance_agreement_is_one() -> None:
    same = [label("/a", "Cup"), label("/b", "Cup")]
    assert agreement(same, same, TBOX).kappa is None
    with pytest.raises(ValueError, match="no prim in common"):
        agreement(same, [label("/z", "Cup")], TBOX)
