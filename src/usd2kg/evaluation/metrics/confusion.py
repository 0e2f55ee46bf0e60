"""Precision and recall by class, and confusions between classes."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from usd2kg.evaluation.score import Score
from usd2kg.ontology import ClassIRI

__all__ = ["ClassReport", "class_reports", "confusion"]


@dataclass(frozen=True, slots=True)
class ClassReport:
    """Counts for one class."""

    class_iri: ClassIRI
    support: int
    """Objects with this target."""
    answered: int
    """Objects with this answer."""
    correct: int

    @property
    def precision(self) -> float | None:
        """Share of the answers with this class that are right; None if there are none."""
        return self.correct / self.answered if self.answered else None

    @property
    def recall(self) -> float | None:
        """Share of the objects with this target that have this answer; None if there are none."""
        return self.correct / self.support if self.support else None


def class_reports(scores: Sequence[Score]) -> tuple[ClassReport, ...]:
    """Return a report for each class that is a target or an answer, sorted by IRI."""
    support = Counter(score.target for score in scores)
    answered = Counter(score.answer for score in scores if score.answer is not None)
    correct = Counter(score.target for score in scores if score.is_exact)
    classes = sorted(support.keys() | answered.keys())
    return tuple(ClassReport(iri, support[iri], answered[iri], correct[iri]) for iri in classes)


def confusion(scores: Sequence[Score]) -> tuple[tuple[ClassIRI, ClassIRI | None, int], ...]:
    """Return (target, answer, count) of the wrong answers, most frequent first; a missing answer is None."""
    counts = Counter((score.target, score.answer) for score in scores if not score.is_exact)
    return tuple(
        (target, answer, count)
        for (target, answer), count in sorted(counts.items(), key=lambda i: (-i[1], i[0][0], i[0][1] or ""))
    )
