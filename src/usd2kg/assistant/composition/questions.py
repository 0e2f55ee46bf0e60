"""read_question: all readings of a question that account for every one of its words."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from usd2kg.assistant.composition.filters import EVERYTHING, Filters, negated
from usd2kg.assistant.composition.groups import ANY, EACH, NO, Filter, Group, exactly
from usd2kg.assistant.composition.modifiers import Modifiers
from usd2kg.assistant.composition.noun_phrases import KnownNouns, NounPhrases
from usd2kg.assistant.composition.predicates import Predicates
from usd2kg.assistant.composition.words import BE, DO, Words
from usd2kg.knowledge import word_set
from usd2kg.query.lookup import Nouns, SceneFacts, Things
from usd2kg.query.lookup.body_measures import COMPARED, MEASURES

__all__ = ["Questions", "Reading"]

_HOLDING, _PLACED = word_set("grammar", "holding_verbs"), word_set("grammar", "place_verbs")
_PEOPLE, _FINDING = word_set("grammar", "people"), word_set("grammar", "finding_verbs")
_MODALS, _REQUESTS = word_set("grammar", "modals"), word_set("grammar", "requests")
_TO_NEAREST = frozenset(["the nearest", "the closest", "its nearest"])
_HAVING = frozenset(["has", "have", "had"])
_WHICH = frozenset(["which", "what"])


@dataclass(frozen=True)
class Reading:
    """What a question may mean."""

    type: str
    """Kind of answer: list, count, claim, or a question type of the handlers, such as `measure`."""
    groups: tuple[Group, ...]
    """Noun phrases, in the order of the parameters of the answer."""
    predicate: Filter | None = None
    given: tuple[tuple[str, str], ...] = ()
    """Further parameters: a measure, an adjective."""

    @property
    def cost(self) -> int:
        """How far the reading is from the words."""
        return sum(group.cost for group in self.groups) + (self.predicate.cost if self.predicate else 0)

    @property
    def guesses(self) -> tuple[str, ...]:
        """How words were read that are not known as they are."""
        own = [guess for group in self.groups for guess in group.guesses]
        return tuple(dict.fromkeys([*own, *(self.predicate.guesses if self.predicate else ())]))


class Questions:
    """Reads one question."""

    def __init__(
        self, text: str, facts: SceneFacts, nouns: Nouns, filters: Filters, known: KnownNouns | None = None
    ) -> None:
        """Split a question.

        Args:
            text: the question.
            facts: the graph.
            nouns: resolves its nouns.
            filters: makes filters about it.
            known: what nouns mean, kept for other wordings of the question.
        """
        self._words = Words(text)
        self._things = Things(tuple(facts.things), "thing")
        self._filters = filters
        self._phrases = NounPhrases(self._words, nouns, filters, facts.things, {} if known is None else known)
        self._modifiers = Modifiers(self._words, self._phrases, nouns, filters)
        self._predicates = Predicates(self._words, self._phrases, self._modifiers, filters)
        self._word = self._words.word
        self._end = len(self._words)

    def read(self) -> list[Reading]:
        """Return the readings that use all words."""
        readers = (
            self._which,
            self._preposed,
            self._request,
            self._how_many,
            self._is_there,
            self._in_scene,
            self._claim,
            self._having,
            self._where,
            self._measure,
            self._distance,
            self._looks,
            self._choose,
            self._sum,
        )
        return [one for read in readers for one in read()]

    def _done(self, end: int) -> bool:
        return end == self._end

    def _everything(self) -> Group:
        return Group(self._things, "things", is_general=True)

    # Lists.

    def _subjects(self, at: int) -> Iterator[tuple[Group, int]]:
        """Yield what `which` asks for: which chairs, which of the chairs, what."""
        start = at + (self._word(at) in {"one", "ones"})
        if self._word(start) == "of":
            yield from self._phrases.parse(start + 1)
            return
        yield from self._phrases.parse(at)
        yield self._everything(), at

    def _which(self) -> Iterator[Reading]:
        if self._word(0) not in _WHICH:
            return
        for group, end in self._subjects(1):
            if self._done(end) and not group.is_general:
                yield Reading("list", (group,))
            if self._word(end) in BE and self._word(end + 1) in {"there", ""} and not group.is_general:
                yield from self._there(group, end + 2, "list")
            if group.is_general and self._word(end) in BE and self._word(end + 1) == "there":
                yield from self._there(group, end + 2, "list")
            for one, last in self._predicates.parse(end) if self._agrees(group, end) else ():
                if self._done(last):
                    yield self._restricted("list", group, one, end)
            yield from self._inverted(group, end, "list")

    def _agrees(self, group: Group, at: int) -> bool:
        """Return whether the verb at a place may have a group as its subject: not in “how many drawers has it”."""
        return not (group.is_plural and not group.is_general and self._word(at) == "has")

    def _there(self, group: Group, at: int, kind: str) -> Iterator[Reading]:
        """Yield readings after `which cups are there`: with a place, or nothing."""
        if at >= self._end:
            yield Reading(kind, (group,))
        for one, end in self._modifiers.parse(at):
            if self._done(end):
                yield self._restricted(kind, group, one, at, is_verb=False)

    def _restricted(self, kind: str, group: Group, one: Filter, at: int, *, is_verb: bool = True) -> Reading:
        """Return a reading about the things to which the words from a place on apply, which may begin with a verb."""
        said = self._words.text(at, self._end)
        said = f"that {said}" if is_verb else said
        return Reading(kind, (group.keep(one, f"{self._named(group)} {said}", said),))

    def _named(self, group: Group) -> str:
        return "things" if group.is_general else group.text

    def _inverted(self, group: Group, at: int, kind: str) -> Iterator[Reading]:
        """Yield readings where what is asked for is the object: which drawers does it have, which is it mounted on."""
        verb = self._word(at)
        if verb in DO | _HAVING | _MODALS:
            for subject, end in self._phrases.parse(at + 1):
                if not self._agrees(group, at) and self._done(end):
                    # How many drawers has the cabinet?
                    yield Reading(kind, (group.keep(self._owned_by(subject), self._named(group)),))
                if self._word(end) in _HOLDING or (self._word(end) == "got" and verb in _HAVING):
                    _, last = self._modifiers.back(end + 1)
                    if self._done(last):
                        yield Reading(kind, (group.keep(self._owned_by(subject), self._named(group)),))
                yield from self._carriers(group, subject, end, kind)
            if self._word(at + 1) in _PEOPLE and self._word(at + 2) in _FINDING:
                yield from self._there(group, at + 3, kind)
        if verb in BE:
            for subject, end in self._phrases.parse(at + 1):
                yield from self._carriers(group, subject, end, kind)

    def _owned_by(self, owner: Group) -> Filter:
        """Choose what things have: their parts, and what is on or in them."""
        if self._phrases.is_scene(owner):
            return EVERYTHING
        parts = self._filters.part_of(owner)
        held = [self._filters.related(name, owner) for name in ("on", "inside", "attached")]

        def choose(iris: Sequence[str]) -> set[str]:
            return {iri for one in (parts, *held) for iri in one.choose(iris)}

        return Filter(choose, owner.guesses, owner.cost)

    def _carriers(self, group: Group, subject: Group, at: int, kind: str) -> Iterator[Reading]:
        """Yield readings after a subject: (which wall) is the clock mounted on."""
        start = at
        if self._word(at) in _PLACED:
            at += 1
        for relation, end in self._words.relation(start, at):
            if self._done(end):
                one = self._filters.carrying(relation, subject)
                yield Reading("places", (group.keep(one, self._named(group)),))

    def _preposed(self) -> Iterator[Reading]:
        """Yield readings that begin with a preposition: on which table is the lamp, in what is it."""
        for relation, end in self._words.relation(0, 0):
            if self._word(end) not in _WHICH:
                return
            for group, after in self._subjects(end + 1):
                if self._word(after) not in BE | DO | _MODALS:
                    continue
                for subject, last in self._phrases.parse(after + 1 + (self._word(after + 1) == "there")):
                    verb = last + (self._word(last) in _PLACED)
                    if self._done(verb):
                        one = self._filters.carrying(relation, subject)
                        yield Reading("places", (group.keep(one, self._named(group)),))
                if self._word(after + 1) in _PEOPLE and self._word(after + 2) in _FINDING:
                    for subject, last in self._phrases.parse(after + 3):
                        if self._done(last):
                            one = self._filters.carrying(relation, subject)
                            yield Reading("places", (group.keep(one, self._named(group)),))

    def _request(self) -> Iterator[Reading]:
        start = 0
        if self._word(0) in _REQUESTS:
            start = 1 + (self._word(1) in {"me", "us"})
        for group, end in self._phrases.parse(start):
            if not self._done(end):
                continue
            if not start and group.quantity == ANY:
                # Any cups? Anything on the table?
                yield Reading("exists", (group,))
            elif start or group.is_plural or group.is_general or any(one.is_relative for one in group.filters):
                yield Reading("list", (group,))
        if start and self._word(start) in {"what", "which"}:
            # Tell me what is on the table; what the shelf holds.
            for group, end in self._subjects(start + 1):
                for one, last in self._predicates.parse(end):
                    if self._done(last):
                        yield self._restricted("list", group, one, end)
                for subject, last in self._phrases.parse(end):
                    if self._word(last) in _HOLDING and self._done(last + 1):
                        yield Reading("list", (group.keep(self._owned_by(subject), self._named(group)),))

    # Numbers.

    def _how_many(self) -> Iterator[Reading]:
        start = self._words.after(0, {"how many", "number of", "the number of", "what is the number of", "count"})
        if not start:
            return
        for group, end in self._subjects(start):
            if group.is_general and end == start:
                continue
            if self._done(end):
                yield Reading("count", (group,))
            if self._word(end) in BE and self._word(end + 1) in {"there", "left", ""}:
                yield from self._there(group, end + 2, "count")
            if self._word(end) == "there" and self._word(end + 1) in BE:
                yield from self._there(group, end + 2, "count")
            for one, last in self._predicates.parse(end) if self._agrees(group, end) else ():
                if self._done(last):
                    yield self._restricted("count", group, one, end)
            yield from self._inverted(group, end, "count")

    # Yes or no.

    def _is_there(self) -> Iterator[Reading]:
        if self._word(0) in BE and self._word(1) == "there":
            start = 2
        elif self._word(0) in _MODALS | _HAVING and self._word(1) in _PEOPLE and self._word(2) in _FINDING | _HAVING:
            start = 3
        elif self._word(0) in _HAVING and self._word(1) in _PEOPLE:
            start = 2 + (self._word(2) == "got")
        else:
            return
        yield from self._more(start)
        yield from self._exist(start)

    def _in_scene(self) -> Iterator[Reading]:
        """Yield readings about all of the scene: does the shop have a till."""
        if self._word(0) in DO | _HAVING:
            for scene, end in self._phrases.parse(1):
                if self._phrases.is_scene(scene) and self._word(end) in _HAVING | {"got"}:
                    yield from self._exist(end + 1)

    def _exist(self, start: int) -> Iterator[Reading]:
        for group, end in self._phrases.parse(start):
            if self._done(end) and group.quantity != NO:
                yield Reading("exists", (group,))

    def _more(self, at: int) -> Iterator[Reading]:
        """Yield comparisons of numbers: more chairs than tables, as many plates as bowls on the shelf."""
        word = self._word(at)
        is_equal = word == "as" and self._word(at + 1) == "many"
        if not is_equal and word not in {"more", "fewer", "less"}:
            return
        link, start = ("as", at + 2) if is_equal else ("than", at + 1)
        for first, end in self._phrases.parse(start):
            for second, last in self._phrases.parse(end + 1) if self._word(end) == link else ():
                given = (("adjective", "as many" if is_equal else word),)
                if not self._done(last):
                    continue
                # A place at the end is that of both.
                shared = second.filters if not first.filters else first.filters
                one = Group(first.noun, first.text, shared, guesses=first.guesses, cost=first.cost)
                yield Reading("more", (one, second), given=given)

    def _claim(self) -> Iterator[Reading]:
        """Yield claims: is the cup on the table, are all chairs black, does any table have a cloth."""
        if "or" in self._words[:]:
            # A choice is no question to be answered with yes.
            return
        if self._word(0) in BE and self._word(1) != "there":
            readers: list[Callable[[int], Iterator[tuple[Filter, int]]]] = [self._predicates.complement]
        elif self._word(0) in DO:
            readers = [self._predicates.verb]
        else:
            return
        for group, end in self._phrases.parse(1):
            for reader in readers:
                is_denied = self._word(end) == "not"
                for one, last in self._predicates.joined(reader, end + is_denied):
                    # Whether it is the largest depends on what it is compared with.
                    if self._done(last) and not one.is_relative:
                        yield Reading("claim", (group,), negated(one) if is_denied else one)

    def _having(self) -> Iterator[Reading]:
        """Yield claims with an auxiliary: has the wardrobe got two doors, have the chairs cushions."""
        if self._word(0) not in _HAVING:
            return
        for group, end in self._phrases.parse(1):
            for one, last in self._modifiers.owned(end + (self._word(end) == "got")):
                if self._done(last):
                    yield Reading("claim", (group,), one)

    # Places, measures and looks.

    def _where(self) -> Iterator[Reading]:
        if self._word(0) != "where":
            return
        if self._word(1) in BE | DO | _HAVING:
            for group, end in self._phrases.parse(2):
                if self._done(end + (self._word(end) in _PLACED)):
                    yield Reading("where", (group,))
        # Where can I find it; where did we put it, but not where can we put it.
        placing = {"have", "keep", "leave", "put", "store"}
        verbs = placing | (_FINDING - {"own"}) if self._word(1) in DO | _HAVING else _FINDING - placing - {"own"}
        if self._word(1) in DO | _MODALS | _HAVING and self._word(2) in _PEOPLE and self._word(3) in verbs:
            for group, end in self._phrases.parse(4):
                if self._done(end):
                    yield Reading("where", (group,))

    def _measure(self) -> Iterator[Reading]:
        if self._word(0) == "how" and self._word(1) in MEASURES and self._word(2) in BE | DO:
            for group, end in self._phrases.parse(3):
                if self._done(end):
                    yield Reading("measure", (group,), given=(("adjective", self._word(1)),))
        start = self._words.after(0, {"what is", "what are", "give me", "tell me"})
        start += self._word(start) == "the"
        if self._word(start) in MEASURES and self._word(start + 1) == "of":
            for group, end in self._phrases.parse(start + 2):
                if self._done(end):
                    yield Reading("measure", (group,), given=(("adjective", self._word(start)),))
        asked = self._words.after(0, {"what do", "what does", "how much do", "how much does"})
        if asked:
            for group, end in self._phrases.parse(asked):
                if self._word(end) == "weigh" and self._done(end + 1):
                    yield Reading("measure", (group,), given=(("adjective", "heavy"),))

    def _sum(self) -> Iterator[Reading]:
        start = self._words.after(0, {"what is", "how much is"})
        start += self._word(start) == "the"
        if self._word(start) in {"total", "combined"} and self._word(start + 1) in MEASURES:
            for group, end in self._phrases.parse(start + 3) if self._word(start + 2) == "of" else ():
                if self._done(end):
                    yield Reading("total", (group,), given=(("how", "total"), ("measure", self._word(start + 1))))

    def _distance(self) -> Iterator[Reading]:
        asked = self._words.after(0, {"how far", "how far away", "how far apart"})
        if asked and self._word(asked) in BE:
            start = asked + 1
            pairs = {"from", "to", "and"}
            if self._word(start) == "it":
                start += 1 + (self._word(start + 1) == "from")
            yield from self._pair(start, pairs, "distance")
        start = self._words.after(0, {"what is", "how large is", "how wide is", "how big is", "how much"})
        start += self._word(start) == "the"
        start += self._word(start) in {"free", "empty", "clear"}
        if self._word(start) in {"distance", "gap", "space", "room", "clearance"}:
            after = self._words.after(start + 1, {"is there between", "is between", "between", "from", "is there from"})
            if after > start + 1:
                yield from self._pair(after, {"and", "to"}, "distance")

    def _two(self, at: int) -> Iterator[Reading]:
        """Yield the distance between two things of a noun: the two nightstands."""
        for group, end in self._phrases.parse(at):
            if self._done(end) and group.quantity in {EACH, exactly(2)} and len(group.noun.iris) == 2:
                yield Reading("distance", tuple(self._one_of(group, iri) for iri in group.noun.iris))

    def _one_of(self, group: Group, iri: str) -> Group:
        return Group(Things((iri,), group.text), group.text, guesses=group.guesses, cost=group.cost)

    def _pair(self, at: int, links: set[str], kind: str) -> Iterator[Reading]:
        yield from self._two(at)
        for first, end in self._phrases.parse(at):
            if self._word(end) in links:
                # The gap to the nearest shelf is the least gap to any.
                start = self._words.after(end + 1, _TO_NEAREST)
                for second, last in self._phrases.parse(start):
                    if self._done(last):
                        yield Reading(kind, (first, second))

    def _looks(self) -> Iterator[Reading]:
        if self._word(0) in _WHICH and self._word(1) in {"colour", "color", "material"}:
            for group, end in self._phrases.parse(3) if self._word(2) in BE else ():
                if self._done(end) or (self._word(end) == "made" and self._done(end + 2)):
                    kind = "material" if self._word(1) == "material" else "color"
                    yield Reading(kind, (group,))
        if self._word(0) == "what" and self._word(1) in BE:
            for group, end in self._phrases.parse(2):
                if self._word(end) == "made" and self._word(self._end - 1) == "of" and end + 2 == self._end:
                    yield Reading("material", (group,))

    def _nearer(self, at: int) -> Iterator[Reading]:
        """Yield choices by distance: (which is) farther from the wardrobe, the armchair or the sofa."""
        signs = {"closer": 1, "nearer": 1, "farther": -1, "further": -1}
        if self._word(at) not in signs or self._word(at + 1) not in {"to", "from"}:
            return
        for other, end in self._phrases.parse(at + 2):
            for choice, last in self._phrases.parse(end + (self._word(end) == ",")):
                if self._done(last) and choice.is_joined:
                    yield Reading(
                        "list", (choice.keep(self._filters.nearest(other, signs[self._word(at)]), choice.text),)
                    )

    def _choose(self) -> Iterator[Reading]:
        """Yield choices between two: which is heavier, the oven or the fridge."""
        if self._word(0) not in _WHICH | {"who"}:
            return
        start = 1 + (self._word(1) in {"one", "thing"})
        if self._word(start) in BE:
            yield from self._nearer(start + 1)
        adjective, end = "", start
        if self._word(start) in BE:
            end = start + 1 + (self._word(start + 1) == "the")
            adjective = self._word(end)
        elif self._word(start) in {"weigh", "weighs"} and self._word(start + 1) in {"more", "less"}:
            adjective, end = {"more": "heavier", "less": "lighter"}[self._word(start + 1)], start + 1
        if adjective not in COMPARED:
            return
        at = end + 1
        at += self._word(at) == ","
        for first, after in self._phrases.parse(at):
            link = after + (self._word(after) == ",")
            for second, last in self._phrases.parse(link + 1) if self._word(link) == "or" else ():
                if self._done(last):
                    yield Reading("choose", (first, second), given=(("adjective", adjective),))
