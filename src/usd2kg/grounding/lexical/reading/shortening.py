"""Model of how words are shortened (vowels dropped, truncated, or both), and an index from forms to words."""

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding.lexical.reading.shortening_settings import SHORTENING
from usd2kg.knowledge import read_rows

__all__ = [
    "Expansion",
    "FormIndex",
    "consonants_of",
    "find_range",
    "forms_of",
    "log_probability",
    "may_be_short",
    "usual_abbreviations",
    "ways_of",
]

_VOWELS = "aeiou"
_STYLES = (SHORTENING.skeleton_share, SHORTENING.skeleton_with_first_vowel_share, SHORTENING.truncated_share)
"""Share of each style: consonants only, consonants and a first vowel, first letters."""
_LENGTHS = tuple(enumerate(SHORTENING.length_shares, start=1))
"""(number of letters kept, share)."""
_WAYS = (SHORTENING.full_share, *(style * share for style in _STYLES for _, share in _LENGTHS))
"""Prior probability of each abbreviation style, see `ways_of`."""
_LONGEST_FORM = len(_LENGTHS)
_CACHED_LETTERS = 4
"""Length of the prefixes whose range of words is cached: about 10,000 exist, and few words share each."""
_NONE, _BEGINNING, _WHOLE = range(3)
"""Relation of a form to the letters of a word in one style, before truncation."""
_WITHOUT_VOWELS = str.maketrans("", "", _VOWELS)
_LAST = "\U0010ffff"
"""Sorts after every letter."""


class Expansion(NamedTuple):
    """A word that a form may abbreviate."""

    score: float
    """log P(word) + log P(form | word)."""
    word: str


@lru_cache(maxsize=1)
def usual_abbreviations() -> dict[str, str]:
    """Return short form → word of common abbreviations: `kbd` is a keyboard."""
    return {row["short"]: row["word"] for row in read_rows("abbreviations.csv")}


def may_be_short(word: str) -> bool:
    """Return whether an unknown word looks abbreviated: few letters, or hardly any vowel. Brands usually do not.

    >>> may_be_short("cush"), may_be_short("wrkbnch"), may_be_short("granito")
    (True, True, False)
    """
    vowels = len(word) - len(word.translate(_WITHOUT_VOWELS))
    has_few_vowels = len(word) <= SHORTENING.max_letters_with_vowels or vowels < 2
    return word.isalpha() and len(word) <= SHORTENING.max_letters and has_few_vowels


def consonants_of(word: str) -> str:
    """Return the first letter of a word and the consonants after it."""
    return word[0] + word[1:].translate(_WITHOUT_VOWELS)


def _styled(word: str) -> tuple[str, str, str]:
    """Return the letters of a word in each style, before truncation; empty for a word of vowels."""
    rest = word[1:].translate(_WITHOUT_VOWELS)
    return rest if word[0] in _VOWELS else word[0] + rest, word[0] + rest, word


def ways_of(word: str) -> dict[str, int]:
    """Return form → bit mask of the ways that lead to it: in full, then style by style and length by length."""
    ways = {word: 1}
    at = 0
    for letters in _styled(word):
        for length, _ in _LENGTHS:
            at += 1
            if letters:
                ways[letters[:length]] = ways.get(letters[:length], 0) | 1 << at
    return ways


@lru_cache(maxsize=4096)
def log_probability(ways: int) -> float:
    """Return the log probability of a set of ways; -inf for none."""
    probability = sum(share for at, share in enumerate(_WAYS) if ways >> at & 1)
    return math.log(probability) if probability else -math.inf


@lru_cache(maxsize=8192)
def forms_of(word: str) -> list[tuple[str, float]]:
    """Return (form, log probability) of all forms of a word."""
    return [(form, log_probability(ways)) for form, ways in ways_of(word).items()]


def _code(skeleton: int, with_first_vowel: int, cut: int) -> int:
    """Return a code for the relations of a form to a word in each style."""
    return skeleton + 3 * with_first_vowel + 9 * cut


@lru_cache(maxsize=64)
def _log_probabilities(length: int, is_full: bool) -> list[float]:
    """Return `_code` → log P(form | word) for forms of a length; -inf where it is impossible.

    A form that has all letters of the word may come from any larger number of kept letters.
    """
    found = []
    for code in range(27):
        probability = SHORTENING.full_share if is_full else 0.0
        for style, style_share in enumerate(_STYLES):
            fit = code // 3**style % 3
            for kept, share in _LENGTHS:
                if (fit == _BEGINNING and kept == length) or (fit == _WHOLE and kept >= length):
                    probability += style_share * share
        found.append(math.log(probability) if probability else -math.inf)
    return found


class FormIndex:
    """Index from forms to words.

    The letters of all words are sorted, so that words with a common beginning are one range. Forms are looked up on
    demand: a scene has about a thousand of half a million.
    """

    def __init__(self, priors: Mapping[str, float], most: int) -> None:
        """Index words.

        Args:
            priors: word → log P(word).
            most: number of words returned for a form.
        """
        self._priors = priors
        self._most = most
        self._words = sorted(priors)
        skeletons = sorted(found for word in self._words for found in _skeletons(word))
        self._letters = [letters for letters, _, _ in skeletons]
        self._behind = [word for _, word, _ in skeletons]
        self._styles = bytes(code for _, _, code in skeletons)
        self._all = _Places(0, len(self._words), 0, len(self._letters))
        self._near = lru_cache(maxsize=8192)(self._find_near)

    def __contains__(self, word: str) -> bool:
        return word in self._priors

    def choices(self, form: str) -> list[Expansion] | None:
        """Return the most probable words for a form, best first; None if no form of a word begins with it."""
        places = self._find(form)
        if places is None:
            return None
        if len(form) > _LONGEST_FORM:
            codes = {form: _code(_NONE, _NONE, _NONE)} if form in self._priors else {}
        else:
            codes = self._codes(form, places)
        logs, priors = _log_probabilities(len(form), False), self._priors
        found = [Expansion(priors[word] + logs[code], word) for word, code in codes.items() if word != form]
        if form in codes:
            found.append(Expansion(priors[form] + _log_probabilities(len(form), True)[codes[form]], form))
        found.sort(reverse=True)
        return found[: self._most]

    def _codes(self, form: str, places: "_Places") -> dict[str, int]:
        """Return word → code of its relations to a form."""
        codes = dict.fromkeys(self._words[places.first : places.last], _code(_NONE, _NONE, _BEGINNING))
        if form in codes:
            codes[form] = _code(_NONE, _NONE, _WHOLE)
        for at in range(places.start, places.end):
            word = self._behind[at]
            fit = _WHOLE if len(self._letters[at]) == len(form) else _BEGINNING
            codes[word] = codes.get(word, 0) + fit * self._styles[at]
        return codes

    def _find(self, form: str) -> "_Places | None":
        """Return the ranges of words and letters that begin with a form; None if both are empty."""
        near = self._near(form[:_CACHED_LETTERS])
        return near if near is None or len(form) <= _CACHED_LETTERS else self._narrow(form, near)

    def _find_near(self, form: str) -> "_Places | None":
        near = self._near(form[:-1]) if len(form) > 1 else self._all
        return near and self._narrow(form, near)

    def _narrow(self, form: str, near: "_Places") -> "_Places | None":
        first, last = find_range(self._words, form, near.first, near.last)
        start, end = find_range(self._letters, form, near.start, near.end)
        # A word without its vowels is always truncated.
        return (
            _Places(first, last, start, end) if first < last or (start < end and len(form) <= _LONGEST_FORM) else None
        )


class _Places(NamedTuple):
    """Ranges of the words and of the letters that begin with a form, their ends exclusive."""

    first: int
    last: int
    """Range of the words in full."""
    start: int
    end: int
    """Range of their letters without vowels."""


def _skeletons(word: str) -> Iterator[tuple[str, str, int]]:
    """Yield (letters without vowels, word, code of the styles); `_code` is the sum of code · relation."""
    skeleton, with_first_vowel, _ = _styled(word)
    if skeleton == with_first_vowel:
        yield skeleton, word, _code(1, 1, 0)
    else:
        yield with_first_vowel, word, _code(0, 1, 0)
        if skeleton:
            yield skeleton, word, _code(1, 0, 0)


def find_range(ordered: list[str], beginning: str, first: int = 0, last: int | None = None) -> tuple[int, int]:
    """Return the range of the texts in a sorted list that begin with `beginning`, its end exclusive.

    `first` and `last` bound the search.
    """
    start = bisect_left(ordered, beginning, first, last)
    return start, bisect_left(ordered, beginning + _LAST, start, last)
