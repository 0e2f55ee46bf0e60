"""ObjectReview: what is known of an object's class, as the page shows it."""

from dataclasses import dataclass
from enum import StrEnum

from usd2kg.grounding import Prediction, Status
from usd2kg.ontology import ClassIRI
from usd2kg.studio.review_state import ReviewState
from usd2kg.studio.verdicts import Suggestion, Verdict, VerdictKind

__all__ = ["ObjectReview", "ReviewStatus", "state_of", "suggestion_of"]


class ReviewStatus(StrEnum):
    """How the class of an object came about; each way of having none is a status."""

    SUGGESTED = "suggested"
    CONFIRMED = "confirmed"
    """A person agreed with the suggestion."""
    CORRECTED = "corrected"
    """A person chose another class."""
    UNSURE = "unsure"
    NO_CLASS = "no-class"
    REFUSED = "refused"
    UNREADABLE = "unreadable"
    FAILED = "failed"

    @property
    def is_open(self) -> bool:
        """Whether a person still has to decide."""
        return self not in {ReviewStatus.CONFIRMED, ReviewStatus.CORRECTED, ReviewStatus.NO_CLASS}


_SUGGESTED = {
    Status.GROUNDED: ReviewStatus.SUGGESTED,
    Status.SUPERCLASS: ReviewStatus.SUGGESTED,
    Status.REFUSED: ReviewStatus.REFUSED,
    Status.UNREADABLE: ReviewStatus.UNREADABLE,
    Status.FAILED: ReviewStatus.FAILED,
    Status.MISSING: ReviewStatus.FAILED,
}


@dataclass(frozen=True, slots=True)
class ObjectReview:
    """The current class of an object, and what the grounder suggested."""

    prim_path: str
    status: ReviewStatus
    class_iri: ClassIRI | None
    """The current class; None if there is none."""
    prediction: Prediction
    """What the grounder suggested."""
    verdict: Verdict
    is_conflict: bool

    @property
    def confidence(self) -> float | None:
        """The confidence of the current class: 1 for a person's; None without a class."""
        if self.verdict.kind is VerdictKind.CLASS:
            return 1.0
        return None if self.class_iri is None else self.prediction.confidence


def state_of(prediction: Prediction, review: ReviewState) -> ObjectReview:
    """Return the state of the object of a prediction."""
    path = prediction.prim_path
    verdict = review.verdict(path)
    status, class_iri = _judge(prediction, verdict)
    return ObjectReview(path, status, class_iri, prediction, verdict, review.is_conflict(path))


def suggestion_of(prediction: Prediction) -> Suggestion | None:
    """Return what a prediction suggests; None if the call failed."""
    is_answer = prediction.status not in {Status.UNREADABLE, Status.FAILED, Status.MISSING}
    return Suggestion(prediction.class_iri, prediction.confidence) if is_answer else None


def _judge(prediction: Prediction, verdict: Verdict) -> tuple[ReviewStatus, ClassIRI | None]:
    suggested = prediction.class_iri
    match verdict.kind:
        case VerdictKind.CLASS:
            is_same = verdict.class_iri == suggested
            return ReviewStatus.CONFIRMED if is_same else ReviewStatus.CORRECTED, verdict.class_iri
        case VerdictKind.NO_CLASS:
            return ReviewStatus.NO_CLASS, None
        case VerdictKind.UNSURE:
            return ReviewStatus.UNSURE, suggested
    if prediction.status is Status.REVIEWED:
        # Decided before the project, by `--decisions` of the run.
        return ReviewStatus.NO_CLASS if suggested is None else ReviewStatus.CONFIRMED, suggested
    return _SUGGESTED[prediction.status], suggested
