"""Exact match, with or without the second gold labels."""

from collections.abc import Sequence

from usd2kg.evaluation.score import Score

__all__ = ["accept_also", "exact_match"]


def exact_match(scores: Sequence[Score]) -> float:
    """Return EMA = (1/n) Σ 1[ĉ = c*], from 0 to 1; objects without an answer count as wrong.

    Raises:
        ValueError: there are no scores.
    """
    return _share([score.is_exact for score in scores])


def accept_also(scores: Sequence[Score]) -> float:
    """Return the share of answers that are the target or one of its second labels, from 0 to 1.

    Raises:
        ValueError: there are no scores.
    """
    return _share([score.is_accepted for score in scores])


def _share(hits: Sequence[bool]) -> float:
    if not hits:
        raise ValueError("the accuracy of no samples is undefined")
    return sum(hits) / len(hits)
