"""What an object is by its size, how it stands and what is around it, whatever it is called.

Bayes' rule over everyday things, whose usual sizes and whereabouts are known, and then over their classes:

    P(thing | evidence) ∝ P(thing | place) · p(size | thing) · P(how it stands | thing)

The kind of place is told by the things around the object and by the names of the prims above it.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.context.placement import Look
from usd2kg.grounding.lexical.alignment.naming import Match
from usd2kg.grounding.lexical.concepts.places import PLACES, Floats, log_stances, stance_of, thing_shares
from usd2kg.grounding.lexical.concepts.sizes import Size, likelihoods_of, thing_nouns
from usd2kg.ontology import ClassIRI

__all__ = ["NO_BELIEFS", "Beliefs", "Classify", "ThingBeliefs", "log_likelihoods_of_look", "neighbour_weights"]

_NEIGHBOUR, _REACH = 0.4, 4.0
"""What a thing right beside counts for the kind of place, and in how many metres that falls to its e-th part."""
_PLACE_IS_CLEAR = 0.5

Classify = Callable[[str, tuple[str, ...], Size | None], Sequence[Match]]
"""Gives the classes for a name, the names above it and the thing's size in metres, best first."""


class Beliefs(NamedTuple):
    """What one object is believed to be."""

    classes: Mapping[ClassIRI, int]
    """Class → its place in `probabilities`."""
    probabilities: Floats
    """(classes,): how probable each class is."""
    place: str | None
    """The kind of place it is in, where that is clear."""

    def probability(self, iri: ClassIRI) -> float:
        """Return how probable a class is; 0 for one that no everyday thing is of."""
        return float(self.probabilities[self.classes[iri]]) if iri in self.classes else 0.0

    def ranked(self) -> dict[ClassIRI, float]:
        """Return class → its probability, the greatest first, of equal ones the first by IRI."""
        order = np.argsort(-self.probabilities, kind="stable").tolist()
        classes, probabilities = list(self.classes), self.probabilities.tolist()
        return {classes[at]: probabilities[at] for at in order}


NO_BELIEFS = Beliefs({}, np.empty(0), None)


def neighbour_weights(metres: npt.ArrayLike) -> Floats:
    """Return what things at these distances count for the kind of place."""
    weights: Floats = _NEIGHBOUR * np.exp(-np.asarray(metres) / _REACH)
    return weights


def log_likelihoods_of_look(look: Look) -> Floats:
    """Return log P(what is seen of an object | thing) for each thing, natural logarithm, (things,)."""
    return likelihoods_of(look.size) + log_stances(stance_of(look))


class ThingBeliefs:
    """The beliefs about objects in one TBox, by what its classes' names say of everyday things."""

    def __init__(self, classify: Classify) -> None:
        matches = [classify(noun, (), None) for noun in thing_nouns()]
        classes = sorted({found[0].class_iri for found in matches if found})
        self.classes = {iri: column for column, iri in enumerate(classes)}
        self._rows = np.array([row for row, found in enumerate(matches) if found], dtype=int)
        self._columns = np.array([self.classes[found[0].class_iri] for found in matches if found], dtype=int)

    def ask(self, logs: Floats, places: Floats) -> Beliefs:
        """Return what an object is believed to be.

        Args:
            logs: log P(what is seen of it | thing) for each thing, (things,), see `log_likelihoods_of_look`.
            places: probability of each kind of place, (places,).
        """
        if not self.classes:
            return NO_BELIEFS
        likely = np.exp(logs - logs.max()) * thing_shares(places)
        joint = np.bincount(self._columns, likely[self._rows], minlength=len(self.classes))
        likeliest = int(places.argmax())
        place = PLACES[likeliest] if places[likeliest] > _PLACE_IS_CLEAR else None
        return Beliefs(self.classes, joint / joint.sum(), place)
