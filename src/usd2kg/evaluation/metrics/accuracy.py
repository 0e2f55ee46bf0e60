"""How often the answer is right."""

from collections.abc import Sequence

from usd2kg.evaluation.sample import Score

__all__ = ["accept_also", "exact_match"]


def exact_match(scores: Sequence[Score]) -> float:
    """Return EMA = (1/n) Σ 1[ĉ = c*], from 0 to 1; unanswered objects count as wrong.

    Raises:
        ValueError: there is no score.
    """
    return _share([score.is_exact for score in scores])


def accept_also(scores: Sequence[Score]) -> float:
    """Return the share of answers that are the target or a class accepted beside it, from 0 to 1."""
    return _share([score.is_accepted for score in scores])


def _share(hits: Sequence[bool]) -> float:
    if not hits:
        raise ValueError("a share of no samples is undefined")
    return sum(hits) / len(hits)
