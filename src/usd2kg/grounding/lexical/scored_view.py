"""The answer for one object before its confidence is calibrated."""

from typing import NamedTuple

from usd2kg.grounding.lexical.class_posterior import ClassPosterior
from usd2kg.grounding.model import Prediction

__all__ = ["ScoredView"]


class ScoredView(NamedTuple):
    """A prediction with the features for its confidence."""

    prediction: Prediction
    """With an uncalibrated score as confidence."""
    posterior: ClassPosterior
    """By the appearance of the object."""
    is_listed: bool = False
    """Whether a list of class members decided: shipped, by a language model or by a person."""
    unknown_share: float = 0.0
    """Share of the words of the name, as it was read, that are not known; 0 for a name without words."""
