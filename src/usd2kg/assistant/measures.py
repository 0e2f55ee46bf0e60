"""Answers about numbers and looks: sizes, masses, distances, colours, materials, places, confidence."""

from collections.abc import Callable

import numpy as np

from usd2kg.assistant.body_measures import MASS, MEASURES, SIZE, BodyMeasures
from usd2kg.assistant.free_places import find_free_places
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few, join_words, name_things, number_text
from usd2kg.assistant.settings import PLACING
from usd2kg.errors import GraphError
from usd2kg.knowledge import word_map, word_set
from usd2kg.query.lookup import Nouns, SceneFacts, UnknownWordError
from usd2kg.query.lookup.colors import COLORS, has_color, has_material, is_material, material_words, own_colors
from usd2kg.query.settings import WORDS

__all__ = ["MeasureAnswers"]

Handler = Callable[..., InterpretedAnswer]


_WITH_MATERIAL = "?s u2k:material []"
_COLORED = "{ ?s u2k:color [] } UNION { ?s usd:hasColor/usd:primvars_displayColor [] }"


class MeasureAnswers:
    """Answers to questions about numbers and looks."""

    def __init__(self, facts: SceneFacts, nouns: Nouns) -> None:
        self._facts = facts
        self._nouns = nouns
        self._bodies = BodyMeasures(facts)

    def find(self, question: str) -> Handler | None:
        """Return the method that answers a question type; None if it is another's."""
        handlers: dict[str, Handler] = {
            "measure": self._measure,
            "weigh": lambda thing: self._measure(thing, "heavy"),
            "distance": self._distance,
            "color": self._color,
            "material": self._material,
            "are-color": self._are_like,
            "are-kind": self._are_kind,
            "purpose": self._purpose,
            "put": self._put,
            "openable": self._openable,
            "sure": self._sure,
            "unknown": self._unknown,
        }
        return handlers.get(question)

    def _measure(self, thing: str, adjective: str = "size") -> InterpretedAnswer:
        things, measure = self._nouns.existing(thing), MEASURES[adjective.lower()]
        values = self._bodies.values(things.iris, measure)
        if not values:
            raise self._bodies.unmeasured(things, measure)
        facts = self._facts
        parts = []
        for iri, value in values.items():
            extents = facts.body(iri).extents
            if measure is SIZE and extents is not None:
                sides = " × ".join(f"{side:.2f}" for side in reversed(extents))
                parts.append(f"{facts.label(iri)} measures {sides} m")
            elif measure is MASS:
                parts.append(f"{facts.label(iri)} weighs {number_text(value, 'kg')}")
            else:
                parts.append(f"{facts.label(iri)} is {number_text(value, 'm')} {measure.name}")
        column = {f"{'mass_kg' if measure is MASS else f'{measure.name}_m'}": values}
        sentence = f"{join_few(parts)}{things.suffix}."
        return InterpretedAnswer(
            f"how {measure.name}: {things.text}",
            facts.table(values, **column),
            number=next(iter(values.values())),
            sentence=sentence,
        )

    def _distance(self, thing: str, other: str) -> InterpretedAnswer:
        first, second = self._nouns.existing(thing), self._nouns.existing(other)
        gaps = self._bodies.gaps(first.iris, second.iris)
        if not gaps:
            raise GraphError(f"not known: the graph has no boxes for {first.text} and {second.text}")
        facts = self._facts
        parts = [f"{facts.label(iri)} is {number_text(gap, 'm')} from {second.text}" for iri, gap in gaps.items()]
        sentence = f"{join_few(parts)}, from side to side{first.suffix}{second.suffix}."
        table = facts.table(sorted(gaps, key=lambda iri: gaps[iri]), gap_m=gaps)
        return InterpretedAnswer(
            f"the gap between {first.text} and {second.text}, in metres",
            table,
            number=min(gaps.values()),
            sentence=sentence,
        )

    def _color(self, thing: str) -> InterpretedAnswer:
        things, facts = self._nouns.existing(thing), self._facts
        colors = {iri: ", ".join(own_colors(facts, iri)) for iri in things.iris if own_colors(facts, iri)}
        if not colors:
            raise GraphError(f"not known: the graph has no colour for {things.text}{things.suffix}")
        parts = [
            f"{facts.label(iri)} is {color}{f' ({source})' if (source := facts.color_source(iri)) else ''}"
            for iri, color in colors.items()
        ]
        return InterpretedAnswer(
            f"colour of {things.text}",
            facts.table(colors, color=colors),
            sentence=f"{join_few(parts)}{things.suffix}.",
        )

    def _material(self, thing: str) -> InterpretedAnswer:
        things, facts = self._nouns.existing(thing), self._facts
        found = {iri: ", ".join(facts.materials(iri)) for iri in things.iris if facts.materials(iri)}
        if not found:
            raise GraphError(f"not known: the graph has no material for {things.text}{things.suffix}")
        parts = []
        for iri, names in found.items():
            words = material_words(facts, iri)
            parts.append(
                f"{facts.label(iri)} is made of {join_words(words)} ({names})"
                if words
                else f"{facts.label(iri)}: {names}"
            )
        return InterpretedAnswer(
            f"material of {things.text}",
            facts.table(found, material=found),
            sentence=f"{join_few(parts)}{things.suffix}. The names of materials say how things look.",
        )

    def _are_like(self, kind: str, adjective: str) -> InterpretedAnswer:
        """Return the things of a colour, a material, or another kind."""
        things, facts, word = self._nouns.existing(kind), self._facts, adjective.lower()
        if word in COLORS:
            if not facts.count(_COLORED):
                raise GraphError("not known: the graph has no colours")
            chosen = [iri for iri in things.iris if has_color(facts, iri, word)]
        elif is_material(word):
            if not facts.count(_WITH_MATERIAL):
                raise GraphError("not known: the graph has no materials")
            chosen = [iri for iri in things.iris if has_material(facts, iri, word)]
        else:
            kinds = set(self._nouns.find(adjective).iris)
            chosen = [iri for iri in things.iris if iri in kinds]
        sentence = begin_sentence(f"{name_things(facts, chosen) if chosen else f'no {things.text}'}: {word}.")
        return InterpretedAnswer(f"{things.text} that are {word}", facts.table(chosen), sentence=sentence)

    def _are_kind(self, kind: str) -> InterpretedAnswer:
        word = kind.lower().split()[-1]
        if word in COLORS or is_material(word):
            return self._are_like("things", word)
        things = self._nouns.find(kind)
        sentence = begin_sentence(f"{name_things(self._facts, things.iris) or f'no {things.text}'}.")
        return InterpretedAnswer(f"all {things.text}", self._facts.table(things.iris), sentence=sentence)

    def _purpose(self, kind: str) -> InterpretedAnswer:
        """Return the things for a purpose: those of the kinds that the purpose names."""
        word = word_map("assistant", "purpose_verbs").get(kind.lower(), kind.lower())
        found: set[str] = set()
        known = False
        for noun in sorted(word_set("assistant", "purpose_nouns")):
            try:
                found.update(self._nouns.find(f"{word} {noun}").iris)
                known = True
            except UnknownWordError:
                continue
        if not known:
            raise UnknownWordError(f"{kind!r} is not understood as a purpose")
        chosen = self._facts.sorted(found)
        sentence = f"{name_things(self._facts, chosen) or 'nothing'} {'is' if len(chosen) == 1 else 'are'} for {word}."
        return InterpretedAnswer(f"things for {word}", self._facts.table(chosen), sentence=begin_sentence(sentence))

    def _put(self, thing: str) -> InterpretedAnswer:
        things, facts = self._nouns.find(thing), self._facts
        sizes = [facts.body(iri) for iri in things.iris]
        body = next((one for one in sizes if one.lower is not None), None)
        if body is None or body.lower is None or body.upper is None:
            raise GraphError(f"not known: the graph has no box for {things.text}, so its size is unknown")
        width, depth, height = (float(side) for side in body.upper - body.lower)
        floors = set(self._nouns.find("floor").iris)
        surfaces = [
            iri for iri in facts.things if iri in facts.supporters and iri not in things.iris and iri not in floors
        ]
        usual = {iri for noun in sorted(word_set("assistant", "surface_nouns")) for iri in self._nouns.find(noun).iris}
        found = find_free_places(facts, (width, depth, height), surfaces, things.iris)
        # A seat and a rug are level too, but people put things on tables.
        places = ([place for place in found if place.surface in usual] or found)[: PLACING.max_places]
        if not places:
            sentence = f"No level top has room for {things.text} ({width:.2f} × {depth:.2f} m)."
            return InterpretedAnswer(f"where to put {things.text}", facts.table(()), sentence=sentence)
        spots = {place.surface: " ".join(f"{value:g}" for value in place.position) for place in places}
        first = places[0]
        x, y, z = first.position
        rest = f"; also on {join_words([facts.label(one.surface) for one in places[1:]])}" if len(places) > 1 else ""
        sentence = begin_sentence(
            f"{things.text} ({width:.2f} × {depth:.2f} m) has room on the {facts.kind(first.surface)} "
            f"{facts.label(first.surface)}, at ({x:g}, {y:g}, {z:g}) m{rest}."
        )
        paths = tuple(facts.path(place.surface) for place in places)
        table = facts.table(spots, center_m=spots)
        return InterpretedAnswer(f"where to put {things.text}", table, sentence=sentence, places=paths)

    def between_legs(self, anchor: str) -> list[str]:
        """Return what is below the top of a thing and over its footprint, and neither on, in nor a part of it.

        The box of a table begins at its feet, so nothing is below that box.
        """
        facts, table = self._facts, self._facts.bodies.table
        body = facts.body(anchor)
        if body.lower is None or body.upper is None:
            return []
        middle = (table.lower[:, :2] + table.upper[:, :2]) / 2
        is_over = ((middle > body.lower[:2]) & (middle < body.upper[:2])).all(axis=1)
        is_lower = (table.upper[:, 2] < body.upper[2]) & (table.lower[:, 2] >= body.lower[2] - PLACING.step)
        own = {
            anchor,
            *self._nouns.related("on", [anchor], is_direct=False),
            *self._nouns.related("inside", [anchor], is_direct=False),
        }
        own |= self._nouns.related("part", [anchor], is_direct=True)
        return [iri for row in np.flatnonzero(is_over & is_lower).tolist() if (iri := table.iris[row]) not in own]

    def _openable(self) -> InterpretedAnswer:
        facts = self._facts
        by_joint = facts.opened_by_joint & set(facts.things)
        if by_joint:
            chosen = facts.sorted(by_joint)
            return InterpretedAnswer(
                "what a joint opens",
                facts.table(chosen),
                sentence=begin_sentence(f"{name_things(facts, chosen)} can be opened."),
            )
        found: set[str] = set()
        for noun in word_set("assistant", "closed_things"):
            found.update(self._nouns.find(noun).iris)
        chosen = facts.sorted(found)
        sentence = f"By what they are, since the stage has no joints: {name_things(facts, chosen) or 'nothing'}."
        return InterpretedAnswer("things that open", facts.table(chosen), sentence=sentence)

    def _sure(self, thing: str, kind: str) -> InterpretedAnswer:
        things, facts = self._nouns.existing(thing), self._facts
        what = set(self._nouns.find(kind).iris)
        sure = facts.confidences(things.iris)
        parts = []
        for iri in things.iris:
            labels = join_words(facts.class_labels(iri))
            share = f", {100 * sure[iri]:.0f} % sure" if iri in sure else ""
            other = "" if iri in what else f", not as {kind}"
            parts.append(f"{facts.label(iri)} was classified as {labels or 'nothing'}{share}{other}")
        return InterpretedAnswer(
            f"confidence that {things.text} is {kind}",
            facts.table(things.iris, confidence=sure),
            all(iri in what for iri in things.iris),
            number=next(iter(sure.values()), None),
            sentence=f"{join_few(parts)}.",
        )

    def _unknown(self) -> InterpretedAnswer:
        facts = self._facts
        things = facts.things
        sure = facts.confidences(things)
        unsure = [iri for iri in things if sure.get(iri, 0.0) < WORDS.min_confidence]
        masses = len(self._bodies.values(things, MASS))
        parts = [f"{len(unsure)} of {len(things)} objects have no class or a doubtful one"]
        materials, colors = facts.count(_WITH_MATERIAL), facts.count(_COLORED)
        for known, name in ((masses, "mass"), (materials, "material"), (colors, "colour")):
            if known < len(things):
                parts.append(f"{len(things) - known} lack a {name}" if known else f"no object has a {name}")
        if not facts.has_joints:
            parts.append("there are no joints")
        table = facts.table(unsure, confidence=sure)
        return InterpretedAnswer("what is not known", table, sentence=begin_sentence(f"{'; '.join(parts)}."))
