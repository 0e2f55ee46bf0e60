"""find_copies: objects without the concept of a thing that have class and size of objects with one."""

from collections.abc import Set
from functools import cache

from usd2kg.grounding import hypernyms_of
from usd2kg.query.lookup.facts import SceneFacts

__all__ = ["find_copies"]

_DECIMALS = 3
"""Of metres: copies of an asset have the same extents to a millimetre."""

_Look = tuple[tuple[str, ...], tuple[float, ...]]


def find_copies(facts: SceneFacts, members: Set[str]) -> set[str]:
    """Return objects without a concept that look like a member: `ms_07` has the class and the size of `mouse_01`.

    A look that objects of another concept have as well is not taken into account.

    Args:
        facts: the graph.
        members: objects with a concept.
    """
    unnamed = [iri for iri in facts.things if _is_unnamed(facts, iri)]
    if not unnamed or not members:
        return set()
    looks = {look for iri in members if (look := _look(facts, iri)) is not None}
    found = {iri: look for iri in unnamed if (look := _look(facts, iri)) in looks}
    if found:
        others = (iri for iri in facts.things if iri not in members and not _is_unnamed(facts, iri))
        looks -= {look for iri in others if (look := _look(facts, iri)) is not None}
    return {iri for iri, look in found.items() if look in looks}


def _is_unnamed(facts: SceneFacts, iri: str) -> bool:
    """Return whether an object has no concept, or one that is no thing: `mon_L` is not the language Mon."""
    concept = facts.concept(iri)
    return concept is None or _is_abstract(facts.label_of(concept))


@cache
def _is_abstract(noun: str) -> bool:
    above = hypernyms_of(noun)
    return "abstraction" in above and "physical entity" not in above


def _look(facts: SceneFacts, iri: str) -> _Look | None:
    extents = facts.body(iri).extents
    if extents is None:
        return None
    return tuple(facts.classes(iri)), tuple(round(side, _DECIMALS) for side in extents)
