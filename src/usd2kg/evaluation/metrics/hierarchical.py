"""Hierarchical precision, recall and F1, with partial credit for answers near the target.

Silla and Freitas 2011, as in the study. With ↑c for a class and its superclasses in the scope:
hP = |↑ĉ ∩ ↑c*| / |↑ĉ|, hR = |↑ĉ ∩ ↑c*| / |↑c*|, and HF1 is the mean over objects of 2 hP hR / (hP + hR).
"""

from collections.abc import Sequence
from typing import NamedTuple

from usd2kg.evaluation.score import Score
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["HierarchicalScore", "hierarchical_f1", "hierarchical_score", "mean_hierarchical_score"]


class HierarchicalScore(NamedTuple):
    """Hierarchical precision, recall and F1, each from 0 to 1."""

    precision: float
    recall: float
    f1: float


def hierarchical_score(answer: ClassIRI | None, target: ClassIRI, tbox: TBox) -> HierarchicalScore:
    """Return hP, hR and F1 of one answer; all 0 without an answer or a common superclass."""
    if answer is None:
        return HierarchicalScore(0.0, 0.0, 0.0)
    predicted, true = tbox.closure(answer), tbox.closure(target)
    common = len(predicted & true)
    precision, recall = common / len(predicted), common / len(true)
    return HierarchicalScore(precision, recall, 2 * precision * recall / (precision + recall) if common else 0.0)


def mean_hierarchical_score(scores: Sequence[Score], tbox: TBox) -> HierarchicalScore:
    """Return the means of hP, hR and F1 over objects; those without an answer count as 0.

    Raises:
        ValueError: there are no scores.
    """
    if not scores:
        raise ValueError("the mean of no samples is undefined")
    each = [hierarchical_score(score.answer, score.target, tbox) for score in scores]
    return HierarchicalScore(*(sum(values) / len(each) for values in zip(*each, strict=True)))


def hierarchical_f1(scores: Sequence[Score], tbox: TBox) -> float:
    """Return HF1, the mean F1 over objects."""
    return mean_hierarchical_score(scores, tbox).f1
