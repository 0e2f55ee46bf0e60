"""Spellings of foreign words: inflected, transliterated, or within a German compound."""

import unicodedata
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from usd2kg.knowledge import word_map, word_set
from usd2kg.languages.settings import SPELLING

__all__ = ["Entry", "Form", "compound_forms", "fold", "word_forms"]

_TRANSLITERATIONS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss", "œ": "oe"})
_UMLAUTS = {"a": "ä", "o": "ö", "u": "ü"}
_PARTS_OF_SPEECH = {"": "noun", "adjective": "adjective"}
"""Role of an entry → name of its word lists."""

_Kind = tuple[str, str]
"""Language and role, which determine the inflection."""
_ENDINGS: Mapping[_Kind, tuple[str, ...]] = {
    (language, role): tuple(sorted(word_set("languages", f"{language}_{name}_endings")))
    for language in ("de", "es", "fr")
    for role, name in _PARTS_OF_SPEECH.items()
}
_REPLACEMENTS: Mapping[_Kind, Mapping[str, str]] = {
    (language, role): word_map("languages", f"{language}_{name}_replacements")
    for language in ("es", "fr", "it")
    for role, name in _PARTS_OF_SPEECH.items()
}
"""Ending → the endings that replace it, separated by spaces."""
_UMLAUT_ENDINGS = ("", *sorted(word_set("languages", "de_umlaut_endings")))
_LINKING_ELEMENTS = tuple(sorted(word_set("languages", "de_linking_elements")))
_GERMAN_NOUN = ("de", "")


class Entry(NamedTuple):
    """One row of the vocabulary."""

    language: str
    word: str
    english: tuple[str, ...]
    is_homograph: bool
    """Whether it is also an English word."""
    role: str
    """Empty for a noun; `material`; `adjective`; `stem` (only begins compounds); `link` and `with` (no gloss)."""

    @property
    def is_spelling(self) -> bool:
        """Whether it is no word of its own, but a spelling of inflected ones that is an English word, too."""
        return not self.english and not self.role

    @property
    def kind(self) -> _Kind:
        """Language and role; materials are inflected as nouns."""
        return self.language, "" if self.role == "material" else self.role


class Form(NamedTuple):
    """One spelling of an entry."""

    entry: Entry
    cost: int
    """0 for the dictionary form; higher for rarer or more ambiguous spellings."""
    reveals_language: bool
    """Whether the spelling is not an English word."""


def fold(word: str, language: str) -> str:
    """Return a lower-case word without accents; German ä, ö, ü and ß become ae, oe, ue and ss."""
    if word.isascii():
        return word
    text = unicodedata.normalize("NFC", word)
    text = text.translate(_TRANSLITERATIONS) if language == "de" else text.replace("œ", "oe")
    return _strip_accents(text)


def _strip_accents(text: str) -> str:
    if text.isascii():
        return text
    return "".join(c for c in unicodedata.normalize("NFD", text) if not unicodedata.combining(c))


def word_forms(entry: Entry) -> Iterator[tuple[str, Form]]:
    """Yield (folded spelling, form) for an entry as a whole word."""
    yield from _spellings(entry.word, entry, 0)
    for ending in _ENDINGS.get(entry.kind, ()):
        yield from _spellings(entry.word + ending, entry, SPELLING.inflection_cost)
    for replaced, endings in _REPLACEMENTS.get(entry.kind, {}).items():
        if entry.word.endswith(replaced):
            for ending in endings.split():
                yield from _spellings(entry.word.removesuffix(replaced) + ending, entry, SPELLING.inflection_cost)
    if entry.kind == _GERMAN_NOUN and (stem := _with_umlaut(entry.word)):
        for ending in _UMLAUT_ENDINGS:
            yield from _spellings(stem + ending, entry, SPELLING.umlaut_cost, is_homograph=False)


def compound_forms(entry: Entry) -> Iterator[tuple[str, Form]]:
    """Yield (folded spelling, form) for the further spellings of a German noun that begins or continues a compound."""
    if entry.kind == _GERMAN_NOUN:
        for element in _LINKING_ELEMENTS:
            yield from _spellings(entry.word + element, entry, SPELLING.inflection_cost)
        if entry.word.endswith("e"):
            yield from _spellings(entry.word[:-1], entry, SPELLING.elision_cost, is_homograph=True)


def _spellings(word: str, entry: Entry, cost: int, *, is_homograph: bool | None = None) -> Iterator[tuple[str, Form]]:
    """Yield the folded spelling of a word and, for German umlauts, one without them, as some exporters write it."""
    reveals_language = not (entry.is_homograph if is_homograph is None else is_homograph)
    text = fold(word, entry.language)
    yield text, Form(entry, cost, reveals_language)
    bare = _strip_accents(word)
    if entry.language == "de" and bare != text and len(bare) >= SPELLING.min_lost_umlaut:
        is_long = len(bare) > SPELLING.min_lost_umlaut
        yield bare, Form(entry, cost + SPELLING.lost_umlaut_cost, is_long and reveals_language)


def _with_umlaut(word: str) -> str | None:
    """Return a German noun with the umlaut of its plural (`stühl`, `häus`); None if it has no such vowel.

    >>> _with_umlaut("baum")
    'bäum'
    """
    at = max(word.rfind("au"), word.rfind("a"), word.rfind("o"))
    at = at if word[at : at + 2] == "au" else max(at, word.rfind("u"))
    return word[:at] + _UMLAUTS[word[at]] + word[at + 1 :] if at >= 0 else None
