"""Which word of a name says what the thing is: the bowl of `bowl_salad_oak`, the table of `dining_table`.

A conditional logit over the words at which the phrase proper may end (McFadden, 1974): the weight of an end is
exp(Σ weight · feature). The weights are in `data/head_noun.json`, written by `tools/fit_head_noun.py`.
"""

import json
import math
from collections import Counter
from functools import lru_cache
from itertools import chain
from operator import mul
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.lexicon import home_names
from usd2kg.knowledge import read_text

__all__ = ["HeadFeatures", "head_likelihood", "head_log_odds"]


class HeadFeatures(NamedTuple):
    """What is known of one end."""

    score: float = 0.0
    """Logarithm of the score of the best class at this end."""
    telling: float = 0.0
    """Logarithm of how likely the head itself does more than describe, for a single word."""
    compound: float = 0.0
    """Whether a term of several words ends here."""
    compound_within: float = 0.0
    """Whether one ends here and words stand behind it, as behind the `sink area` of `sink_area_drawer`."""
    size: float = 0.0
    """Logarithm of how much likelier the size makes it that a thing is called so."""
    no_usual_size: float = 0.0
    """Whether nothing is known of the usual size of what is called so."""
    guessed: float = 0.0
    """Whether the head was misspelt: a brand or a word of another language may look like it."""
    behind: float = 0.0
    """Whether words stand behind it."""
    glued: float = 0.0
    """Number of words that are written on to the head, as in `RoomWindow`."""
    propensity: float = 0.0
    """`propensity` of the head, for a single word."""
    propensity_behind: float = 0.0
    """Mean `propensity` of the words behind it."""
    linked: float = 0.0
    """Whether a term that ends later holds the head, as `swab jar` does in `cotton_swab_jar`."""
    turned: float = 0.0
    """Whether the word that tells its kind stands behind the head, as in `plate_dinner`."""
    place: float = 0.0
    """Whether it is a place, after which things are called."""
    shared: float = 0.0
    """Whether the name begins with the parent's words up to the head: below `fridge_main` a `fridge_interior_lamp`."""
    repeated: float = 0.0
    """Whether the parent's name holds the head, and words stand before it: below `sinkUnit` a `doorSink` is a door."""


def head_likelihood(features: HeadFeatures) -> float:
    """Return how likely a phrase ends where these features were read, up to a factor that all its ends share."""
    return math.exp(sum(map(mul, _weights(), features)))


@lru_cache(maxsize=16384)
def head_log_odds(word: str) -> float:
    """Return the logarithm of how many times oftener a word ends a name of several words than stands within one.

    >>> head_log_odds("frame") > 0 > head_log_odds("porcelain")
    True
    """
    ends, within = _counts()
    return math.log((ends[word] + 1) / (within[word] + 1))


@lru_cache(maxsize=1)
def _counts() -> tuple[Counter[str], Counter[str]]:
    names = (name.lower().split() for found in home_names().values() for name in found)
    compounds = [words for words in names if len(words) > 1]
    return Counter(words.pop() for words in compounds), Counter(chain.from_iterable(compounds))


@lru_cache(maxsize=1)
def _weights() -> HeadFeatures:
    text = read_text("head_noun.json")
    return HeadFeatures(**json.loads(text)["weights"])
