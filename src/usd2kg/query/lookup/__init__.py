"""Find the objects and kinds that people name, and what a graph states about them."""

from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.kinds import Kinds
from usd2kg.query.lookup.nouns import Nouns
from usd2kg.query.lookup.things import Things, UnknownWordError

__all__ = ["Kinds", "Nouns", "SceneFacts", "Things", "UnknownWordError"]
