"""Answers about distances: between things, from side to side, up from the floor, and which of two is nearer."""

import re
from collections.abc import Mapping

import numpy as np

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few, plural, yes_or_no
from usd2kg.errors import GraphError
from usd2kg.query.body_table import Body
from usd2kg.query.lookup import Things
from usd2kg.query.lookup.amounts import read_amount
from usd2kg.query.lookup.body_measures import nearest_of
from usd2kg.query.lookup.related_things import find_parts, find_related

__all__ = ["DistanceAnswers"]

_NEAREST = re.compile(r"^(the )?(nearest|closest) ", re.IGNORECASE)
_END = re.compile(r"(the )?(?P<end>bottom|underside|lower|top|upper)( edge| side| end| rim)? of ", re.IGNORECASE)


class DistanceAnswers(Answers):
    """Answers about distances in one graph, by the boxes of things."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "apart": lambda kind: self.distance(*self._things.pair(kind)),
            "distance": self.distance,
            "elevation": self._elevation,
            "is-nearer": self._is_nearer,
            "nearer": self._nearer,
            "nearer-than": self._nearer_than,
            "passes": self._passes,
            "passes-two": lambda distance, kind: self._passes(distance, *self._things.pair(kind)),
            "rise": self._rise,
        }

    def distance(self, thing: str, other: str) -> InterpretedAnswer:
        """Return the gaps between things and the nearest of others."""
        for end, level in ((thing, other), (other, thing)):
            if _END.match(end) and self._nouns.is_floor(level):
                return self._elevation(end)
        # The gap to the nearest shelf is the least gap to any.
        first, second = (self._nouns.existing(_NEAREST.sub("", text)) for text in (thing, other))
        gaps = self._gaps(first, second)
        facts = self._facts
        parts = [f"{facts.label(iri)} is {self._text(gap, 'm')} from {second.text}" for iri, gap in gaps.items()]
        sentence = f"{join_few(parts)}, from side to side{first.suffix}{second.suffix}."
        table = facts.table(sorted(gaps, key=lambda iri: gaps[iri]), gap_m=gaps)
        return InterpretedAnswer(
            f"the gap between {first.text} and {second.text}, in metres",
            table,
            number=min(gaps.values()),
            sentence=sentence,
        )

    def nearest(self, understood: str, values: Mapping[str, str]) -> InterpretedAnswer:
        """Return the thing of a kind with the least gap to others; `values` has `thing` and may have `class`."""
        anchors, facts = self._nouns.existing(values["thing"]), self._facts
        what = self._nouns.find(values.get("class", "things"))
        # What holds a thing, and the shell of a room, is not a neighbour of it.
        holders = {one for iri in anchors.iris for name in ("on", "inside", "room") for one in facts.anchors(name, iri)}
        # Nor are its own parts, and what is fixed to it.
        holders |= self._nouns.shells() | find_parts(facts, anchors.iris)
        holders |= find_related(facts, "attached", anchors.iris, is_direct=True)
        is_any = self._nouns.is_everything(values.get("class", "things"))
        candidates = what.iris if not is_any else [iri for iri in what.iris if iri not in holders]
        gaps = self._bodies.gaps(candidates, anchors.iris)
        if not what.iris:
            return InterpretedAnswer(understood, facts.table(()), sentence=f"{begin_sentence(what.absence)}.")
        if not gaps:
            raise GraphError(f"not known: the graph has no boxes for {what.text} or for {anchors.text}")
        nearest = facts.sorted(nearest_of(gaps))
        kind, verb = (what.text, "is") if len(nearest) == 1 else (plural(what.text), "are")
        sentence = (
            f"The nearest {kind} to {self._things.the(anchors)} {verb} {join_few([*map(facts.label, nearest)])}, "
            f"{self._text(min(gaps.values()), 'm')} away."
        )
        return InterpretedAnswer(understood, facts.table(nearest, gap_m=gaps), sentence=sentence)

    def _passes(self, distance: str, thing: str, other: str) -> InterpretedAnswer:
        """Return whether something of a width has room between two things."""
        width, unit = read_amount(distance)
        if unit != "m":
            raise GraphError(f"{distance!r} is not a width; expected a length, such as 60 cm")
        found = self.distance(thing, other)
        gap = found.number or 0.0
        is_so = gap >= width
        sentence = yes_or_no(is_so, f"The gap is {self._text(gap, 'm')} wide, from side to side.")
        return InterpretedAnswer(
            f"whether {distance} pass through {found.understood}", found.answer, is_so, sentence=sentence
        )

    def _nearer(self, thing: str, other: str, third: str) -> InterpretedAnswer:
        """Return which of two things is nearer to another."""
        anchors = self._nouns.existing(thing)
        choices = [self._nouns.existing(text) for text in (other, third)]
        gaps = [min(self._gaps(choice, anchors).values()) for choice in choices]
        winner = choices[int(gaps[1] < gaps[0])]
        how = " and ".join(
            f"{choice.text} is {self._text(gap, 'm')} away" for choice, gap in zip(choices, gaps, strict=True)
        )
        said = "They are equally far" if gaps[0] == gaps[1] else f"{winner.text} is nearer to {anchors.text}"
        chosen = () if gaps[0] == gaps[1] else winner.iris
        return InterpretedAnswer(
            f"which is nearer to {anchors.text}: {choices[0].text} or {choices[1].text}",
            self._facts.table(chosen),
            sentence=begin_sentence(f"{said}: {how}{anchors.suffix}."),
        )

    def _nearer_than(self, thing: str, other: str, third: str) -> InterpretedAnswer:
        """Return whether a thing is nearer to one than to another."""
        anchors = self._nouns.existing(thing)
        near, far = (self._nouns.existing(text) for text in (other, third))
        own, rival = (min(self._gaps(choice, anchors).values()) for choice in (near, far))
        how = f"{anchors.text} is {self._text(own, 'm')} from {near.text} and {self._text(rival, 'm')} from {far.text}"
        return InterpretedAnswer(
            f"whether {anchors.text} is nearer to {near.text} than to {far.text}",
            self._facts.table(anchors.iris),
            own < rival,
            sentence=yes_or_no(own < rival, f"{how}{anchors.suffix}."),
        )

    def _is_nearer(self, thing: str, other: str, third: str) -> InterpretedAnswer:
        """Return whether a thing is nearer to another than a third one is."""
        anchors = self._nouns.existing(other)
        first, second = self._nouns.existing(thing), self._nouns.existing(third)
        own, rival = (min(self._gaps(things, anchors).values()) for things in (first, second))
        how = f"{first.text} is {self._text(own, 'm')} from {anchors.text}, {second.text} {self._text(rival, 'm')}"
        return InterpretedAnswer(
            f"whether {first.text} is nearer to {anchors.text} than {second.text}",
            self._facts.table(first.iris),
            own < rival,
            sentence=yes_or_no(own < rival, f"{how}{anchors.suffix}."),
        )

    def _elevation(self, thing: str) -> InterpretedAnswer:
        """Return how high things are above the floor: the end that is named, else the top of what carries something."""
        named = _END.match(thing)
        things, facts = self._nouns.existing(_END.sub("", thing)), self._facts
        floor = self._bodies.floor_level
        heights, parts = {}, []
        for iri in things.iris:
            lower, upper = self._ends(facts.body(iri), things)
            bottom, top = lower - floor, upper - floor
            is_top = iri in facts.supporters if named is None else named["end"].lower() in {"top", "upper"}
            heights[iri] = round(top if is_top else bottom, 4)
            parts.append(f"{facts.label(iri)} is {self._text(bottom, 'm')} to {self._text(top, 'm')} above the floor")
        return InterpretedAnswer(
            f"how high above the floor: {things.text}",
            facts.table(heights, height_m=heights),
            number=next(iter(heights.values())),
            sentence=f"{join_few(parts)}{things.suffix}.",
        )

    def _rise(self, thing: str, other: str) -> InterpretedAnswer:
        """Return the vertical gap between the top of the lower one of two things and the bottom of the higher one."""
        first, second = self._nouns.existing(thing), self._nouns.existing(other)
        one, two = ([self._ends(self._facts.body(iri), things) for iri in things.iris] for things in (first, second))
        gap = min(max(upper[0] - lower[1], lower[0] - upper[1]) for lower in one for upper in two)
        said = f"{self._text(gap, 'm')} of height are between {first.text} and {second.text}"
        if gap < 0:
            said = f"{first.text} and {second.text} overlap in height by {self._text(-gap, 'm')}"
        return InterpretedAnswer(
            f"the height between {first.text} and {second.text}, in metres",
            self._facts.table((*first.iris, *second.iris)),
            number=round(gap, 4),
            sentence=begin_sentence(f"{said}{first.suffix}{second.suffix}."),
        )

    def _gaps(self, first: Things, second: Things) -> dict[str, float]:
        gaps = self._bodies.gaps(first.iris, second.iris)
        if not gaps:
            raise GraphError(f"not known: the graph has no boxes for {first.text} and {second.text}")
        return gaps

    def _ends(self, body: Body, things: Things) -> tuple[float, float]:
        """Return the heights of the bottom and the top of a box, in metres."""
        if body.lower is None or body.upper is None or not np.isfinite([*body.lower, *body.upper]).all():
            raise GraphError(f"not known: the graph has no box for {things.text}")
        return float(body.lower[2]), float(body.upper[2])
