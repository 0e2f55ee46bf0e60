"""Answers about things that move: what is in the way, how far they open, and what moves along."""

import math
from collections.abc import Collection, Mapping
from dataclasses import replace

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few, join_words, name_things, the_thing
from usd2kg.assistant.swept_space import find_in_the_way
from usd2kg.assistant.units import Units
from usd2kg.errors import GraphError
from usd2kg.query import Answer, GraphStore
from usd2kg.query.answer import join_answers
from usd2kg.query.lookup import Nouns, Things
from usd2kg.query.lookup.related_things import find_related

__all__ = ["OpeningAnswers"]


class OpeningAnswers(Answers):
    """Answers about things that open or move in one graph."""

    def __init__(self, graph: GraphStore, nouns: Nouns, units: Units) -> None:
        super().__init__(graph.facts, nouns, units)
        self._graph = graph

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "is-blocked": self._is_blocked,
            "joints": self._joints,
            "moves-with": self._moves_with,
            "to-open": self._to_open,
            "to-open-from": self._to_open,
        }

    def _to_open(self, thing: str, other: str = "") -> InterpretedAnswer:
        """Return what is in the way of a thing that opens: by its joint, else by the boxes in front of it."""
        things = self._existing_or_whole(thing)
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

    def _existing_or_whole(self, thing: str) -> Things:
        """Return the objects that are meant, or the whole of a part that is no object: the fridge, for its door."""
        try:
            return self._nouns.existing(thing)
        except GraphError:
            if (whole := self._nouns.whole_of(thing)) is None:
                raise
            return whole

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

    def _joints(self, thing: str) -> InterpretedAnswer:
        """Return the joints of things, and how far each of them moves."""
        things = self._existing_or_whole(thing)
        found = join_answers([self._graph.answer("joints", {"thing": self._facts.path(iri)}) for iri in things.iris])
        rows = [dict(zip(found.columns, values, strict=True)) for values in found.values]
        parts = [
            f"{row['moves'] or row['joint']} {self._motion(self._turns(row), row['range'])}"
            for row in {row["joint"]: row for row in rows}.values()
        ]
        if not parts:
            raise GraphError(f"not known: the stage has no joint for {things.text}, so how it opens is unknown")
        sentence = f"{join_few(parts)}{things.suffix}."
        turns = {
            round(math.degrees(span)) for row in rows if self._turns(row) and isinstance(span := row["range"], float)
        }
        number = float(turns.pop()) if len(turns) == 1 and all(map(self._turns, rows)) else None
        return InterpretedAnswer(
            f"joints of {things.text}, and how far they open", found, number=number, sentence=sentence
        )

    def _turns(self, row: Mapping[str, object]) -> bool:
        return any(kind in str(row["type"]) for kind in ("Revolute", "Hinge"))

    def _motion(self, turns: bool, span: object) -> str:
        """Return how a joint moves: radians for revolute joints, metres for prismatic ones."""
        verb = "turns" if turns else "slides"
        if not isinstance(span, float):
            return f"{verb} without stated limits"
        return f"{verb} by {math.degrees(span):.0f}°" if verb == "turns" else f"{verb} by {self._text(span, 'm')}"

    def _moves_with(self, thing: str, kind: str) -> InterpretedAnswer:
        """Return the things of a kind that move along with others."""
        things, what = self._nouns.existing(thing), self._nouns.find(kind)
        found = join_answers(
            [self._graph.answer("moves-along", {"thing": self._facts.path(iri)}) for iri in things.iris]
        )
        chosen = self._only(found, what.iris)
        paths = dict.fromkeys(str(row[chosen.columns.index("path")]) for row in chosen.rows)
        named = name_things(self._facts, [iri for path in paths for iri in self._facts.at_path(path)])
        said = f"{named or f'no {what.text}'} {'move' if len(paths) > 1 else 'moves'} along with {things.text}"
        return InterpretedAnswer(
            f"{what.text} that move along with {things.text}",
            chosen,
            sentence=begin_sentence(f"{said}{things.suffix}{what.suffix}."),
        )
