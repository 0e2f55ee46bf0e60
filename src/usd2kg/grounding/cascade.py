"""CascadeGrounder: a second grounder for the objects that the first is uncertain about."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from usd2kg.errors import GroundingError
from usd2kg.grounding.base import Grounder
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Prediction
from usd2kg.ontology import TBox

__all__ = ["CascadeGrounder", "TierReport"]


@dataclass(slots=True)
class TierReport:
    """Number of objects and duration of each tier."""

    sure: int = 0
    """Objects that the first grounder decided with enough confidence."""
    decided: int = 0
    """Objects that the second grounder decided."""
    kept: int = 0
    """Objects for which the second grounder found no class, so the first prediction stands."""
    first_s: float = 0.0
    """Seconds that the first grounder took."""
    second_s: float = 0.0
    """Seconds that the second grounder took."""


class CascadeGrounder:
    """Grounds with one grounder, and with a second where the confidence of the first is low."""

    name = "cascade"
    is_calibrated = False

    def __init__(self, first: Grounder, second: Grounder, min_confidence: float) -> None:
        """Create a cascade.

        Args:
            first: a fast grounder, whose confidence should be calibrated.
            second: an expensive grounder.
            min_confidence: from 0 to 1; predictions of `first` below it go to `second`.

        Raises:
            GroundingError: `min_confidence` is not between 0 and 1.
        """
        if not 0 <= min_confidence <= 1:
            raise GroundingError(f"a cascade at confidence {min_confidence}; expected a number from 0 to 1")
        self.first, self.second, self._min_confidence = first, second, min_confidence
        self.report = TierReport()

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that affect its predictions, those of both grounders included."""
        return {
            "first": self.first.name,
            "second": self.second.name,
            "min_confidence": f"{self._min_confidence:g}",
            **self.first.settings,
            **self.second.settings,
        }

    def find_uncertain(self, predictions: Sequence[Prediction]) -> list[int]:
        """Return the indices of predictions without a class or below the required confidence."""
        return [index for index, p in enumerate(predictions) if (p.confidence or 0.0) < self._min_confidence]

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view)."""
        start = time.perf_counter()
        predictions = self.first.ground_views(views, tbox)
        uncertain = self.find_uncertain(predictions)
        handover = time.perf_counter()
        second = self.second.ground_views([views[index] for index in uncertain], tbox) if uncertain else []
        self.report.first_s += handover - start
        self.report.second_s += time.perf_counter() - handover
        self.report.sure += len(views) - len(uncertain)
        for index, prediction in zip(uncertain, second, strict=True):
            predictions[index] = self._combine(predictions[index], prediction)
        return predictions

    def _combine(self, first: Prediction, second: Prediction) -> Prediction:
        """Return the second prediction, or the first if the second has no class."""
        if second.class_iri is not None:
            self.report.decided += 1
            return second
        self.report.kept += 1
        return replace(first, explanation=f"{first.explanation}; {second.grounder}: {second.explanation}")
