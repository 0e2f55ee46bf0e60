"""Combine the evidence of words, neighbours, and size and place into one score for each class."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import NamedTuple

from usd2kg.grounding.lexical.settings import COMBINATION
from usd2kg.ontology import ClassIRI

__all__ = ["CONTEXT_GROUPS", "ScoredClass", "combine_evidence"]

CONTEXT_GROUPS = frozenset({"neighbours", "geometry"})
"""Evidence groups of the context: other objects, or size and place."""


class ScoredClass(NamedTuple):
    """A class that one kind of evidence supports."""

    group: str
    """Kind of evidence: name, asset, labels, documentation, hierarchy, parts, neighbours or geometry."""
    class_iri: ClassIRI
    score: float
    explain: Callable[[], str]
    """Returns the explanation as one sentence; a function, since most explanations are never shown."""
    words: tuple[str, ...] = ()
    """The expansion of an abbreviated name; otherwise empty."""
    is_listed: bool = False
    """See `Match.is_listed`."""


def combine_evidence(
    by_words: Sequence[ScoredClass],
    by_neighbours: Sequence[ScoredClass],
    posterior: Mapping[ClassIRI, float],
    explain_posterior: Callable[[ClassIRI], str],
    *,
    is_masked: bool,
) -> list[ScoredClass]:
    """Return the classes with their scores by all evidence together, best first.

    A product of experts (Hinton, 2002) of the words and the context. The context is a mixture: the object is either of
    a neighbour's class or drawn from the posterior by size and place. Floors keep one expert from excluding a class:

        (words + word_floor) · (shared + (1 - Σ neighbours) · posterior + context_floor)^power
        shared = neighbours · (posterior + posterior_floor)^posterior_power

    with the settings `COMBINATION`. The power is 1 less the best score of the words: the more informative the words,
    the less the context counts.

    Args:
        by_words: the classes that words support, spelled out or abbreviated.
        by_neighbours: the classes of neighbours, each once; the scores add up to 1 at most.
        posterior: class → its probability given size and place, in descending order.
        explain_posterior: returns the sentence for a class that size and place support.
        is_masked: whether the naming regime masks the name; then the power is 1.
    """
    worded, neighboured = _best_by_class(by_words), _best_by_class(by_neighbours)
    best_word_score = max((found.score for found in by_words), default=0.0)
    neighbour_total = sum(found.score for found in by_neighbours)
    power = 1 - (0.0 if is_masked else best_word_score)
    weighted: list[tuple[float, ClassIRI, float, float]] = []
    for iri in dict.fromkeys([*worded, *neighboured, *islice(posterior, COMBINATION.max_posterior_classes)]):
        own = posterior.get(iri, 0.0)
        word_score = worded[iri].score if iri in worded else 0.0
        shared = 0.0
        if iri in neighboured:
            shared = neighboured[iri].score * (own + COMBINATION.posterior_floor) ** COMBINATION.posterior_power
        own *= 1 - neighbour_total
        context = (shared + own + COMBINATION.context_floor) ** power
        weighted.append(((word_score + COMBINATION.word_floor) * context, iri, shared, own))
    total = sum([weight for weight, *_ in weighted])
    trust = max(
        best_word_score,
        COMBINATION.neighbour_trust * neighbour_total,
        COMBINATION.posterior_trust if posterior else 0.0,
    )
    weighted.sort(key=lambda entry: (-entry[0], entry[1]))
    combined = []
    for weight, iri, shared, own in weighted[: COMBINATION.max_classes]:
        word_score = worded[iri].score if iri in worded else 0.0
        is_explained = own >= shared and word_score >= COMBINATION.explained_score
        if iri in worded and (word_score >= max(shared, own) or is_explained):
            expert = worded[iri]
        elif shared >= own and iri in neighboured:
            expert = neighboured[iri]
        else:
            expert = ScoredClass("geometry", iri, own, partial(explain_posterior, iri))
        combined.append(expert._replace(score=weight / total * trust))
    return combined


def _best_by_class(scored: Sequence[ScoredClass]) -> dict[ClassIRI, ScoredClass]:
    best: dict[ClassIRI, ScoredClass] = {}
    for found in scored:
        known = best.get(found.class_iri)
        if known is None or known.score < found.score:
            best[found.class_iri] = found
    return best
