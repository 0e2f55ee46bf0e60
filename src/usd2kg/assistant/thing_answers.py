"""Answers about things, how many there are, where they are, and their parts."""

import math
from collections.abc import Mapping
from functools import cached_property

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.relation_answers import PREPOSITIONS
from usd2kg.assistant.sentences import (
    begin_sentence,
    count_phrase,
    join_few,
    plural,
    split_number,
    the_thing,
    yes_or_no,
)
from usd2kg.assistant.settings import SENTENCES
from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_set
from usd2kg.query import Answer
from usd2kg.query.lookup import Things, UnknownWordError
from usd2kg.query.lookup.prepositions import RELATION_OF
from usd2kg.query.lookup.related_things import find_related
from usd2kg.query.lookup.word_forms import singular, split_phrase

__all__ = ["ThingAnswers"]

_LINKS = word_set("query", "connectives") | RELATION_OF.keys()
"""Words that lead to the modifier of a noun."""


class ThingAnswers(Answers):
    """Answers that list, count and locate the things of one graph."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "all": self._all,
            "count": self._count,
            "has-parts": self._has_parts,
            "how-many": self._how_many,
            "in-room": self._in_room,
            "is-there": self._is_there,
            "parts-list": self._parts_list,
            "parts-of": self._parts_of,
            "stands-on": self._stands_on,
            "where": self._where,
        }

    def _all(self, kind: str = "things", **_: str) -> InterpretedAnswer:
        return self.list(self._nouns.find(kind))

    def list(self, things: Things) -> InterpretedAnswer:
        """Return the answer that lists things; a noun that the lexicon lacks is an error."""
        is_modified = not _LINKS.isdisjoint(things.text.split())
        if not things.iris and not is_modified and not concepts_named(things.text):
            raise UnknownWordError(f"{things.text!r} is not a thing that the lexicon knows")
        return self._things.answer(things)

    def _how_many(self, kind: str) -> InterpretedAnswer:
        things = self._nouns.find(kind)
        self._things.check_kind(things)
        count = len(things.iris)
        verb = "is" if count == 1 else "are"
        *before, last = things.text.split() or ["thing"]
        named = " ".join([*before, singular(last)]) if count == 1 else plural(things.text)
        sentence = f"There {verb} {count} {named}{things.suffix}." if count else f"{begin_sentence(things.absence)}."
        return InterpretedAnswer(
            f"number of {things.text}", self._things.located(things.iris), number=count, sentence=sentence
        )

    def _count(self) -> InterpretedAnswer:
        facts = self._facts
        counts = facts.class_counts()
        rows = tuple(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
        table = Answer(("class", "count"), tuple((label, str(count)) for label, count in rows), rows, "")
        sentence = f"There are {len(facts.things)} objects of {len(counts)} classes."
        return InterpretedAnswer("number of objects of each class", table, number=len(facts.things), sentence=sentence)

    def _is_there(self, kind: str, count: str = "") -> InterpretedAnswer:
        exact, kind = split_number(f"{count} {kind}" if count else kind)
        things = self._nouns.find(kind, may_shorten=False)
        self._things.check_kind(things)
        answer = self._things.answer(things)
        yes = len(things.iris) == exact if count else len(things.iris) >= exact
        said = yes_or_no(yes, answer.sentence)
        return InterpretedAnswer(f"whether there is {things.text}", answer.answer, yes, sentence=said)

    def _where(self, thing: str) -> InterpretedAnswer:
        facts, things = self._facts, self._nouns.find(thing)
        if not things.iris:
            return InterpretedAnswer(
                f"where: {things.text}", facts.table(()), sentence=f"{begin_sentence(things.absence)}."
            )
        parts, places = [], []
        for iri in things.iris:
            said: list[str] = []
            rooms = facts.anchors("room", iri)
            held = [
                (name, anchor)
                for name in ("on", "inside", "attached", "part")
                for anchor in facts.anchors(name, iri)
                if anchor not in rooms
            ]
            # The smallest thing that holds it says most about the place.
            held.sort(key=lambda found: self._volume(found[1]))
            is_on_floor = all(anchor in self._floors for _, anchor in held)
            held += [("room", anchor) for anchor in rooms if is_on_floor and (not held or len(facts.rooms) > 1)]
            places += [anchor for _, anchor in held]
            named_once = dict(reversed(held))
            said += [
                f"{PREPOSITIONS.get(name, 'in')} {the_thing(facts.kind(anchor), facts.label(anchor))}"
                for name, anchor in held
                if named_once[name] == anchor
            ]
            body = facts.body(iri)
            if body.lower is not None and body.upper is not None:
                x, y, z = (body.lower + body.upper) / 2
                said.append(f"at ({x:.2f}, {y:.2f}, {z:.2f}) m")
            parts.append(f"{facts.label(iri)} is {', '.join(said) or 'somewhere, without a known place'}")
        rest = len(parts) - SENTENCES.max_named
        shown = "; ".join([*parts[: SENTENCES.max_named], *([f"and {rest} more"] if rest > 0 else [])])
        sentence = f"{shown}{things.suffix}."
        named = tuple(dict.fromkeys(facts.path(iri) for iri in places))
        return InterpretedAnswer(
            f"where: {things.text}", self._things.located(things.iris), sentence=sentence, places=named
        )

    def _in_room(self, thing: str) -> InterpretedAnswer:
        facts, things = self._facts, self._nouns.existing(thing)
        by_room: dict[str, list[str]] = {}
        for iri in things.iris:
            for room in facts.anchors("room", iri):
                by_room.setdefault(room, []).append(iri)
        if not by_room:
            raise GraphError(f"not known: the graph does not state in which room {self._things.the(things)} is")
        parts = [
            f"{join_few([facts.label(iri) for iri in inside])} {'is' if len(inside) == 1 else 'are'} "
            f"in {the_thing(facts.kind(room), facts.label(room))}"
            for room, inside in by_room.items()
        ]
        return InterpretedAnswer(
            f"room of {things.text}",
            self._things.located(things.iris),
            sentence=f"{'; '.join(parts)}{things.suffix}.",
            places=tuple(map(facts.path, by_room)),
        )

    @cached_property
    def _floors(self) -> frozenset[str]:
        return frozenset(self._bodies.floors())

    def _volume(self, iri: str) -> float:
        """Return the volume of the box of an object in m³, infinite without one."""
        extents = self._facts.body(iri).extents
        return math.prod(extents) if extents is not None else math.inf

    def _stands_on(self, thing: str) -> InterpretedAnswer:
        facts, things = self._facts, self._nouns.find(thing)
        rooms = {room for iri in things.iris for room in facts.anchors("room", iri)}
        held = [
            (name, anchor)
            for iri in things.iris
            for name in ("on", "inside", "attached")
            for anchor in facts.anchors(name, iri)
            if anchor not in rooms
        ]
        # What is on a thing is not asked about where it is in or attached to another.
        first = held[0][0] if held else ""
        anchors = [anchor for name, anchor in held if name == first]
        if not anchors:
            raise GraphError(f"not known: the graph does not state what {things.text} is on{things.suffix}")
        verb = "are" if len(things.iris) > 1 else "is"
        named = join_few([the_thing(facts.kind(anchor), facts.label(anchor)) for anchor in dict.fromkeys(anchors)])
        sentence = begin_sentence(f"{things.text} {verb} {PREPOSITIONS[first]} {named}{things.suffix}.")
        paths = tuple(map(facts.path, dict.fromkeys(anchors)))
        return InterpretedAnswer(
            f"what {things.text} is on", self._things.located(anchors), sentence=sentence, places=paths
        )

    def _parts_of(self, kind: str, thing: str) -> InterpretedAnswer:
        wholes, what = self._nouns.find(thing), self._nouns.find(kind)
        if not wholes.iris:
            if self._nouns.is_whole_scene(wholes.text):
                return self._how_many(kind)
            raise GraphError(wholes.absence)
        parts = find_related(self._facts, "part", wholes.iris, is_direct=True)
        if not parts:
            raise GraphError(f"not known: the graph states no parts of {wholes.text} as objects of their own")
        if not what.iris:
            raise GraphError(what.absence)
        chosen = [iri for iri in what.iris if iri in parts]
        sentence = f"{begin_sentence(self._things.the(wholes))} has {count_phrase(len(chosen), what.text)}."
        return InterpretedAnswer(
            f"{what.text} that are parts of {wholes.text}",
            self._things.located(chosen),
            number=len(chosen),
            sentence=sentence,
        )

    def _parts_list(self, kind: str, thing: str) -> InterpretedAnswer:
        if self._nouns.is_whole_scene(" ".join(split_phrase(thing))):
            return self._all(kind)
        return self._parts_of(kind, thing)

    def _has_parts(self, kind: str, thing: str) -> InterpretedAnswer:
        found = self._parts_of(kind, thing)
        yes = bool(found.number)
        sentence = yes_or_no(yes, found.sentence)
        return InterpretedAnswer(f"whether there are {found.understood}", found.answer, yes, sentence=sentence)
