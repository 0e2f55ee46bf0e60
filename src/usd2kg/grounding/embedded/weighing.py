"""Weighing what the words, the company and the size of an object say against each other."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import NamedTuple

from usd2kg.ontology import ClassIRI

__all__ = ["Finding", "weigh"]

_COMPANY = 0.8
"""How far the company is trusted to tell the class, as a share of what the name would be."""
_WORDS_FLOOR, _COMPANY_FLOOR, _COMPANY_POWER = 0.02, 0.01, 0.7
_SIZE_FLOOR, _NO_SIZE = 0.05, 0.3
_SIZE_POWER, _SIZE_POWER_ALONE = 0.2, 0.45
"""How far the size is heard beside a company, whose votes heed it already, and without one."""
_SIZE_TRUST = 0.3
_SUITED = 3
"""The classes that are considered for their size alone."""
_SHARE_FLOOR = 0.3


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
    by_size: Mapping[ClassIRI, tuple[float, float]],
    explain_size: Callable[[ClassIRI], str],
    *,
    is_masked: bool,
    has_company: bool,
) -> list[Finding]:
    """Return the findings of words that are not clear by themselves, of the company and of the size together.

    A product of experts (Hinton, 2002), each with a floor below which it rules nothing out and a power for how
    far it is heard.

    Args:
        words: what the words say, whether spelled out or abbreviated.
        company: what the company says, each class once.
        by_size: class → (likelihood of the size, probability of the class), the most probable first.
        explain_size: gives the sentence for a class that the size alone speaks for.
        is_masked: whether the name is not the authored one.
        has_company: whether the company's votes heed the size.
    """
    by_words, by_company = _best_by_class(words), _best_by_class(company)
    weighed: dict[ClassIRI, tuple[float, Finding]] = {}
    best_said = max((finding.score for finding in words), default=0.0)
    # The more a name says, the less is asked of the company; what an abbreviation seems to say is often wrong.
    power = _COMPANY_POWER * (1 - (0.0 if is_masked else best_said))
    size_power = _SIZE_POWER if has_company else _SIZE_POWER_ALONE
    for iri in dict.fromkeys([*by_words, *by_company, *islice(by_size, _SUITED)]):
        said, seen = by_words.get(iri), by_company.get(iri)
        fit, share = by_size.get(iri, (_NO_SIZE, 0.0))
        heard = ((seen.score if seen else 0.0) + _COMPANY_FLOOR * (_SHARE_FLOOR + share)) ** power
        weight = ((said.score if said else 0.0) + _WORDS_FLOOR) * heard * (fit + _SIZE_FLOOR) ** size_power
        experts = [found for found in (said, seen) if found is not None]
        if experts:
            weighed[iri] = weight, max(experts, key=lambda found: found.score)
        else:
            weighed[iri] = weight, Finding("geometry", iri, share, partial(explain_size, iri))
    total = sum(weight for weight, _ in weighed.values())
    trust = max(best_said, _COMPANY * sum(finding.score for finding in company), _SIZE_TRUST if by_size else 0.0)
    findings = [
        Finding(finding.group, iri, weight / total * trust, finding.explain)
        for iri, (weight, finding) in weighed.items()
    ]
    return sorted(findings, key=lambda finding: (-finding.score, finding.class_iri))


def _best_by_class(findings: Sequence[Finding]) -> dict[ClassIRI, Finding]:
    best: dict[ClassIRI, Finding] = {}
    for finding in findings:
        known = best.get(finding.class_iri)
        if known is None or known.score < finding.score:
            best[finding.class_iri] = finding
    return best
