"""How common a word is in English text, and as the name of a thing in a scene."""

import gzip
import math
from functools import lru_cache

from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.knowledge import read_bytes

__all__ = ["UNKNOWN_FREQUENCY", "thing_prior", "word_frequency"]

UNKNOWN_FREQUENCY = 1.0
"""Zipf score of a word that no list has: ten uses in a billion words, where SCOWL's class 70 ends, rounded down."""

_DISCOUNT = 0.75
"""Power of a word's frequency: names in scenes are spread more evenly than words in texts.

The value that word2vec draws words with (Mikolov et al., NeurIPS 2013, section 2.2).
"""

_DOMAIN_WEIGHTS = {
    "artifact": 1.0,
    "food": 0.2,
    "plant": 0.2,
    "animal": 0.1,
    "body": 0.1,
    "object": 0.1,
    "substance": 0.1,
    "communication": 0.03,
    "shape": 0.03,
    "group": 0.01,
    "person": 0.01,
    "phenomenon": 0.01,
    "top": 0.01,
}
"""WordNet's domain → how much rarer than an artifact its members stand, named so, in homes and factories."""

_TOTAL_WEIGHT = 2509746.600651732
"""Sum of the weights of the vocabulary, written down because it takes half a second to add up; a test does."""

_OTHER_WEIGHT = 0.003
"""The same for persons, acts, times and all that is not in the taxonomy, and for uses that are no nouns."""

_NEW_WEIGHT = 0.5
"""The same for a word that WordNet lacks and that a label of the home TBox ends with (`cooktop`)."""

_UNLISTED = f"{10 * UNKNOWN_FREQUENCY:.0f}/"
"""The entry of a word that the data do not list."""


@lru_cache(maxsize=1)
def _load_entries() -> dict[str, str]:
    """Return word → "tenths of Zipf/percent of uses as a common noun", taken apart only where asked for."""
    data = read_bytes("frequencies.txt.gz")
    words, entries = gzip.decompress(data).decode("ascii").splitlines()
    return dict(zip(words.split(), entries.split(), strict=True))


def word_frequency(word: str) -> float:
    """Return the Zipf score of a singular noun or an adjective in lower case: log10 of its uses in a billion words.

    Plurals are counted with their singular, all parts of speech together; the score is given to one decimal.
    It rests on ranks (books up to 2012, Wikipedia, novels), not on counts, so it errs by half a unit. Any other
    word has `UNKNOWN_FREQUENCY`: an unknown one, a plural, a compound of several words, a word for nothing physical
    (`summer`).

    >>> word_frequency("chair"), word_frequency("davenport")
    (4.9, 3.7)
    """
    return int(_load_entries().get(word, _UNLISTED).partition("/")[0]) / 10


def thing_prior(word: str) -> float:
    """Return the natural logarithm of the probability that an object in an indoor or industrial scene is called so.

    p(w) = f(w)^0.75 · t(w) / Z, with f the uses in a billion words. The thing share t weighs what the word stands for:

        t(w) = n(w) · (Σ_s weight(domain(s)) / rank(s)) / (Σ_s 1 / rank(s)) + (1 - n(w)) · 0.003

    n is the share of uses as a common noun. The meanings s of the noun run down to its last one in the taxonomy, used
    the less the later they rank (after Zipf); one that the taxonomy leaves out (person, act, time…) weighs 0.003, an
    artifact 1. Where WordNet lacks the word and a label of the home TBox ends with it, t = 0.5. Z makes the sum over
    the vocabulary 1: the single-word nouns and the adjectives of the taxonomy, and the English words of the home TBox.
    Any other word has the unknown word's f and comes on top of the sum, so compare it, but do not add.
    """
    return _prior(_load_entries().get(word, _UNLISTED), load_taxonomy().kinds(word))


@lru_cache(maxsize=8192)
def _prior(entry: str, kinds: str) -> float:
    """Return the prior of the words that share an entry and the kinds of their meanings, which many do."""
    tenths, _, percent = entry.partition("/")
    weight = float(10 ** (_DISCOUNT * (int(tenths) / 10)) * _thing_share(percent, kinds))
    return math.log(weight / _TOTAL_WEIGHT)


def _thing_share(percent: str, kinds: str) -> float:
    if not percent:
        return _noun_weight(kinds)
    if percent == "-":
        return _NEW_WEIGHT
    noun_share = int(percent) / 100
    return noun_share * _noun_weight(kinds) + (1 - noun_share) * _OTHER_WEIGHT


@lru_cache(maxsize=4096)
def _noun_weight(kinds: str) -> float:
    senses = load_taxonomy().parse_kinds(kinds)
    if not senses:
        return _OTHER_WEIGHT
    # Meanings share a rank where a compound is written in two ways (back door, backdoor); the first one stands.
    weights = {rank: _DOMAIN_WEIGHTS[domain] for rank, domain in reversed(senses)}
    ranks = range(1, senses[-1][0] + 1)
    return sum(weights.get(rank, _OTHER_WEIGHT) / rank for rank in ranks) / sum(1 / rank for rank in ranks)
