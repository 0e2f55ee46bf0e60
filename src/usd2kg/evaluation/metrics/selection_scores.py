"""Recall and precision of object selection, independent of the classes."""

from collections.abc import Iterable
from typing import NamedTuple

__all__ = ["SelectionScore", "score_selection"]


class SelectionScore(NamedTuple):
    """Comparison of the selected prims with the labelled ones."""

    recall: float
    """Share of the labelled prims that were selected."""
    precision: float | None
    """Share of the selected prims that are labelled; None if nothing was selected."""
    missed: tuple[str, ...]
    """Labelled, not selected; sorted."""
    unlabelled: tuple[str, ...]
    """Selected, not labelled; sorted. If the gold labels are incomplete, these are not errors."""


def score_selection(selected: Iterable[str], labelled: Iterable[str]) -> SelectionScore:
    """Return the recall and precision of a selection of prim paths.

    Raises:
        ValueError: nothing is labelled.
    """
    chosen, gold = set(selected), set(labelled)
    if not gold:
        raise ValueError("the recall of no labels is undefined")
    common = len(chosen & gold)
    return SelectionScore(
        recall=common / len(gold),
        precision=common / len(chosen) if chosen else None,
        missed=tuple(sorted(gold - chosen)),
        unlabelled=tuple(sorted(chosen - gold)),
    )
