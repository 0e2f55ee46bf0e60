"""Answers about numbers and looks: sizes, masses, distances, colours, materials, places, confidence."""

from collections.abc import Mapping

import numpy as np

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.free_places import find_free_places, flat_tops, thing_to_place
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, count_phrase, join_few, join_words, name_things, yes_or_no
from usd2kg.assistant.settings import PLACING
from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_map, word_set
from usd2kg.query.body_table import Body
from usd2kg.query.lookup import UnknownWordError
from usd2kg.query.lookup.amounts import read_sides
from usd2kg.query.lookup.body_measures import AREA, ELEVATION, HEIGHT, MASS, MEASURES, SIZE, WIDTH, Measure
from usd2kg.query.lookup.colors import COLORS, has_color, has_material, is_material, material_words, own_colors
from usd2kg.query.lookup.modifiers import restricts
from usd2kg.query.lookup.openable_things import find_openable
from usd2kg.query.lookup.related_things import find_parts
from usd2kg.query.lookup.word_forms import is_plural, split_phrase
from usd2kg.query.settings import WORDS

__all__ = ["MeasureAnswers"]


_OVERHEAD = word_set("assistant", "overhead")
_WITH_MATERIAL = "?s u2k:material []"
_COLORED = "{ ?s u2k:color [] } UNION { ?s usd:hasColor/usd:primvars_displayColor [] }"


class MeasureAnswers(Answers):
    """Answers to questions about numbers and looks."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "measure": self._measure,
            "weigh": lambda thing: self._measure(thing, "heavy"),
            "color": self._color,
            "material": self._material,
            "are-kind": self._are_kind,
            "purpose": self._purpose,
            "put": self._put,
            "openable": self._openable,
            "is-openable": self._is_openable,
            "put-size": self._put_size,
            "where-to": self._where_to,
            "sure": self._sure,
            "unknown": self._unknown,
        }

    def _measure(self, thing: str, adjective: str = "size") -> InterpretedAnswer:
        word = adjective.lower()
        measure = MEASURES[word_map("assistant", "foreign_measures").get(word, word)]
        if measure is SIZE and self._units.is_area:
            measure = AREA
        if measure is not MASS and self._nouns.is_whole_scene(" ".join(split_phrase(thing))):
            return self._measure_scene(thing, measure)
        if self._nouns.is_group(noun := " ".join(split_phrase(thing))):
            raise GraphError(f"not known: the graph has the things in the {noun}, not its walls")
        things = self._nouns.existing(thing)
        facts = self._facts
        if measure is HEIGHT and all(facts.kind(iri) in _OVERHEAD for iri in things.iris):
            # The ceiling is as high as the room below it, not as it is thick.
            measure = ELEVATION
        values = self._bodies.values(things.iris, measure)
        if not values:
            raise self._bodies.unmeasured(things, measure)
        parts = []
        for iri, value in values.items():
            extents = facts.body(iri).extents
            if measure is SIZE and extents is not None:
                parts.append(f"{facts.label(iri)} measures {self._units.sides(extents[::-1])}")
            elif measure is AREA:
                parts.append(f"{facts.label(iri)} covers {self._text(value, measure.unit)}")
            elif measure is MASS:
                parts.append(f"{facts.label(iri)} weighs {self._text(value, 'kg')}{self._mass_with_parts(iri, value)}")
            elif measure is ELEVATION:
                parts.append(f"the underside of {facts.label(iri)} is {self._text(value, 'm')} above the floor")
            else:
                parts.append(f"{facts.label(iri)} is {self._text(value, 'm')} {measure.name}")
        name = {MASS: "mass_kg", ELEVATION: "bottom_m"}.get(measure, f"{measure.name}_m")
        column = {name: values}
        sentence = f"{join_few(parts)}{things.suffix}."
        if measure is ELEVATION:
            sentence = begin_sentence(sentence)
        return InterpretedAnswer(
            f"how {measure.name}: {things.text}",
            facts.table(values, **column),
            number=next(iter(values.values())),
            sentence=sentence,
        )

    def _mass_with_parts(self, iri: str, mass: float) -> str:
        """Return what a thing weighs with its parts, such as the mast of a forklift; empty if none has a mass."""
        parts = self._bodies.values(find_parts(self._facts, [iri]), MASS)
        if not parts:
            return ""
        return f", {self._text(mass + sum(parts.values()), 'kg')} with {count_phrase(len(parts), 'part')}"

    def _measure_scene(self, text: str, measure: Measure) -> InterpretedAnswer:
        """Return a measure of the box around the walls and floors, or around all things if there are none."""
        if measure is AREA and (floors := self._nouns.known("floor")):
            values = self._bodies.values(floors, AREA)
            sentence = f"The floor covers {self._text(sum(values.values()), AREA.unit)}."
            table = self._facts.table(floors, area_m2=values)
            return InterpretedAnswer(f"floor area: {text}", table, number=sum(values.values()), sentence=sentence)
        shells = {iri for noun in ("floor", "wall") for iri in self._nouns.known(noun)}
        bodies = [self._facts.body(iri) for iri in shells or self._facts.things]
        lower = [body.lower for body in bodies if body.lower is not None]
        upper = [body.upper for body in bodies if body.upper is not None]
        if not lower:
            raise GraphError("not known: the graph has no boxes")
        start, end = np.min(lower, axis=0), np.max(upper, axis=0)
        x, y, z = (float(side) for side in end - start)
        shortest, middle, longest = sorted((x, y, z))
        value = measure.of(Body(start, end, (shortest, middle, longest), None))
        # A wardrobe is as wide as its front; a hall is longer than wide.
        value = min(x, y) if measure is WIDTH else value
        of = "walls and floors" if shells else "all things"
        sentence = f"The {of} of the scene measure {self._units.sides((x, y, z))} along x, y and z."
        return InterpretedAnswer(
            f"how {measure.name}: {text}",
            self._facts.table(self._facts.sorted(shells)),
            number=value,
            sentence=sentence,
        )

    def _color(self, thing: str, **_: str) -> InterpretedAnswer:
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
        elif restricts(word):
            chosen = [*self._nouns.find(f"{word} {kind}").iris]
        else:
            kinds = set(self._nouns.find(adjective).iris)
            chosen = [iri for iri in things.iris if iri in kinds]
        named = name_things(facts, chosen) if chosen else f"no {things.text}"
        verb = "are" if len(chosen) > 1 or (not chosen and is_plural(things.text)) else "is"
        sentence = begin_sentence(f"{named} {verb} {word}.")
        return InterpretedAnswer(
            f"{things.text} that are {word}", facts.table(chosen), number=len(chosen), sentence=sentence
        )

    def _are_kind(self, kind: str) -> InterpretedAnswer:
        word = kind.lower().split()[-1]
        if word in COLORS or is_material(word):
            return self._are_like("things", word)
        things = self._nouns.find(kind, may_shorten=False)
        if not things.iris and not concepts_named(things.text):
            # A monthly rent: words that name things, and together none.
            raise UnknownWordError(f"{things.text!r} is not a thing that the lexicon knows")
        sentence = begin_sentence(f"{name_things(self._facts, things.iris) or f'no {things.text}'}.")
        return InterpretedAnswer(f"all {things.text}", self._facts.table(things.iris), sentence=sentence)

    def _purpose(self, kind: str) -> InterpretedAnswer:
        """Return the things for a purpose: those of the kinds that the purpose names."""
        things, facts = self._nouns.for_purpose(kind), self._facts
        named, use = name_things(facts, things.iris) or "nothing", things.text.removeprefix("things ")
        verb = "can be used" if use.startswith("to ") else "is" if len(things.iris) < 2 else "are"
        sentence = begin_sentence(f"{named} {verb} {use}.")
        return InterpretedAnswer(things.text, facts.table(things.iris), sentence=sentence)

    def _where_to(self, verb: str) -> InterpretedAnswer:
        """Return the things that an activity needs: a sink to wash, a bed to sleep."""
        things = self._nouns.for_purpose(verb)
        if not things.iris:
            raise UnknownWordError(f"{verb!r} is not understood as an activity")
        places = tuple(map(self._facts.path, things.iris))
        sentence = begin_sentence(f"to {verb}: {name_things(self._facts, things.iris)}.")
        return InterpretedAnswer(f"where to {verb}", self._facts.table(things.iris), sentence=sentence, places=places)

    def _put(self, thing: str) -> InterpretedAnswer:
        placed = thing_to_place(self._nouns, self._facts, thing)
        return self._free_tops(placed.text, placed.size, placed.moved)

    def _put_size(self, sides: str) -> InterpretedAnswer:
        return self._free_tops(f"a thing of {sides}", read_sides(sides), ())

    def _free_tops(self, text: str, size: tuple[float, float, float], moved: tuple[str, ...]) -> InterpretedAnswer:
        """Return the level tops with room for a thing of a size in metres; `moved` takes no room."""
        facts, (width, depth, _) = self._facts, size
        floors = self._nouns.floors
        # What stands on the floor, such as a cart, has its place there.
        is_on_floor = bool(moved) and all(floors.intersection(facts.anchors("on", iri)) for iri in moved)
        flat = flat_tops(self._nouns, facts)
        tops = floors if is_on_floor else (facts.supporters | flat) - floors
        surfaces = [iri for iri in facts.things if iri in tops and iri not in moved]
        usual = {iri for noun in sorted(word_set("assistant", "surface_nouns")) for iri in self._nouns.known(noun)}
        found = find_free_places(facts, size, surfaces, moved, flat)
        # A seat and a rug are level too, but people put things on tables.
        places = ([place for place in found if place.surface in usual] or found)[: PLACING.max_places]
        if not places and is_on_floor:
            raise GraphError(f"not known: boxes over the floor leave no spot for {text} ({width:.2f} × {depth:.2f} m)")
        if not places:
            sentence = f"No level top has room for {text} ({width:.2f} × {depth:.2f} m)."
            return InterpretedAnswer(f"where to put {text}", facts.table(()), sentence=sentence)
        spots = {place.surface: " ".join(f"{value:g}" for value in place.position) for place in places}
        first = places[0]
        x, y, z = first.position
        rest = f"; also on {join_words([facts.label(one.surface) for one in places[1:]])}" if len(places) > 1 else ""
        sentence = begin_sentence(
            f"{text} ({width:.2f} × {depth:.2f} m) has room on the {facts.kind(first.surface)} "
            f"{facts.label(first.surface)}, at ({x:g}, {y:g}, {z:g}) m{rest}."
        )
        paths = tuple(facts.path(place.surface) for place in places)
        table = facts.table(spots, center_m=spots)
        return InterpretedAnswer(f"where to put {text}", table, sentence=sentence, places=paths)

    def _openable(self, kind: str = "things", verb: str = "open", action: str = "") -> InterpretedAnswer:
        """Return the things of a kind that a joint moves, or that open by what they are."""
        things, facts = self._nouns.find(kind), self._facts
        found, is_by_kind = find_openable(facts, self._nouns, (action or verb).split()[0].lower())
        if self._nouns.is_everything(kind):
            chosen = facts.sorted(found)
        else:
            # A cabinet is opened by its door.
            chosen = [
                iri for iri in things.iris if iri in found or not found.isdisjoint(find_parts(self._facts, [iri]))
            ]
        named = name_things(facts, chosen) or f"no {things.text}"
        how = "by what they are, since the stage has no joints for them: " if is_by_kind else ""
        sentence = begin_sentence(f"{how}{named} can be opened or moved{things.suffix}.")
        return InterpretedAnswer(f"{things.text} that open", facts.table(chosen), bool(chosen), sentence=sentence)

    def _is_openable(self, thing: str) -> InterpretedAnswer:
        self._nouns.existing(thing)
        found = self._openable(thing)
        sentence = yes_or_no(bool(found.verdict), found.sentence)
        return InterpretedAnswer(f"whether {thing} opens", found.answer, found.verdict, sentence=sentence)

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
