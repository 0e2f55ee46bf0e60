"""Modifiers: parses of what restricts a noun from behind, and of what predicates share with that."""

from collections.abc import Callable
from dataclasses import replace

from usd2kg.assistant.composition.filters import EVERYTHING, Filters, both, negated
from usd2kg.assistant.composition.groups import ANY, EACH, NO, Filter, Group, Quantity, exactly
from usd2kg.assistant.composition.noun_phrases import NEAREST, FilterParses, NounPhrases
from usd2kg.assistant.composition.words import BE, Words, is_function_word
from usd2kg.knowledge import word_set
from usd2kg.query.lookup import Nouns, Things
from usd2kg.query.lookup.body_measures import COMPARED, MEASURES, SIZE, Measure
from usd2kg.query.lookup.colors import COLORS, is_material

__all__ = ["Modifiers"]

_EXISTENTIAL, _DEFINITE = word_set("grammar", "existential"), word_set("grammar", "definite")
_EXCLUSIONS, _PLACED = word_set("grammar", "exclusions"), word_set("grammar", "place_verbs")
_MODALS, _MOVING = word_set("grammar", "modals"), word_set("grammar", "moving_verbs")
_HOLDING, _PEOPLE = word_set("grammar", "holding_verbs"), word_set("grammar", "people")
_RELATIVE = frozenset(["that", "which", "who"])
_EMPTY = word_set("query", "empty_adjectives")
_LIMITS = {"more than": 1, "over": 1, "at least": 1, "less than": -1, "under": -1, "at most": -1}
"""Words before an amount, and 1 if it is a lower limit."""
_DISTANCES = frozenset(["within", "closer than", "less than", "more than", "further than"])
_MAX_PLACE = 3
"""Words of the name of a part of the scene."""
_MAX_ABLE = 5
"""Words of a clause about what can be moved."""


class Modifiers:
    """Parses modifiers of one question."""

    def __init__(self, words: Words, phrases: NounPhrases, nouns: Nouns, filters: Filters) -> None:
        self._words, self._word = words, words.word
        self._phrases = phrases
        self._nouns = nouns
        self._filters = filters
        self.predicates: Callable[[int], FilterParses] = lambda _: iter(())
        """Parses what is said about things, for relative clauses."""
        phrases.modifier = self.parse

    def parse(self, at: int, *, is_all: bool = False) -> FilterParses:
        """Parse what follows a noun and restricts it; `is_all` after everything, also what is on or in other things."""
        word = self._word(at)
        if word == ",":
            if self._word(at + 1) in _RELATIVE:
                yield from self.parse(at + 1)
            elif (end := self._words.after(at + 1, _EXCLUSIONS)) > at + 1:
                yield from self._excluded(end)
        elif word in _RELATIVE:
            yield from self.predicates(at + 1)
        elif word == "where":
            yield from self._where(at + 1)
        elif (end := self.able(at)) > at:
            yield self._filters.movable(self._word(end - 1)), end
        elif word == "not":
            for one, end in self.parse(at + 1):
                yield negated(one), end
        elif (end := self._words.after(at, _EXCLUSIONS)) > at:
            yield from self._excluded(end)
        else:
            yield from self.place(at, is_all=is_all)
            yield from self._having(at)
            yield from self.comparison(at)
            yield from self._made(at)
            yield from self._of(at)

    def able(self, at: int) -> int:
        """Return the end of a clause about what can be moved: I can open, can be turned; its begin without one."""
        words = [self._word(place) for place in range(at, at + _MAX_ABLE)]
        for start in range(_MAX_ABLE - 1):
            if words[start] not in _MODALS:
                continue
            # I can; can I, can my robot, can be.
            before, after = words[:start], words[start + 1 :]
            if before and before[-1] not in {*_PEOPLE, "robot"}:
                return at
            end = start + 1
            while end < _MAX_ABLE and words[end] in {*_PEOPLE, *_DEFINITE, "a", "robot", "be"}:
                end += 1
            if words[end : end + 1] and words[end] in _MOVING and (before or after):
                return at + end + 1
        return at

    def _where(self, at: int) -> FilterParses:
        """Parse the place where something is: the table where the scale stands."""
        for group, end in self._phrases.parse(at):
            if self._word(end) in BE | _PLACED:
                after = end + 1 + (self._word(end) in BE and self._word(end + 1) in _PLACED)
                yield self._filters.carrying("on", group), after

    def _excluded(self, at: int) -> FilterParses:
        for group, end in self._phrases.parse(at):
            yield self._filters.excluding(group), end

    def place(self, at: int, *, is_all: bool = False) -> FilterParses:
        """Parse where things are: on the table, standing in the fridge, within 2 m of it, nearest to the door."""
        start = at
        if self._word(at) in _PLACED:
            at += 1
        is_direct = self._word(at) in {"directly", "immediately"}
        at += is_direct
        for relation, end in self._words.relation(start, at):
            yield from self._place_in(relation, end, is_direct=is_direct, is_all=is_all)
        word = self._word(at)
        if word in NEAREST:
            end = at + 1 + (self._word(at + 1) in {"one", "ones"})
            for other, after in self._phrases.parse(end + 1) if self._word(end) in {"to", "from"} else ():
                yield self._filters.nearest(other, NEAREST[word]), after
        if word == "between":
            yield from self._between(at + 1)
        if (limit := self._words.after(at, _DISTANCES)) > at:
            yield from self._within(at, limit)

    def _place_in(self, relation: str, at: int, *, is_direct: bool, is_all: bool) -> FilterParses:
        if self._word(at) == "top" and relation == "on":
            # A hat on top is on what has it, not on a thing with that name.
            return
        if (same := self._same(at)) is not None:
            yield from self._same_place(relation, same)
        for group, end in self._phrases.parse(at):
            text = group.text
            if group.quantity is not None and group.quantity != ANY and not group.is_definite:
                # On each table, on no table: how many is not about the things that are there.
                continue
            is_plain = relation == "inside" and not group.filters
            if is_plain and self._nouns.lacks_room(text):
                missing = replace(group, noun=Things((), text))
                yield self._filters.related(relation, missing), end
            elif is_plain and self._phrases.is_scene(group):
                yield EVERYTHING, end
            elif is_plain and (area := self._area(group)):
                yield self._filters.of_area(area), end
            else:
                yield self._filters.related(relation, group, is_direct=is_direct, is_all=is_all), end
            if not group.noun.iris and " of " in text and (whole := self._nouns.whole_of(text)) is not None:
                # On the ledge of the whiteboard, which is no object of its own.
                meant = Group(whole, text, guesses=(whole.note,), cost=group.cost)
                yield self._filters.related(relation, meant, is_direct=is_direct, is_all=is_all), end
        yield from self._areas(relation, at)

    def _area(self, group: Group) -> set[str]:
        """Return what is in a place that is no thing, or is named after one; nothing for other nouns."""
        is_area = not group.noun.iris or self._nouns.is_area(group.text, group.noun.iris)
        return self._nouns.in_area(group.text) if is_area else set()

    def _areas(self, relation: str, at: int) -> FilterParses:
        """Parse a part of the scene that is no thing: in the reception area."""
        start = at + (self._word(at) in _DEFINITE)
        for end in range(min(len(self._words), start + _MAX_PLACE), start, -1):
            text = self._words.text(start, end)
            if relation != "inside" or any(map(is_function_word, self._words[start:end])):
                continue
            if self._nouns.lacks_room(text):
                continue
            if self._nouns.is_whole_scene(text.lower()):
                yield EVERYTHING, end
            elif (area := self._nouns.in_area(text)) and not any(
                group.noun.iris for group, last in self._phrases.parse(at) if last == end
            ):
                yield self._filters.of_area(area), end

    def _same(self, at: int) -> int | None:
        end = at + (self._word(at) in {"the", "one"})
        return end + 1 if self._word(end) == "same" else None

    def _same_place(self, relation: str, at: int) -> FilterParses:
        for places, end in self._phrases.joined(at):
            if self._word(end) not in {"as", "like"}:
                # They hang on the same wall.
                yield self._filters.together(relation, places), end
            for other, after in self._phrases.parse(end + 1) if self._word(end) in {"as", "like"} else ():
                yield self._filters.same_place(relation, places, other), after

    def _between(self, at: int) -> FilterParses:
        for first, end in self._phrases.parse(at):
            if first.quantity in {EACH, exactly(2)} or (first.is_definite and first.is_plural and not first.is_joined):
                # Between the two nightstands.
                yield self._filters.between(first, first), end
            for second, after in self._phrases.parse(end + 1) if self._word(end) == "and" else ():
                yield self._filters.between(first, second), after

    def _within(self, at: int, end: int) -> FilterParses:
        amount = self._words.amount(end)
        is_beyond = self._word(at) in {"more", "further"}
        if amount is None or amount[1] != "m":
            return
        after = amount[2] + (self._word(amount[2]) == "away")
        if self._word(after) in {"of", "from", "to", "around"}:
            for other, last in self._phrases.parse(after + 1):
                yield self._filters.within(other, amount[0], is_beyond=is_beyond), last

    def _having(self, at: int) -> FilterParses:
        """Parse what things have: with a lid, without books on it, holding two cups."""
        word = self._word(at)
        if word == "without":
            yield from self.owned(at + 1, is_denied=True)
        elif word == "with" or word in _HOLDING:
            yield from self.owned(at + 1)

    def owned(self, at: int, *, is_denied: bool = False) -> FilterParses:
        """Parse the object of having: two screens, neither a glass nor a plate, no books on them."""
        yield from self._either(at, is_denied=is_denied)
        most = at + (self._word(at) == "the")
        most = most + 1 if self._word(most) in {"more", "most"} and self._word(most + 1) != "than" else at
        start = at + 1 if is_denied and self._word(at) in _EXISTENTIAL else most
        start += self._word(start) == "both"
        for group, end in self._phrases.parse(start):
            if group.is_joined:
                continue
            yield self._owns(group, end, is_most=most > at, is_denied=is_denied)
            link = end + (self._word(end) == ",")
            if self._word(link) in {"and", "but", "or"}:
                # A cup and a plate on it: both.
                for also, after in self._phrases.parse(link + 1):
                    if not also.is_joined:
                        second, last = self._owns(also, after, is_most=False, is_denied=is_denied)
                        back, _ = self.back(after)
                        first, _ = self._owns(group, end, is_most=most > at, is_denied=is_denied, relation=back)
                        yield both(first, second, is_or=(self._word(link) == "or") != is_denied), last

    def _either(self, at: int, *, is_denied: bool) -> FilterParses:
        """Parse neither a glass nor a plate on it; either of them."""
        link = {"neither": "nor", "either": "or"}.get(self._word(at), "")
        for one, end in self._phrases.parse(at + 1) if link else ():
            for other, after in self._phrases.parse(end + 1) if self._word(end) == link else ():
                relation, last = self.back(after)
                first, second = (self._filters.holding(group, ANY, relation) for group in (one, other))
                found = both(first, second, is_or=True)
                yield (negated(found) if link == "nor" or is_denied else found), last

    def _owns(
        self, group: Group, end: int, *, is_most: bool, is_denied: bool, relation: str = ""
    ) -> tuple[Filter, int]:
        back, last = self.back(end)
        wanted = Quantity(1, is_most=True) if is_most else group.quantity or ANY
        if group.is_general and wanted in {NO, ANY}:
            # Without anything, with nothing; but having something.
            empty = self._filters.empty()
            return (empty if is_denied or wanted == NO else negated(empty)), last
        if is_denied:
            return self._filters.without(group, relation or back), last
        return self._filters.holding(group, wanted, relation or back), last

    def back(self, at: int) -> tuple[str, int]:
        """Return the relation that leads back to what has something, and where it ends: on it, in them, on top."""
        at += self._word(at) in _PLACED
        for relation, end in self._words.relation(at, at):
            if self._word(end) in {"it", "them", "itself", "themselves", "top"}:
                return relation, end + 1
            if relation == "on" and self._word(end - 1) == "on" and self._word(end) == "top":
                return relation, end + 1
        return "", at

    def comparison(self, at: int) -> FilterParses:
        """Parse a comparison: taller than the fridge, more than 2 m long, as wide as the table, heavier than 3 kg."""
        word = self._word(at)
        signs = {"more": 1, "less": -1}
        adjective: tuple[Measure, int] | None = COMPARED.get(word)
        end = at + 1
        if adjective is None and word in signs and self._word(at + 1) in MEASURES:
            adjective, end = (MEASURES[self._word(at + 1)], signs[word]), at + 2
        if adjective is not None and self._word(end) == "than":
            measure, sign = adjective
            if (
                (amount := self._words.amount(end + 1)) is not None
                and amount[1] == measure.unit
                and measure is not SIZE
            ):
                yield self._filters.beyond(measure, sign, amount[0]), amount[2]
            for other, after in self._phrases.parse(end + 1):
                yield self._filters.compared(measure, sign, other), after + (self._word(after) in BE)
        yield from self._limit(at)
        if word == "as" and self._word(at + 1) in MEASURES and self._word(at + 2) == "as":
            for other, after in self._phrases.parse(at + 3):
                yield self._filters.equal(MEASURES[self._word(at + 1)], other), after

    def _limit(self, at: int) -> FilterParses:
        """Parse more than 2 m long, at most 1 m wide."""
        end = self._words.after(at, _LIMITS)
        amount = self._words.amount(end) if end > at else None
        measure = MEASURES.get(self._word(amount[2])) if amount is not None else None
        if amount is None or measure is None or measure is SIZE or measure.unit != amount[1]:
            return
        sign = _LIMITS[self._words.text(at, end).lower()]
        yield self._filters.beyond(measure, sign, amount[0], or_equal=self._word(at) == "at"), amount[2] + 1

    def _made(self, at: int) -> FilterParses:
        end = self._words.after(at, {"made of", "made from", "made out of", "of", "in"})
        if end > at and is_material(self._word(end)):
            yield self._filters.like(self._word(end)), end + 1
        if end > at and is_material(self._word(end + 1)) and not is_function_word(self._word(end)):
            # Cast iron, stainless steel.
            note = f"“{self._words.text(end, end + 2)}” was read as “{self._word(end + 1)}”"
            yield self._filters.like(self._word(end + 1))._replace(guesses=(note,), cost=1), end + 2

    def adjective(self, at: int) -> FilterParses:
        """Parse an adjective that stands alone: red, wooden, empty."""
        word = self._word(at)
        if word in _EMPTY:
            yield self._filters.empty(), at + 1
        elif word in COLORS or is_material(word):
            yield self._filters.like(word), at + 1

    def _of(self, at: int) -> FilterParses:
        if self._word(at) == "of":
            for wholes, end in self._phrases.parse(at + 1):
                yield self._filters.part_of(wholes), end
        elif self._word(at) in _PEOPLE and self._word(at + 1) in {"have", "own", "see"}:
            yield EVERYTHING, at + 2
