"""Platt scaling fitted to answers with known correctness."""

import math
import random
from pathlib import Path

import pytest

from tests.evaluation.records import score
from usd2kg.errors import EvaluationError, GroundingError
from usd2kg.evaluation import Score, fit_scaling
from usd2kg.grounding import PlattScaling, read_scaling


def scores(confidences: list[float], right: list[bool]) -> list[Score]:
    return [
        score("Cup", "Cup" if is_right else "Bowl", confidence, name=str(number))
        for number, (confidence, is_right) in enumerate(zip(confidences, right, strict=True))
    ]


def test_recovers_the_scaling_that_generated_the_answers():
    drawn = random.Random(4)
    confidences = [drawn.uniform(0.02, 0.98) for _ in range(20000)]
    truth = PlattScaling(-1.0, 0.5, "", 0)
    fitted = fit_scaling(scores(confidences, [drawn.random() < truth(c) for c in confidences]), "model")
    assert fitted.intercept == pytest.approx(-1.0, abs=0.06)
    assert fitted.slope == pytest.approx(0.5, abs=0.04)
    assert (fitted.grounder, fitted.answers) == ("model", 20000)


def test_fits_two_groups_exactly_with_platts_targets():
    # 8 of 10 are right at 0.9, 3 of 10 at 0.2: two parameters fit two groups exactly.
    known = scores([0.9] * 10 + [0.2] * 10, [True] * 8 + [False] * 2 + [True] * 3 + [False] * 7)
    fitted = fit_scaling(known, "model")
    high, low = 12 / 13, 1 / 11
    assert fitted(0.9) == pytest.approx((8 * high + 2 * low) / 10, abs=1e-3)
    assert fitted(0.2) == pytest.approx((3 * high + 7 * low) / 10, abs=1e-3)
    assert fitted(1.0) <= 1.0
    assert math.isfinite(fitted(0.0))


@pytest.mark.parametrize("right", [[True] * 30, [False] * 30, [True, False] * 5])
def test_rejects_too_few_or_one_sided_answers(right: list[bool]):
    with pytest.raises(EvaluationError, match="label more objects"):
        fit_scaling(scores([0.5] * len(right), right), "model")


def test_reads_scaling_files_and_rejects_malformed_ones(tmp_path: Path):
    path = tmp_path / "calibration.json"
    scaling = PlattScaling(-0.25, 1.5, "llm, semantic names", 200)
    path.write_text(scaling.as_json(), "utf-8")
    assert read_scaling(path) == scaling
    path.write_text(scaling.as_json().replace("1.5", "NaN"), "utf-8")
    with pytest.raises(GroundingError, match="not finite"):
        read_scaling(path)
    path.write_text("{}", "utf-8")
    with pytest.raises(GroundingError, match="cannot be read as a calibration"):
        read_scaling(path)
