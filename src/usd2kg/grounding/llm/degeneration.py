"""is_degenerate: whether a completion is empty, repeats itself, or consists of ever longer fragments."""

import re
from itertools import pairwise

from usd2kg.grounding.llm.settings import DEGENERATION

__all__ = ["is_degenerate"]

_FRAGMENT_ENDS = (r"[\n.!?]+", r"[\n,;]+")
"""Ends of sentences, and of items."""


def is_degenerate(text: str) -> bool:
    """Return whether a text, complete or not, is empty or ends in a loop or a run of growing fragments.

    A loop is a repetition of one fragment, or of up to three in any order. The rows of many objects are not a loop,
    since their numbers differ. The thresholds are in knowledge/settings/llm.toml, `[degeneration]`.
    """
    tail = text[-DEGENERATION.window_characters :]
    if not text.strip() or _is_periodic(tail) or _is_growing(tail):
        return True
    return any(_repeats_few_fragments(re.split(ends, tail)) for ends in _FRAGMENT_ENDS)


def _is_periodic(tail: str) -> bool:
    for scale in DEGENERATION.period_scales:
        # The previous occurrence of the last `scale` characters is one period earlier, for periods up to `scale`.
        period = len(tail) - scale - tail.rfind(tail[-scale:], 0, len(tail) - 1)
        length = max(DEGENERATION.min_loop_characters, DEGENERATION.min_repetitions * period)
        if 0 < period <= scale and len(tail) >= length and tail[-length:-period] == tail[period - length :]:
            return True
    return False


def _repeats_few_fragments(pieces: list[str]) -> bool:
    """Return whether the last complete pieces are repetitions of a few fragments, in any order."""
    fragments: set[str] = set()
    length = count = 0
    # The first and the last piece may be incomplete.
    for piece in reversed(pieces[1:-1]):
        fragments.add(piece)
        if len(fragments) > DEGENERATION.max_distinct_fragments:
            return False
        length, count = length + len(piece) + 1, count + 1
        is_long = length >= DEGENERATION.min_loop_characters
        if is_long and count >= DEGENERATION.min_repetitions * len(fragments):
            return True
    return False


def _is_growing(tail: str) -> bool:
    """Return whether a text ends in words or lines that each extend the previous one, or in an endless word."""
    if len(tail) >= DEGENERATION.min_loop_characters and re.fullmatch(
        r"\w+", tail[-DEGENERATION.min_loop_characters :]
    ):
        return True
    run = DEGENERATION.min_growing_run
    # The last word or line may be incomplete.
    words = re.split(r"[\s,;]+", tail)[-run - 1 : -1]
    if len(words) == run and all(len(one) < len(other) for one, other in pairwise(words)):
        return True
    lines = tail.split("\n")[-run - 1 : -1]
    return len(lines) == run and all(other.startswith(one) and one != other for one, other in pairwise(lines))
