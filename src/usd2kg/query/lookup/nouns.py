"""Nouns: from words in a question to objects of the graph."""

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named, hypernyms_of
from usd2kg.knowledge import word_set
from usd2kg.languages import translate
from usd2kg.query.lookup.body_measures import COMPARED, SUPERLATIVES
from usd2kg.query.lookup.corrections import Spelling
from usd2kg.query.lookup.directions import find_beside
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.general_kinds import find_more_general
from usd2kg.query.lookup.modifiers import PhraseModifiers, restricts
from usd2kg.query.lookup.part_phrases import PartPhrases
from usd2kg.query.lookup.place_nouns import PlaceNouns
from usd2kg.query.lookup.prepositions import DIRECTLY, RELATION_OF, SIDES, preposition_pattern
from usd2kg.query.lookup.related_things import find_below, find_related
from usd2kg.query.lookup.things import Things, UnknownWordError
from usd2kg.query.lookup.word_forms import (
    is_noun,
    is_plural,
    noun_words,
    singular,
    split_phrase,
)
from usd2kg.query.settings import LOOKUP

__all__ = ["Nouns"]

_DETERMINERS = word_set("query", "determiners")
_EVERYTHING = word_set("query", "general_nouns")
_NEGATIONS = word_set("query", "negations")
_QUESTION_WORDS = word_set("query", "question_words")
_FRAMES = word_set("query", "framing_nouns")
_CONNECTIVES = word_set("query", "connectives")
_OPERATORS = word_set("query", "operators")
_RELATIONAL = word_set("query", "relational_nouns")
_NUMBERS = word_set("query", "number_words")
_FLOORS = word_set("query", "floors")
_SHELLS = word_set("query", "shells")
_ROOM_NOUNS = word_set("query", "room_nouns")
_LANGUAGES = ("de", "fr", "es", "it")
_RELATIONS = ("on", "inside", "near", "above", "below", "attached", *SIDES)
"""Relations in noun phrases: cups on the table."""
_ORIGIN = {"from": "inside"}
"""Prepositions of noun phrases only: the milk from the fridge is in or on it, but what hangs from it is not."""
_PREPOSITIONS = "|".join([preposition_pattern(_RELATIONS), *_ORIGIN])
_RELATION_OF = {**RELATION_OF, **_ORIGIN}
_RELATION = re.compile(
    rf"(?P<first>.+?) (?:that (?:is|are) )?(?P<direct>{DIRECTLY})?(?P<relation>{_PREPOSITIONS}) (?P<second>.+)"
)


class Nouns(PlaceNouns):
    """Resolves noun phrases in the words of people, with the lexicon that grounded the scene."""

    def __init__(self, facts: SceneFacts, *, is_english: bool = True) -> None:
        """Wrap the facts of a graph.

        Args:
            facts: the graph.
            is_english: whether the words are English; else a word that two languages have may be foreign.
        """
        super().__init__(facts)
        self._is_english = is_english
        self._spelling = Spelling(facts, self._kinds)
        self._defined: dict[str, Things] = {}
        self.notes: list[str] = []
        """How unusual words of the noun phrases so far were read."""
        self.guesses: list[str] = []
        """Notes on words that were read as something else that is near: nothing follows if no such thing is found."""

    @property
    def _modifiers(self) -> PhraseModifiers:
        # An attribute would be a reference cycle, which keeps the graph until the next full garbage collection.
        return PhraseModifiers(self._facts, self._find, self._noun_within)

    @property
    def _parts(self) -> PartPhrases:
        return PartPhrases(self._facts, self._kinds, self._names, self._find, self._noun_within)

    def find(self, text: str, *, may_shorten: bool = True) -> Things:
        """Return the objects that a noun phrase means, and note how unusual words in it were read.

        Criteria in order: prim path; label; class or concept, with everything below it; all words in the label; a place
        in the prim path and the rest; relations (`cups on the table`); colours, materials and sizes before a noun; the
        asset; other languages; the head of a compound that the lexicon lacks; spelling.

        Args:
            text: the noun phrase.
            may_shorten: whether a compound may be read as its head, which the note says.

        Raises:
            UnknownWordError: a word is not understood; the message has the nearest ones.
        """
        if (defined := self._defined.get(text)) is not None:
            return defined
        found = self._resolve(text, may_shorten)
        if found.note:
            self.notes.append(found.note)
        return found

    def define(self, things: Things) -> str:
        """Return a name that means some objects from now on."""
        name = f"#{len(self._defined)}"
        self._defined[name] = things
        return name

    def _resolve(self, text: str, may_shorten: bool) -> Things:
        exact = text.strip()
        if named := self._facts.at_path(exact) or self._facts.labelled({exact} - {""}):
            return Things(tuple(self._facts.sorted(named)), exact)
        words = split_phrase(text)
        if (with_name := self._names.in_text(words, is_english=self._is_english)) is not None:
            return with_name
        while len(words) > 1 and words[0] in _NUMBERS:
            words = words[1:]
        if not words:
            raise UnknownWordError(f"{exact!r} names no thing; expected a noun, such as table")
        if words[0] in _NEGATIONS:
            raise UnknownWordError(f"{words[0]!r} is not understood in a noun phrase")
        foreign = [
            word
            for last, word in zip(["", *words], words, strict=False)
            # A trash can is a noun of the lexicon.
            if word in _QUESTION_WORDS and not (last.isalpha() and concepts_named(f"{last} {word}"))
        ]
        if foreign and not concepts_named(" ".join(words)):
            raise UnknownWordError(f"{foreign[0]!r} is not understood in a noun phrase")
        found = self._find(" ".join(words))
        if found is not None and found.iris:
            is_linked = self._is_english or any(map(self._links, words))
            return self._of_this_name(text, found) if is_linked else self._or_translated(words, found)
        if denied := _NEGATIONS.intersection(words):
            if found is not None:
                return found
            raise UnknownWordError(f"{min(denied)!r} is not understood in a noun phrase")
        read = self._translated(words, found) or self._shortened(words, may_shorten)
        return read or (self._absent(found, may_shorten) if found is not None else self._correct(words))

    def _or_translated(self, words: Sequence[str], found: Things) -> Things:
        """Return what foreign words mean if it includes what they name: palettes, one of which has that name."""
        translated = self._translated(words, None)
        return translated if translated is not None and set(translated.iris) > set(found.iris) else found

    def _translated(self, words: Sequence[str], found: Things | None) -> Things | None:
        """Return what words of another language mean, also nothing if they mean nothing else."""
        for language in (None,) if self._is_english else _LANGUAGES:
            if (english := translate(tuple(words), language)) and set(english) != set(words):
                translated = self._find(" ".join(english))
                if translated is None or not translated.iris:
                    translated = self._of_head([*english]) or translated
                if translated is not None and (translated.iris or found is None):
                    return replace(translated, note=f"“{' '.join(words)}” was read as “{translated.text}”")
        return None

    def _shortened(self, words: Sequence[str], may_shorten: bool) -> Things | None:
        """Return what a compound means without a word that frames it, or by its head alone."""
        short = self._find(" ".join(words[:-1])) if len(words) > 1 and words[-1] in _FRAMES else None
        if short is None or not short.iris:
            short = self._of_head(words) if may_shorten else None
            if short is not None and len(short.iris) > 1 and concepts_named(" ".join(words)):
                return None
        return None if short is None else replace(short, note=self._guess(words, short.text))

    def _guess(self, words: Sequence[str], meant: str, how: str = "") -> str:
        """Note that words were read as something else that is near, and return the note."""
        note = f"“{' '.join(words)}” was read as “{meant}”{how}"
        self.guesses.append(note)
        return note

    def _of_head(self, words: Sequence[str]) -> Things | None:
        """Return the things of the last noun of a compound, or of its last two; None without such things."""
        if not all(is_noun(word) and not (restricts(word) or self._links(word)) for word in words[:-1]):
            return None
        if not _OPERATORS.isdisjoint(words):
            return None
        if (part := self._parts.read_compound(words)) is not None:
            return part
        heads = (self._find(" ".join(words[start:])) for start in range(1, len(words)))
        found = next((head for head in heads if head is not None and head.iris), None)
        # The door of an oven is not just any door, which is a part of something else; a back room is not just any room.
        if found is None or self._parts.are_parts(found) or set(found.iris) <= set(self._facts.rooms):
            return None
        return found

    def _links(self, word: str) -> bool:
        return word in _CONNECTIVES or word in _RELATION_OF

    def _of_this_name(self, text: str, found: Things) -> Things:
        """Return the only things of several that are named by a definite singular noun: the computer, among tablets."""
        noun = found.text
        if not text.lower().startswith("the ") or len(found.iris) < 2 or is_plural(noun):
            return found
        if " " in noun:
            # The family photo, among picture frames: the one whose name has both words.
            exact = tuple(iri for iri in found.iris if noun_words(noun) <= noun_words(self._facts.label(iri)))
        else:
            exact = tuple(iri for iri in found.iris if self._facts.kind(iri) == noun)
        if not exact or len(exact) == len(found.iris):
            return found
        self.guesses.append(f"“{text}” was read as {len(exact)} of {len(found.iris)} things that may be meant")
        others = list(dict.fromkeys(self._facts.label(iri) for iri in found.iris if iri not in exact))
        more = [f"{len(others) - LOOKUP.max_suggestions} more"] if len(others) > LOOKUP.max_suggestions else []
        *first, last = [*others[: LOOKUP.max_suggestions], *more]
        note = f"there {'is' if len(others) == 1 else 'are'} also {', '.join(first)}{' and ' if first else ''}{last}"
        return replace(found, iris=exact, note="; ".join(filter(None, (found.note, note))))

    def for_purpose(self, verb: str) -> Things:
        """Return the things for a purpose, those of the kinds that it names: cleaning equipment.

        Raises:
            UnknownWordError: the lexicon has no such kind.
        """
        found = self._modifiers.find_for_purpose(verb)
        if found is None:
            raise UnknownWordError(f"{verb!r} is not understood as a purpose")
        return found

    def existing(self, text: str) -> Things:
        """Return the objects that a noun phrase means, at least one.

        Raises:
            UnknownWordError: a word is not understood.
            GraphError: there are none.
        """
        things = self.find(text)
        if not things.iris:
            raise GraphError(things.absence)
        return things

    def whole_of(self, text: str) -> Things | None:
        """Return the whole of a part that the graph does not have as an object; None if the words name no part."""
        return self._parts.read_whole(text)

    def _find(self, text: str) -> Things | None:
        """Return what a phrase means as it is written; None if a word is unknown."""
        if not text or text in _OPERATORS:
            return None
        if text in _EVERYTHING:
            return Things(tuple(self._facts.things), "thing")
        if found := self._names.named(text):
            return self._also_by_adjective(text, Things(tuple(found), text))
        if (by_words := self._names.of_words(text)) is not None:
            return self._also_by_adjective(text, by_words)
        readers = (
            self._modifiers.read_first,
            self._parts.read,
            self._restricted,
            self._modifiers.read,
            self._joined,
        )
        for read in readers:
            if (restricted := read(text)) is not None:
                return restricted
        # The noun is known, and no object is one.
        return Things((), text) if self._names_a_kind(text) else None

    def _also_by_adjective(self, text: str, named: Things) -> Things:
        """Return things with a name, and all others to which its adjective applies: wooden crates, one of that name."""
        meant = self._modifiers.read(text) if restricts(text.split(maxsplit=1)[0]) else None
        if meant is None or set(named.iris).isdisjoint(meant.iris):
            return named
        return Things(tuple(self._facts.sorted({*named.iris, *meant.iris})), text)

    def _names_a_kind(self, text: str) -> bool:
        """Return whether a text names a kind of physical things, of which the scene may have none."""
        *before, head = text.split()
        above = hypernyms_of(" ".join([*before, singular(head)]))
        if "abstraction" in above and "artifact" not in above and not self._kinds.find(text):
            # A scene does not lack a price or a time as it may lack a piano.
            return False
        if self._kinds.find(text) or (concepts_named(text) and (before or head not in _RELATIONAL)):
            return True
        # The words before the head of a compound are nouns in the singular: book stack, but not doors part.
        is_compound = bool(before) and is_noun(text) and not any(map(is_plural, before))
        return is_compound and (_OPERATORS | _RELATIONAL | _CONNECTIVES).isdisjoint(text.split())

    def _absent(self, found: Things, may_shorten: bool) -> Things:
        """Return what a kind without things is read as, or that kind.

        Raises:
            GraphError: things of a more general kind may be of this kind.
        """
        noun = found.text
        # No oven is empty: not all ovens may be.
        is_kind = concepts_named(noun) and noun not in _ROOM_NOUNS and not restricts(noun.split(maxsplit=1)[0])
        general = find_more_general(self._facts, noun) if is_kind else None
        if general is None:
            *before, head = noun.split() or [noun]
            parts = self._find(head) if before and is_noun(noun) else None
            if parts is not None and self._parts.are_parts(parts):
                raise GraphError(f"not known: no {noun} is known, but {len(parts.iris)} of {head} are parts of things")
            return found
        # Where all lights are only lights, a ceiling light is one of them; not so where most are of a known kind.
        if may_shorten and 2 * len(general.iris) >= len(self._kinds.objects(general.text)):
            note = self._guess([noun], general.text, ", which is more general")
            self.notes.append(note)
            return replace(general, note=note)
        raise GraphError(
            f"not known: no {noun} is known, but there {'is' if len(general.iris) == 1 else 'are'} "
            f"{len(general.iris)} known only as {general.text}, which may be one"
        )

    def kinds(self, text: str) -> list[ox.NamedNode]:
        """Return the classes and concepts that a noun names.

        Raises:
            UnknownWordError: there are none; the message lists the classes of the graph's objects.
        """
        words = split_phrase(text)
        found = self._kinds.find(text.strip()) or self._kinds.find(" ".join(words))
        if found:
            return found
        if (english := translate(tuple(words), None)) and (found := self._kinds.find(" ".join(english))):
            return found
        nearest = self._spelling.correct(words, is_noun).nearest if not is_noun(" ".join(words)) else []
        advice = f"; did you mean {' or '.join(nearest)}?" if nearest else ""
        raise UnknownWordError(
            f"no class or concept is named {text!r}{advice}; expected a noun that is a concept of an object, or one of "
            f"the classes {', '.join(self._kinds.used_labels)}"
        )

    def shells(self) -> set[str]:
        """Return what surrounds a room, which nobody asks for as a neighbour of a thing."""
        return {iri for noun in _SHELLS for iri in self.known(noun)}

    def known(self, noun: str) -> tuple[str, ...]:
        """Return the things that are known to be of a kind, by prim path."""
        found = self._find(noun)
        return () if found is None else found.iris

    @cached_property
    def floors(self) -> set[str]:
        """What heights are measured from."""
        return {iri for noun in _FLOORS for iri in self.known(noun)}

    def _restricted(self, text: str) -> Things | None:
        """Return the things that stand in a relation to others: `cups on the table`."""
        parts = _RELATION.fullmatch(text)
        if parts is None:
            return None
        first = self._noun_within(" ".join(split_phrase(parts["first"])))
        if first is None:
            return None
        is_direct = bool(parts["direct"])
        near = self.around(_RELATION_OF[parts["relation"]], parts["second"], is_direct=is_direct)
        if parts["relation"] in _ORIGIN:
            near |= self.around("on", parts["second"], is_direct=is_direct)
        shown = f"{first.text} {parts['direct'] or ''}{parts['relation']} {parts['second']}"
        return Things(tuple(iri for iri in first.iris if iri in near), shown)

    def _noun_within(self, noun: str) -> Things | None:
        """Return what a noun means within a phrase, where a language or a compound may be foreign to the graph."""
        found = self._find(noun)
        if found is not None and found.iris:
            return found
        words = noun.split()
        if not self._is_english and (english := translate(tuple(words), None)):
            found = self._find(" ".join(english)) or found
        if concepts_named(noun):
            return self._absent(found, may_shorten=True) if found is not None and not found.iris else found
        if (head := self._of_head(words)) is None:
            return found
        self.notes.append(self._guess(words, head.text))
        return head

    def around(self, relation: str, text: str, *, is_direct: bool) -> set[str]:
        """Return the objects in a relation to the things that a noun phrase means, or in a part of the scene.

        Raises:
            GraphError: there are no such things.
        """
        if relation == "inside" and self.is_whole_scene(" ".join(split_phrase(text))):
            return set(self._facts.things)
        try:
            anchors = self.find(text)
        except UnknownWordError:
            if relation != "inside" or not (area := self._names.in_area(text)):
                raise
            return area
        if relation == "inside" and self.is_area(text, anchors.iris):
            return self._names.in_area(text)
        found = self.in_relation(relation, anchors.iris, is_direct=is_direct)
        if relation == "inside" and not found and (area := self._names.in_area(text)):
            return area
        if not anchors.iris:
            raise GraphError(anchors.absence)
        return found

    def in_relation(self, relation: str, anchors: Sequence[str], *, is_direct: bool) -> set[str]:
        """Return the objects in a relation to any of some anchors, by boxes where the graph does not state it."""
        if relation == "below":
            return {iri for anchor in anchors for iri in find_below(self._facts, anchor)}
        # What is on a table is not on the floor.
        is_direct = is_direct or (relation == "on" and set(anchors) <= self.floors)
        found = find_related(self._facts, relation, anchors, is_direct=is_direct)
        if relation not in SIDES or found:
            return found
        self.notes.append("What is beside a thing is by boxes, as seen from among the surrounding objects")
        return {iri for anchor in anchors for iri in find_beside(self._facts, relation, anchor) or ()}

    def _joined(self, text: str) -> Things | None:
        """Return the things of several nouns: `cups and plates`; none, with the first noun that nothing is."""
        nouns = re.split(r",? (?:and|or) |, ", text)
        if any(map(restricts, nouns)):
            return None
        found = [self._find(" ".join(split_phrase(noun))) for noun in nouns] if len(nouns) > 1 else []
        if not found or any(things is None for things in found):
            return None
        each = [things for things in found if things is not None]
        if missing := next((things for things in each if not things.iris), None):
            return missing
        return Things(tuple(self._facts.sorted({iri for things in each for iri in things.iris})), text)

    def _correct(self, words: list[str]) -> Things:
        """Return what is meant if one spelling is much more likely than all others.

        Raises:
            UnknownWordError: no spelling, or several, are near.
        """
        if measures := [word for word in words if word in SUPERLATIVES or word in COMPARED]:
            raise UnknownWordError(f"{measures[0]!r} is not understood without a noun")
        corrected, unknown, nearest = self._spelling.correct(words, self._is_known)
        if corrected != words and (found := self._find(" ".join(corrected))) is not None and found.iris:
            return replace(found, note=self._guess(words, " ".join(corrected)))
        shown = " ".join(unknown)
        raise UnknownWordError(
            f"{shown!r} is not understood; did you mean {' or '.join(nearest)}?"
            if nearest
            else f"{shown!r} is not a word that this graph or the lexicon knows"
        )

    @property
    def vocabulary(self) -> Sequence[str]:
        """The words of the names, classes and concepts of the graph."""
        return self._spelling.vocabulary

    def knows(self, word: str) -> bool:
        """Return whether a word of a noun phrase is in the lexicon or in a name of the graph, as it is written."""
        return restricts(word) or self._is_known(word) or self._spelling.is_in_use(word)

    def _is_known(self, word: str) -> bool:
        return _RELATION_OF.get(word) in _RELATIONS or word in _DETERMINERS or is_noun(word)
