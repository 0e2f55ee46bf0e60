"""What grounding gives: a class for every object, with how sure it is and why."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property

from usd2kg.ontology import ClassIRI

__all__ = ["Candidate", "Grounding", "Prediction", "Status"]


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


@dataclass(frozen=True, slots=True)
class Candidate:
    """A class that was considered."""

    class_iri: ClassIRI
    score: float
    """Higher is better; comparable within one prediction only."""


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
