"""Which word of a name says what the thing is: the bowl of `bowl_salad_oak`, the table of `dining_table`.

A conditional logit over the words at which the phrase proper may end (McFadden, 1974): the weight of an end is
exp(Σ weight · feature). The weights are in `data/heads.json`, written by `tools/fit_heads.py`.
"""

import json
import math
from collections import Counter
from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files

from usd2kg.grounding.embedded.lexicon import home_names

__all__ = ["FEATURES", "likelihood", "propensity"]

FEATURES = {
    "score": "logarithm of the score of the best class at this end",
    "telling": "logarithm of how likely the head itself does more than describe, for a single word",
    "compound": "whether a term of several words ends here",
    "size": "logarithm of how much likelier the size makes it that a thing is called so",
    "no_usual_size": "whether nothing is known of the usual size of what is called so",
    "guessed": "whether the head was misspelt: a brand or a word of another language may look like it",
    "behind": "number of words behind it",
    "glued": "whether a word is written on to the head, as in `RoomWindow`",
    "propensity": "`propensity` of the head, for a single word",
    "propensity_behind": "`propensity` of the words behind it, added up",
    "linked": "whether a term that ends later holds the head, as `swab jar` does in `cotton_swab_jar`",
    "turned": "whether the word that tells its kind stands behind the head, as in `plate_dinner`",
    "place": "whether it is a place, after which things are called",
}
"""Name → what it is."""


def likelihood(features: Mapping[str, float]) -> float:
    """Return how likely a phrase ends where these features were read, up to a factor that all its ends share."""
    weights = _weights()
    return math.exp(sum(weights[name] * value for name, value in features.items()))


def propensity(word: str) -> float:
    """Return the logarithm of how many times oftener a word ends a name of several words than stands within one.

    >>> propensity("frame") > 0 > propensity("porcelain")
    True
    """
    ends, within = _counts()
    return math.log((ends[word] + 1) / (within[word] + 1))


@lru_cache(maxsize=1)
def _counts() -> tuple[Counter[str], Counter[str]]:
    ends: Counter[str] = Counter()
    within: Counter[str] = Counter()
    for names in home_names().values():
        for *modifiers, head in (words for name in names if len(words := name.lower().split()) > 1):
            ends[head] += 1
            within.update(modifiers)
    return ends, within


@lru_cache(maxsize=1)
def _weights() -> dict[str, float]:
    text = (files("usd2kg.grounding") / "data" / "heads.json").read_text(encoding="utf-8")
    found: dict[str, float] = json.loads(text)["weights"]
    return found
