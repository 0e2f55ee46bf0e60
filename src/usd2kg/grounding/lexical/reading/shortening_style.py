"""Whether the words of a name are shortened alike: who writes `spn` for a spoon writes `frk` for a fork, not `for`.

A way to shorten words is a style and a number of letters, see `shortening`. The channel of `AbbreviationReader` takes
each word for itself, P(written | words) = Π_i Σ_s P(s) P(written_i | word_i, s). Of names of several words it says more
that most have one way for all of them, Σ_s P(s) Π_i P(written_i | word_i, s).
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding.lexical.reading.shortening import log_probability, usual_abbreviations, ways_of

__all__ = ["log_consistency"]

_CONSISTENT = 0.7
"""How often the words of one name are all shortened in the same way."""
_LONGEST_GAP = 6
_GAP = math.log(0.05)
"""About what a letter costs that belongs to no word."""
_USUAL = math.log(0.01)
"""About what an abbreviation costs that people have agreed on."""
_ANY_WAY = -1
"""All bits: nothing is told of the way."""


class _Parse(NamedTuple):
    """Words laid on letters."""

    score: float
    """Logarithm of how likely the words are written so, each taken for itself."""
    told: float
    """The same of those words alone that tell of a way."""
    ways: int
    """The ways in which all words may be shortened, a bit for each."""


def log_consistency(letters: str, words: Sequence[str], whole: Mapping[int, str]) -> float:
    """Return the logarithm of how much likelier words are written so than if each was shortened for itself.

    Args:
        letters: the name.
        words: what it is read as, in order.
        whole: place → word of those that stand in full for certain, and tell nothing of how others are shortened.
    """
    parse = _parse(letters, words, whole, longest_gap=0) or _parse(letters, words, whole, longest_gap=_LONGEST_GAP)
    alike = 0.0 if parse is None else math.exp(log_probability(parse.ways) - parse.told)
    return math.log(1 - _CONSISTENT + _CONSISTENT * alike)


def _parse(letters: str, words: Sequence[str], whole: Mapping[int, str], longest_gap: int) -> _Parse | None:
    """Return the likeliest way to lay words on letters, with gaps between them; None if there is none."""
    ends = {0: _Parse(0.0, 0.0, _ANY_WAY)}
    for word in words:
        begun, ends = _with_gaps(ends, longest_gap), {}
        for start, parse in begun.items():
            for form, log, ways in ((word, 0.0, 0),) if whole.get(start) == word else _written(word):
                if letters.startswith(form, start):
                    end, score = start + len(form), parse.score + log
                    if end not in ends or ends[end].score < score:
                        told = log if ways else 0.0
                        ends[end] = _Parse(score, parse.told + told, parse.ways & (ways or _ANY_WAY))
    return _with_gaps(ends, longest_gap).get(len(letters))


def _with_gaps(ends: dict[int, _Parse], longest: int) -> dict[int, _Parse]:
    found = dict(ends) if longest else ends
    for end, parse in ends.items():
        for gap in range(1, longest + 1):
            score = parse.score + gap * _GAP
            if end + gap not in found or found[end + gap].score < score:
                found[end + gap] = parse._replace(score=score)
    return found


@lru_cache(maxsize=2048)
def _written(word: str) -> tuple[tuple[str, float, int], ...]:
    """Return (form, log probability, ways) of all forms of a word; no ways for one that people have agreed on."""
    forms = [(form, log_probability(ways), ways) for form, ways in ways_of(word).items()]
    return (*forms, *((short, _USUAL, 0) for short in _short_forms().get(word, ())))


@lru_cache(maxsize=1)
def _short_forms() -> Mapping[str, list[str]]:
    found: dict[str, list[str]] = {}
    for short, word in usual_abbreviations().items():
        found.setdefault(word, []).append(short)
    return found
