"""NounPhrases: parses of noun phrases, from determiner to relative clause, that account for every word."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from usd2kg.assistant.composition.filters import Filters
from usd2kg.assistant.composition.groups import ANY, EACH, NO, Filter, Group, Quantity, exactly
from usd2kg.assistant.composition.words import Words, is_function_word, read_number
from usd2kg.assistant.sentences import plural
from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_map, word_set
from usd2kg.query.lookup import Nouns, Things, UnknownWordError
from usd2kg.query.lookup.word_forms import is_place, is_plural, singular

__all__ = ["NEAREST", "FilterParses", "KnownNouns", "NounPhrases"]

FilterParses = Iterator[tuple[Filter, int]]
GroupParses = Iterator[tuple[Group, int]]
"""What words from a place on may mean, and where each reading ends."""
KnownNouns = dict[tuple[str, bool], list[Group]]
"""Noun, and whether it is definite → what it may mean."""

_MAX_NOUN = 6
"""Words of a noun with its adjectives."""
_UNIVERSAL, _EXISTENTIAL = word_set("grammar", "universal"), word_set("grammar", "existential")
_DEFINITE, _GENERAL = word_set("grammar", "definite"), word_map("grammar", "general_things")
_EXCLUSIONS, _PLACED = word_set("grammar", "exclusions"), word_set("grammar", "place_verbs")
_MODALS, _MOVING = word_set("grammar", "modals"), word_set("grammar", "moving_verbs")
_HOLDING, _PEOPLE = word_set("grammar", "holding_verbs"), word_set("grammar", "people")
NEAREST = {"nearest": 1, "closest": 1, "nearer": 1, "closer": 1, "furthest": -1, "farthest": -1}
_QUANTITIES = {
    **dict.fromkeys(_UNIVERSAL, EACH),
    **dict.fromkeys([*_EXISTENTIAL, "either"], ANY),
    **dict.fromkeys(["no", "none", "neither"], NO),
}
_LINKS = {"of", "the"}
_VERBS = _PLACED | _HOLDING
_RELATIVE = frozenset(["that", "which", "who"])
_EMPTY = word_set("query", "empty_adjectives")
_GUESSED, _ABSENT, _WIDER = 4, 2, 1
"""Costs of a noun that is read as another, that the scene lacks, and that is less definite."""


class _Determiner(NamedTuple):
    quantity: Quantity | None
    is_definite: bool
    end: int
    stated: int | None = None
    """How many there are, as the words take for granted: the two cups."""


class NounPhrases:
    """Parses noun phrases of one question."""

    def __init__(
        self, words: Words, nouns: Nouns, filters: Filters, everything: Sequence[str], known: KnownNouns
    ) -> None:
        self._words, self._word = words, words.word
        self._nouns = nouns
        self._filters = filters
        self._everything = tuple(everything)
        self._phrases: dict[int, list[tuple[Group, int]]] = {}
        self._known = known
        self.modifier: Callable[..., FilterParses] = lambda _, **__: iter(())
        """Parses what follows a noun and restricts it, from a word on."""

    def parse(self, at: int) -> list[tuple[Group, int]]:
        """Return all readings of a noun phrase that begins at a word."""
        if at not in self._phrases:
            self._phrases[at] = []
            self._phrases[at] = [*self._parse(at)]
        return self._phrases[at]

    def _parse(self, at: int) -> GroupParses:
        for determiner in self._determiners(at):
            for group, end in self._measured(determiner.end, at):
                meant = group if determiner.quantity is None else replace(group, quantity=determiner.quantity)
                if determiner.stated is not None:
                    meant = meant.keep(self._filters.counted(meant.text, determiner.stated), meant.text)
                yield replace(meant, is_definite=determiner.is_definite or group.is_definite), end

    def _determiners(self, at: int) -> Iterator[_Determiner]:
        """Yield what determines a noun: all the, one of my, at least three, no; nothing in particular without one."""
        quantity, end = self._quantity(at)
        if end > at and self._word(end) == "of":
            # One of the chairs is at least one.
            quantity = ANY if quantity == exactly(1) else quantity
            end += 1
        start = end
        while self._word(end) in _DEFINITE or self._word(end).endswith(("body's", "one's")):
            end += 1
        is_definite = end > start
        number = read_number(self._word(end)) if self._words.superlative(end) is None else None
        if number is not None and is_definite and quantity in {None, EACH}:
            # The two cups are all of them.
            yield _Determiner(EACH, is_definite, end + 1, number)
            return
        elif number is not None and quantity == ANY and self._word(at) in {"some", "any"}:
            quantity, end = Quantity(number), end + 1
        yield _Determiner(quantity, is_definite, end)

    def _quantity(self, at: int) -> tuple[Quantity | None, int]:
        """Return the quantity that words stand for, and where they end: at least three, every, any, no, two."""
        if (limit := self._limit(at)) is not None:
            return limit
        word = self._word(at)
        if word in _QUANTITIES:
            return _QUANTITIES[word], at + 1
        number = read_number(word) if self._words.superlative(at) is None else None
        return (None, at) if number is None else (exactly(number), at + 1)

    def _limit(self, at: int) -> tuple[Quantity, int] | None:
        """Return a quantity with a limit: more than three, at least one."""
        pairs = {"more than": (1, None), "at least": (0, None), "over": (1, None)}
        for words in ("more than", "at least", "fewer than", "less than", "at most", "exactly", "only", "precisely"):
            end = self._words.after(at, {words})
            number = read_number(self._word(end)) if end > at else None
            if number is None:
                continue
            if words in pairs:
                return Quantity(number + pairs[words][0]), end + 1
            high = number - 1 if words in {"fewer than", "less than"} else number
            return Quantity(0 if words in {"fewer than", "less than", "at most"} else number, high), end + 1
        return None

    def _measured(self, at: int, start: int) -> GroupParses:
        """Parse a noun with its modifiers, of which a superlative before it applies last."""
        if (best := self._words.superlative(at)) is not None:
            measure, sign, end = best
            count = read_number(self._word(at)) or 1
            for group, after in self._modified_all(end):
                filter_ = self._filters.most(measure, sign, count)
                yield replace(group.keep(filter_, self._words.text(at, after)), is_definite=True), after
        if self._word(at) in NEAREST:
            yield from self._nearest_before(at)
        yield from self._modified_all(at)

    def _nearest_before(self, at: int) -> GroupParses:
        """Parse the nearest chair to the door."""
        for group, end in self._modified_all(at + 1):
            if self._word(end) in {"to", "from", "of"}:
                for other, after in self.parse(end + 1):
                    one = self._filters.nearest(other, NEAREST[self._word(at)])
                    yield replace(group.keep(one, self._words.text(at, after)), is_definite=True), after

    def _modified_all(self, at: int) -> GroupParses:
        for group, end in self.joined(at):
            yield from self._modified(group, at, end)

    def _modified(self, group: Group, start: int, end: int) -> GroupParses:
        yield group, end
        for one, after in self.modifier(end, is_all=group.is_general and group.quantity == EACH):
            if after > end:
                kept = group.keep(one, self._words.text(start, after), self._words.text(end, after))
                yield from self._modified(kept, start, after)

    def joined(self, at: int) -> GroupParses:
        """Parse a noun without a determiner, or several: cups and plates."""
        for group, end in self._noun(at):
            yield group, end
            link = end + (self._word(end) == ",")
            # After a comma, or begins what is chosen from: the cart, the drum or the box.
            links = {"and"} if link > end else {"and", "or"}
            if self._word(link) in links or link > end:
                after = link + (self._word(link) in links)
                for determiner in self._determiners(after):
                    for other, last in self.joined(determiner.end):
                        if group.is_general or other.is_general:
                            continue
                        iris = tuple(dict.fromkeys((*group.noun.iris, *other.noun.iris)))
                        text = self._words.text(at, last)
                        guesses, cost = (*group.guesses, *other.guesses), group.cost + other.cost
                        joined = Group(
                            Things(iris, text), text, guesses=guesses, cost=cost, is_plural=True, is_joined=True
                        )
                        yield joined, last

    def _noun(self, at: int) -> GroupParses:
        """Parse a noun with the adjectives before it, longer ones first; a pronoun for any thing."""
        if (word := self._word(at)) in _GENERAL:
            quantity = {"some": ANY, "all": EACH, "none": NO}.get(_GENERAL[word])
            things = Things(self._everything, "thing")
            yield Group(things, word, quantity=quantity, is_general=True, is_plural=word.endswith("s")), at + 1
        for end in range(min(len(self._words), at + _MAX_NOUN), at, -1):
            words = self._words[at:end]
            text = " ".join(words)
            is_part = "of" in words[1:-1] and all(word in _LINKS or not is_function_word(word) for word in words)
            is_listed = is_part or (len(words) > 1 and bool(concepts_named(text.lower())))
            if any(map(is_function_word, words)) and not is_listed:
                continue
            # A single word may be misspelt; a compound with an unknown word is none, unless the lexicon lists it.
            if text in _VERBS or (len(words) > 1 and not all(map(self._nouns.knows, words)) and not is_listed):
                continue
            is_definite = self._word(at - 1) in _DEFINITE or self._word(at - 1).endswith("'s")
            if (text, is_definite) not in self._known:
                self._known[text, is_definite] = self._read_noun(text, is_definite=is_definite)
            for group in self._known[text, is_definite]:
                # The countertop of the island may be its part, or be named like that.
                yield (replace(group, cost=group.cost + _WIDER) if is_part else group), end

    def _read_noun(self, text: str, *, is_definite: bool) -> list[Group]:
        """Return what a noun may mean: for a definite one, the things of that very kind, or all of them."""
        if singular(text.lower()) == "room" and (rooms := self._rooms()):
            return [self._group(text, Things(rooms, text))]
        if is_definite:
            narrow, wide = self._found(f"the {text}"), self._found(text)
            if narrow is None or wide is None or narrow.iris == wide.iris:
                return [self._group(text, narrow)] if narrow is not None else []
            # That there are others, too, makes the narrow reading no guess.
            return [replace(self._group(text, narrow), cost=0), replace(self._group(text, wide), cost=_WIDER)]
        found = self._found(text)
        if found is None:
            return []
        if text.isalpha() and not is_plural(text) and found.iris:
            # Any door is not only the one with that name.
            many = self._found(plural(text))
            found = many if many is not None and set(many.iris) > set(found.iris) else found
        return [self._group(text, found)]

    def _rooms(self) -> tuple[str, ...]:
        """Return the rooms that something is in."""
        return tuple(sorted({room for iri in self._everything for room in self._filters.rooms_of(iri)}))

    def _group(self, text: str, found: Things) -> Group:
        guesses = (found.note,) if found.note else ()
        cost = _GUESSED * bool(guesses) + _ABSENT * (not found.iris)
        return Group(found, text, is_plural=is_plural(text), guesses=guesses, cost=cost)

    def _found(self, text: str) -> Things | None:
        """Return the things that a noun means, as it is written or by its head; None if it is not understood."""
        noun = text.removeprefix("the ")
        is_definite = noun != text
        try:
            found = self._nouns.find(text, may_shorten=False)
            if not (found.iris or concepts_named(noun) or concepts_named(singular(noun))):
                # A monthly rent: what its head means may be no thing.
                self._nouns.find(noun.rsplit(maxsplit=1)[-1], may_shorten=False)
                found = self._nouns.find(text)
        except UnknownWordError:
            return None
        except GraphError:
            # Something more general may be meant, of which nothing follows unless it is the only one.
            if not is_definite:
                return None
            try:
                found = self._nouns.find(text)
            except GraphError:
                return None
        is_named = any(letter.isdigit() for letter in noun)
        # Desk A7 is no desk in general, and a thing that only has the word in its name is none of that kind.
        is_wrong = found.is_by_name and not is_definite
        is_wider = "more general" in found.note and not (is_definite and len(found.iris) == 1)
        return None if is_wrong or is_wider or (found.note and is_named) else found

    def is_scene(self, group: Group) -> bool:
        """Return whether a noun means the whole scene: the shop; the room that the graph does not have."""
        text = group.text.lower()
        return not group.filters and (
            self._nouns.is_whole_scene(text)
            or (not group.noun.iris and is_place(text) and not self._nouns.lacks_room(text))
        )
