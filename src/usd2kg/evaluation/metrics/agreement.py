"""Agreement of two annotators on the same scene."""

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

from usd2kg.evaluation.gold import GoldLabel
from usd2kg.evaluation.metrics.hierarchical import hierarchical_score
from usd2kg.ontology import TBox

__all__ = ["Agreement", "agreement"]


class Agreement(NamedTuple):
    """Agreement on the prims that both annotators labelled."""

    n: int
    """Number of prims that both annotators labelled."""
    exact: float
    """Share with the same class."""
    kappa: float | None
    """Cohen's kappa; None if the expected chance agreement is 1."""
    accepted: float
    """Share where the class of either annotator is the target or a second label of the other."""
    hierarchical_f1: float
    """Mean hierarchical F1 between the two classes, which is symmetric."""
    disagreements: tuple[tuple[GoldLabel, GoldLabel], ...]
    only_first: tuple[str, ...]
    """Prims that only the first annotator labelled, sorted."""
    only_second: tuple[str, ...]


def agreement(first: Sequence[GoldLabel], second: Sequence[GoldLabel], tbox: TBox) -> Agreement:
    """Return the agreement of two lists of labels.

    Raises:
        ValueError: they have no prim in common.
    """
    by_path = {label.prim_path: label for label in second}
    pairs = [(label, by_path[label.prim_path]) for label in first if label.prim_path in by_path]
    if not pairs:
        raise ValueError("the two files label no prim in common")
    n = len(pairs)
    exact = sum(a.target == b.target for a, b in pairs) / n
    paths = {label.prim_path for label in first}
    return Agreement(
        n=n,
        exact=exact,
        kappa=_kappa(exact, pairs),
        accepted=sum(a.target in {b.target, *b.also} or b.target in a.also for a, b in pairs) / n,
        hierarchical_f1=sum(hierarchical_score(a.target, b.target, tbox).f1 for a, b in pairs) / n,
        disagreements=tuple((a, b) for a, b in pairs if a.target != b.target),
        only_first=tuple(sorted(paths - by_path.keys())),
        only_second=tuple(sorted(by_path.keys() - paths)),
    )


def _kappa(exact: float, pairs: Sequence[tuple[GoldLabel, GoldLabel]]) -> float | None:
    """Return Cohen's kappa (Cohen 1960, A Coefficient of Agreement for Nominal Scales)."""
    first, second = Counter(a.target for a, _ in pairs), Counter(b.target for _, b in pairs)
    by_chance = sum(count * second[iri] for iri, count in first.items()) / len(pairs) ** 2
    return (exact - by_chance) / (1 - by_chance) if by_chance < 1 else None
