"""The answer for one object before its confidence is calibrated."""

from typing import NamedTuple

from usd2kg.grounding.lexical.class_posterior import ClassPosterior
from usd2kg.grounding.model import Prediction

__all__ = ["ScoredView"]


class ScoredView(NamedTuple):
    """A prediction, and what its confidence follows from."""

    prediction: Prediction
    """With an uncalibrated score as confidence."""
    posterior: ClassPosterior
    """By the appearance of the object."""
    is_listed: bool = False
    """Whether a list of what belongs to the class decided: a shipped one, a language model's or a person's."""
    unknown_share: float = 0.0
    """Share of the words of the name, as it was read, that are not known; 0 for a name without words."""
