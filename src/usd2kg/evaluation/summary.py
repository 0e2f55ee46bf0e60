"""The figures of one run, in the study's units: EMA in percent, HF1 from 0 to 1."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from usd2kg.evaluation.metrics.accuracy import accept_also, exact_match
from usd2kg.evaluation.metrics.calibration import accuracy_at_coverage, calibration_error
from usd2kg.evaluation.metrics.hierarchical import hierarchical, hierarchical_one
from usd2kg.evaluation.metrics.intervals import Interval, bootstrap_interval
from usd2kg.evaluation.metrics.misses import count_misses
from usd2kg.evaluation.sample import Score, distinct_name
from usd2kg.ontology import TBox

__all__ = ["Summary", "summarize_scores"]


@dataclass(frozen=True)
class Summary:
    """What a list of scores comes to."""

    n: int
    """Gold objects, unanswered ones included."""
    names: int
    """Distinct names among them."""
    answered: int
    ema: float
    """Exact match, percent."""
    ema_interval: Interval
    """95 % interval over objects, percent."""
    ema_name_interval: Interval
    """95 % interval of the same figure when whole names are drawn, percent: the honest one where objects repeat."""
    ema_by_name: float
    """Exact match, percent, each distinct name counted once."""
    ema_by_name_interval: Interval
    """95 % interval of that over distinct names, percent."""
    ema_also: float
    """Exact match accepting the second labels, percent."""
    ema_also_interval: Interval
    hp: float
    """Hierarchical precision, 0 to 1."""
    hr: float
    """Hierarchical recall, 0 to 1."""
    hf1: float
    """Hierarchical F1, 0 to 1."""
    hf1_interval: Interval
    calibration_error: float | None
    accuracy_at_80: float | None
    """Exact match, percent, of the surest answers that make up 80 % of the objects."""
    accepted_at_80: float | None
    """The same, accepting the second labels, percent."""
    misses: dict[str, int]

    def as_json(self) -> dict[str, Any]:
        """Return the figures as plain data."""
        data = dict(self.__dict__)
        return {key: list(value) if isinstance(value, Interval) else value for key, value in data.items()}


def summarize_scores(scores: Sequence[Score], tbox: TBox) -> Summary:
    """Return the figures of a run.

    Raises:
        ValueError: there is no score.
    """
    names = [distinct_name(score.name) for score in scores]
    exact = [100.0 * score.is_exact for score in scores]
    also = [100.0 * score.is_accepted for score in scores]
    f1 = [hierarchical_one(score.answer, score.target, tbox).f1 for score in scores]
    by_name: dict[str, list[float]] = {}
    for name, value in zip(names, exact, strict=True):
        by_name.setdefault(name, []).append(value)
    name_means = [sum(values) / len(values) for values in by_name.values()]
    means = hierarchical(scores, tbox)
    surest, surest_also = (accuracy_at_coverage(scores, 0.8, accepting=accepting) for accepting in (False, True))
    return Summary(
        n=len(scores),
        names=len(by_name),
        answered=sum(score.answer is not None for score in scores),
        ema=100 * exact_match(scores),
        ema_interval=bootstrap_interval(exact),
        ema_name_interval=bootstrap_interval(exact, names),
        ema_by_name=sum(name_means) / len(name_means),
        ema_by_name_interval=bootstrap_interval(name_means),
        ema_also=100 * accept_also(scores),
        ema_also_interval=bootstrap_interval(also),
        hp=means.precision,
        hr=means.recall,
        hf1=means.f1,
        hf1_interval=bootstrap_interval(f1),
        calibration_error=calibration_error(scores),
        accuracy_at_80=None if surest is None else 100 * surest,
        accepted_at_80=None if surest_also is None else 100 * surest_also,
        misses={kind.value: count for kind, count in count_misses(scores, tbox).items()},
    )
