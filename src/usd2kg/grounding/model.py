"""The result of grounding: a class for each object, with confidence, status and explanation."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property

from usd2kg.ontology import ClassIRI
from usd2kg.rich_display import RichDisplay

__all__ = ["PERSON", "Candidate", "Concept", "Decision", "Grounding", "Prediction", "Review", "Status", "reviewer_iri"]

_ORCID = re.compile(r"(?:(?:https?://)?orcid\.org/|orcid:)?(\d{4}-\d{4}-\d{4}-\d{3}[\dX])/?", re.ASCII | re.IGNORECASE)
PERSON = "person"
"""The grounder id of a decision about an object that was not grounded."""


class Status(StrEnum):
    """How a prediction came about. Each reason for having no class is a status."""

    GROUNDED = "grounded"
    """The evidence supports this class."""
    SUPERCLASS = "superclass"
    """The evidence determines no specific class: a superclass of the candidates, or the default class of the TBox."""
    REFUSED = "refused"
    """The grounder declined to answer."""
    UNREADABLE = "unreadable"
    """The answer names no class of the TBox."""
    FAILED = "failed"
    """The grounder could not run, for instance because a server is down."""
    MISSING = "missing"
    """The requested prim is not on the stage."""
    REVIEWED = "reviewed"
    """A person decided, perhaps that no class fits; `Prediction.review` holds what was predicted."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A class that the grounder considered."""

    class_iri: ClassIRI
    score: float
    """Higher is better. Scores are comparable only within one prediction."""


@dataclass(frozen=True, slots=True)
class Concept:
    """A sense of a noun, independent of any ontology."""

    iri: str
    """WordNet's IRI, or one of this project for a sense that WordNet lacks."""
    label: str
    """Its usual noun, with spaces."""
    broader: tuple[str, ...] = ()
    """IRIs of the direct hypernyms."""


def reviewer_iri(reviewer: str) -> str:
    """Return the IRI of an ORCID iD, written as such, as a CURIE or as an IRI; any other name is returned unchanged.

    >>> reviewer_iri("orcid:0000-0002-1825-0097"), reviewer_iri("Ada")
    ('https://orcid.org/0000-0002-1825-0097', 'Ada')
    """
    found = _ORCID.fullmatch(reviewer.strip())
    return f"https://orcid.org/{found[1].upper()}" if found else reviewer


@dataclass(frozen=True, slots=True)
class Decision:
    """The class that a person chose for an object; what was predicted is not part of it."""

    class_iri: ClassIRI | None
    """None if no class fits."""
    reviewer: str = ""
    """Who decided: an IRI such as an ORCID iD, or a name; empty if unknown."""
    comment: str = ""
    """The reason, empty if none was given."""
    time: str = ""
    """When, as ISO 8601; empty if unknown."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "reviewer", reviewer_iri(self.reviewer))


@dataclass(frozen=True, slots=True)
class Review:
    """A person's decision about an object, and what was predicted before."""

    reviewer: str
    """Who decided: an IRI such as an ORCID iD, or a name; empty if unknown."""
    predicted_class: ClassIRI | None
    predicted_confidence: float | None
    predicted_status: Status | None
    """None if nothing was predicted."""
    comment: str = ""
    """The reviewer's reason, empty if none was given."""
    time: str = ""
    """When, as ISO 8601; empty if unknown."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "reviewer", reviewer_iri(self.reviewer))


@dataclass(frozen=True, slots=True)
class Prediction:
    """The class of one object."""

    prim_path: str
    class_iri: ClassIRI | None
    """None unless the status is grounded, superclass or reviewed; a person may have decided that no class fits."""
    confidence: float | None
    """Probability from 0 to 1 that a person would choose the class, or that the object belongs to a superclass which
    replaces the best candidate; None if there is no class, or the grounder or the person gives none."""
    status: Status
    grounder: str
    """Id of the grounder that chose the class."""
    explanation: str
    """One sentence for the user."""
    evidence: tuple[str, ...] = ()
    """The evidence groups that the choice rests on."""
    candidates: tuple[Candidate, ...] = ()
    """The classes considered, best first. The chosen one need not be among them: it may be a superclass of theirs, or a
    person's choice."""
    review: Review | None = None
    """A person's decision, which sets class, status and confidence above; None if there is none."""
    decided_for: str = ""
    """The prim path of the decision if the object has been renamed or moved since; else empty."""
    words: tuple[str, ...] = ()
    """The words that the grounder read an abbreviated name as; empty if it spelled none out."""
    concept: str | None = None
    """IRI of the concept that the object's own words name, in `Grounding.concepts`; None if they name none."""
    concept_confidence: float | None = None
    """Probability that the concept is right, from 0 to 1, calibrated on names of objects in homes and workplaces."""

    @property
    def chosen_by(self) -> str:
        """Who chose the class: `PERSON`, or the id of the grounder."""
        return PERSON if self.status is Status.REVIEWED else self.grounder

    def reviewed(
        self,
        class_iri: ClassIRI | None,
        reviewer: str,
        *,
        confidence: float | None = None,
        comment: str = "",
        time: str = "",
    ) -> "Prediction":
        """Return a copy of the prediction with a person's decision.

        Args:
            class_iri: the correct class, possibly the predicted one; None if no class fits.
            reviewer: an IRI such as an ORCID iD, or a name.
            confidence: the person's confidence from 0 to 1; None if not given.
            comment: the reason.
            time: when, as ISO 8601.
        """
        # A second decision keeps what the grounder predicted, not the first decision.
        before = self.review or Review("", self.class_iri, self.confidence, self.status)
        review = replace(before, reviewer=reviewer, comment=comment, time=time)
        return replace(self, class_iri=class_iri, confidence=confidence, status=Status.REVIEWED, review=review)


@dataclass(frozen=True)
class Grounding(RichDisplay):
    """The predictions for one scene and one TBox, with their provenance."""

    scene: str
    """`Scene.source`."""
    scene_hash: str
    ontology: str
    """IRI of the ontology."""
    ontology_hash: str
    grounder: str
    settings: Mapping[str, str]
    """Naming regime, evidence groups and the settings of the grounder, as text."""
    is_calibrated: bool
    """Whether confidences are fitted probabilities; otherwise they only rank."""
    tool_version: str
    predictions: tuple[Prediction, ...] = field(default=())
    """One for each object, in scene order."""
    concepts: Mapping[str, Concept] = field(default_factory=dict)
    """IRI → concept, for the concepts of the predictions and all their hypernyms."""

    @cached_property
    def by_path(self) -> Mapping[str, Prediction]:
        """Prim path → prediction."""
        return {prediction.prim_path: prediction for prediction in self.predictions}
