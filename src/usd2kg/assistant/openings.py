"""Answers about what is in the way of things that open."""

from collections.abc import Callable, Collection
from dataclasses import replace

from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_words, name_things, the_thing
from usd2kg.assistant.swept_space import find_in_the_way
from usd2kg.assistant.thing_lists import ThingLists
from usd2kg.errors import GraphError
from usd2kg.query import Answer, GraphStore
from usd2kg.query.answer import join_answers
from usd2kg.query.lookup import Nouns, Things
from usd2kg.query.lookup.related_things import find_related

__all__ = ["OpeningAnswers"]


class OpeningAnswers:
    """Answers about what has to be moved to open something."""

    def __init__(self, graph: GraphStore, nouns: Nouns) -> None:
        self._graph = graph
        self._facts = graph.facts
        self._nouns = nouns
        self._things = ThingLists(graph.facts, nouns)

    def find(self, question: str) -> Callable[..., InterpretedAnswer] | None:
        """Return the method that answers a question type; None if it is another's."""
        handlers: dict[str, Callable[..., InterpretedAnswer]] = {
            "is-blocked": self._is_blocked,
            "to-open": self._to_open,
            "to-open-from": self._to_open,
        }
        return handlers.get(question)

    def _to_open(self, thing: str, other: str = "") -> InterpretedAnswer:
        """Return what is in the way of a thing that opens: by its joint, else by the boxes in front of it."""
        things = self._nouns.existing(thing)
        carried = self._nouns.around("on", other, is_direct=False) if other else None
        found = join_answers([self._graph.answer("to-open", {"thing": self._facts.path(iri)}) for iri in things.iris])
        if found.rows or not self._facts.opened_by_joint.isdisjoint(things.iris):
            answer = found if carried is None else self._only(found, carried)
            rows = [dict(zip(answer.columns, row, strict=True)) for row in answer.rows]
            named = dict.fromkeys(the_thing(row["class"] or "", row["object"] or "") for row in rows)
            reason = "by boxes that move as far as the joints allow"
            sentence = self._obstructed(things, other, join_words([*named]), len(named), reason)
            return InterpretedAnswer(f"what must be moved to open {things.text}", answer, sentence=sentence)
        parts = find_related(self._facts, "part", things.iris, is_direct=True)
        swept = [find_in_the_way(self._facts, iri, parts) for iri in things.iris]
        if any(one is None for one in swept):
            raise GraphError(f"not known: the stage has no joint for {things.text}, so how it opens is unknown")
        chosen = self._facts.sorted({iri for one in swept for iri in one or () if carried is None or iri in carried})
        reason = "by boxes: the stage has no joint for it, and it may open to either side"
        sentence = self._obstructed(things, other, name_things(self._facts, chosen), len(chosen), reason)
        return InterpretedAnswer(
            f"what is in the way of {things.text}", self._things.located(chosen), sentence=sentence
        )

    def _obstructed(self, things: Things, other: str, named: str, count: int, reason: str) -> str:
        """Return the sentence about what is in the way, of all things or of those on another."""
        named = f"{named or 'nothing'}{f' on {other}' if other else ''}"
        verb = "is" if count < 2 else "are"
        return begin_sentence(f"{named} {verb} in the way of {self._things.the(things)}, {reason}{things.suffix}.")

    def _only(self, answer: Answer, objects: Collection[str]) -> Answer:
        """Return the rows of an answer that are about some of its objects."""
        paths, column = {self._facts.path(iri) for iri in objects}, answer.columns.index("path")
        kept = [number for number, row in enumerate(answer.rows) if row[column] in paths]
        return replace(
            answer,
            rows=tuple(answer.rows[number] for number in kept),
            values=tuple(answer.values[number] for number in kept),
        )

    def _is_blocked(self, thing: str) -> InterpretedAnswer:
        found = self._to_open(thing)
        is_blocked = bool(found.answer.rows)
        sentence = f"{'Yes' if is_blocked else 'No'}. {found.sentence}"
        return InterpretedAnswer(f"what blocks {thing}", found.answer, is_blocked, sentence=sentence)
