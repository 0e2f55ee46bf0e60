"""Kinds of wrong answers, by the relation of answer and target in the hierarchy."""

from collections import Counter
from collections.abc import Iterable
from enum import StrEnum

from usd2kg.evaluation.score import Score
from usd2kg.ontology import TBox

__all__ = ["Miss", "classify_miss", "count_misses"]


class Miss(StrEnum):
    """Kinds of wrong answers; the first that applies counts."""

    UNANSWERED = "unanswered"
    """There is no answer."""
    SUPERCLASS_COLLAPSE = "superclass collapse"
    """The target is a leaf, the answer one of its superclasses."""
    TOO_GENERAL = "too general"
    """The target has subclasses, the answer is one of its superclasses."""
    TOO_SPECIFIC = "too specific"
    """The answer is a subclass of the target."""
    SIBLING = "sibling"
    """Answer and target have a direct superclass in common."""
    SAME_BRANCH = "same branch"
    """Answer and target have a common superclass other than a root."""
    FAR_OFF = "far off"
    """Answer and target have at most a root in common."""


def classify_miss(score: Score, tbox: TBox) -> Miss | None:
    """Return the kind of a wrong answer; None for a right one."""
    if score.is_exact:
        return None
    if score.answer is None:
        return Miss.UNANSWERED
    if tbox.is_subclass(score.target, score.answer):
        return Miss.TOO_GENERAL if tbox.children[score.target] else Miss.SUPERCLASS_COLLAPSE
    if tbox.is_subclass(score.answer, score.target):
        return Miss.TOO_SPECIFIC
    if set(tbox.by_iri[score.answer].parents) & set(tbox.by_iri[score.target].parents):
        return Miss.SIBLING
    common = tbox.closure(score.answer) & tbox.closure(score.target)
    return Miss.SAME_BRANCH if common - set(tbox.roots) else Miss.FAR_OFF


def count_misses(scores: Iterable[Score], tbox: TBox) -> dict[Miss, int]:
    """Return the count of each kind, 0 included."""
    counts = Counter(classify_miss(score, tbox) for score in scores)
    return {kind: counts[kind] for kind in Miss}
