"""UnnamedCopies: objects without the concept of a thing that have class and size of objects with one."""

from collections.abc import Set
from functools import cache, cached_property

import numpy as np

from usd2kg.grounding import hypernyms_of
from usd2kg.query.lookup.facts import SceneFacts

__all__ = ["UnnamedCopies"]

_DECIMALS = 3
"""Of metres: copies of an asset have the same extents to a millimetre."""

_Look = tuple[tuple[str, ...], tuple[float, ...]]


class UnnamedCopies:
    """Finds copies in one graph."""

    def __init__(self, facts: SceneFacts) -> None:
        self._facts = facts

    def find(self, members: Set[str]) -> set[str]:
        """Return objects without a concept that look like a member: `ms_07` has the class and the size of `mouse_01`.

        A look that objects of another concept have as well is not taken into account.

        Args:
            members: objects with a concept.
        """
        facts = self._facts
        if not self._unnamed or not members:
            return set()
        looks = {look for iri in members if (look := _look(facts, iri)) is not None}
        found = {iri: look for iri in self._unnamed if (look := _look(facts, iri)) in looks}
        if found:
            others = (iri for iri in facts.things if iri not in members and iri not in self._unnamed)
            looks -= {look for iri in others if (look := _look(facts, iri)) is not None}
        return {iri for iri, look in found.items() if look in looks}

    @cached_property
    def _unnamed(self) -> dict[str, None]:
        """The objects without a concept, or with one that is no thing: `mon_L` is not the language Mon."""
        columns = self._facts.columns
        rows, first = np.unique(columns.of_concept.pairs[:, 0], return_index=True)
        concepts = columns.of_concept.pairs[first, 1]
        used, number = np.unique(concepts, return_inverse=True)
        is_abstract = [_is_abstract(self._facts.label_of(columns.kinds[kind])) for kind in used.tolist()]
        is_named = np.zeros(len(columns.iris), np.bool_)
        is_named[rows] = ~np.array(is_abstract, np.bool_)[number]
        named = {columns.iris[row] for row in np.flatnonzero(is_named).tolist()}
        return {iri: None for iri in self._facts.things if iri not in named}


@cache
def _is_abstract(noun: str) -> bool:
    above = hypernyms_of(noun)
    return "abstraction" in above and "physical entity" not in above


def _look(facts: SceneFacts, iri: str) -> _Look | None:
    extents = facts.body(iri).extents
    if extents is None:
        return None
    return tuple(facts.classes(iri)), tuple(round(side, _DECIMALS) for side in extents)
