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
        """The settings that its answers depend on, as text."""
        ...

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view), in order.

        The path is the key to answer under and no evidence: under a naming regime it would give the name
        away. What is learnt from one view must not tell what another is; how the answers to all look may be heard in
        their confidence.
        """
        ...
