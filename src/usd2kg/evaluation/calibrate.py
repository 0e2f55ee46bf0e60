"""Fitting the probability of being right to answers whose truth is known."""

from collections.abc import Sequence

import numpy as np

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.sample import Score
from usd2kg.grounding import PlattScaling
from usd2kg.grounding.platt_scaling import logit

__all__ = ["fit_scaling"]

_FEWEST = 20
_ROUNDS = 100
_CLOSE = 1e-10


def fit_scaling(scores: Sequence[Score], grounder: str) -> PlattScaling:
    """Return the scaling that makes the known answers most likely, by Newton's method.

    Against overconfidence the truths are Platt's targets, (N₊ + 1) / (N₊ + 2) for right answers and 1 / (N₋ + 2) for
    wrong ones (Platt, 1999, section 2.2).

    Args:
        scores: answers; those without a confidence say nothing.
        grounder: what gave them, in a line.

    Raises:
        EvaluationError: there are fewer than 20 answers with a confidence, or all are right, or none.
    """
    known = [(logit(score.confidence), score.is_exact) for score in scores if score.confidence is not None]
    right = sum(is_right for _, is_right in known)
    if len(known) < _FEWEST or right in (0, len(known)):
        raise EvaluationError(
            f"{len(known)} answers with a confidence, {right} of them right; expected {_FEWEST} or more, some right "
            "and some wrong: label more objects"
        )
    features = np.array([(1.0, odds) for odds, _ in known])
    high, low = (right + 1) / (right + 2), 1 / (len(known) - right + 2)
    targets = np.where([is_right for _, is_right in known], high, low)
    weights = np.zeros(2)
    for _ in range(_ROUNDS):
        shares = 1 / (1 + np.exp(-features @ weights))
        gradient = features.T @ (targets - shares)
        curvature = features.T @ (features * (shares * (1 - shares))[:, None]) + 1e-9 * np.eye(2)
        step = np.linalg.solve(curvature, gradient)
        weights += step
        if float(np.abs(step).max()) < _CLOSE:
            break
    return PlattScaling(round(float(weights[0]), 6), round(float(weights[1]), 6), grounder, len(known))
