"""Scores: the gold class of each object and the answer of the grounder."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from usd2kg.evaluation.gold import GoldLabel
from usd2kg.grounding import Grounding, Status
from usd2kg.ontology import ClassIRI
from usd2kg.words import words_of

__all__ = ["Score", "distinct_name", "drop_missed", "join_scores"]


@dataclass(frozen=True, slots=True)
class Score:
    """Target and answer of one object; every metric is a function of a list of these."""

    id: str
    """The prim path."""
    name: str
    """The authored name, even if the naming regime masked it."""
    target: ClassIRI
    also: frozenset[ClassIRI]
    """Second labels: further classes that count as right in the lenient metrics."""
    answer: ClassIRI | None
    """None if there is no answer, which counts as wrong."""
    confidence: float | None
    status: Status
    explanation: str

    @property
    def is_exact(self) -> bool:
        """Whether the answer is the target."""
        return self.answer == self.target

    @property
    def is_accepted(self) -> bool:
        """Whether the answer is the target or a second label."""
        return self.is_exact or self.answer in self.also


def distinct_name(name: str) -> str:
    """Return the words of a name, which copies of an object share, without numbers and pipeline tokens.

    >>> distinct_name("SM_CupCBlue_01") == distinct_name("CupCBlue_7")
    True
    """
    return " ".join(words_of(name)) or name


def join_scores(gold: Iterable[GoldLabel], grounding: Grounding) -> tuple[Score, ...]:
    """Return one score per gold label, in order; a prim without a prediction has a score without an answer."""
    return tuple(_score(label, grounding) for label in gold)


def drop_missed(scores: Iterable[Score], missed: Collection[str]) -> tuple[Score, ...]:
    """Return the scores without the answers for objects that the object selection missed, given by prim path."""
    return tuple(
        replace(score, answer=None, confidence=None, status=Status.MISSING, explanation="not selected as an object")
        if score.id in missed
        else score
        for score in scores
    )


def _score(label: GoldLabel, grounding: Grounding) -> Score:
    prediction = grounding.by_path.get(label.prim_path)
    return Score(
        id=label.prim_path,
        name=label.prim_path.rpartition("/")[2],
        target=label.target,
        also=label.also,
        answer=prediction.class_iri if prediction else None,
        confidence=prediction.confidence if prediction else None,
        status=prediction.status if prediction else Status.MISSING,
        explanation=prediction.explanation if prediction else "not among the predictions",
    )
