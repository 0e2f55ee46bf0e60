"""Hierarchical precision, recall and F1: an answer near the target in the hierarchy is partly right.

Silla and Freitas (2011), as the study uses them. With ↑c the class and all its ancestors up to the scope's roots:
hP = |↑ĉ ∩ ↑c*| / |↑ĉ|, hR = |↑ĉ ∩ ↑c*| / |↑c*|, and HF1 is the mean over objects of 2 hP hR / (hP + hR).
"""

from collections.abc import Sequence
from typing import NamedTuple

from usd2kg.evaluation.sample import Score
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["Hierarchical", "hierarchical", "hierarchical_f1", "hierarchical_one"]


class Hierarchical(NamedTuple):
    """Means over objects, each from 0 to 1."""

    precision: float
    recall: float
    f1: float


def hierarchical_one(answer: ClassIRI | None, target: ClassIRI, tbox: TBox) -> Hierarchical:
    """Return hP, hR and F1 of one answer; all 0 where there is no answer or no common ancestor."""
    if answer is None:
        return Hierarchical(0.0, 0.0, 0.0)
    given, true = tbox.closure(answer), tbox.closure(target)
    common = len(given & true)
    precision, recall = common / len(given), common / len(true)
    return Hierarchical(precision, recall, 2 * precision * recall / (precision + recall) if common else 0.0)


def hierarchical(scores: Sequence[Score], tbox: TBox) -> Hierarchical:
    """Return the means of hP, hR and F1 over objects; unanswered ones count as 0.

    Raises:
        ValueError: there is no score.
    """
    if not scores:
        raise ValueError("a mean of no samples is undefined")
    each = [hierarchical_one(score.answer, score.target, tbox) for score in scores]
    return Hierarchical(*(sum(values) / len(each) for values in zip(*each, strict=True)))


def hierarchical_f1(scores: Sequence[Score], tbox: TBox) -> float:
    """Return HF1 alone."""
    return hierarchical(scores, tbox).f1
