"""vote: the majority class over the samples of an answer, with its share of the votes as confidence.

This is self-consistency (Wang et al., 2023).
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from usd2kg.grounding.llm.answers import ParsedAnswer
from usd2kg.grounding.model import Candidate
from usd2kg.ontology import ClassIRI

__all__ = ["ScoredAnswer", "vote"]


@dataclass(frozen=True, slots=True)
class ScoredAnswer:
    """An answer with its confidence."""

    answer: ParsedAnswer
    confidence: float | None
    """From 0 to 1; None if unknown."""
    candidates: tuple[Candidate, ...] = ()
    """The classes that the samples name with their shares, largest first; empty for a single sample."""


def vote(samples: Sequence[ScoredAnswer]) -> ScoredAnswer:
    """Return the answer with the majority class, the first such class on a tie.

    Samples without a class count in the denominator of the shares. If no sample has a class, return the first one.
    """
    if len(samples) == 1:
        return samples[0]
    votes: Counter[ClassIRI] = Counter(iri for sample in samples if (iri := sample.answer.class_iri) is not None)
    if not votes:
        return samples[0]
    shares = {iri: count / len(samples) for iri, count in votes.most_common()}
    chosen = next(iter(shares))
    answer = next(sample.answer for sample in samples if sample.answer.class_iri == chosen)
    return ScoredAnswer(answer, shares[chosen], tuple(Candidate(iri, share) for iri, share in shares.items()))
