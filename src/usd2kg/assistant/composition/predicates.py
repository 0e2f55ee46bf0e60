"""Predicates: parses of what a sentence says about its subject, after the subject."""

from collections.abc import Callable

from usd2kg.assistant.composition.filters import Filters, both, negated, then
from usd2kg.assistant.composition.groups import ANY, Filter
from usd2kg.assistant.composition.modifiers import Modifiers
from usd2kg.assistant.composition.noun_phrases import FilterParses, NounPhrases
from usd2kg.assistant.composition.words import BE, DO, Words
from usd2kg.knowledge import word_set
from usd2kg.query.lookup.body_measures import MASS

__all__ = ["Predicates"]

_EXCLUSIONS = word_set("grammar", "exclusions")
_HOLDING, _PLACED = word_set("grammar", "holding_verbs"), word_set("grammar", "place_verbs")
_PART_OF = frozenset(["a part of", "part of", "parts of", "a component of"])
_HAVING = frozenset(["has", "have", "had"])
_WEIGHING = frozenset(["weigh", "weighs", "weighing"])


class Predicates:
    """Parses predicates of one question: is on the table, has two drawers, stands there, weighs more than 2 kg."""

    def __init__(self, words: Words, phrases: NounPhrases, modifiers: Modifiers, filters: Filters) -> None:
        self._words, self._word = words, words.word
        self._phrases = phrases
        self._modifiers = modifiers
        self._filters = filters
        modifiers.predicates = self.parse

    def parse(self, at: int) -> FilterParses:
        """Parse a predicate with its verb, and those that are joined to it."""
        yield from self.joined(self._single, at)

    def joined(self, reader: Callable[[int], FilterParses], at: int) -> FilterParses:
        """Parse a predicate by a method, and those that are joined to it."""
        for one, end in reader(at):
            yield from self._joined(one, end, at)

    def _joined(self, one: Filter, end: int, at: int) -> FilterParses:
        yield one, end
        link = end + (self._word(end) == ",")
        if (start := self._words.after(link, _EXCLUSIONS)) > link:
            for group, last in self._phrases.parse(start):
                yield then(one, self._filters.excluding(group)), last
        if self._word(link) not in {"and", "or", "but"}:
            return
        after, is_or = link + 1, self._word(link) == "or"
        # On the table and red; is on the table and has a lid.
        readers = [self.parse]
        if self._word(at) in BE:
            readers.append(self.complement)
        for reader in readers:
            for other, last in reader(after):
                yield both(one, other, is_or=is_or), last

    def _single(self, at: int) -> FilterParses:
        word = self._word(at)
        if word in BE:
            yield from self.complement(at + 1)
        elif word in DO:
            is_denied = self._word(at + 1) == "not"
            for one, end in self.verb(at + 1 + is_denied):
                yield (negated(one) if is_denied else one), end
        elif (end := self._modifiers.able(at)) > at:
            yield self._filters.movable(self._word(end - 1)), end
        else:
            yield from self.verb(at)

    def verb(self, at: int) -> FilterParses:
        """Parse a verb with what belongs to it, in any form."""
        word = self._word(at)
        if word in _HOLDING:
            is_denied = word in _HAVING and self._word(at + 1) == "not"
            start = at + 1 + is_denied + (self._word(at + 1) == "got")
            for one, end in self._modifiers.owned(start):
                yield (negated(one) if is_denied else one), end
        if word in _PLACED:
            yield from self._modifiers.place(at)
        if word in _WEIGHING:
            yield from self._weighing(at + 1)
        if word in {"lack", "lacks"}:
            yield from self._modifiers.owned(at + 1, is_denied=True)

    def _weighing(self, at: int) -> FilterParses:
        sign = {"more": 1, "less": -1, "over": 1, "under": -1}.get(self._word(at))
        if sign is None:
            return
        start = at + 1 + (self._word(at + 1) == "than")
        if (amount := self._words.amount(start)) is not None and amount[1] == MASS.unit:
            yield self._filters.beyond(MASS, sign, amount[0]), amount[2]
        if self._word(at + 1) == "than":
            for other, end in self._phrases.parse(start):
                yield self._filters.compared(MASS, sign, other), end + (self._word(end) in DO)

    def complement(self, at: int) -> FilterParses:
        """Parse what follows a form of to be: on the table, red, taller than it, the largest, a chair, not empty."""
        if self._word(at) == "not":
            for one, end in self.complement(at + 1):
                yield negated(one), end
            return
        if self._word(at) in {"all", "both", "each"}:
            at += 1
        for one, end in self._each(at):
            yield one, end
            link = end + (self._word(end) == ",")
            if self._word(link) in {"and", "or"}:
                for other, last in self.complement(link + 1):
                    yield both(one, other, is_or=self._word(link) == "or"), last

    def _each(self, at: int) -> FilterParses:
        yield from self._modifiers.place(at)
        yield from self._modifiers.comparison(at)
        yield from self._modifiers.adjective(at)
        yield from self._made(at)
        yield from self._best(at)
        if self._word(at) in _HOLDING:
            yield from self.verb(at)
        if self._word(at) in {"among", "amongst"}:
            for group, end in self._phrases.parse(at + 1):
                yield self._filters.of_kind(group), end
        start = self._words.after(at, _PART_OF)
        if start > at:
            for group, end in self._phrases.parse(start):
                yield self._filters.part_of(group), end
        for group, end in self._phrases.parse(at):
            # A kind has a determiner: is it a chair; are they chairs. A bare noun is a part of the compound before it.
            if not group.is_general and (group.is_plural or group.is_definite or group.quantity == ANY):
                yield self._filters.of_kind(group), end

    def _made(self, at: int) -> FilterParses:
        if self._word(at) == "made":
            yield from self._modifiers.parse(at)

    def _best(self, at: int) -> FilterParses:
        """Parse a superlative without a noun: the largest, the nearest one to the door."""
        start = at + (self._word(at) == "the")
        best = self._words.superlative(start)
        if best is not None:
            measure, sign, end = best
            yield self._filters.most(measure, sign), end + (self._word(end) in {"one", "ones"})
        elif start > at:
            yield from self._modifiers.place(start)
