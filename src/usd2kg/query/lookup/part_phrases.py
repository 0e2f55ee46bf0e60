"""PartPhrases: things that are parts of others, in noun phrases: drawers of cabinet 10, stove door."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.kinds import Kinds
from usd2kg.query.lookup.names import NameMatcher
from usd2kg.query.lookup.prepositions import RELATION_OF
from usd2kg.query.lookup.related_things import find_parts
from usd2kg.query.lookup.things import Things
from usd2kg.query.lookup.word_forms import is_noun, split_phrase

__all__ = ["PartPhrases"]

_AS_PART = re.compile(r"(?<=\w) (a )?(parts?|components?|pieces?)$")
_ON_TOP_OF = re.compile(rf"\b({'|'.join(sorted(word for word in RELATION_OF if word.endswith(' of')))})\b")
_Find = Callable[[str], Things | None]


class PartPhrases:
    """Reads noun phrases about parts of the things of one graph."""

    def __init__(self, facts: SceneFacts, kinds: Kinds, names: NameMatcher, find: _Find, find_noun: _Find) -> None:
        """Wrap the facts of a graph.

        Args:
            facts: the graph.
            kinds: its classes and concepts.
            names: its names.
            find: returns what a phrase means, None if a word is unknown.
            find_noun: as `find`; a compound that the lexicon lacks may be read as its head, which is noted.
        """
        self._facts = facts
        self._kinds = kinds
        self._names = names
        self._find = find
        self._find_noun = find_noun

    def read(self, text: str) -> Things | None:
        """Return the things that are parts of others, or of a group: `drawers of cabinet 10`."""
        if _ON_TOP_OF.search(text):
            # What is on top of a table is no part of it.
            return None
        noun, _, whole = text.partition(" of ")
        noun = _AS_PART.sub("", noun)
        first = self._find_noun(noun) if whole else None
        if first is None:
            return None
        wholes = self._find(" ".join(split_phrase(whole)))
        parts = find_parts(self._facts, wholes.iris) if wholes is not None else set()
        # One of many doors may have the name door.
        named = {*first.iris, *self._kinds.objects(noun)}
        if chosen := tuple(self._facts.sorted(named & parts)):
            return Things(chosen, text)
        # The switch of the light is the light switch.
        if whole and (compound := self._names.named(f"{whole} {noun}")):
            return Things(tuple(compound), text)
        below = self._names.in_area(whole)
        chosen = tuple(iri for iri in first.iris if iri in below)
        return Things(chosen, text) if chosen or wholes is not None else None

    def read_compound(self, words: Sequence[str]) -> Things | None:
        """Return the things of the head of a compound that are parts of what the words before it mean: oven door."""
        for start in range(1, len(words)):
            found = self.read(f"{' '.join(words[start:])} of {' '.join(words[:start])}")
            if found is not None and found.iris:
                return found
        return None

    def read_whole(self, text: str) -> Things | None:
        """Return the whole of a part that the graph does not have as an object: the fridge, for its door."""
        words = split_phrase(text)
        part, _, whole = " ".join(words).partition(" of ")
        if not whole:
            part, whole = words[-1], " ".join(words[:-1])
        found = self._find(" ".join(split_phrase(whole))) if whole and is_noun(part) else None
        if found is None or not found.iris:
            return None
        return replace(found, note=f"“{' '.join(words)}” was read as “{found.text}”")

    def are_parts(self, things: Things) -> bool:
        """Return whether there are things, and all are parts of others."""
        return bool(things.iris) and all(self._facts.anchors("part", iri) for iri in things.iris)
