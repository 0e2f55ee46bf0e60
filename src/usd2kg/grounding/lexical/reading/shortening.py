"""The ways in which people shorten words: vowels dropped, cut short, or both; and the words behind a short form."""

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple

from usd2kg.knowledge import read_rows

__all__ = [
    "Choice",
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
_FULL = 0.15
"""How often a word stands in full among abbreviations."""
_STYLES = {"skeleton": 0.5, "skeleton with first vowel": 0.15, "cut": 0.2}
"""How often words are shortened in each way."""
_LENGTHS = ((1, 0.02), (2, 0.1), (3, 0.28), (4, 0.35), (5, 0.15), (6, 0.1))
"""How many letters are kept, and how often."""
_WAYS = (_FULL, *(share * how_often for share in _STYLES.values() for _, how_often in _LENGTHS))
"""How often each way is taken, see `ways_of`."""
_LONGEST = 6
_REMEMBERED = 4
"""So many first letters are worth remembering: there are some ten thousand, and few words begin with each."""
_NONE, _BEGINNING, _WHOLE = range(3)
"""How a form stands to the letters of a word in one style, before they are cut."""
_LONGEST_SHORT, _MAY_HAVE_VOWELS = 8, 5
"""Letters of an abbreviation, and of one that may keep all of its vowels."""
_NO_VOWELS = str.maketrans("", "", _VOWELS)
_LAST = "\U0010ffff"
"""Sorts behind every letter."""


class Choice(NamedTuple):
    """A word that a form may stand for."""

    score: float
    """Logarithm of how likely it is, and that it is written so."""
    word: str


@lru_cache(maxsize=1)
def usual_abbreviations() -> dict[str, str]:
    """Return short form → word of the abbreviations that people have agreed on: `kbd` is a keyboard."""
    return {row["short"]: row["word"] for row in read_rows("abbreviations.csv")}


def may_be_short(word: str) -> bool:
    """Return whether an unknown word looks abbreviated: of few letters, or of hardly a vowel. Brands mostly do not.

    >>> may_be_short("cush"), may_be_short("wrkbnch"), may_be_short("granito")
    (True, True, False)
    """
    vowels = len(word) - len(word.translate(_NO_VOWELS))
    return word.isalpha() and len(word) <= _LONGEST_SHORT and (len(word) <= _MAY_HAVE_VOWELS or vowels < 2)


def consonants_of(word: str) -> str:
    """Return the first letter of a word and its letters behind it that are no vowels."""
    return word[0] + word[1:].translate(_NO_VOWELS)


def _styled(word: str) -> tuple[str, str, str]:
    """Return the letters of a word in each style, before it is cut; none where it has but vowels."""
    rest = word[1:].translate(_NO_VOWELS)
    return rest if word[0] in _VOWELS else word[0] + rest, word[0] + rest, word


def ways_of(word: str) -> dict[str, int]:
    """Return form → the ways that lead to it, a bit for each: in full; style by style, so many letters kept.

    Where a word has no more letters than are kept, all of them are.
    """
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
    """Return the logarithm of how often one of some ways is taken; -inf for none."""
    probability = sum(how_often for at, how_often in enumerate(_WAYS) if ways >> at & 1)
    return math.log(probability) if probability else -math.inf


@lru_cache(maxsize=8192)
def forms_of(word: str) -> list[tuple[str, float]]:
    """Return (form, log probability) of the ways in which a word is written."""
    return [(form, log_probability(ways)) for form, ways in ways_of(word).items()]


def _code(skeleton: int, with_first_vowel: int, cut: int) -> int:
    """Return a number for how a form stands to a word in each style."""
    return skeleton + 3 * with_first_vowel + 9 * cut


@lru_cache(maxsize=64)
def _log_probabilities(length: int, is_full: bool) -> list[float]:
    """Return by `_code` the log probability that a word is written in a form of that length; -inf where it is not.

    Letters that are no longer than the form are in it whole, however many more were kept.
    """
    found = []
    for code in range(27):
        probability = _FULL if is_full else 0.0
        for style, share in enumerate(_STYLES.values()):
            fit = code // 3**style % 3
            for kept, how_often in _LENGTHS:
                if (fit == _BEGINNING and kept == length) or (fit == _WHOLE and kept >= length):
                    probability += share * how_often
        found.append(math.log(probability) if probability else -math.inf)
    return found


class FormIndex:
    """Words by the forms in which they may be written.

    The letters of all words lie sorted, so that what begins with a form lies together. What a form may stand for is
    found when it is first asked for: of half a million forms a scene has some thousand.
    """

    def __init__(self, priors: Mapping[str, float], most: int) -> None:
        """Index words.

        Args:
            priors: word → logarithm of how likely it is.
            most: the number of words that are given for a form.
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

    def choices(self, form: str) -> list[Choice] | None:
        """Return the likeliest words for a form, best first; None if nothing that begins so is a form either."""
        places = self._find(form)
        if places is None:
            return None
        if len(form) > _LONGEST:
            codes = {form: _code(_NONE, _NONE, _NONE)} if form in self._priors else {}
        else:
            codes = self._codes(form, places)
        logs, priors = _log_probabilities(len(form), False), self._priors
        found = [Choice(priors[word] + logs[code], word) for word, code in codes.items() if word != form]
        if form in codes:
            found.append(Choice(priors[form] + _log_probabilities(len(form), True)[codes[form]], form))
        found.sort(reverse=True)
        return found[: self._most]

    def _codes(self, form: str, places: "_Places") -> dict[str, int]:
        """Return the words that may be written so, and how."""
        codes = dict.fromkeys(self._words[places.first : places.last], _code(_NONE, _NONE, _BEGINNING))
        if form in codes:
            codes[form] = _code(_NONE, _NONE, _WHOLE)
        for at in range(places.start, places.end):
            word = self._behind[at]
            fit = _WHOLE if len(self._letters[at]) == len(form) else _BEGINNING
            codes[word] = codes.get(word, 0) + fit * self._styles[at]
        return codes

    def _find(self, form: str) -> "_Places | None":
        """Return where the words and the letters lie that begin with a form; None if there are none."""
        near = self._near(form[:_REMEMBERED])
        return near if near is None or len(form) <= _REMEMBERED else self._narrow(form, near)

    def _find_near(self, form: str) -> "_Places | None":
        near = self._near(form[:-1]) if len(form) > 1 else self._all
        return near and self._narrow(form, near)

    def _narrow(self, form: str, near: "_Places") -> "_Places | None":
        first, last = find_range(self._words, form, near.first, near.last)
        start, end = find_range(self._letters, form, near.start, near.end)
        # Without its vowels a word is cut.
        return _Places(first, last, start, end) if first < last or (start < end and len(form) <= _LONGEST) else None


class _Places(NamedTuple):
    """Where what begins with a form lies; the last places are those behind it."""

    first: int
    last: int
    """Of the words in full."""
    start: int
    end: int
    """Of their letters without vowels."""


def _skeletons(word: str) -> Iterator[tuple[str, str, int]]:
    """Yield (letters, word, which styles) of a word without its vowels; times the fit, the styles are a code."""
    skeleton, with_first_vowel, _ = _styled(word)
    if skeleton == with_first_vowel:
        yield skeleton, word, _code(1, 1, 0)
    else:
        yield with_first_vowel, word, _code(0, 1, 0)
        if skeleton:
            yield skeleton, word, _code(1, 0, 0)


def find_range(ordered: list[str], beginning: str, first: int = 0, last: int | None = None) -> tuple[int, int]:
    """Return the first place, and the place behind the last, of what begins so in a sorted list.

    `first` and `last` are places between which it lies.
    """
    start = bisect_left(ordered, beginning, first, last)
    return start, bisect_left(ordered, beginning + _LAST, start, last)
