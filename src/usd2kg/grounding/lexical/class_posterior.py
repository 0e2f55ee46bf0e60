"""P(class | size, stance, place) of an object regardless of its name, by Bayes' rule over everyday objects.

    P(noun | evidence) ∝ P(noun | place) · p(size | noun) · P(stance | noun)

summed over the nouns of each class. The objects around and the names above indicate the kind of place.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.context.placement import Appearance
from usd2kg.grounding.lexical.concepts.places import (
    PLACES,
    Floats,
    log_stance_likelihoods,
    noun_priors,
    stance_of,
)
from usd2kg.grounding.lexical.concepts.sizes import everyday_nouns, size_log_likelihoods
from usd2kg.grounding.lexical.matching.head_matching import Match
from usd2kg.grounding.lexical.settings import PLACE
from usd2kg.ontology import ClassIRI

__all__ = [
    "NO_POSTERIOR",
    "ClassPosterior",
    "PosteriorModel",
    "log_likelihoods_of_appearance",
    "match_everyday_nouns",
    "neighbour_weights",
]

MatchName = Callable[[str, tuple[str, ...]], Sequence[Match]]
"""Returns the matches for a name and the names above it, best first."""


class ClassPosterior(NamedTuple):
    """The probabilities of classes for one object."""

    columns: Mapping[ClassIRI, int]
    """Class → its index in `probabilities`."""
    probabilities: Floats
    """(classes,)"""
    place: str | None
    """The kind of place of the object, if its probability exceeds that of all others together."""

    def probability(self, iri: ClassIRI) -> float:
        """Return the probability of a class; 0 for a class without everyday objects."""
        return float(self.probabilities[self.columns[iri]]) if iri in self.columns else 0.0

    def ranked(self) -> dict[ClassIRI, float]:
        """Return class → probability in descending order, ties by IRI."""
        order = np.argsort(-self.probabilities, kind="stable").tolist()
        classes, probabilities = list(self.columns), self.probabilities.tolist()
        return {classes[at]: probabilities[at] for at in order}


NO_POSTERIOR = ClassPosterior({}, np.empty(0), None)


def neighbour_weights(metres: npt.ArrayLike) -> Floats:
    """Return the weights of objects at these distances as evidence for the kind of place, same shape."""
    weights: Floats = PLACE.neighbour_weight * np.exp(-np.asarray(metres) / PLACE.reach)
    return weights


def log_likelihoods_of_appearance(seen: Appearance) -> Floats:
    """Return log P(size, stance | noun) for each everyday noun, natural logarithm, (nouns,)."""
    return size_log_likelihoods(seen.size) + log_stance_likelihoods(stance_of(seen))


def match_everyday_nouns(match: MatchName) -> list[ClassIRI | None]:
    """Return the class that each everyday noun matches best."""
    matches = (match(noun, ()) for noun in everyday_nouns())
    return [found[0].class_iri if found else None for found in matches]


class PosteriorModel:
    """Computes posteriors over the classes of one TBox that everyday nouns match."""

    def __init__(self, noun_classes: Sequence[ClassIRI | None]) -> None:
        """Index the classes.

        Args:
            noun_classes: the class of each everyday noun; None for a noun without one.
        """
        self._columns = {iri: column for column, iri in enumerate(sorted({iri for iri in noun_classes if iri}))}
        self._nouns = np.array([row for row, iri in enumerate(noun_classes) if iri], dtype=int)
        self._noun_columns = np.array([self._columns[iri] for iri in noun_classes if iri], dtype=int)

    def posterior(self, log_likelihoods: Floats, places: Floats) -> ClassPosterior:
        """Return the posterior of one object.

        Args:
            log_likelihoods: log P(size, stance | noun) for each noun, (nouns,).
            places: probability of each kind of place, (places,).
        """
        if not self._columns:
            return NO_POSTERIOR
        likely = np.exp(log_likelihoods - log_likelihoods.max()) * noun_priors(places)
        joint = np.bincount(self._noun_columns, likely[self._nouns], minlength=len(self._columns))
        likeliest = int(places.argmax())
        place = PLACES[likeliest] if places[likeliest] > PLACE.clear_probability else None
        return ClassPosterior(self._columns, joint / joint.sum(), place)
