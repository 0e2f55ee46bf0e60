"""Likelihood of a common abbreviation style in a name: `spn` for spoon suggests `frk` for fork, not `for`.

A way of shortening is a style and a number of letters, see `shortening`. The channel of `AbbreviationReader` shortens
words independently: P(written | words) = Π_i Σ_s P(s) P(written_i | word_i, s). Most names use one way for all words:
Σ_s P(s) Π_i P(written_i | word_i, s). This module returns the log ratio of a mixture of both to the first.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding.lexical.reading.shortening import log_probability, usual_abbreviations, ways_of
from usd2kg.grounding.lexical.reading.shortening_settings import CHANNEL

__all__ = ["log_consistency"]

_LOG_GAP_LETTER = math.log(CHANNEL.gap_letter)
_LOG_COMMON_FORM = math.log(CHANNEL.common_form)
_ANY_WAY = -1
"""All bits set: no evidence of the style."""


class _Parse(NamedTuple):
    """An alignment of words with letters."""

    score: float
    """Log probability of the forms, words independent."""
    informative: float
    """The same for the words that are evidence of a style."""
    ways: int
    """The styles consistent with all words, one bit each."""


def log_consistency(letters: str, words: Sequence[str], whole: Mapping[int, str]) -> float:
    """Return log (P(written | words) with the mixture / P(written | words) with independent words).

    Args:
        letters: the name.
        words: its reading, in order.
        whole: index in `letters` → word of those certainly written in full, which are no evidence of a way.
    """
    parse = _parse(letters, words, whole, longest_gap=0) or _parse(
        letters, words, whole, longest_gap=CHANNEL.max_gap_letters
    )
    alike = 0.0 if parse is None else math.exp(log_probability(parse.ways) - parse.informative)
    return math.log(1 - CHANNEL.consistent_share + CHANNEL.consistent_share * alike)


def _parse(letters: str, words: Sequence[str], whole: Mapping[int, str], longest_gap: int) -> _Parse | None:
    """Return the most probable alignment of words with letters, with gaps between words; None if there is none."""
    ends = {0: _Parse(0.0, 0.0, _ANY_WAY)}
    for word in words:
        begun, ends = _with_gaps(ends, longest_gap), {}
        for start, parse in begun.items():
            for form, log, ways in ((word, 0.0, 0),) if whole.get(start) == word else _written(word):
                if letters.startswith(form, start):
                    end, score = start + len(form), parse.score + log
                    if end not in ends or ends[end].score < score:
                        informative = log if ways else 0.0
                        ends[end] = _Parse(score, parse.informative + informative, parse.ways & (ways or _ANY_WAY))
    return _with_gaps(ends, longest_gap).get(len(letters))


def _with_gaps(ends: dict[int, _Parse], longest: int) -> dict[int, _Parse]:
    found = dict(ends) if longest else ends
    for end, parse in ends.items():
        for gap in range(1, longest + 1):
            score = parse.score + gap * _LOG_GAP_LETTER
            if end + gap not in found or found[end + gap].score < score:
                found[end + gap] = parse._replace(score=score)
    return found


@lru_cache(maxsize=2048)
def _written(word: str) -> tuple[tuple[str, float, int], ...]:
    """Return (form, log probability, ways) of all forms of a word; ways are 0 for common abbreviations."""
    forms = [(form, log_probability(ways), ways) for form, ways in ways_of(word).items()]
    return (*forms, *((short, _LOG_COMMON_FORM, 0) for short in _short_forms().get(word, ())))


@lru_cache(maxsize=1)
def _short_forms() -> Mapping[str, list[str]]:
    found: dict[str, list[str]] = {}
    for short, word in usual_abbreviations().items():
        found.setdefault(word, []).append(short)
    return found
