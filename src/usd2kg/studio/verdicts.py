"""Verdicts, changes and events: what reviewers decide, as immutable records."""

from dataclasses import dataclass
from enum import StrEnum

from usd2kg.ontology import ClassIRI

__all__ = ["OPEN", "Action", "Event", "Suggestion", "Verdict", "VerdictChange", "VerdictKind"]


class VerdictKind(StrEnum):
    """What a person said about an object."""

    OPEN = "open"
    """Nothing: not decided yet, or the decision was taken back."""
    CLASS = "class"
    """It has this class."""
    NO_CLASS = "no-class"
    """No class of the ontology fits."""
    UNSURE = "unsure"
    """The person cannot tell; somebody else should look."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """The current judgement on one object."""

    kind: VerdictKind
    class_iri: ClassIRI | None = None
    """For the kind `class`; None otherwise."""
    reviewer: str = ""
    """Who judged; empty if open."""
    time: str = ""
    """When, as ISO 8601 in UTC; empty if open."""
    comment: str = ""
    event: int = 0
    """Number of the event that set it; 0 if none did."""
    proposal: str = ""
    """For the kind `class`, the label of a subclass that the person proposes for it; empty without one."""

    def agrees(self, other: "Verdict") -> bool:
        """Return whether two verdicts say the same, whoever gave them."""
        return (self.kind, self.class_iri) == (other.kind, other.class_iri)


OPEN = Verdict(VerdictKind.OPEN)


class Action(StrEnum):
    """What a reviewer did."""

    DECIDE = "decide"
    UNDO = "undo"
    REDO = "redo"


@dataclass(frozen=True, slots=True)
class Suggestion:
    """What a grounder had suggested when a person decided."""

    class_iri: ClassIRI | None
    """None if it said that no class fits."""
    confidence: float | None
    """Probability that it is right; None if the grounder gave none."""


@dataclass(frozen=True, slots=True)
class VerdictChange:
    """The verdict that an event sets for one object."""

    prim_path: str
    verdict: Verdict
    suggested: Suggestion | None = None
    """For `decide`; None if the grounder gave no answer."""


@dataclass(frozen=True, slots=True)
class Event:
    """One act of a reviewer, which concerns one or more objects."""

    number: int
    """1 for the first event of a journal."""
    action: Action
    reviewer: str
    time: str
    """ISO 8601 in UTC."""
    changes: tuple[VerdictChange, ...]
    seen: int
    """Number of the last event that the reviewer had seen."""
    reverts: int = 0
    """For `undo` and `redo`, the number of the decision that is taken back or made again; else 0."""
    concept: str = ""
    """IRI of the concept, if the reviewer decided that all its objects have the class; empty otherwise."""
    is_audit: bool = False
    """Whether the objects were drawn at random, to measure how often suggestions are right."""
