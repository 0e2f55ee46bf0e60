"""What grounding gives: a class for every object, with how sure it is and why."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property

from usd2kg.ontology import ClassIRI

__all__ = ["Candidate", "Grounding", "Prediction", "Review", "Status"]


class Status(StrEnum):
    """How a prediction came about; the kinds that are no answer stay apart."""

    GROUNDED = "grounded"
    """The evidence points at the class."""
    SUPERCLASS = "superclass"
    """The evidence does not decide between classes, so one above them was taken."""
    REFUSED = "refused"
    """The grounder declined to answer."""
    UNREADABLE = "unreadable"
    """The grounder answered, but with no class of the TBox."""
    FAILED = "failed"
    """The grounder could not be asked."""
    MISSING = "missing"
    """The prim that was asked for does not exist on the stage."""
    REVIEWED = "reviewed"
    """A person decided; `Prediction.review` keeps what was predicted."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A class that was considered."""

    class_iri: ClassIRI
    score: float
    """Higher is better; comparable within one prediction only."""


@dataclass(frozen=True, slots=True)
class Review:
    """A person's decision about an object, and what the grounder had said."""

    reviewer: str
    """Who decided: an IRI such as an ORCID's, or a name."""
    predicted_class: ClassIRI | None
    predicted_confidence: float | None
    predicted_status: Status
    comment: str = ""
    """The reviewer's reason, empty if none was given."""
    time: str = ""
    """When, as ISO 8601; empty if nobody said."""


@dataclass(frozen=True, slots=True)
class Prediction:
    """The class of one object."""

    prim_path: str
    class_iri: ClassIRI | None
    """None unless the status is grounded or superclass."""
    confidence: float | None
    """Probability that the class is right, from 0 to 1; None where there is no class, or nobody knows."""
    status: Status
    grounder: str
    """Id of the grounder that decided."""
    explanation: str
    """One sentence for a person."""
    evidence: tuple[str, ...] = ()
    """The evidence groups that decided."""
    candidates: tuple[Candidate, ...] = ()
    """All that was considered, best first, the chosen class included."""
    review: Review | None = None
    """A person's decision, which then is the class, status and confidence above; None if nobody decided."""
    decided_for: str = ""
    """The prim path that the person decided about, where the thing was renamed or moved since; else empty."""

    def reviewed(
        self,
        class_iri: ClassIRI | None,
        reviewer: str,
        *,
        confidence: float | None = None,
        comment: str = "",
        time: str = "",
    ) -> "Prediction":
        """Return the prediction with a person's decision in its place.

        Args:
            class_iri: the right class, maybe the predicted one; None if no class fits.
            reviewer: an IRI such as an ORCID's, or a name.
            confidence: how sure the person is, 0 to 1; None if they did not say.
            comment: the reason.
            time: when, as ISO 8601.
        """
        # A later decision stands beside what the grounder said, not beside the earlier one.
        before = self.review or Review("", self.class_iri, self.confidence, self.status)
        review = replace(before, reviewer=reviewer, comment=comment, time=time)
        return replace(self, class_iri=class_iri, confidence=confidence, status=Status.REVIEWED, review=review)


@dataclass(frozen=True)
class Grounding:
    """The predictions for one scene and one TBox, and what produced them."""

    scene: str
    """Source of the scene."""
    scene_hash: str
    ontology: str
    """IRI of the ontology."""
    ontology_hash: str
    grounder: str
    settings: Mapping[str, str]
    """Regime, evidence and the grounder's own settings, as text."""
    is_calibrated: bool
    """Whether confidences were fitted to be probabilities; otherwise they only rank."""
    tool_version: str
    predictions: tuple[Prediction, ...] = field(default=())
    """One for each object, in scene order."""

    @cached_property
    def by_path(self) -> Mapping[str, Prediction]:
        """Prim path → prediction."""
        return {prediction.prim_path: prediction for prediction in self.predictions}
