"""NameMatcher: from words to the objects whose names, kinds or groups have them."""

import os.path
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property

import numpy as np

from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_set
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.kinds import Kinds
from usd2kg.query.lookup.related_things import find_parts
from usd2kg.query.lookup.things import Things
from usd2kg.query.lookup.word_forms import (
    is_noun,
    is_place,
    is_plural,
    name_parts,
    name_words,
    noun_words,
    singular,
    split_phrase,
)
from usd2kg.query.settings import WORDS
from usd2kg.words import split_identifier

__all__ = ["NameMatcher"]

_LINKS = word_set("query", "connectives") | word_set("query", "operators")
"""Words between two nouns, or that change which things are meant: the name of another thing may follow them."""
_HELD = ("on", "inside", "attached", "part")
"""Relations of a thing to the one that it is found at."""
_AREAS = word_set("query", "area_nouns")
_ROOM_NOUNS = word_set("query", "room_nouns")

_Criterion = Callable[[], Iterable[str]]
"""Returns the objects that match a name in one way."""


class NameMatcher:
    """Finds objects of one graph by their names, kinds and groups."""

    def __init__(self, facts: SceneFacts, kinds: Kinds) -> None:
        self._facts = facts
        self._kinds = kinds
        self._words_of_groups: dict[str, frozenset[str]] = {}

    def in_text(self, words: list[str], *, is_english: bool) -> Things | None:
        """Return the objects whose whole name stands after a noun, of any language: the book stack BookD_01_003."""
        *nouns, name = words or [""]
        is_named = any(letter.isdigit() for letter in name) and bool(nouns)
        if not is_named or not _LINKS.isdisjoint(nouns):
            return None
        if not (all(map(is_noun, nouns)) if is_english else len(nouns) == 1):
            return None
        found = self._facts.labelled([name])
        return Things(tuple(self._facts.sorted(found)), name) if found else None

    def named(self, text: str) -> list[str]:
        """Return the objects with this name, of this kind, or with these words, by the first criterion with a match."""
        facts, lower, words, names = self._facts, text.lower(), noun_words(text), name_words(text)
        exact: tuple[_Criterion, ...] = (
            lambda: facts.at_path(text),
            lambda: facts.labelled({text, lower, text.upper(), text.title(), text.capitalize()}),
            lambda: self._rooms(lower),
            lambda: self._numbered_rooms(lower),
            lambda: self._with_run(text) if any(letter.isdigit() for letter in text) else (),
        )
        named: tuple[_Criterion, ...] = (
            lambda: facts.named(lower),
            lambda: facts.named("".join(lower.split())) or facts.named("_".join(lower.split())) if " " in lower else (),
            lambda: self._with_words(names, is_whole=True) if len(words) > 1 and words == names else (),
            lambda: self._main_of_groups(text) or self._main_of_group("_".join(lower.split())),
        )
        kinds: tuple[_Criterion, ...] = (
            lambda: self._in_place(text) if self._is_plain(text) else (),
            lambda: self._kinds.objects(text) | (self._main_of_single_groups(text) if text.isalpha() else set()),
        )
        # One noun is rarely a name, and all names of a large graph take seconds to read.
        for criterion in (*exact, *kinds) if text.isalpha() else exact:
            if found := facts.sorted(criterion()):
                return found
        by_name, by_kind = (set(next(filter(None, map(_found, group)), ())) for group in (named, kinds))
        # Objects whose names are that of their kind stand for all of it.
        is_kind = not (by_name.isdisjoint(by_kind) or any(letter.isdigit() for letter in text))
        return facts.sorted(by_name | by_kind if is_kind or not by_name else by_name)

    def of_words(self, text: str) -> Things | None:
        """Return the objects with these words in the label, in the path or in the name of the asset.

        A word that a label begins with is what the thing is for, not what it is, unless nothing else is known of it.
        """
        facts, names = self._facts, name_words(text)
        labelled = facts.sorted(self._with_words(names))
        numbers = {word for word in names if word.isdigit()}
        # Rack A1 is not rack A1_02.
        labelled = [iri for iri in labelled if numbers and numbers == _numbers(facts.label(iri))] or labelled
        if len(labelled) > max(1, len(facts.things) * WORDS.max_label_share):
            # The name of a project or an asset pack says nothing about single objects.
            labelled = []
        if labelled and is_noun(text):
            head = singular(text.rsplit(maxsplit=1)[-1].lower())
            exact = [iri for iri in labelled if facts.concept(iri) is None or _head_of(facts.label(iri)) == head]
            return Things(tuple(exact or labelled), text, is_by_name=not exact)
        if labelled:
            return Things(tuple(labelled), text)
        rest: tuple[_Criterion, ...] = (
            lambda: self._in_place(text),
            lambda: (iri for asset, iris in facts.assets() if names and names <= name_words(asset) for iri in iris),
        )
        found: list[str] = next((one for criterion in rest if (one := facts.sorted(criterion()))), [])
        return Things(tuple(found), text) if found else None

    def in_area(self, text: str) -> set[str]:
        """Return the objects below the groups that are named after a place: the reception area."""
        words = noun_words(" ".join(word for word in split_phrase(text) if word not in _AREAS))
        return {iri for iri in self._facts.things if words and words <= self._group_words(self._group(iri))}

    def _rooms(self, text: str) -> Iterator[str]:
        """Yield the rooms with a name: the kitchen `R05_StaffKitchen`, the living room `living_bedroom`."""
        words = noun_words(text) - {"room"}
        if not self._facts.rooms or not (words or is_plural(text)):
            return
        head = singular(text.rsplit(maxsplit=1)[-1])
        for iri, label in self._words_of_rooms.items():
            # Of other words than those for rooms, the name has all: a print is no print room.
            if words == label or (words <= label and (text in _ROOM_NOUNS or head in _ROOM_NOUNS or is_place(head))):
                yield iri

    def _numbered_rooms(self, text: str) -> Iterator[str]:
        """Yield the rooms whose names have the number of a room and all other words: room 102 is `102 Kitchen`."""
        words = name_words(text)
        if "room" in words and any(word.isdigit() for word in words):
            wanted = words - {"room"}
            yield from (iri for iri in self._facts.rooms if wanted <= name_words(self._facts.label(iri)))

    @cached_property
    def _words_of_rooms(self) -> dict[str, frozenset[str]]:
        return {iri: noun_words(self._facts.label(iri)) for iri in self._facts.rooms}

    def _with_words(self, words: frozenset[str], *, is_whole: bool = False) -> Iterator[str]:
        """Yield the objects whose label has some words; if whole, no others but numbers."""
        if words:
            for iri, label in self._facts.with_words(words):
                if words == noun_words(label) if is_whole else words <= name_words(label):
                    yield iri

    def _with_run(self, text: str) -> list[str]:
        """Return the objects whose label ends with the words and numbers of a text, else has them within."""
        run = name_parts(text)
        labelled = [(iri, name_parts(label)) for iri, label in self._facts.with_words(run)]
        ending = [iri for iri, parts in labelled if parts[-len(run) :] == run]
        starts = range(max((len(parts) for _, parts in labelled), default=0))
        return ending or [iri for iri, parts in labelled if any(parts[at : at + len(run)] == run for at in starts)]

    def _in_place(self, text: str) -> set[str]:
        """Return the objects of a kind below a group that the words before the noun name: dining chairs."""
        words = text.split()
        for start in range(1, len(words)):
            place = noun_words(" ".join(words[:start]))
            kind = self._kinds.objects(" ".join(words[start:]))
            if found := {iri for iri in kind if place <= self._group_words(self._group(iri))}:
                return found
        return set()

    def _is_plain(self, text: str) -> bool:
        """Return whether the words before a noun do not make another kind: a dining chair is a chair."""
        *before, last = text.split()
        head = singular(last)
        return bool(before) and not set(concepts_named(" ".join([*before, head]))).isdisjoint(concepts_named(head))

    def _main_of_group(self, name: str) -> set[str]:
        """Return the objects of the kind that a group is named after, the desk of Desk_A1, else what it consists of."""
        grouped = set(self._facts.below_group(name))
        if not grouped:
            return set()
        noun = " ".join(word for word in split_identifier(name) if word.isalpha() and len(word) > 1)
        if of_kind := self._kinds.objects(noun) & grouped:
            return of_kind
        held = {iri for iri in grouped for name in _HELD if not grouped.isdisjoint(self._facts.anchors(name, iri))}
        carriers = (grouped - held) or grouped
        if len(carriers) > 1 and (is_plural(noun) or is_place(noun) or not concepts_named(noun)):
            # The group is no single thing.
            return (grouped - find_parts(self._facts, grouped)) or grouped
        # The sideboard of a group with what stands on it; the frame of a bed, not its pillows.
        return {max(self._facts.sorted(carriers), key=self._volume)}

    def _volume(self, iri: str) -> float:
        extents = self._facts.body(iri).extents
        return 0.0 if extents is None else float(np.prod(extents))

    def _main_of_groups(self, text: str) -> set[str]:
        """Return the main objects of the groups that are named after a kind: the fridge of `Refrigerator_1`."""
        if not is_noun(text) or any(len(word) == 1 for word in text.split()):
            return set()
        meant, words = self._kinds.usual_concepts(text), noun_words(text)
        # The groups of single nightstands tell more than the one of all nightstands around them.
        if single := self._main_of_single_groups(text):
            return single
        nouns = self._nouns_of_groups.items()
        named = [group for group, noun in nouns if noun_words(noun) == words]
        named = named or [group for group, noun in nouns if not meant.isdisjoint(self._kinds_of_group(noun))]
        return {iri for group in named for iri in self._main_of_group(group)}

    def _main_of_single_groups(self, text: str) -> set[str]:
        """Return the main objects of the groups that a noun in the singular names: a group `Fridge` is one fridge."""
        words = noun_words(text)
        named = (
            group for group, noun in self._nouns_of_groups.items() if not is_plural(noun) and noun_words(noun) == words
        )
        return {iri for group in named for iri in self._main_of_group(group)}

    def _kinds_of_group(self, noun: str) -> frozenset[str]:
        """Return the concepts of a noun and of its head: a wall cabinet is a cabinet."""
        return self._kinds.usual_concepts(noun) | self._kinds.usual_concepts(noun.rsplit(maxsplit=1)[-1])

    @cached_property
    def _nouns_of_groups(self) -> dict[str, str]:
        """Name of a group in lower case → its words without numbers and single letters."""
        names = sorted({name for path in self._facts.columns.paths for name in path.split("/")[2:-1]})
        words = {name: [w for w in split_identifier(name) if w.isalpha() and len(w) > 1] for name in names}
        return {name.lower(): " ".join(found).lower() for name, found in words.items() if found}

    def _group(self, iri: str) -> str:
        """Return the path of the groups of an object, without the root that all share."""
        return self._facts.path(iri).rpartition("/")[0].removeprefix(self.root)

    def _group_words(self, group: str) -> frozenset[str]:
        # Objects share groups.
        if group not in self._words_of_groups:
            self._words_of_groups[group] = noun_words(group)
        return self._words_of_groups[group]

    @cached_property
    def root(self) -> str:
        """The prim path that the groups of all objects begin with."""
        groups = {path.rpartition("/")[0] for path in self._facts.columns.paths}
        return os.path.commonpath([group for group in groups if group] or ["/"])


def _numbers(label: str) -> set[str]:
    return {word for word in name_words(label) if word.isdigit()}


def _found(criterion: _Criterion) -> frozenset[str]:
    return frozenset(criterion())


def _head_of(label: str) -> str:
    """Return the last word of a label in the singular: `rack` of ShoeRack_01."""
    words = [part.lower() for part in split_identifier(label) if part.isalpha() and len(part) > 1]
    return singular(words[-1]) if words else ""
