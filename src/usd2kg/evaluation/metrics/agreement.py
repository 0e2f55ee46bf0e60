"""How far two people agree on the same scene."""

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

from usd2kg.evaluation.gold import GoldLabel
from usd2kg.evaluation.metrics.hierarchical import hierarchical_one
from usd2kg.ontology import TBox

__all__ = ["Agreement", "agreement"]


class Agreement(NamedTuple):
    """Two gold files, compared on the prims that both label."""

    n: int
    """Prims that both label."""
    exact: float
    """Share of them with the same class."""
    kappa: float | None
    """Cohen's kappa; None where chance alone would agree on everything."""
    accepted: float
    """Share where either one's class is accepted by the other."""
    hierarchical_f1: float
    """Mean hierarchical F1 of one against the other; it is symmetric."""
    disagreements: tuple[tuple[GoldLabel, GoldLabel], ...]
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]


def agreement(first: Sequence[GoldLabel], second: Sequence[GoldLabel], tbox: TBox) -> Agreement:
    """Return how far two labellings agree.

    Raises:
        ValueError: they label no prim in common.
    """
    others = {label.prim_path: label for label in second}
    pairs = [(label, others[label.prim_path]) for label in first if label.prim_path in others]
    if not pairs:
        raise ValueError("the two files label no prim in common")
    n = len(pairs)
    exact = sum(a.target == b.target for a, b in pairs) / n
    here, there = Counter(a.target for a, _ in pairs), Counter(b.target for _, b in pairs)
    by_chance = sum(here[iri] * there[iri] for iri in here) / n**2
    paths = {label.prim_path for label in first}
    return Agreement(
        n=n,
        exact=exact,
        # Cohen, A Coefficient of Agreement for Nominal Scales (1960).
        kappa=(exact - by_chance) / (1 - by_chance) if by_chance < 1 else None,
        accepted=sum(a.target in {b.target, *b.also} or b.target in a.also for a, b in pairs) / n,
        hierarchical_f1=sum(hierarchical_one(a.target, b.target, tbox).f1 for a, b in pairs) / n,
        disagreements=tuple((a, b) for a, b in pairs if a.target != b.target),
        only_first=tuple(sorted(paths - others.keys())),
        only_second=tuple(sorted(others.keys() - paths)),
    )
