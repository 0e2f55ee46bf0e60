"""Two grounders in a row: the second is asked only where the first is unsure."""

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
    """What became of the objects."""

    sure: int = 0
    """Objects of which the first grounder was sure."""
    decided: int = 0
    """Those that the second one decided."""
    kept: int = 0
    """Those that the second one had no class for, so that the first one's stands."""
    first_s: float = 0.0
    second_s: float = 0.0
    """Seconds that each took."""


class CascadeGrounder:
    """Asks a second grounder about what the first is unsure of; nothing that is known is lost."""

    name = "cascade"
    is_calibrated = False

    def __init__(self, first: Grounder, second: Grounder, least_confidence: float) -> None:
        """Make the cascade.

        Args:
            first: the quick one, whose confidence means something.
            second: the dear one.
            least_confidence: from 0 to 1; below it an answer of the first is no answer.

        Raises:
            GroundingError: the confidence is no probability.
        """
        if not 0 <= least_confidence <= 1:
            raise GroundingError(f"a cascade at confidence {least_confidence}; expected a number from 0 to 1")
        self.first, self.second, self._least = first, second, least_confidence
        self.report = TierReport()

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that its answers depend on."""
        return {
            "first": self.first.name,
            "second": self.second.name,
            "least_confidence": f"{self._least:g}",
            **self.first.settings,
            **self.second.settings,
        }

    def unsure(self, predictions: Sequence[Prediction]) -> list[int]:
        """Return the places of the first one's answers that are no answers."""
        return [index for index, found in enumerate(predictions) if (found.confidence or 0.0) < self._least]

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view)."""
        start = time.perf_counter()
        predictions = self.first.ground_views(views, tbox)
        unsure = self.unsure(predictions)
        turn = time.perf_counter()
        second = self.second.ground_views([views[index] for index in unsure], tbox) if unsure else []
        self.report.first_s += turn - start
        self.report.second_s += time.perf_counter() - turn
        self.report.sure += len(views) - len(unsure)
        for index, found in zip(unsure, second, strict=True):
            if found.class_iri is not None:
                self.report.decided += 1
                predictions[index] = found
            else:
                self.report.kept += 1
                said = f"{predictions[index].explanation}; {found.grounder}: {found.explanation}"
                predictions[index] = replace(predictions[index], explanation=said)
        return predictions
