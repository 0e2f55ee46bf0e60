"""Weighing what the words, the company and the size and place of an object say against each other."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import NamedTuple

from usd2kg.ontology import ClassIRI

__all__ = ["Finding", "weigh"]

_WORDS_FLOOR, _SEEN_FLOOR, _BELIEF_FLOOR = 0.02, 0.01, 0.04
"""What each kind of evidence gives a class that it does not speak for: it rules nothing out."""
_BELIEF_POWER = 0.5
"""How far the beliefs are heard of what the company speaks for, whose votes heed the size already."""
_TOLD = 0.3
"""A score that says something, if not enough."""
_SUITED = 8
"""The classes that are considered for the beliefs alone."""
_MOST = 8
"""The classes that are told."""
_COMPANY_TRUST, _BELIEF_TRUST = 0.8, 0.5
"""How far the company and the beliefs are trusted to tell the class, as a share of what the name would be."""


class Finding(NamedTuple):
    """A class that one kind of evidence speaks for."""

    group: str
    """The evidence group."""
    class_iri: ClassIRI
    score: float
    explain: Callable[[], str]
    """Gives one sentence for a person: of most findings nobody asks for it."""


def weigh(
    words: Sequence[Finding],
    company: Sequence[Finding],
    beliefs: Mapping[ClassIRI, float],
    explain_belief: Callable[[ClassIRI], str],
    *,
    is_masked: bool,
) -> list[Finding]:
    """Return what words that are not clear by themselves, the company and the beliefs say together, the best first.

    An object is of a kind with its company, or a thing of its own, which the beliefs tell: a mixture. That and the
    words are a product of experts (Hinton, 2002), each with a floor below which it rules nothing out:

        (words + 0.02) · (company · (belief + 0.04)^½ + (1 - Σ company) · belief + 0.01)^power

    Args:
        words: what the words say, whether spelled out or abbreviated.
        company: what the company says, each class once; the scores add up to 1 at most.
        beliefs: class → its probability by size and place, the greatest first.
        explain_belief: gives the sentence for a class that the beliefs speak for.
        is_masked: whether the name is not the authored one.
    """
    by_words, by_company = _best_by_class(words), _best_by_class(company)
    best_said = max((finding.score for finding in words), default=0.0)
    votes = sum(finding.score for finding in company)
    # The more a name says, the less is asked of the others; what an abbreviation seems to say is often wrong.
    power = 1 - (0.0 if is_masked else best_said)
    weighed: list[tuple[float, ClassIRI, float, float]] = []
    for iri in dict.fromkeys([*by_words, *by_company, *islice(beliefs, _SUITED)]):
        belief = beliefs.get(iri, 0.0)
        said = by_words[iri].score if iri in by_words else 0.0
        shared = by_company[iri].score * (belief + _BELIEF_FLOOR) ** _BELIEF_POWER if iri in by_company else 0.0
        own = (1 - votes) * belief
        weighed.append(((said + _WORDS_FLOOR) * (shared + own + _SEEN_FLOOR) ** power, iri, shared, own))
    total = sum([weight for weight, *_ in weighed])
    trust = max(best_said, _COMPANY_TRUST * votes, _BELIEF_TRUST if beliefs else 0.0)
    weighed.sort(key=lambda one: (-one[0], one[1]))
    found = []
    for weight, iri, shared, own in weighed[:_MOST]:
        said = by_words[iri].score if iri in by_words else 0.0
        # What the name says it has said, though the size may say so more clearly.
        if iri in by_words and (said >= max(shared, own) or (own >= shared and said >= _TOLD)):
            expert = by_words[iri]
        elif shared >= own and iri in by_company:
            expert = by_company[iri]
        else:
            expert = Finding("geometry", iri, own, partial(explain_belief, iri))
        found.append(expert._replace(score=weight / total * trust))
    return found


def _best_by_class(findings: Sequence[Finding]) -> dict[ClassIRI, Finding]:
    best: dict[ClassIRI, Finding] = {}
    for finding in findings:
        known = best.get(finding.class_iri)
        if known is None or known.score < finding.score:
            best[finding.class_iri] = finding
    return best
