"""Platt scaling fitted to answers with known correctness."""

import math
import random
from dataclasses import replace
from pathlib import Path

import pytest

from tests.evaluation.records import score
from usd2kg.errors import EvaluationError, GroundingError
from usd2kg.evaluation import Score, fit_scaling
from usd2kg.evaluation.calibrate import model_answers
from usd2kg.evaluation.stored import StoredRun
from usd2kg.grounding import PlattScaling, Status, read_scaling
from usd2kg.grounding.platt_scaling import describe_settings

SETTINGS = {"regime": "semantic", "evidence": "name", "model": "openai:m", "strategy": "A", "temperature": "0"}


def stored(
    name: str = "a.json", scene: str = "1", *, grounder: str = "llm", calibrated: bool = False, **settings: str
) -> StoredRun:
    """Return a run with an answer of the model and a decision of a person; an empty setting is left out."""
    decided = replace(score("Bowl", "Bowl", 1.0, name="decided"), status=Status.REVIEWED)
    own = {key: value for key, value in (SETTINGS | settings).items() if value}
    return StoredRun(
        source=name,
        scene=f"{scene}.usda",
        scene_hash=scene,
        ontology_hash="sha256:0",
        grounder=grounder,
        regime=own["regime"],
        evidence=own["evidence"],
        settings=own,
        is_calibrated=calibrated,
        scores=(score("Cup", "Cup", 0.7), decided),
        missed=frozenset(),
    )


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
    assert read_scaling(path) == read_scaling(str(path)) == scaling
    path.write_text(scaling.as_json().replace("1.5", "NaN"), "utf-8")
    with pytest.raises(GroundingError, match="not finite"):
        read_scaling(path)
    path.write_text("{}", "utf-8")
    with pytest.raises(GroundingError, match="cannot be read as a calibration"):
        read_scaling(path)


def test_uses_only_the_answers_of_the_model():
    answers = model_answers([stored(), stored("b.json", "2"), stored("c.json", first_sample="1")])
    assert [(answer.name, answer.confidence) for answer in answers] == [("a", 0.7)] * 3


@pytest.mark.parametrize(
    ("runs", "said"),
    [
        (
            [stored(grounder="lexical", model="", strategy="", calibrated=True)],
            r"a\.json: is a run of lexical; expected a run of a language model",
        ),
        (
            [stored(grounder="cascade", first="lexical", second="llm", min_confidence="0.8")],
            r"a\.json: is a run of a cascade, with answers of lexical; expected .* alone, without --cascade",
        ),
        ([stored(calibrated=True)], r"a\.json: its confidences are calibrated already; .* without --calibration"),
        (
            [stored(), stored("b.json", "2", shortlist="3")],
            r"runs of different grounders: .*, shortlist 3; .*, shortlist default; expected runs of one",
        ),
        ([stored(), stored("b.json", "2", regime="opaque")], r"runs of different grounders: .* opaque names"),
        (
            [stored(), stored("b.json")],
            r"a\.json and b\.json: both have an answer about /w/a of 1\.usda; expected each object once",
        ),
    ],
)
def test_rejects_runs_that_are_not_separate_answers_of_one_model(runs: list[StoredRun], said: str):
    with pytest.raises(EvaluationError, match=said):
        model_answers(runs)


def test_a_calibration_is_for_the_settings_of_the_model_not_of_the_run():
    described = describe_settings({**SETTINGS, "first_sample": "3", "calibration": "0 +1 logit"})
    assert described == "model openai:m, strategy A, temperature 0"
    assert PlattScaling(-0.25, 1.5, "", 9).formula == "-0.25 +1.5 logit"
