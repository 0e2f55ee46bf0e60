"""Corrections of words that neither a graph nor the lexicon has."""

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import NamedTuple

from rapidfuzz import fuzz, process

from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.kinds import Kinds
from usd2kg.query.lookup.word_forms import noun_words
from usd2kg.query.settings import LOOKUP, WORDS
from usd2kg.words import split_identifier

__all__ = ["Correction", "Spelling"]


class Correction(NamedTuple):
    """What the words of a phrase probably are."""

    words: list[str]
    """The words, corrected where one spelling is more likely than all others."""
    unknown: list[str]
    nearest: list[str]
    """Words that the unknown ones may be."""


class Spelling:
    """Corrects words by those of the names, classes and concepts of a graph."""

    def __init__(self, facts: SceneFacts, kinds: Kinds) -> None:
        self._facts = facts
        self._kinds = kinds

    def correct(self, words: Sequence[str], is_known: Callable[[str], bool]) -> Correction:
        """Return the correction of a phrase; its words that are neither known nor in the graph are unknown."""
        unknown = [word for word in words if not is_known(word) and not self.is_in_use(word)]
        corrected, nearest = list(words), []
        for word in unknown or words:
            similar = process.extract(
                word,
                self.vocabulary,
                scorer=fuzz.ratio,
                score_cutoff=WORDS.min_similarity,
                limit=LOOKUP.max_suggestions,
            )
            nearest += [name for name, _, _ in similar]
            if similar and (len(similar) == 1 or similar[0][1] > similar[1][1]) and len(word) >= WORDS.min_letters:
                corrected[words.index(word)] = similar[0][0]
        return Correction(corrected, unknown or [*words], list(dict.fromkeys(nearest)))

    def is_in_use(self, word: str) -> bool:
        """Return whether a name, class or concept of the graph has a word, or a word has no letters."""
        return not noun_words(word).isdisjoint(self._words_in_use) or not any(map(str.isalpha, word))

    @cached_property
    def _words_in_use(self) -> frozenset[str]:
        return frozenset(stem for word in self.vocabulary for stem in noun_words(word))

    @cached_property
    def vocabulary(self) -> list[str]:
        """The words of names, classes and concepts of the graph."""
        labels = (label for _, label in self._kinds.names)
        words = {*self._facts.columns.words, *(word.lower() for label in labels for word in split_identifier(label))}
        return sorted(word for word in words if word.isalpha() and len(word) >= WORDS.min_letters)
