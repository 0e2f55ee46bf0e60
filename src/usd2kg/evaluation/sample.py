"""What is scored: one object with its true class and the answer that was given."""

from collections.abc import Iterable
from dataclasses import dataclass

from usd2kg.evaluation.gold import GoldLabel
from usd2kg.grounding import Grounding, Status
from usd2kg.ontology import ClassIRI
from usd2kg.words import words_of

__all__ = ["Score", "distinct_name", "join_scores"]


@dataclass(frozen=True, slots=True)
class Score:
    """One object's target and answer; every measure is a function of a list of these."""

    id: str
    """The prim path."""
    name: str
    """The authored name, whatever the regime showed."""
    target: ClassIRI
    also: frozenset[ClassIRI]
    answer: ClassIRI | None
    """None where there was no answer: it counts as wrong."""
    confidence: float | None
    status: Status
    explanation: str

    @property
    def is_exact(self) -> bool:
        """Whether the answer is the target."""
        return self.answer == self.target

    @property
    def is_accepted(self) -> bool:
        """Whether the answer is the target or one of the classes accepted beside it."""
        return self.answer is not None and (self.answer == self.target or self.answer in self.also)


def distinct_name(name: str) -> str:
    """Return what a name shares with the names of copies: its words, without numbers and pipeline tokens.

    >>> distinct_name("SM_CupCBlue_01") == distinct_name("CupCBlue_7")
    True
    """
    return " ".join(words_of(name)) or name


def join_scores(gold: Iterable[GoldLabel], grounding: Grounding) -> tuple[Score, ...]:
    """Return a score for each gold label, in its order; a prim that was not answered for stays, without answer."""
    return tuple(_score(label, grounding) for label in gold)


def _score(label: GoldLabel, grounding: Grounding) -> Score:
    found = grounding.by_path.get(label.prim_path)
    return Score(
        id=label.prim_path,
        name=label.prim_path.rpartition("/")[2],
        target=label.target,
        also=label.also,
        answer=found.class_iri if found else None,
        confidence=found.confidence if found else None,
        status=found.status if found else Status.MISSING,
        explanation=found.explanation if found else "it was not asked for",
    )
