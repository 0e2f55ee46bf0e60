"""Answers that compare things: superlatives, two things, numbers of things, limits, and whether something fits."""

from collections.abc import Mapping
from itertools import product

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.free_places import PlacedThing, find_free_places, flat_tops, thing_to_place
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import (
    begin_sentence,
    count_phrase,
    join_few,
    name_things,
    plural,
    yes_or_no,
)
from usd2kg.errors import GraphError
from usd2kg.query.lookup import UnknownWordError
from usd2kg.query.lookup.amounts import NUMBER_WORDS, read_amount, read_sides
from usd2kg.query.lookup.body_measures import COMPARED, ELEVATION, MASS, SAME, SIZE, SUPERLATIVES, Measure
from usd2kg.query.lookup.word_forms import singular

__all__ = ["ComparisonAnswers"]


class ComparisonAnswers(Answers):
    """Answers that compare things."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "superlative": self._superlative,
            "compare": self._compare,
            "choose": self._choose,
            "more": self._more,
            "limit": self._limit,
            "bigger-things": self._bigger_things,
            "more-than": self._more_than,
            "fits": self._fits,
            "fits-in": self._fits_in,
        }

    def _superlative(self, adjective: str, kind: str = "things", count: str = "1") -> InterpretedAnswer:
        """Return the things that come first by a measure, with those that are equal to the last of them."""
        things = self._nouns.existing(kind)
        measure, sign = {**COMPARED, **SUPERLATIVES}[adjective.lower()]
        values = self._bodies.values(things.iris, measure)
        if not values:
            raise self._bodies.unmeasured(things, measure)
        facts = self._facts
        order = sorted(values, key=lambda iri: (-sign * values[iri], facts.path(iri)))
        last = values[order[: NUMBER_WORDS.get(count.lower()) or int(count)][-1]]
        best = [iri for iri in order if sign * values[iri] >= sign * last]
        known = (
            f" of the {len(values)} whose mass is known" if measure is MASS and len(values) < len(things.iris) else ""
        )
        labels = join_few([facts.label(iri) for iri in best])
        amount = "" if measure is SIZE or count != "1" else f", {self._text(last, measure.unit)}"
        shown = (
            f"The {adjective.lower()} {things.text}"
            if count == "1"
            else f"The {count} {adjective} {plural(things.text)}"
        )
        sentence = f"{shown}{known}: {labels}{amount}{things.suffix}."
        column = {"mass_kg" if measure is MASS else "bottom_m" if measure is ELEVATION else f"{measure.name}_m": values}
        return InterpretedAnswer(
            f"{adjective} {things.text}", facts.table(best, **column), number=last, sentence=sentence
        )

    def _compare(self, thing: str, adjective: str, other: str) -> InterpretedAnswer:
        """Return whether one thing, or each of several, is more of something than another."""
        first, second = self._nouns.existing(thing), self._nouns.existing(other)
        measure, sign = COMPARED[adjective.lower()]
        values = self._bodies.values([*first.iris, *second.iris], measure)
        ranges = []
        for things in (first, second):
            if not values.keys() >= set(things.iris):
                raise self._bodies.unmeasured(things, measure)
            own = [values[iri] for iri in things.iris]
            ranges.append((min(own), max(own)))
        pairs = list(product(*ranges))
        verdicts = {sign * (one - two) > SAME * max(one, two) for one, two in pairs}
        if len(verdicts) > 1:
            named = " and ".join(
                join_few([*map(self._facts.label, things.iris)]) for things in (first, second) if len(things.iris) > 1
            )
            raise GraphError(
                f"not known: some {first.text} are {adjective} than some {second.text}, others are not; "
                f"expected the names of two things; there are {named}"
            )
        (is_more,) = verdicts
        equal = all(abs(one - two) <= SAME * max(one, two) for one, two in pairs)
        how = " against ".join(self._range_text(low, high, measure) for low, high in ranges)
        how += " m³" if measure is SIZE else ""
        said = yes_or_no(is_more, f"{'they are equal' if equal else how}.")
        return InterpretedAnswer(
            f"whether {first.text} is {adjective} than {second.text}", self._facts.table(values), is_more, sentence=said
        )

    def _choose(self, thing: str, adjective: str, other: str) -> InterpretedAnswer:
        """Return which of two things is more of something."""
        first, second = self._nouns.existing(thing), self._nouns.existing(other)
        measure, sign = COMPARED[adjective.lower()]
        values = self._bodies.values([*first.iris, *second.iris], measure)
        ranges = []
        for things in (first, second):
            own = [sign * values[iri] for iri in things.iris if iri in values]
            if not own:
                raise self._bodies.unmeasured(things, measure)
            ranges.append((min(own), max(own)))
        (low, high), (other_low, other_high) = ranges
        if low <= other_high and other_low <= high and (low, high) != (other_low, other_high):
            raise GraphError(f"not known: some {first.text} are {adjective} than some {second.text}, others are not")
        winner = first if low > other_high else second
        is_equal = abs(low - other_low) <= SAME * max(abs(low), abs(other_low))
        numbers = " and ".join(self._text(abs(value), measure.unit) for value in (low, other_low))
        said = "They are equal" if is_equal else f"{winner.text} is {adjective}"
        how = "" if measure is SIZE else f": {numbers}"
        chosen = () if is_equal else winner.iris
        return InterpretedAnswer(
            f"which is {adjective}: {first.text} or {second.text}",
            self._facts.table(chosen),
            sentence=begin_sentence(f"{said}{how}{first.suffix}{second.suffix}."),
        )

    def _more(self, thing: str, adjective: str, other: str) -> InterpretedAnswer:
        """Return whether there are more things of one kind than of another."""
        first, second = self._nouns.find(thing), self._nouns.find(other)
        one, two = len(first.iris), len(second.iris)
        is_so = one > two if adjective.lower() == "more" else one < two
        counts = f"{count_phrase(one, first.text)} and {count_phrase(two, second.text)}"
        return InterpretedAnswer(
            f"whether there are {adjective} {first.text} than {second.text}",
            self._facts.table((*first.iris, *second.iris)),
            is_so,
            sentence=yes_or_no(is_so, f"there are {counts}{first.suffix}{second.suffix}."),
        )

    def _bigger_things(self, adjective: str, thing: str) -> InterpretedAnswer:
        """Return all things that have more or less of something than another."""
        things = self._nouns.find(f"things {adjective.lower()} than {thing}")
        named = name_things(self._facts, things.iris) or "nothing"
        sentence = f"{named} {'is' if len(things.iris) < 2 else 'are'} {adjective} than {thing}."
        return InterpretedAnswer(things.text, self._facts.table(things.iris), sentence=begin_sentence(sentence))

    def _more_than(self, kind: str, adjective: str, count: str) -> InterpretedAnswer:
        """Return whether there are more or fewer things of a kind than a number."""
        dozens = {"a dozen": 12, "dozen": 12}
        limit = (
            dozens.get(count.lower()) or NUMBER_WORDS.get(count.lower()) or (int(count) if count.isdecimal() else None)
        )
        if limit is None:
            raise UnknownWordError(f"{count!r} is not understood as a number")
        things = self._nouns.find(kind)
        many = len(things.iris)
        is_so = many > limit if adjective.lower() == "more" else many < limit
        return InterpretedAnswer(
            f"whether there are {adjective} than {limit} {things.text}",
            self._facts.table(things.iris),
            is_so,
            number=many,
            sentence=yes_or_no(is_so, f"there are {count_phrase(many, singular(things.text))}{things.suffix}."),
        )

    def _limit(self, adjective: str, amount: str, kind: str = "things") -> InterpretedAnswer:
        """Return the things whose measure is above or below an amount."""
        things = self._nouns.existing(kind)
        adjective = {"more": "heavier", "less": "lighter"}.get(adjective.lower(), adjective.lower())
        measure, sign = COMPARED[adjective]
        value, unit = read_amount(amount)
        if measure is SIZE or unit != measure.unit:
            raise GraphError(f"{amount!r} does not measure what is {adjective}; expected a number with {measure.unit}")
        values = self._bodies.values(things.iris, measure)
        if not values:
            raise self._bodies.unmeasured(things, measure)
        chosen = [iri for iri in self._facts.sorted(values) if sign * values[iri] > sign * value]
        known = (
            f" of the {len(values)} whose mass is known" if measure is MASS and len(values) < len(things.iris) else ""
        )
        named = name_things(self._facts, chosen) or f"no {things.text}"
        sentence = f"{named}{known} {'is' if len(chosen) < 2 else 'are'} {adjective} than {self._text(value, unit)}"
        column = {"mass_kg" if measure is MASS else f"{measure.name}_m": values}
        return InterpretedAnswer(
            f"{things.text} {adjective} than {amount}",
            self._facts.table(chosen, **column),
            number=len(chosen),
            sentence=begin_sentence(f"{sentence}{things.suffix}."),
        )

    def _fits(self, other: str, thing: str = "", sides: str = "") -> InterpretedAnswer:
        """Return whether a thing, or a box of some size, has room on others."""
        surfaces, facts = self._nouns.existing(other), self._facts
        if sides:
            placed = PlacedThing(f"a box of {sides}", read_sides(sides), ())
        else:
            placed = thing_to_place(self._nouns, facts, thing)
        name, (width, depth, _), moved = placed
        flat = flat_tops(self._nouns, facts)
        if not any(iri in facts.supporters or iri in flat for iri in surfaces.iris):
            raise GraphError(f"not known: nothing stands on {surfaces.text}, so the height of its top is unknown")
        places = find_free_places(facts, placed.size, surfaces.iris, moved, flat)
        spots = {place.surface: " ".join(f"{value:g}" for value in place.position) for place in places}
        size = f" ({width:.2f} × {depth:.2f} m)"
        if places:
            x, y, z = places[0].position
            where = f"room for {name}{size} on {facts.label(places[0].surface)}, at ({x:g}, {y:g}, {z:g}) m"
        else:
            where = f"no room for {name}{size} on {surfaces.text}"
        sentence = yes_or_no(bool(places), f"there is {where}{surfaces.suffix}.")
        understood = f"whether {name} fits on {surfaces.text}"
        return InterpretedAnswer(understood, facts.table(spots, center_m=spots), bool(places), sentence=sentence)

    def _fits_in(self, thing: str, other: str) -> InterpretedAnswer:
        """Return whether a thing fits into others by their outer sizes, turned in any way."""
        things, holders = self._nouns.existing(thing), self._nouns.existing(other)
        sizes = [self._facts.body(iri).extents for iri in things.iris]
        spaces = {iri: self._facts.body(iri).extents for iri in holders.iris}
        if None in sizes or None in spaces.values():
            raise GraphError(f"not known: the graph has no box for some of {things.text} and {holders.text}")
        # Extents are in ascending order.
        wide = [
            iri
            for iri, space in spaces.items()
            for size in sizes
            if size and space and all(map(float.__lt__, size, space))
        ]
        found = next(iter(wide), holders.iris[0])
        smaller = self._units.sides((sizes[0] or ())[::-1])
        larger = self._units.sides((spaces[found] or ())[::-1])
        said = f"{things.text} measures {smaller}, {self._facts.label(found)} {larger} on the outside"
        return InterpretedAnswer(
            f"whether {things.text} fits into {holders.text}",
            self._facts.table(dict.fromkeys(wide)),
            bool(wide),
            sentence=yes_or_no(bool(wide), f"{said}{things.suffix}{holders.suffix}."),
        )

    def _range_text(self, low: float, high: float, measure: Measure) -> str:
        """Return a range of measures: 31 cm, 31 cm to 1.2 m; sizes without their unit, m³."""
        ends = [f"{end**3:.3g}" if measure is SIZE else self._text(end, measure.unit) for end in (low, high)]
        return " to ".join(dict.fromkeys(ends))
