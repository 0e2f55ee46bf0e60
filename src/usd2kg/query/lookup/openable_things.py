"""find_openable: what opens or moves, by the joints of the stage or by its kind."""

from typing import NamedTuple

from usd2kg.knowledge import word_set
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.nouns import Nouns
from usd2kg.query.lookup.related_things import find_parts

__all__ = ["Openable", "find_openable"]


class Openable(NamedTuple):
    """What opens or moves."""

    iris: frozenset[str]
    is_by_kind: bool
    """Whether some of it is known by its kind only."""


def find_openable(facts: SceneFacts, nouns: Nouns, verb: str) -> Openable:
    """Return what a joint moves, and what opens by its kind unless joints move most of that.

    Args:
        facts: the graph.
        nouns: finds the things of a kind.
        verb: what is done to it; to open or close a thing is not to turn the knob on it.
    """
    moved = facts.opened_by_joint & set(facts.things)
    closed = {iri for noun in word_set("assistant", "closed_things") for iri in nouns.of_kind(noun)}
    reached = {iri for iri in closed if iri in moved or not moved.isdisjoint(find_parts(facts, [iri]))}
    is_by_kind = 2 * len(reached) < len(closed)
    if verb in word_set("grammar", "opening_verbs"):
        controls = {iri for noun in word_set("assistant", "controls") for iri in nouns.of_kind(noun)}
        moved = ((closed & moved) | (find_parts(facts, closed) & moved)) - controls or moved
    return Openable(frozenset(moved | closed if is_by_kind else moved), is_by_kind)
