"""Whether a confidence is the probability of being right, and what abstaining would buy."""

from collections.abc import Sequence
from dataclasses import dataclass

from usd2kg.evaluation.sample import Score

__all__ = ["ReliabilityBin", "accuracy_at_coverage", "calibration_error", "reliability", "risk_coverage"]


@dataclass(frozen=True, slots=True)
class ReliabilityBin:
    """The answers whose confidence lies in one interval."""

    lower: float
    upper: float
    count: int
    confidence: float
    """Mean confidence."""
    accuracy: float
    """Share that is right."""


def reliability(scores: Sequence[Score], bins: int = 10) -> tuple[ReliabilityBin, ...]:
    """Return the bins of equal width that hold answers, lowest first; unanswered objects have no confidence."""
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


def calibration_error(scores: Sequence[Score], bins: int = 10) -> float | None:
    """Return the expected calibration error Σ (n_b / n) |accuracy_b - confidence_b|; None if nothing was answered.

    Guo et al., On Calibration of Modern Neural Networks (2017), equation 3.
    """
    filled = reliability(scores, bins)
    total = sum(b.count for b in filled)
    return sum(b.count * abs(b.accuracy - b.confidence) for b in filled) / total if total else None


def risk_coverage(scores: Sequence[Score], *, accepting: bool = False) -> tuple[tuple[float, float], ...]:
    """Return (coverage, risk) as answers are taken in falling confidence; equal confidences are taken together.

    Coverage is the share of all objects, risk the share of wrong answers among those taken. Unanswered objects are
    never taken. With `accepting`, an answer that is one of the gold's second labels is not wrong.
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
    """Return the accuracy of the surest answers that make up at least `coverage`; None if there are too few.

    With `accepting`, the gold's second labels count as right.
    """
    reached = [risk for share, risk in risk_coverage(scores, accepting=accepting) if share >= coverage - 1e-12]
    return 1 - reached[0] if reached else None
