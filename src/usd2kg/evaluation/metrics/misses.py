"""What kind of miss a wrong answer is."""

from collections import Counter
from collections.abc import Iterable
from enum import StrEnum

from usd2kg.evaluation.sample import Score
from usd2kg.ontology import TBox

__all__ = ["Miss", "count_misses", "kind_of_miss"]


class Miss(StrEnum):
    """The kinds, in the order in which they are looked for."""

    UNANSWERED = "unanswered"
    """There was no answer."""
    SUPERCLASS_COLLAPSE = "superclass collapse"
    """The truth is a leaf, the answer a class above it."""
    TOO_GENERAL = "too general"
    """The truth is itself a class with subclasses, the answer a class above it."""
    TOO_SPECIFIC = "too specific"
    """The answer is below the truth."""
    SIBLING = "sibling"
    """Answer and truth have a parent in common."""
    SAME_BRANCH = "same branch"
    """They have a common ancestor other than a root."""
    FAR_OFF = "far off"
    """They have a root in common at most."""


def kind_of_miss(score: Score, tbox: TBox) -> Miss | None:
    """Return what kind of miss a score is; None if it is right."""
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
    """Return how often each kind occurs; kinds that do not are 0."""
    counts = Counter(kind_of_miss(score, tbox) for score in scores)
    return {kind: counts[kind] for kind in Miss}
