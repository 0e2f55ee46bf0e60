"""Answers about relations: what is on, in, near, above, between or beside others."""

import re
from collections.abc import Mapping, Sequence

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few, name_things, split_number, the_thing, yes_or_no
from usd2kg.errors import GraphError
from usd2kg.knowledge import word_set
from usd2kg.query.lookup import Things, UnknownWordError
from usd2kg.query.lookup.body_measures import BodyMeasures, nearest_of
from usd2kg.query.lookup.directions import find_beside, find_between
from usd2kg.query.lookup.prepositions import SIDES, is_direct, relation_of
from usd2kg.query.lookup.related_things import find_above, find_over_covers, find_parts, find_related
from usd2kg.query.lookup.word_forms import is_plural, split_phrase
from usd2kg.query.settings import DIRECTIONS

__all__ = ["PREPOSITIONS", "RelationAnswers"]

PREPOSITIONS = {
    "on": "on",
    "inside": "in",
    "near": "near",
    "above": "above",
    "below": "below",
    "attached": "attached to",
    "part": "a part of",
    "left": "left of",
    "right": "right of",
    "front": "in front of",
    "behind": "behind",
}
"""Relation → preposition."""
_ALL = re.compile(r"(all|every|each|both|everything)\b|the [^?]*(?<!s)s$", re.IGNORECASE)
_EACH = re.compile(r"(each|every)( one)?( of)?( the)? ", re.IGNORECASE)
_BY_BOXES = frozenset(["above", *SIDES])
"""Relations that the boxes tell where the graph states none."""


class RelationAnswers(Answers):
    """Answers about relations of one graph."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "between": self._between,
            "between-two": lambda kind: self._between(*self._things.pair(kind)),
            "rel-count": self._rel_count,
            "rel-is": self._rel_is,
            "rel-what": self._rel_what,
        }

    def _rel_what(self, relation: str, thing: str) -> InterpretedAnswer:
        return self._related(relation, thing, None)

    def _kind(self, kind: str) -> str | None:
        """Return the noun for what is asked for; None for any things, which are meant as they are stated."""
        return None if kind.lower() in {"objects", "things", "items"} else kind

    def _rel_count(self, kind: str, relation: str, thing: str) -> InterpretedAnswer:
        found = self._related(relation, thing, self._kind(kind))
        if _EACH.match(thing):
            return self._count_each(kind, relation, thing)
        return InterpretedAnswer(
            f"number of {found.understood}", found.answer, number=len(found.answer.rows), sentence=found.sentence
        )

    def _count_each(self, kind: str, relation: str, thing: str) -> InterpretedAnswer:
        """Return the number of things of a kind at each of several others."""
        anchors, what = self._nouns.existing(_EACH.sub("", thing)), self._nouns.find(kind)
        name, counts = relation_of(relation), dict[str, int]()
        for iri in anchors.iris:
            found = self._by_relation(name, self._facts.path(iri), anchors, is_direct=False)
            counts[iri] = len(found.intersection(what.iris))
        parts = [f"{count} {PREPOSITIONS[name]} {self._facts.label(iri)}" for iri, count in counts.items()]
        return InterpretedAnswer(
            f"number of {what.text} {relation} each of {anchors.text}",
            self._facts.table(counts, count=counts),
            sentence=f"{begin_sentence(what.text)}: {join_few(parts)}{what.suffix}{anchors.suffix}.",
        )

    def _rel_is(self, kind: str, relation: str, thing: str) -> InterpretedAnswer:
        count, noun = split_number(kind)
        found = self._related(relation, thing, noun)
        many = len(found.answer.rows)
        yes, share = many >= count, ""
        if _ALL.match(kind):
            anchors = set(self._nouns.find(thing).iris)
            total = sum(iri not in anchors for iri in self._nouns.find(noun).iris)
            yes, share = 0 < total == many, f" ({many} of {total})"
        said = yes_or_no(yes, f"{found.sentence.removesuffix('.')}{share}.")
        return InterpretedAnswer(f"whether {found.understood}", found.answer, yes, sentence=said)

    def _related(self, relation: str, thing: str, kind: str | None) -> InterpretedAnswer:
        """Return the things of a kind, or all things, in a relation to others."""
        name, facts = relation_of(relation), self._facts
        what = None if kind is None else self._nouns.find(kind)
        if what is not None:
            self._things.check_kind(what)
        anchors = self._anchors(name, thing)
        understood = f"{'things' if what is None else what.text} {PREPOSITIONS[name]} {anchors.text}"
        found = self._by_relation(name, thing, anchors, is_direct=what is None or is_direct(relation))
        if what is None and name == "on" and not is_direct(relation):
            found = found | find_over_covers(facts, anchors.iris)
        chosen, note = self._completed(name, found, anchors.iris, what)
        notes = f"{what.suffix if what else ''}{anchors.suffix}{note}"
        place = (
            f"{'directly ' if is_direct(relation) else ''}{PREPOSITIONS[name]} {self._the_used(name, chosen, anchors)}"
        )
        if chosen:
            verb = "is" if len(chosen) == 1 else "are"
            named = name_things(facts, chosen)
            sentence = begin_sentence(f"{named} {verb} {place}{notes}.")
        elif what is not None and not what.iris:
            sentence = f"{begin_sentence(what.absence)}."
        else:
            named = "Nothing" if what is None or what.text == "thing" else f"No {what.text}"
            sentence = f"{named} {'are' if what is not None and is_plural(what.text) else 'is'} {place}{notes}."
        return InterpretedAnswer(understood, self._things.located(chosen), sentence=sentence)

    def _the_used(self, name: str, chosen: Sequence[str], anchors: Things) -> str:
        """Return the noun phrase for what things are in a relation to: one pallet, where the others are empty."""
        is_holder = name in {"attached", "inside", "on"}
        held = {anchor for iri in chosen if is_holder for anchor in self._facts.anchors(name, iri)}
        used = [iri for iri in anchors.iris if iri in held]
        if not used or len(used) == len(anchors.iris):
            return self._things.the(anchors)
        if len(used) == 1:
            return the_thing(self._facts.kind(used[0]), self._facts.label(used[0]))
        return f"{len(used)} of {self._things.the(anchors)}"

    def find_in_relation(
        self, name: str, anchors: Sequence[str], iris: Sequence[str] | None, *, is_direct: bool
    ) -> set[str]:
        """Return which of some objects, or of all, are in a relation to any of others.

        Args:
            name: the relation.
            anchors: the others.
            iris: the objects; None for all.
            is_direct: whether what is over another thing is left out.
        """
        what = None if iris is None else Things(tuple(iris), "")
        others = Things(tuple(anchors), "")
        found = self._of_anchors(name, others, is_direct=is_direct or iris is None)
        if iris is None and name == "on" and not is_direct:
            found = found | find_over_covers(self._facts, anchors)
        chosen, _ = self._completed(name, found, anchors, what)
        return set(chosen)

    def _completed(
        self, name: str, found: set[str], anchors: Sequence[str], what: Things | None
    ) -> tuple[list[str], str]:
        """Return what people mean by a relation, among what the graph states, and the note that says how it is known.

        Args:
            name: the relation.
            found: what the graph states.
            anchors: what the relation leads to.
            what: the things among which is chosen; None for all.

        Raises:
            GraphError: the graph does not say where the things are.
        """
        facts, note = self._facts, ""
        is_any = what is None or what.text == "thing"
        if name == "inside" and is_any:
            # The door of a microwave is a part of it, not what is in it.
            found = found - find_parts(facts, anchors)
        if name == "inside" and what is not None and self._nouns.shells().issuperset(anchors):
            # A window is in the wall that it is fixed to.
            found = found | find_related(facts, "attached", anchors, is_direct=True)
        if name == "attached" and not found:
            # A sink is built into a countertop as a part of it.
            found = find_related(facts, "part", anchors, is_direct=True)
        if name in {"below", "near"} and is_any:
            found = found - self._nouns.shells()
        if name in _BY_BOXES and (
            not found or (name == "above" and found.isdisjoint(found if what is None else what.iris))
        ):
            # The graph states what is just above, and there may be more above that.
            found, note = self._by_boxes(name, anchors)
        if name == "on" and found.isdisjoint(found if what is None else what.iris):
            # Pictures hang on a wall, and handles are on a cabinet.
            found = self._fixed_to([*anchors, *found], with_parts=not is_any)
        if name == "below" and what is not None and found.isdisjoint(what.iris):
            # A rug is under the table that stands on it.
            found = {one for iri in anchors for one in facts.anchors("on", iri)}
        chosen = [iri for iri in facts.sorted(found) if (what is None or iri in what.iris) and iri not in anchors]
        if name == "near" and what is not None and what.iris and not chosen and anchors:
            chosen, note = self._nearest_within_reach(what.iris, anchors)
        if not chosen and what is not None and not is_any:
            self._check_placed(what.iris)
        return chosen, note

    def _check_placed(self, iris: Sequence[str]) -> None:
        """Check that the place of some things is known, so that they may be said to be elsewhere.

        Raises:
            GraphError: none of them has a box.
        """
        if iris and all(self._facts.body(iri).lower is None for iri in iris):
            raise GraphError(f"not known: the graph has no place of {join_few([*map(self._facts.label, iris)])}")

    def _nearest_within_reach(self, iris: Sequence[str], anchors: Sequence[str]) -> tuple[list[str], str]:
        """Return the nearest of some things, if it is within reach, and the note that says how far it is."""
        gaps = BodyMeasures(self._facts).gaps((iri for iri in iris if iri not in anchors), anchors)
        nearest = self._facts.sorted(nearest_of(gaps))
        if not nearest or gaps[nearest[0]] > DIRECTIONS.reach:
            return [], ""
        return nearest, f" ({self._text(gaps[nearest[0]], 'm')} away)"

    def _fixed_to(self, anchors: Sequence[str], *, with_parts: bool) -> set[str]:
        """Return what is fixed to things or to parts of them, and these parts on request."""
        parts = find_parts(self._facts, anchors)
        fixed = find_related(self._facts, "attached", [*anchors, *parts], is_direct=True)
        return fixed | parts if with_parts else fixed

    def _anchors(self, relation: str, text: str) -> Things:
        """Return the things that a relation leads to; none for a part of the scene.

        Raises:
            GraphError: there are none.
        """
        noun = " ".join(split_phrase(text))
        if relation == "inside" and self._nouns.is_whole_scene(noun):
            return Things((), noun)
        if relation == "inside" and self._nouns.lacks_room(noun):
            raise GraphError(Things((), noun).absence)
        try:
            things = self._nouns.find(text)
        except UnknownWordError:
            if relation == "inside" and self._nouns.in_area(text):
                return Things((), text)
            raise
        self._things.check_kind(things)
        if relation == "inside" and self._nouns.is_area(text, things.iris):
            return Things((), noun)
        if not things.iris and not (relation == "inside" and self._nouns.in_area(text)):
            raise GraphError(things.absence)
        return things

    def _by_relation(self, name: str, text: str, anchors: Things, *, is_direct: bool) -> set[str]:
        if name == "below" or name in _BY_BOXES:
            return self._of_anchors(name, anchors, is_direct=is_direct)
        found = self._nouns.around(name, text, is_direct=is_direct)
        if name == "on" and self._is_open_storage(anchors):
            found |= self._nouns.around("inside", text, is_direct=is_direct)
        return found

    def _of_anchors(self, name: str, anchors: Things, *, is_direct: bool) -> set[str]:
        """Return the objects that the graph states to be in a relation to others."""
        if name in _BY_BOXES:
            return find_related(self._facts, name, anchors.iris, is_direct=is_direct)
        found = self._nouns.in_relation(name, anchors.iris, is_direct=is_direct)
        if name == "on" and self._is_open_storage(anchors):
            found |= self._nouns.in_relation("inside", anchors.iris, is_direct=is_direct)
        return found

    def _by_boxes(self, name: str, anchors: Sequence[str]) -> tuple[set[str], str]:
        """Return what is above or beside things by their boxes, and the note that says so.

        Raises:
            GraphError: the boxes do not say what is beside them.
        """
        if name == "above":
            return {iri for anchor in anchors for iri in find_above(self._facts, anchor)}, ""
        found = [find_beside(self._facts, name, iri) for iri in anchors]
        if any(one is None for one in found):
            named = join_few([*map(self._facts.label, anchors)])
            raise GraphError(f"not known: the graph has no viewpoint, and the boxes around {named} suggest none")
        note = " (by boxes, as seen from among the surrounding objects)"
        return {iri for one in found for iri in one or ()}, note

    def _between(self, thing: str, other: str, kind: str = "things") -> InterpretedAnswer:
        first, second = self._nouns.existing(thing), self._nouns.existing(other)
        pairs = [(one, two) for one in first.iris for two in second.iris if one != two]
        if len(pairs) != 1:
            raise GraphError(f"{thing!r} and {other!r} are {len(pairs)} pairs of things; expected the name of one each")
        between = find_between(self._facts, *pairs[0])
        if between is None:
            raise GraphError(f"not known: the graph has no boxes for {first.text} and {second.text}")
        if not self._nouns.is_everything(kind):
            of_kind = set(self._nouns.existing(kind).iris)
            between = [iri for iri in between if iri in of_kind]
        verb = "is" if len(between) < 2 else "are"
        named = name_things(self._facts, between) or "nothing"
        sentence = f"{named} {verb} between {self._things.the(first)} and {self._things.the(second)}."
        understood = f"things between {first.text} and {second.text}"
        return InterpretedAnswer(understood, self._things.located(between), sentence=begin_sentence(sentence))

    def _is_open_storage(self, things: Things) -> bool:
        """Return whether things have boards above each other, so that what is on a board is inside them."""
        nouns = word_set("assistant", "open_storage")
        return bool(things.iris) and all(self._facts.kind(iri).split()[-1] in nouns for iri in things.iris)
