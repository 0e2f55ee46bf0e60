"""Abbreviated names as words: a noisy channel over the words of the TBox, of the taxonomy and of the stage.

A name is read as the words w that make P(w) · P(written | w) largest (Shannon's noisy channel; for spelling Kernighan,
Church and Gale, COLING 1990). P(w) mixes how likely a thing is called so, the TBox's terms and the words of the other
names on the stage. P(written | w) is that of the usual ways to shorten a word: vowels dropped, cut short, or both.
"""

import csv
import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.resources import files
from itertools import accumulate
from typing import NamedTuple

from usd2kg.grounding.embedded.frequencies import thing_prior
from usd2kg.grounding.embedded.lexicon import Lexicon
from usd2kg.grounding.embedded.taxonomy import Taxonomy
from usd2kg.scene import Company

__all__ = ["AbbreviationReader", "Reading", "forms_of", "usual_abbreviations"]

_VOWELS = frozenset("aeiou")
_THINGS = frozenset({"artifact", "food", "plant", "substance"})
_FULL = 0.15
"""How often a word stands in full among abbreviations."""
_STYLES = {"skeleton": 0.5, "skeleton with first vowel": 0.15, "cut": 0.2}
"""How often words are shortened in each way."""
_LENGTHS = ((1, 0.02), (2, 0.1), (3, 0.28), (4, 0.35), (5, 0.15), (6, 0.1))
"""How many letters are kept, and how often."""
_TBOX_SHARE, _STAGE_SHARE = 0.55, 0.3
"""Of the words of names, how many are the TBox's, and how many are in another name on the stage."""
_ADJECTIVE = math.log(0.05 / 0.003)
"""How much likelier an adjective is to stand in a name than `thing_prior`, which is about heads, has it."""
_GENERAL = math.log(1 - _TBOX_SHARE - _STAGE_SHARE)
_RAREST = -15.5
_COMPOUND = math.log(15)
"""How much likelier two words are together if they make a known compound."""
_NEXT_WORD = math.log(0.35)
_ANY_LETTER = math.log(0.0004)
"""A single letter or pair that stands for no word: the C of CupC."""
_USUAL = math.log(0.002)
"""An abbreviation that people have agreed on, before the stage is heard."""
_UNKNOWN_WORD, _UNKNOWN_LETTER = math.log(0.02), math.log(0.06)
"""A word that nobody knows, a brand say, of three to six letters that may be any."""
_LONGEST_UNKNOWN = 6
_CHOICES = 7
_BEAM = 10
_HOPELESS = 9.0
"""A reading this much less likely than the best, as a logarithm, is given up."""
_MOST_PIECES = 8
_LONGEST_PIECE = 12
_READINGS = 12


@dataclass(frozen=True, slots=True)
class Reading:
    """One way to read a name."""

    words: tuple[str, ...]
    probability: float
    """Among all readings of the name that were found."""


class _Choice(NamedTuple):
    score: float
    word: str


class _Path(NamedTuple):
    score: float
    words: tuple[str, ...]
    pieces: int


class AbbreviationReader:
    """Reads abbreviated names with the words of one TBox."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._tbox_words = {word: count for word, count in lexicon.vocabulary.items() if len(word) > 1}
        self._tbox_total = sum(self._tbox_words.values())
        self._forms: dict[str, dict[str, list[_Choice]]] = {}
        """First letter → form → words; made for a letter when it is first met."""

    @cached_property
    def _by_initial(self) -> dict[str, list[str]]:
        """First letter of a form → the words that may be written so."""
        found: dict[str, list[str]] = {}
        for word in sorted({*self._taxonomy.words(_THINGS), *self._taxonomy.adjectives, *self._tbox_words}):
            if len(word) > 2 or word in self._tbox_words:
                for initial in {form[0] for form, _ in _styled(word)}:
                    found.setdefault(initial, []).append(word)
        return found

    def read(self, tokens: Sequence[str], company: Company | None = None) -> list[Reading]:
        """Return the likeliest readings of a name, best first.

        Args:
            tokens: its runs of letters, lower case; each may hold several words.
            company: the other objects of the stage, whose names may hold the same words.
        """
        letters = "".join(tokens)
        borders = list(accumulate(map(len, tokens)))
        ends: list[list[_Path]] = [[_Path(0.0, (), 0)], *([] for _ in letters)]
        for at in range(len(letters)):
            border = next(border for border in borders if border > at)
            paths = ends[at] = _best(ends[at])
            for end in range(at + 1, min(border, at + _LONGEST_PIECE) + 1):
                piece = letters[at:end]
                ends[end].extend(self._extended(paths, piece, self._choices(piece, company)))
        return _readings(_best(ends[-1]))

    def _choices(self, piece: str, company: Company | None) -> list[_Choice]:
        if piece[0] not in self._forms:
            self._forms[piece[0]] = self._index(piece[0])
        choices = list(self._forms[piece[0]].get(piece, ()))
        if piece in usual_abbreviations():
            choices.append(_Choice(_USUAL, usual_abbreviations()[piece]))
        if company is not None:
            near = [
                (math.log(_STAGE_SHARE * min(1.0, share)) + score, word)
                for word, share, score in company.words_written(piece, forms_of)
            ]
            best = sorted(near, key=lambda found: (-found[0], found[1]))[:_CHOICES]
            choices.extend(_Choice(score, self._taxonomy.singular(word)) for score, word in best)
        return choices

    def _extended(self, paths: list[_Path], piece: str, choices: list[_Choice]) -> Iterator[_Path]:
        for path in paths:
            if path.pieces >= _MOST_PIECES:
                continue
            score = path.score + (_NEXT_WORD if path.pieces else 0.0)
            if len(piece) <= 2:
                yield _Path(score + len(piece) * _ANY_LETTER, path.words, path.pieces + 1)
            elif len(piece) <= _LONGEST_UNKNOWN:
                yield _Path(score + _UNKNOWN_WORD + len(piece) * _UNKNOWN_LETTER, path.words, path.pieces + 1)
            for choice in choices:
                bonus = _COMPOUND if path.words and self._is_compound(path.words[-1], choice.word) else 0.0
                yield _Path(score + choice.score + bonus, (*path.words, choice.word), path.pieces + 1)

    def _is_compound(self, first: str, second: str) -> bool:
        key = first + second
        return key in self._lexicon.terms or key in self._taxonomy

    def _index(self, initial: str) -> dict[str, list[_Choice]]:
        index: dict[str, list[_Choice]] = {}
        for word in self._by_initial.get(initial, ()):
            prior = self._prior(word)
            if prior > _RAREST:
                for form, score in forms_of(word):
                    if form[0] == initial:
                        index.setdefault(form, []).append(_Choice(prior + score, word))
        return {form: sorted(choices, reverse=True)[:_CHOICES] for form, choices in index.items()}

    def _prior(self, word: str) -> float:
        """Return the log probability of a word in a name, the stage apart."""
        prior = thing_prior(word) + (_ADJECTIVE if word in self._taxonomy.adjectives else 0.0) + _GENERAL
        if word not in self._tbox_words:
            return prior
        # A word is the likelier the more terms hold it, and likelier where people use it.
        return _log_sum(prior, math.log(_TBOX_SHARE * self._tbox_words[word] / self._tbox_total))


@lru_cache(maxsize=1)
def usual_abbreviations() -> dict[str, str]:
    """Return short form → word of the abbreviations that people have agreed on: `kbd` is a keyboard."""
    text = (files("usd2kg.grounding") / "data" / "abbreviations.csv").read_text(encoding="utf-8")
    return {row["short"]: row["word"] for row in csv.DictReader(io.StringIO(text))}


def _styled(word: str) -> list[tuple[str, float]]:
    """Return (letters, probability) of a word in each style, before it is cut."""
    rest = "".join(letter for letter in word[1:] if letter not in _VOWELS)
    skeleton = rest if word[0] in _VOWELS else word[0] + rest
    styles = (("skeleton", skeleton), ("skeleton with first vowel", word[0] + rest), ("cut", word))
    return [(letters, _STYLES[style]) for style, letters in styles if letters]


@lru_cache(maxsize=65536)
def forms_of(word: str) -> list[tuple[str, float]]:
    """Return (form, log probability) of the ways in which a word is written."""
    forms = {word: _FULL}
    for letters, share in _styled(word):
        for length, kept in _LENGTHS:
            form = letters[:length]
            forms[form] = forms.get(form, 0.0) + share * kept
    return [(form, math.log(probability)) for form, probability in forms.items()]


def _readings(paths: list[_Path]) -> list[Reading]:
    found = paths[:_READINGS]
    weights = [math.exp(path.score - found[0].score) for path in found]
    readings = [Reading(path.words, weight / sum(weights)) for path, weight in zip(found, weights, strict=True)]
    # That it is no word at all is a reading too.
    return [reading for reading in readings if reading.words]


def _best(paths: list[_Path]) -> list[_Path]:
    """Return the best paths, those that read the same words as one."""
    by_words: dict[tuple[str, ...], _Path] = {}
    least = max((path.score for path in paths), default=0.0) - _HOPELESS
    paths = [path for path in paths if path.score > least]
    for path in sorted(paths, key=lambda path: (-path.score, path.words)):
        known = by_words.get(path.words)
        by_words[path.words] = path if known is None else known._replace(score=_log_sum(known.score, path.score))
    return sorted(by_words.values(), key=lambda path: (-path.score, path.words))[:_BEAM]


def _log_sum(one: float, other: float) -> float:
    high, low = max(one, other), min(one, other)
    return high + math.log1p(math.exp(low - high))
