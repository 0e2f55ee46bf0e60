"""Fit Platt scaling to answers whose correctness is known, such as those of a language model in stored runs."""

from collections.abc import Sequence

import numpy as np

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.score import Score
from usd2kg.evaluation.settings import PLATT_FIT
from usd2kg.evaluation.stored import StoredRun, describe_runs
from usd2kg.grounding import PlattScaling, Status
from usd2kg.grounding.platt_scaling import describe_settings, logit

__all__ = ["fit_scaling", "model_answers"]


def model_answers(runs: Sequence[StoredRun]) -> tuple[Score, ...]:
    """Return the answers of the language model that was asked in all runs, without decisions of a person.

    Raises:
        EvaluationError: a run has answers of another grounder or calibrated ones, the runs differ in model, prompts,
            naming regime or evidence, or have an object in common.
    """
    for run in runs:
        _check_raw(run)
    kinds = {(describe_settings(run.settings), run.regime, run.evidence) for run in runs}
    if len(kinds) > 1:
        found = "; ".join(sorted(set(describe_runs(runs))))
        raise EvaluationError(f"runs of different grounders: {found}; expected runs of one, with the same options")
    _check_counted_once(runs)
    return tuple(score for run in runs for score in run.scores if score.status is not Status.REVIEWED)


def _check_raw(run: StoredRun) -> None:
    """Check that a run has the answers of a language model alone, with its own confidences."""
    if not run.asks_model:
        raise EvaluationError(f"{run.source}: is a run of {run.grounder}; expected a run of a language model")
    if "first" in run.settings:
        raise EvaluationError(
            f"{run.source}: is a run of a cascade, with answers of {run.settings['first']}; expected a run of the "
            "language model alone, without --cascade"
        )
    if run.is_calibrated:
        raise EvaluationError(
            f"{run.source}: its confidences are calibrated already; expected a run without --calibration"
        )


def _check_counted_once(runs: Sequence[StoredRun]) -> None:
    """Check that no two runs have an answer about the same object, unless they drew different samples."""
    seen: dict[tuple[str, str | None, str], StoredRun] = {}
    for run in runs:
        for score in run.scores:
            first = seen.setdefault((run.scene_hash, run.settings.get("first_sample"), score.id), run)
            if first is not run:
                raise EvaluationError(
                    f"{first.source} and {run.source}: both have an answer about {score.id} of {run.scene}; expected "
                    "each object once, leave out one of the runs"
                )


def fit_scaling(scores: Sequence[Score], grounder: str) -> PlattScaling:
    """Return the maximum-likelihood Platt scaling of the confidences, by Newton's method.

    The targets are smoothed against overconfidence: (N₊ + 1) / (N₊ + 2) for right answers and 1 / (N₋ + 2) for wrong
    ones (Platt 1999, section 2.2).

    Args:
        scores: the answers; those without a confidence are ignored.
        grounder: description of the grounder in one line, kept with the scaling.

    Raises:
        EvaluationError: too few answers have a confidence, or all of them are right, or all wrong.
    """
    known = [(logit(score.confidence), score.is_exact) for score in scores if score.confidence is not None]
    right = sum(is_right for _, is_right in known)
    if len(known) < PLATT_FIT.min_answers or right in (0, len(known)):
        raise EvaluationError(
            f"{len(known)} answers with a confidence, {right} of them right; expected {PLATT_FIT.min_answers} or more, "
            "some right and some wrong: label more objects"
        )
    features = np.array([(1.0, log_odds) for log_odds, _ in known])
    high, low = (right + 1) / (right + 2), 1 / (len(known) - right + 2)
    targets = np.where([is_right for _, is_right in known], high, low)
    weights = np.zeros(2)
    for _ in range(PLATT_FIT.max_iterations):
        probabilities = 1 / (1 + np.exp(-features @ weights))
        gradient = features.T @ (targets - probabilities)
        variances = probabilities * (1 - probabilities)
        hessian = features.T @ (features * variances[:, None]) + PLATT_FIT.ridge * np.eye(2)
        step = np.linalg.solve(hessian, gradient)
        weights += step
        if float(np.abs(step).max()) < PLATT_FIT.tolerance:
            break
    return PlattScaling(round(float(weights[0]), 6), round(float(weights[1]), 6), grounder, len(known))
