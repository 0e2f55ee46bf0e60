"""find_copies: objects without a concept that have class and size of objects with one."""

from collections.abc import Set

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
    unnamed = [iri for iri in facts.things if facts.concept(iri) is None]
    if not unnamed or not members:
        return set()
    looks = {look for iri in members if (look := _look(facts, iri)) is not None}
    found = {iri: look for iri in unnamed if (look := _look(facts, iri)) in looks}
    if found:
        others = (iri for iri in facts.things if iri not in members and facts.concept(iri) is not None)
        looks -= {look for iri in others if (look := _look(facts, iri)) is not None}
    return {iri for iri, look in found.items() if look in looks}


def _look(facts: SceneFacts, iri: str) -> _Look | None:
    extents = facts.body(iri).extents
    if extents is None:
        return None
    return tuple(facts.classes(iri)), tuple(round(side, _DECIMALS) for side in extents)
