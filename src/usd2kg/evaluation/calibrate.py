"""Fit Platt scaling to answers whose correctness is known."""

from collections.abc import Sequence

import numpy as np

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.score import Score
from usd2kg.evaluation.settings import PLATT_FIT
from usd2kg.grounding import PlattScaling
from usd2kg.grounding.platt_scaling import logit

__all__ = ["fit_scaling"]


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
