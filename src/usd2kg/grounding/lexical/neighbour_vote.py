"""Classes that the neighbours of an object suggest.

Each neighbour whose own name is clear votes for its class. The weight of a vote is a kernel over size and position in
the tree (Nadaraya and Watson, 1964): closer and more similar in size means heavier.
"""

import math
from collections.abc import Iterable, Sequence
from itertools import islice
from typing import Generic, NamedTuple, TypeVar

from usd2kg.grounding.context.neighbours import SAME_SIZE, Nearness, Neighbour
from usd2kg.grounding.lexical.matching.head_matching import Match
from usd2kg.grounding.lexical.settings import VOTE
from usd2kg.ontology import ClassIRI

__all__ = ["Vote", "VoteCount", "count_votes", "siblings_as_neighbours", "vote_of"]

_WEIGHTS = {
    Nearness.NEXT: VOTE.next_weight,
    Nearness.SIBLING: VOTE.sibling_weight,
    Nearness.SAME_SIZE: VOTE.same_size_weight,
    Nearness.SIMILAR_SIZE: VOTE.similar_size_weight,
}

V = TypeVar("V")
Voter = tuple["Vote", Nearness, float | None, V]
"""A vote, how near and how similar in size the neighbour is, and an identifier of the neighbour."""


class Vote(NamedTuple):
    """The class of one neighbour."""

    class_iri: ClassIRI
    score: float


class VoteCount(NamedTuple, Generic[V]):
    """The votes of all neighbours."""

    shares: dict[ClassIRI, float]
    """Class → its share; the shares add up to less than 1, the rest is the share of the prior."""
    heaviest: dict[ClassIRI, Voter[V]]
    """Class → the voter with the largest weight."""


def siblings_as_neighbours(names: Iterable[str], parents: tuple[str, ...]) -> list[Neighbour]:
    """Return at most 48 siblings as neighbours known by name only, which is all that the study shows."""
    return [Neighbour(name, parents, Nearness.SIBLING, None) for name in islice(names, VOTE.max_siblings)]


def vote_of(matches: Sequence[Match]) -> Vote | None:
    """Return the vote of a neighbour from the matches of its name, best first; None if the name is ambiguous."""
    if not matches or matches[0].score < VOTE.min_score:
        return None
    return Vote(matches[0].class_iri, matches[0].score)


def count_votes(voters: Iterable[Voter[V]]) -> VoteCount[V]:
    """Return the share of each class among the votes."""
    totals: dict[ClassIRI, float] = {}
    heaviest: dict[ClassIRI, tuple[float, Voter[V]]] = {}
    for voter in voters:
        (iri, score), nearness, distance, _ = voter
        weight = _weigh(nearness, distance) * score
        totals[iri] = totals.get(iri, 0.0) + weight
        if iri not in heaviest or heaviest[iri][0] < weight:
            heaviest[iri] = (weight, voter)
    whole = sum(totals.values()) + VOTE.prior_weight
    shares = {iri: total / whole for iri, total in totals.items()}
    return VoteCount(shares, {iri: voter for iri, (_, voter) in heaviest.items()})


def _weigh(nearness: Nearness, distance: float | None) -> float:
    weight = _WEIGHTS[nearness]
    if distance is None:
        return weight * VOTE.unknown_size_factor
    if distance < SAME_SIZE:
        return weight * VOTE.copy_factor
    return weight * math.exp(-0.5 * (distance / VOTE.size_spread) ** 2)
