"""Agreement of reviewers who decided about the same objects: Cohen's kappa."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

from usd2kg.studio.verdicts import Verdict, VerdictKind

__all__ = ["ReviewerAgreement", "find_agreement"]


@dataclass(frozen=True, slots=True)
class ReviewerAgreement:
    """How far two reviewers agree."""

    reviewers: tuple[str, str]
    objects: int
    """Objects about which both decided, whatever either had seen."""
    same: int
    """Those with the same last verdict."""
    kappa: float | None
    """Cohen's kappa, 1 for full agreement, 0 for that of chance; None if both gave all objects one verdict."""


def find_agreement(given: Mapping[str, Mapping[str, Verdict]]) -> list[ReviewerAgreement]:
    """Return the agreement of each pair of reviewers with an object in common, sorted by name.

    kappa = (po - pe) / (1 - pe), with po the share of equal verdicts and pe that expected from how often each reviewer
    gives each verdict (Cohen 1960).

    Args:
        given: prim path → reviewer → last verdict.
    """
    labels: dict[str, dict[str, str]] = {}
    for path, by_reviewer in given.items():
        for reviewer, verdict in by_reviewer.items():
            if verdict.kind is not VerdictKind.OPEN:
                labels.setdefault(reviewer, {})[path] = verdict.class_iri or verdict.kind.value
    found = []
    for one, other in combinations(sorted(labels), 2):
        pairs = [(label, labels[other][path]) for path, label in labels[one].items() if path in labels[other]]
        if pairs:
            found.append(_agreement((one, other), pairs))
    return found


def _agreement(reviewers: tuple[str, str], pairs: list[tuple[str, str]]) -> ReviewerAgreement:
    same = sum(one == other for one, other in pairs)
    first, second = (Counter(column) for column in zip(*pairs, strict=True))
    expected = sum(count * second[label] for label, count in first.items()) / len(pairs) ** 2
    kappa = None if expected == 1 else (same / len(pairs) - expected) / (1 - expected)
    return ReviewerAgreement(reviewers, len(pairs), same, kappa)
