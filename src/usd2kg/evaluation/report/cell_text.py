"""Numbers and classes as text of table cells. Rounding happens here only."""

from collections.abc import Sequence

import numpy as np

from usd2kg.evaluation.metrics.intervals import Interval, mean_and_deviation
from usd2kg.evaluation.report.published import PublishedResult
from usd2kg.ontology import ClassIRI, TBox

__all__ = [
    "ABSENT",
    "class_text",
    "interval_text",
    "number_text",
    "p_value_text",
    "published_text",
    "significant_digits",
    "spread_text",
]

ABSENT = "–"
"""Content of a cell without a value: nothing was run, or the metric is undefined."""
_SMALLEST_P = 0.0001


def number_text(value: float | None, digits: int) -> str:
    """Return a number with a fixed number of decimals.

    >>> number_text(0.125, 2), number_text(None, 2)
    ('0.12', '–')
    """
    return ABSENT if value is None else f"{value:.{digits}f}"


def spread_text(values: Sequence[float], digits: int, without: str = "") -> str:
    """Return the mean ± standard deviation of repeated runs, or the value of a single run.

    Args:
        values: one value per repeat; empty if nothing was run.
        digits: number of decimals.
        without: prefix to remove: the study writes .98 for 0.98.

    >>> spread_text([90.0, 94.0], 1), spread_text([0.98], 2, without="0"), spread_text([], 1)
    ('92.0 ± 2.8', '.98', '–')
    """
    if not values:
        return ABSENT
    parts = [number_text(value, digits) for value in mean_and_deviation(values) if value is not None]
    return " ± ".join(part.removeprefix(without) for part in parts)


def interval_text(interval: Interval, digits: int) -> str:
    """Return an interval as `81.3 to 92.0`."""
    return f"{interval.lower:.{digits}f} to {interval.upper:.{digits}f}"


def p_value_text(value: float) -> str:
    """Return a p-value with four decimals, or `< 0.0001`."""
    return f"< {_SMALLEST_P:.4f}" if value < _SMALLEST_P else f"{value:.4f}"


def significant_digits(value: float, digits: int = 2) -> str:
    """Return a number with at most `digits` significant digits and no exponent.

    >>> significant_digits(0.0000134), significant_digits(12.3)
    ('0.000013', '12')
    """
    return np.format_float_positional(value, precision=digits, fractional=False, trim="-")


def published_text(result: PublishedResult | None) -> str:
    """Return a published result as `EMA % / HF1`, or as EMA alone if the study has no HF1 for it.

    >>> published_text(PublishedResult(48.0, 0.79, "")), published_text(PublishedResult(None, None, "fail"))
    ('48 / .79', 'fail')
    """
    if result is None:
        return ABSENT
    if result.ema is None:
        return result.note
    f1 = "" if result.hf1 is None else f" / {number_text(result.hf1, 2).removeprefix('0')}"
    return f"{result.ema:.0f}{f1}"


def class_text(iri: ClassIRI | None, tbox: TBox) -> str:
    """Return the readable name of a class; `no answer` for None."""
    return tbox.by_iri[iri].readable_name if iri is not None else "no answer"
