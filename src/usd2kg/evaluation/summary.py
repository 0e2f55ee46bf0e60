"""The metrics of one run, in the study's units: EMA in percent, HF1 from 0 to 1."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from usd2kg.evaluation.metrics.accuracy import accept_also, exact_match
from usd2kg.evaluation.metrics.calibration import (
    accuracy_at_coverage,
    calibration_error,
    chance_calibration_error,
)
from usd2kg.evaluation.metrics.hierarchical import hierarchical_score, mean_hierarchical_score
from usd2kg.evaluation.metrics.intervals import Interval, mean_interval
from usd2kg.evaluation.metrics.misses import count_misses
from usd2kg.evaluation.score import Score, distinct_name
from usd2kg.ontology import TBox

__all__ = ["Summary", "summarize_scores"]

_COVERAGE = 0.8
"""Coverage of the metrics `…_at_80`."""


@dataclass(frozen=True)
class Summary:
    """The metrics of a list of scores."""

    n: int
    """Number of gold objects, including those without an answer."""
    names: int
    """Number of distinct names among them."""
    answered: int
    """Number of objects with an answer."""
    ema: float
    """Exact match, percent."""
    ema_interval: Interval
    """95 % interval over objects, percent."""
    ema_name_interval: Interval
    """95 % interval resampled by distinct name, percent. Use this one if a scene contains copies."""
    ema_by_name: float
    """Mean over distinct names of the exact match of their objects, percent."""
    ema_by_name_interval: Interval
    """95 % interval of `ema_by_name`, percent."""
    ema_also: float
    """Exact match with second labels accepted, percent."""
    ema_also_interval: Interval
    hp: float
    """Hierarchical precision, 0 to 1."""
    hr: float
    """Hierarchical recall, 0 to 1."""
    hf1: float
    """Hierarchical F1, 0 to 1."""
    hf1_interval: Interval
    calibration_error: float | None
    """Expected calibration error, 0 to 1; None without confidences."""
    chance_calibration_error: float | None
    """What the calibration error would be on average if the confidences were true; None without confidences."""
    accuracy_at_80: float | None
    """Exact match, percent, of the most confident answers that cover 80 % of the objects; None if fewer objects have an
    answer with a confidence."""
    accepted_at_80: float | None
    """The same with second labels accepted, percent."""
    misses: dict[str, int]
    """Kind of wrong answer → count."""

    def as_json(self) -> dict[str, Any]:
        """Return the metrics as plain data; intervals as [lower, upper]."""
        data = dict(self.__dict__)
        return {key: list(value) if isinstance(value, Interval) else value for key, value in data.items()}


def summarize_scores(scores: Sequence[Score], tbox: TBox) -> Summary:
    """Return the metrics of a run.

    Raises:
        ValueError: there are no scores.
    """
    names = [distinct_name(score.name) for score in scores]
    exact = [100.0 * score.is_exact for score in scores]
    also = [100.0 * score.is_accepted for score in scores]
    f1 = [hierarchical_score(score.answer, score.target, tbox).f1 for score in scores]
    by_name: dict[str, list[float]] = {}
    for name, value in zip(names, exact, strict=True):
        by_name.setdefault(name, []).append(value)
    name_means = [sum(values) / len(values) for values in by_name.values()]
    means = mean_hierarchical_score(scores, tbox)
    confident, confident_also = (
        accuracy_at_coverage(scores, _COVERAGE, accepting=accepting) for accepting in (False, True)
    )
    return Summary(
        n=len(scores),
        names=len(by_name),
        answered=sum(score.answer is not None for score in scores),
        ema=100 * exact_match(scores),
        ema_interval=mean_interval(exact, highest=100.0),
        ema_name_interval=mean_interval(exact, names, highest=100.0),
        ema_by_name=sum(name_means) / len(name_means),
        ema_by_name_interval=mean_interval(name_means, highest=100.0),
        ema_also=100 * accept_also(scores),
        ema_also_interval=mean_interval(also, highest=100.0),
        hp=means.precision,
        hr=means.recall,
        hf1=means.f1,
        hf1_interval=mean_interval(f1),
        calibration_error=calibration_error(scores),
        chance_calibration_error=chance_calibration_error(scores),
        accuracy_at_80=None if confident is None else 100 * confident,
        accepted_at_80=None if confident_also is None else 100 * confident_also,
        misses={kind.value: count for kind, count in count_misses(scores, tbox).items()},
    )
