"""Calibration of confidences, and selective accuracy when low confidences abstain."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from usd2kg.evaluation.score import Score
from usd2kg.evaluation.settings import CONFIDENCE

__all__ = [
    "ReliabilityBin",
    "accuracy_at_coverage",
    "calibration_error",
    "chance_calibration_error",
    "mean_absolute_deviation",
    "reliability_bins",
    "risk_coverage_curve",
]

_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class ReliabilityBin:
    """The answers with a confidence in one interval."""

    lower: float
    upper: float
    count: int
    confidence: float
    """Mean confidence."""
    accuracy: float
    """Share of right answers."""


def reliability_bins(scores: Sequence[Score], bins: int = CONFIDENCE.bins) -> tuple[ReliabilityBin, ...]:
    """Return the non-empty bins of equal width, lowest first, without the answers that have no confidence."""
    members: dict[int, list[Score]] = {}
    for score in scores:
        if score.confidence is not None:
            members.setdefault(min(int(score.confidence * bins), bins - 1), []).append(score)
    return tuple(_bin(index, bins, members[index]) for index in sorted(members))


def _bin(index: int, bins: int, members: list[Score]) -> ReliabilityBin:
    count = len(members)
    return ReliabilityBin(
        lower=index / bins,
        upper=(index + 1) / bins,
        count=count,
        confidence=sum(score.confidence or 0.0 for score in members) / count,
        accuracy=sum(score.is_exact for score in members) / count,
    )


def calibration_error(scores: Sequence[Score], bins: int = CONFIDENCE.bins) -> float | None:
    """Return the expected calibration error Σ (n_b / n) |accuracy_b - confidence_b|; None without confidences.

    Guo et al. 2017, On Calibration of Modern Neural Networks, equation 3.
    """
    filled = reliability_bins(scores, bins)
    total = sum(b.count for b in filled)
    return sum(b.count * abs(b.accuracy - b.confidence) for b in filled) / total if total else None


def chance_calibration_error(scores: Sequence[Score], bins: int = CONFIDENCE.bins) -> float | None:
    """Return the expected calibration error if each confidence is the true probability; None without confidences.

    A calibration error is only evidence of false confidences as far as it exceeds this: with few answers, chance alone
    makes it large. Answers count as independent, and those of one bin as equally probable.
    """
    filled = reliability_bins(scores, bins)
    total = sum(b.count for b in filled)
    return sum(mean_absolute_deviation(b.count, b.confidence) for b in filled) / total if total else None


def mean_absolute_deviation(count: int, probability: float) -> float:
    """Return E|X - count · probability| of a binomial variable X.

    De Moivre's formula, 2 v C(n, v) p^v (1 - p)^(n - v + 1) with v = ⌊n p⌋ + 1; see Diaconis and Zabell 1991, Closed
    Form Summation for Classical Distributions.

    >>> round(mean_absolute_deviation(2, 0.5), 6)
    0.5
    """
    if not 0 < probability < 1:
        return 0.0
    above = math.floor(count * probability) + 1
    ways = math.lgamma(count + 1) - math.lgamma(above + 1) - math.lgamma(count - above + 1)
    return 2 * above * math.exp(ways + above * math.log(probability) + (count - above + 1) * math.log1p(-probability))


def risk_coverage_curve(scores: Sequence[Score], *, accepting: bool = False) -> tuple[tuple[float, float], ...]:
    """Return the points (coverage, risk) as the confidence threshold falls; ties enter together.

    Coverage is the share of all objects whose confidence reaches the threshold; risk is the share of wrong answers
    among the covered objects. Answers without a confidence are never covered.

    Args:
        scores: the scores.
        accepting: whether second labels count as right.
    """
    answered = sorted((s for s in scores if s.confidence is not None), key=lambda s: -(s.confidence or 0.0))
    points = []
    wrong = 0
    for taken, score in enumerate(answered, 1):
        wrong += not (score.is_accepted if accepting else score.is_exact)
        if taken == len(answered) or answered[taken].confidence != score.confidence:
            points.append((taken / len(scores), wrong / taken))
    return tuple(points)


def accuracy_at_coverage(scores: Sequence[Score], coverage: float, *, accepting: bool = False) -> float | None:
    """Return the accuracy of the most confident answers about at least the share `coverage` of all objects.

    None if fewer objects have an answer with a confidence. Answers of equal confidence count together.
    With `accepting`, second labels count as right.
    """
    curve = risk_coverage_curve(scores, accepting=accepting)
    return next((1 - risk for share, risk in curve if share >= coverage - _ROUNDING), None)
