"""Prior of a word as the name of an object in a scene, from its frequency in English text."""

import math
from functools import lru_cache

from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.settings import DOMAIN_FREQUENCY, WORD_PRIOR
from usd2kg.knowledge import read_compressed

__all__ = ["UNKNOWN_FREQUENCY", "log_prior"]

UNKNOWN_FREQUENCY = 1.0
"""Zipf score of a word in no list: ten uses in a billion words, the end of SCOWL's class 70, rounded down."""

_TOTAL_WEIGHT = 2510471.0821666713
"""Sum of the weights of the vocabulary, stored because it takes half a second to compute; a test verifies it."""

_UNLISTED = f"{10 * UNKNOWN_FREQUENCY:.0f}/"
"""The entry of an unlisted word."""


@lru_cache(maxsize=1)
def _load_entries() -> dict[str, str]:
    """Return word → “tenths of Zipf score/percent of uses as a common noun”, parsed on access.

    The words are singular nouns and adjectives in lower case, without compounds of several words and words for nothing
    physical (`summer`). The Zipf score is log10 of the uses in a billion words, plurals with their singular, all parts
    of speech together. It rests on ranks (books up to 2012, Wikipedia, novels), not on counts, so it errs by half a
    unit.
    """
    words, entries = read_compressed("frequencies.txt.gz").decode("ascii").splitlines()
    return dict(zip(words.split(), entries.split(), strict=True))


def log_prior(word: str) -> float:
    """Return log P(word) as the name of an object in an indoor or industrial scene, natural logarithm.

    P(w) = f(w)^0.75 · t(w) / Z, with f the uses in a billion words, and t the share of uses for physical objects:

        t(w) = n(w) · (Σ_s weight(domain(s)) / rank(s)) / (Σ_s 1 / rank(s)) + (1 - n(w)) · 0.003

    n is the share of uses as a common noun, s a sense of the noun; 1 / rank is Zipf's law. A sense outside the taxonomy
    has the weight 0.003, an artifact 1. A word outside WordNet that ends a label of the home TBox has t = 0.5. Z
    normalises over the vocabulary: nouns and adjectives of the taxonomy, and the English words of the home TBox. Other
    words have the frequency of an unknown word and are not part of Z: their priors compare, but do not add up.
    """
    return _prior(_load_entries().get(word, _UNLISTED), load_taxonomy().kinds(word))


@lru_cache(maxsize=8192)
def _prior(entry: str, kinds: str) -> float:
    """Return the prior by entry and senses, which many words share."""
    tenths, _, percent = entry.partition("/")
    weight = float(10 ** (WORD_PRIOR.frequency_power * (int(tenths) / 10)) * _thing_share(percent, kinds))
    return math.log(weight / _TOTAL_WEIGHT)


def _thing_share(percent: str, kinds: str) -> float:
    if not percent:
        return _noun_weight(kinds)
    if percent == "-":
        return WORD_PRIOR.home_label_share
    noun_share = int(percent) / 100
    return noun_share * _noun_weight(kinds) + (1 - noun_share) * DOMAIN_FREQUENCY.other


@lru_cache(maxsize=4096)
def _noun_weight(kinds: str) -> float:
    senses = load_taxonomy().parse_kinds(kinds)
    if not senses:
        return DOMAIN_FREQUENCY.other
    # Two spellings of a compound (back door, backdoor) have senses of the same rank; the first one counts.
    weights = {rank: DOMAIN_FREQUENCY.of(domain) for rank, domain in reversed(senses)}
    ranks = range(1, senses[-1][0] + 1)
    return sum(weights.get(rank, DOMAIN_FREQUENCY.other) / rank for rank in ranks) / sum(1 / rank for rank in ranks)
