"""Answers: base of the classes that each answer some types of questions."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping

from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.thing_lists import ThingLists
from usd2kg.assistant.units import Units
from usd2kg.query.lookup import Nouns, SceneFacts
from usd2kg.query.lookup.body_measures import BodyMeasures

__all__ = ["Answers", "Handler"]

Handler = Callable[..., InterpretedAnswer]
"""Takes the parameters of a pattern as keywords."""


class Answers(ABC):
    """Answers to some types of questions about one graph."""

    def __init__(self, facts: SceneFacts, nouns: Nouns, units: Units) -> None:
        """Wrap the facts of a graph.

        Args:
            facts: the graph.
            nouns: resolves noun phrases to its objects.
            units: the unit that the question asks for.
        """
        self._facts = facts
        self._nouns = nouns
        self._units = units
        self._text = units.text
        self._bodies = BodyMeasures(facts)
        self._things = ThingLists(facts, nouns)

    @abstractmethod
    def _handlers(self) -> Mapping[str, Handler]:
        """Return question type → method. An attribute would be a reference cycle, which keeps the graph in memory."""

    def find(self, question: str) -> Handler | None:
        """Return the method that answers a question type; None if another class answers it."""
        return self._handlers().get(question)
