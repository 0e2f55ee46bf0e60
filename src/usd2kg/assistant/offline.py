"""ask_offline: answer a question in people's words, without a language model."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from usd2kg.assistant.describe import description_answer
from usd2kg.assistant.directions import find_beside, find_between
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.measures import MeasureAnswers
from usd2kg.assistant.phrases import RELATIONS, Phrase, match_phrase, normalize
from usd2kg.assistant.sentences import (
    begin_sentence,
    count_phrase,
    join_words,
    name_things,
    number_text,
    the_thing,
)
from usd2kg.assistant.swept_space import find_in_the_way
from usd2kg.errors import GraphError
from usd2kg.knowledge import word_map, word_set
from usd2kg.query import Answer, GraphStore
from usd2kg.query.answer import join_answers
from usd2kg.query.lookup import Nouns, Things, UnknownWordError
from usd2kg.query.questions import list_questions
from usd2kg.query.unicode_text import check_text

__all__ = ["ask_offline"]

_UNITS = (("centimet", "cm"), ("millimet", "mm"), ("met", "m"), ("kilo", "kg"), ("gram", "g"))
"""Beginning of a unit's name → symbol, tried in order."""
_SAID = {
    "on": "on",
    "inside": "in",
    "near": "near",
    "above": "above",
    "below": "below",
    "attached": "attached to",
    "left": "left of",
    "right": "right of",
    "front": "in front of",
    "behind": "behind",
}
"""Relation → preposition."""
_BY_BOXES = frozenset(["above", "left", "right", "front", "behind"])
"""Relations that the boxes tell where the graph states none."""


def ask_offline(graph: GraphStore, text: str, since: Path | None = None) -> InterpretedAnswer:
    """Return the answer to a question in English; frequent questions in German, French, Spanish and Italian too.

    A word that is not understood is an error, never the answer "no".

    Args:
        graph: the graph.
        text: the question.
        since: an older version of the scene, a graph or a stage, for questions about changes.

    Raises:
        GraphError: the question or one of its words is not understood.
    """
    check_text(text, "question")
    phrase = match_phrase(text)
    return _Answerer(graph, phrase is None or phrase.is_english, since).answer(text, phrase)


class _Answerer:
    """Answers questions about one graph."""

    def __init__(self, graph: GraphStore, is_english: bool, since: Path | None) -> None:
        self._graph = graph
        self._since = since
        self._facts = graph.facts
        self._nouns = Nouns(self._facts, is_english=is_english)
        self._measures = MeasureAnswers(self._facts, self._nouns)

    @property
    def _handlers(self) -> Mapping[str, Callable[..., InterpretedAnswer]]:
        # An attribute would be a reference cycle, which keeps the graph until the next full garbage collection.
        return {
            "about": self._about,
            "all": self._all,
            "between": self._between,
            "changed": self._changed,
            "count": self._count,
            "how-many": self._how_many,
            "is-blocked": self._is_blocked,
            "is-there": self._is_there,
            "parts": self._parts,
            "parts-of": self._parts_of,
            "rel-count": self._rel_count,
            "rel-is": self._rel_is,
            "rel-some": self._rel_some,
            "rel-what": self._rel_what,
            "stands-on": self._stands_on,
            "to-open": self._to_open,
            "to-open-from": self._to_open,
            "where": self._where,
        }

    def answer(self, text: str, phrase: Phrase | None) -> InterpretedAnswer:
        """Return the answer to a question, or to a noun alone, which matches no phrase."""
        if phrase is not None:
            return self._answer_phrase(phrase)
        # A noun alone: “laptops?”
        try:
            things = self._nouns.find(normalize(text))
        except UnknownWordError as error:
            raise GraphError(
                f"question {text!r} is not understood ({error}); expected a question like 'what is on the table?', "
                "'where is the kettle?', 'how many cups are there?' or 'what must be moved to open the drawer?' "
                "(usd2kg query --list shows more); or let a language model write the query with --model"
            ) from error
        return self._list(things)

    def _answer_phrase(self, phrase: Phrase) -> InterpretedAnswer:
        question, given, _ = phrase
        handler = self._handlers.get(question) or self._measures.find(question)
        if handler is None:
            return self._ready_question(question, given)
        return handler(**{name.replace("class", "kind"): value for name, value in given.items()})

    # Lists and counts.

    def _all(self, kind: str = "things", **_: str) -> InterpretedAnswer:
        return self._list(self._nouns.find(kind))

    def _list(self, things: Things) -> InterpretedAnswer:
        table = self._located(things.iris)
        if not things.iris:
            return InterpretedAnswer(f"all {things.text}", table, sentence=begin_sentence(self._absent(things)))
        verb = "is" if len(things.iris) == 1 else "are"
        sentence = f"There {verb} {name_things(self._facts, things.iris)}{things.suffix}."
        return InterpretedAnswer(f"all {things.text}", table, sentence=sentence)

    def _how_many(self, kind: str) -> InterpretedAnswer:
        things = self._nouns.find(kind)
        count = len(things.iris)
        verb = "is" if count == 1 else "are"
        sentence = (
            f"There {verb} {count} {things.text}{things.suffix}." if count else begin_sentence(self._absent(things))
        )
        return InterpretedAnswer(
            f"number of {things.text}", self._located(things.iris), number=count, sentence=sentence
        )

    def _count(self) -> InterpretedAnswer:
        facts = self._facts
        counts = facts.class_counts()
        rows = tuple(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
        table = Answer(("class", "count"), tuple((label, str(count)) for label, count in rows), rows, "")
        sentence = f"There are {len(facts.things)} objects of {len(counts)} classes."
        return InterpretedAnswer("number of objects of each class", table, number=len(facts.things), sentence=sentence)

    def _is_there(self, kind: str) -> InterpretedAnswer:
        things = self._nouns.find(kind)
        answer = self._list(things)
        yes = bool(things.iris)
        said = f"Yes: {answer.sentence[0].lower()}{answer.sentence[1:]}" if yes else f"No: {self._absent(things)}"
        return InterpretedAnswer(f"whether there is {things.text}", answer.answer, yes, sentence=said)

    def _absent(self, things: Things) -> str:
        return f"there is no {things.text} in this scene{things.suffix}."

    def _located(self, iris: Sequence[str]) -> Answer:
        """Return objects with what they are on and in."""
        facts = self._facts
        on = {iri: facts.label(anchors[0]) for iri in iris if (anchors := facts.anchors("on", iri))}
        inside: dict[str, str] = {}
        for iri in iris:
            rooms = facts.anchors("room", iri)
            containers = [anchor for anchor in facts.anchors("inside", iri) if anchor not in rooms]
            inside.update((iri, facts.label(anchor)) for anchor in (containers or rooms)[:1])
        return facts.table(facts.sorted(iris), on=on, inside=inside)

    # Relations.

    def _rel_what(self, relation: str, thing: str) -> InterpretedAnswer:
        return self._related(relation, thing, None)

    def _rel_some(self, relation: str, thing: str = "", kind: str = "things", other: str = "") -> InterpretedAnswer:
        if other:
            # “Which chairs have a cushion on them?”: the anchors.
            anchors, targets = self._nouns.find(kind), set(self._nouns.find(other).iris)
            name = _relation(relation)
            chosen = [iri for iri in anchors.iris if self._nouns.related(name, [iri], is_direct=False) & targets]
            return self._list(Things(tuple(chosen), f"{anchors.text} with {other} {_SAID[name]} them"))
        return self._related(relation, thing, kind)

    def _rel_count(self, kind: str, relation: str, thing: str) -> InterpretedAnswer:
        found = self._related(relation, thing, kind)
        return InterpretedAnswer(
            f"number of {found.understood}", found.answer, number=len(found.answer.rows), sentence=found.sentence
        )

    def _rel_is(self, kind: str, relation: str, thing: str) -> InterpretedAnswer:
        found = self._related(relation, thing, kind)
        yes = bool(found.answer.rows)
        said = f"{'Yes' if yes else 'No'}: {found.sentence[0].lower()}{found.sentence[1:]}"
        return InterpretedAnswer(f"whether {found.understood}", found.answer, yes, sentence=said)

    def _related(self, relation: str, thing: str, kind: str | None) -> InterpretedAnswer:
        """Return the things of a kind, or all things, in a relation to others."""
        name, facts = _relation(relation), self._facts
        what = None if kind is None else self._nouns.find(kind)
        anchors = self._anchors(name, thing)
        understood = f"{'things' if what is None else what.text} {_SAID[name]} {anchors.text}"
        found, note = self._by_relation(name, thing, anchors, is_direct=what is None), ""
        if not found and name in _BY_BOXES:
            found, note = self._by_boxes(name, anchors)
        chosen = [iri for iri in facts.sorted(found) if (what is None or iri in what.iris) and iri not in anchors.iris]
        notes = f"{what.suffix if what else ''}{anchors.suffix}{note}"
        place = f"{_SAID[name]} {self._the(anchors)}"
        if chosen:
            verb = "is" if len(chosen) == 1 else "are"
            named = name_things(facts, chosen)
            sentence = begin_sentence(f"{named} {verb} {place}{notes}.")
        elif what is not None and not what.iris:
            sentence = begin_sentence(self._absent(what))
        else:
            sentence = f"{'Nothing' if what is None else f'No {what.text}'} is {place}{notes}."
        return InterpretedAnswer(understood, self._located(chosen), sentence=sentence)

    def _anchors(self, relation: str, text: str) -> Things:
        """Return the things that a relation leads to; none for a part of the scene.

        Raises:
            GraphError: there are none.
        """
        try:
            things = self._nouns.find(text)
        except UnknownWordError:
            if relation == "inside" and self._nouns.in_area(text):
                return Things((), text)
            raise
        if not things.iris and not (relation == "inside" and self._nouns.in_area(text)):
            raise GraphError(self._absent(things).removesuffix("."))
        return things

    def _by_relation(self, name: str, text: str, anchors: Things, *, is_direct: bool) -> set[str]:
        if name == "below":
            return self._below(anchors.iris)
        found = self._nouns.around(name, text, is_direct=is_direct)
        if name == "on" and self._is_open_storage(anchors):
            found |= self._nouns.around("inside", text, is_direct=is_direct)
        return found

    def _by_boxes(self, name: str, anchors: Things) -> tuple[set[str], str]:
        """Return what is above or beside things by their boxes, and the note that says so.

        Raises:
            GraphError: the boxes do not say what is beside them.
        """
        if name == "above":
            answers = [self._graph.answer("above", {"thing": self._facts.path(iri)}) for iri in anchors.iris]
            return {iri for one in answers for path in _column(one, "path") for iri in self._facts.at_path(path)}, ""
        found = [find_beside(self._facts, name, iri) for iri in anchors.iris]
        if any(one is None for one in found):
            raise GraphError(f"not known: the graph has no viewpoint, and the boxes around {anchors.text} suggest none")
        note = " (by boxes, seen from amid the things around)"
        return {iri for one in found for iri in one or ()}, note

    def _between(self, thing: str, other: str) -> InterpretedAnswer:
        first, second = self._found(thing), self._found(other)
        pairs = [(one, two) for one in first.iris for two in second.iris if one != two]
        if len(pairs) != 1:
            raise GraphError(f"{thing!r} and {other!r} are {len(pairs)} pairs of things; expected the name of one each")
        between = find_between(self._facts, *pairs[0])
        if between is None:
            raise GraphError(f"not known: the graph has no boxes for {first.text} and {second.text}")
        verb = "is" if len(between) < 2 else "are"
        named = name_things(self._facts, between) or "nothing"
        sentence = f"{named} {verb} between {self._the(first)} and {self._the(second)}."
        understood = f"things between {first.text} and {second.text}"
        return InterpretedAnswer(understood, self._located(between), sentence=begin_sentence(sentence))

    def _is_open_storage(self, things: Things) -> bool:
        """Return whether things have boards above each other, so that what is on a board is inside them."""
        nouns = word_set("assistant", "open_storage")
        return bool(things.iris) and all(self._facts.kind(iri).split()[-1] in nouns for iri in things.iris)

    def _below(self, anchors: Sequence[str]) -> set[str]:
        answers = [self._graph.answer("below", {"thing": self._facts.path(iri)}) for iri in anchors]
        below = {iri for answer in answers for path in _column(answer, "path") for iri in self._facts.at_path(path)}
        return below | {iri for anchor in anchors for iri in self._measures.between_legs(anchor)}

    def _the(self, things: Things) -> str:
        labels = [self._facts.label(iri) for iri in things.iris]
        if not labels:
            return things.text
        if len(labels) == 1:
            return the_thing(self._facts.kind(things.iris[0]), labels[0])
        return f"the {count_phrase(len(labels), things.text)}"

    def _where(self, thing: str) -> InterpretedAnswer:
        facts, things = self._facts, self._nouns.find(thing)
        if not things.iris:
            return InterpretedAnswer(
                f"where: {things.text}", facts.table(()), sentence=begin_sentence(self._absent(things))
            )
        parts, places = [], []
        for iri in things.iris:
            said: list[str] = []
            for name in ("inside", "on", "attached", "room"):
                rooms = set(facts.anchors("room", iri))
                anchors = [a for a in facts.anchors(name, iri) if name == "room" or a not in rooms]
                places += anchors
                if name != "room" or not said:
                    place = _SAID.get(name, "in")
                    said += [f"{place} {the_thing(facts.kind(a), facts.label(a))}" for a in anchors[:1]]
            body = facts.body(iri)
            if body.lower is not None and body.upper is not None:
                x, y, z = (body.lower + body.upper) / 2
                said.append(f"at ({x:.2f}, {y:.2f}, {z:.2f}) m")
            parts.append(f"{facts.label(iri)} is {', '.join(said) or 'somewhere, without a known place'}")
        sentence = f"{'; '.join(parts[:4])}{f'; and {len(parts) - 4} more' if len(parts) > 4 else ''}{things.suffix}."
        named = tuple(dict.fromkeys(facts.path(iri) for iri in places))
        return InterpretedAnswer(f"where: {things.text}", self._located(things.iris), sentence=sentence, places=named)

    def _stands_on(self, thing: str) -> InterpretedAnswer:
        facts, things = self._facts, self._nouns.find(thing)
        anchors = [anchor for iri in things.iris for anchor in facts.anchors("on", iri) or facts.anchors("inside", iri)]
        sentence = f"{things.text} is on {name_things(facts, anchors)}." if anchors else f"{things.text} is on nothing."
        return InterpretedAnswer(f"what {things.text} is on", self._located(anchors), sentence=sentence)

    def _parts_of(self, kind: str, thing: str) -> InterpretedAnswer:
        wholes, what = self._nouns.find(thing), self._nouns.find(kind)
        parts = self._nouns.related("part", wholes.iris, is_direct=True)
        chosen = [iri for iri in what.iris if iri in parts]
        sentence = f"{begin_sentence(self._the(wholes))} has {count_phrase(len(chosen), what.text)}."
        return InterpretedAnswer(
            f"{what.text} that are parts of {wholes.text}", self._located(chosen), number=len(chosen), sentence=sentence
        )

    def _parts(self, thing: str) -> InterpretedAnswer:
        answers = [self._graph.parts_of(self._facts.path(iri)) for iri in self._found(thing).iris]
        return InterpretedAnswer(f"parts of {thing}", join_answers(answers))

    def _about(self, thing: str) -> InterpretedAnswer:
        answers = [description_answer(self._graph, self._facts.path(iri)) for iri in self._found(thing).iris]
        return InterpretedAnswer(f"all about {thing}", join_answers(answers))

    def _found(self, text: str) -> Things:
        """Return things that exist.

        Raises:
            GraphError: there are none.
        """
        things = self._nouns.find(text)
        if not things.iris:
            raise GraphError(self._absent(things).removesuffix("."))
        return things

    def _changed(self, change: str = "changed", thing: str | None = None) -> InterpretedAnswer:
        # Loads OpenUSD, which no other question needs.
        from usd2kg.assistant.changes import NEEDS_OLDER_VERSION, answer_changes, changes_since  # noqa: PLC0415

        if self._since is None:
            raise GraphError(NEEDS_OLDER_VERSION)
        kind = word_map("assistant", "change_words").get(change.lower(), "changed")
        paths = None if thing is None else frozenset(map(self._facts.path, self._found(thing).iris))
        return answer_changes(changes_since(self._since, self._graph), kind, paths)

    def _ready_question(self, question: str, given: Mapping[str, str]) -> InterpretedAnswer:
        """Return the answer to one of the questions that `usd2kg query --list` lists, for each object that is meant."""
        values = {name: _normalize(name, value) for name, value in given.items()}
        text = next(q.text for q in list_questions() if q.id == question)
        parameters = ", ".join(f"{name} = {value}" for name, value in values.items())
        understood = f"{question}: {text}{f' with {parameters}' if parameters else ''}"
        if question == "nearest":
            return self._nearest(understood, values)
        if "thing" not in values:
            return InterpretedAnswer(understood, self._graph.answer(question, values))
        paths = [self._facts.path(iri) for iri in self._found(values["thing"]).iris]
        answers = [self._graph.answer(question, {**values, "thing": path}) for path in paths]
        found = join_answers(answers)
        return InterpretedAnswer(understood, found)

    def _to_open(self, thing: str, other: str = "") -> InterpretedAnswer:
        """Return what is in the way of a thing that opens: by its joint, else by the boxes in front of it."""
        things = self._found(thing)
        carried = self._nouns.around("on", other, is_direct=False) if other else None
        found = self._ready_question("to-open", {"thing": thing})
        if found.answer.rows or not self._facts.opened_by_joint.isdisjoint(things.iris):
            answer = found.answer if carried is None else self._only(found.answer, carried)
            rows = [dict(zip(answer.columns, row, strict=True)) for row in answer.rows]
            named = dict.fromkeys(the_thing(row["class"] or "", row["object"] or "") for row in rows)
            reason = "by boxes that move as far as the joints allow"
            sentence = self._obstructed(things, other, join_words([*named]), len(named), reason)
            return replace(found, answer=answer, sentence=sentence)
        parts = self._nouns.related("part", things.iris, is_direct=True)
        swept = [find_in_the_way(self._facts, iri, parts) for iri in things.iris]
        if any(one is None for one in swept):
            raise GraphError(f"not known: the stage has no joint for {things.text}, so how it opens is unknown")
        chosen = self._facts.sorted({iri for one in swept for iri in one or () if carried is None or iri in carried})
        reason = "by boxes: the stage has no joint for it, and it may open to either side"
        sentence = self._obstructed(things, other, name_things(self._facts, chosen), len(chosen), reason)
        return InterpretedAnswer(f"what is in the way of {things.text}", self._located(chosen), sentence=sentence)

    def _obstructed(self, things: Things, other: str, named: str, count: int, reason: str) -> str:
        """Return the sentence about what is in the way, of all things or of those on another."""
        named = f"{named or 'nothing'}{f' on {other}' if other else ''}"
        verb = "is" if count < 2 else "are"
        return begin_sentence(f"{named} {verb} in the way of {self._the(things)}, {reason}{things.suffix}.")

    def _only(self, answer: Answer, objects: Collection[str]) -> Answer:
        """Return the rows of an answer that are about some of its objects."""
        paths, column = {self._facts.path(iri) for iri in objects}, answer.columns.index("path")
        kept = [number for number, row in enumerate(answer.rows) if row[column] in paths]
        return replace(
            answer,
            rows=tuple(answer.rows[number] for number in kept),
            values=tuple(answer.values[number] for number in kept),
        )

    def _nearest(self, understood: str, values: Mapping[str, str]) -> InterpretedAnswer:
        what, anchors, facts = self._nouns.find(values["class"]), self._found(values["thing"]), self._facts
        gaps = self._measures.gaps(what.iris, anchors.iris)
        if not gaps:
            return InterpretedAnswer(understood, facts.table(()), sentence=begin_sentence(self._absent(what)))
        nearest = min(gaps, key=lambda iri: (gaps[iri], facts.path(iri)))
        sentence = (
            f"The nearest {what.text} to {self._the(anchors)} is {facts.label(nearest)}, "
            f"{number_text(gaps[nearest], 'm')} away."
        )
        return InterpretedAnswer(understood, facts.table([nearest], gap_m=gaps), sentence=sentence)

    def _is_blocked(self, thing: str) -> InterpretedAnswer:
        found = self._to_open(thing)
        is_blocked = bool(found.answer.rows)
        sentence = f"{'Yes' if is_blocked else 'No'}. {found.sentence}"
        return InterpretedAnswer(f"what blocks {thing}", found.answer, is_blocked, sentence=sentence)


def _relation(text: str) -> str:
    """Return the relation that a preposition means."""
    return next(name for name, words in RELATIONS.items() if text.lower() in words.split("|"))


def _normalize(name: str, value: str) -> str:
    """Return a parameter value with unit symbols for unit names; a position without commas."""
    if name == "position":
        return " ".join(value.replace(",", " ").split())
    if name in {"distance", "mass"}:
        number = value.rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ ")
        unit = value[len(number) :].strip().lower()
        return f"{number} {next((symbol for prefix, symbol in _UNITS if unit.startswith(prefix)), unit)}".strip()
    return value


def _column(answer: Answer, name: str) -> list[str]:
    at = answer.columns.index(name)
    return [row[at] or "" for row in answer.rows]
