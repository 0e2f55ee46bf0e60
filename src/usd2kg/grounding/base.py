"""The interface that every grounder implements."""

from collections.abc import Mapping, Sequence
from typing import Protocol

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Prediction
from usd2kg.ontology import TBox

__all__ = ["Grounder"]


class Grounder(Protocol):
    """Chooses a class of a TBox for each object view."""

    name: str
    """Stable id: `dictionary`, `lexical`…"""
    is_calibrated: bool
    """Whether its confidences are fitted probabilities."""

    @property
    def settings(self) -> Mapping[str, str]:
        """Return the settings that affect its predictions, as text."""
        ...

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view), in order.

        The prim path identifies the prediction and is not evidence: it would reveal the name that a naming regime
        masks. The class of a view must not depend on the other views; its confidence may.
        """
        ...
