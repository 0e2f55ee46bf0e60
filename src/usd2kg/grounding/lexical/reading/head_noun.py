"""Likelihood that a word is the head noun of a name: the bowl of `bowl_salad_oak`, the table of `dining_table`.

A conditional logit over the words of the name (McFadden, 1974): the weight of a word is exp(Σ weight · feature).
`tools/fit_head_noun.py` fits the weights and writes them to `data/head_noun.json`.
"""

import json
import math
from functools import lru_cache
from operator import mul
from typing import NamedTuple

from usd2kg.grounding.lexical.concepts.home_names import home_words
from usd2kg.knowledge import read_text

__all__ = ["HeadFeatures", "head_likelihood", "head_log_odds"]


class HeadFeatures(NamedTuple):
    """Features of a word as the head noun; truth values are 0 or 1, and “behind” is to the right of the word."""

    score: float = 0.0
    """Logarithm of the score of the best class."""
    log_not_modifier: float = 0.0
    """Logarithm of the probability that a single word is not a modifier."""
    compound: float = 0.0
    """Whether a known compound ends here."""
    compound_before: float = 0.0
    """Whether a known compound ends here and words are behind it: the sink area of `sink_area_drawer`."""
    size_log_ratio: float = 0.0
    """Log-likelihood ratio of the size for such an object."""
    no_usual_size: float = 0.0
    """Whether the size is known and the usual size of such an object is not."""
    corrected: float = 0.0
    """Whether the spelling was corrected: brands and foreign words may look like the noun."""
    behind: float = 0.0
    """Whether words are behind it."""
    glued: float = 0.0
    """Number of words that follow without a separator, as in `RoomWindow`."""
    last_log_odds: float = 0.0
    """`head_log_odds` of a single word."""
    last_log_odds_behind: float = 0.0
    """Mean `head_log_odds` of the words behind it."""
    inside_compound: float = 0.0
    """Whether a later compound contains it: the swab of `cotton_swab_jar`."""
    inverted: float = 0.0
    """Whether its modifier is behind it, as in `plate_dinner`."""
    place: float = 0.0
    """Whether it is a place, which names often begin with."""
    repeats_parent: float = 0.0
    """Whether the parent's name has the words up to it: below `fridge_main` the fridge of `fridge_interior_lamp`."""
    in_parent: float = 0.0
    """Whether the parent's name has it and words are before it: below `sinkUnit` the sink of `doorSink`."""


def head_likelihood(features: HeadFeatures) -> float:
    """Return the likelihood of a head noun up to a factor common to all words of the name."""
    return math.exp(sum(map(mul, _weights(), features)))


@lru_cache(maxsize=16384)
def head_log_odds(word: str) -> float:
    """Return the log-odds of a word to be last in a compound rather than before, in the home vocabulary.

    >>> head_log_odds("frame") > 0 > head_log_odds("porcelain")
    True
    """
    words = home_words()
    return math.log((words.last_counts.get(word, 0) + 1) / (words.before_counts.get(word, 0) + 1))


@lru_cache(maxsize=1)
def _weights() -> HeadFeatures:
    return HeadFeatures(**json.loads(read_text("head_noun.json"))["weights"])
