"""Several answers about one object: the class that most of them name, and how many do.

Self-consistency (Wang et al., 2023): the share of samples that agree is the confidence.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from usd2kg.grounding.llm.answers import Answer
from usd2kg.grounding.model import Candidate
from usd2kg.ontology import ClassIRI

__all__ = ["ScoredAnswer", "vote"]


@dataclass(frozen=True, slots=True)
class ScoredAnswer:
    """What came back about one object."""

    answer: Answer
    confidence: float | None
    """From 0 to 1; None where nobody knows."""
    candidates: tuple[Candidate, ...] = ()
    """The classes that samples named, with their shares, most first; empty for a single sample."""


def vote(replies: Sequence[ScoredAnswer]) -> ScoredAnswer:
    """Return the reply that stands for all samples: of equally many votes the class that was named first.

    Samples that name no class count as votes for none of them; where all do, the first one stands.
    """
    if len(replies) == 1:
        return replies[0]
    votes: Counter[ClassIRI] = Counter(iri for reply in replies if (iri := reply.answer.class_iri) is not None)
    if not votes:
        return replies[0]
    shares = {iri: count / len(replies) for iri, count in votes.most_common()}
    chosen = next(iter(shares))
    answer = next(reply.answer for reply in replies if reply.answer.class_iri == chosen)
    return ScoredAnswer(answer, shares[chosen], tuple(Candidate(iri, share) for iri, share in shares.items()))
