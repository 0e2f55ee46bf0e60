"""What the company of an object says of it: the classes of the things beside it and of those of its size.

Each named companion votes for the class its name points at (a kernel estimate, Nadaraya and Watson, 1964, over size
and place in the tree): the nearer in the tree and the more alike in size, the heavier the vote.
"""

import math
from collections.abc import Iterable, Sequence
from itertools import islice
from typing import Generic, NamedTuple, TypeVar

from usd2kg.grounding.context.neighbours import Companion, Nearness
from usd2kg.grounding.lexical.alignment.naming import Match
from usd2kg.ontology import ClassIRI

__all__ = ["Vote", "Votes", "ask_company", "siblings_as_company", "vote_of"]

_WEIGHTS = {Nearness.NEXT: 1.0, Nearness.SIBLING: 0.35, Nearness.TWIN: 0.6, Nearness.ALIKE: 0.12}
_TWIN_BONUS = 6.0
"""Companions of exactly the same size are most likely copies."""
_TWIN = 0.01
_SIZE_SPREAD = 0.2
"""How much the sizes of things of one class differ that stand together, as `size_distance`."""
_UNKNOWN_SIZE = 0.5
_MOST_SIBLINGS = 48
_CLEAREST = 0.5
"""A companion whose own name says less has no vote."""


C = TypeVar("C")
Voter = tuple["Vote", Nearness, float | None, C]
"""A vote, how near and how alike the companion is that gives it, and whatever stands for the companion."""


class Vote(NamedTuple):
    """What a companion's name says that it is."""

    class_iri: ClassIRI
    score: float


class Votes(NamedTuple, Generic[C]):
    """The votes of a company."""

    shares: dict[ClassIRI, float]
    """Class → its share; they add up to less than 1: the rest is that the company says nothing."""
    heaviest: dict[ClassIRI, Voter[C]]
    """Class → the companion that spoke for it with most weight."""


def siblings_as_company(names: Iterable[str], parents: tuple[str, ...]) -> list[Companion]:
    """Return siblings of which only the names are known, as the study shows them; at most 48."""
    return [Companion(name, parents, Nearness.SIBLING, None) for name in islice(names, _MOST_SIBLINGS)]


def vote_of(matches: Sequence[Match]) -> Vote | None:
    """Return the vote of a companion whose name has these matches, best first; None if it does not say enough."""
    if not matches or matches[0].score < _CLEAREST:
        return None
    return Vote(matches[0].class_iri, matches[0].score)


def ask_company(voters: Iterable[Voter[C]]) -> Votes[C]:
    """Return the votes of a company."""
    totals: dict[ClassIRI, float] = {}
    heaviest: dict[ClassIRI, tuple[float, Voter[C]]] = {}
    for voter in voters:
        (iri, score), nearness, distance, _ = voter
        weight = _weight(nearness, distance) * score
        totals[iri] = totals.get(iri, 0.0) + weight
        if iri not in heaviest or heaviest[iri][0] < weight:
            heaviest[iri] = (weight, voter)
    whole = sum(totals.values()) + 0.5
    shares = {iri: total / whole for iri, total in totals.items()}
    return Votes(shares, {iri: voter for iri, (_, voter) in heaviest.items()})


def _weight(nearness: Nearness, distance: float | None) -> float:
    weight = _WEIGHTS[nearness]
    if distance is None:
        return weight * _UNKNOWN_SIZE
    if distance < _TWIN:
        return weight * _TWIN_BONUS
    return weight * math.exp(-0.5 * (distance / _SIZE_SPREAD) ** 2)
