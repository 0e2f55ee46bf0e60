"""Counts of words and bigrams in the names of scenes, where words such as `left`, `steel` or `lid` are frequent.

The data are 11,000 names written for this project, see `tools/build_written_names.py`.
"""

import math
from collections import Counter, defaultdict
from collections.abc import Mapping
from functools import cached_property, lru_cache
from itertools import pairwise

from usd2kg.grounding.lexical.settings import FREQUENCY
from usd2kg.knowledge import read_text

__all__ = ["NameBigrams", "load_name_bigrams"]


class NameBigrams:
    """Words of names in the singular."""

    def __init__(self, text: str) -> None:
        """Count the words of names, one name a line, words separated by spaces."""
        self._text = text
        self.counts: Mapping[str, int] = Counter(text.split())
        """Word → number of occurrences."""
        self._total = sum(self.counts.values())

    def log_share(self, word: str) -> float:
        """Return the logarithm of a word's share of all words; -inf for a word that does not occur."""
        return math.log(self.counts[word] / self._total) if word in self.counts else -math.inf

    def followers(self, word: str) -> Mapping[str, float]:
        """Return next word → its probability after `word`, smoothed with pseudo-counts of unseen words."""
        total = self.counts[word] + FREQUENCY.bigram_pseudo_count
        return {follower: count / total for follower, count in Counter(self._pairs.get(word, "").split()).items()}

    def odds_of_last(self, word: str) -> float:
        """Return the odds of a word to be last in a name of several words, smoothed."""
        last, before = self._last_and_before
        return (last[word] + FREQUENCY.last_pseudo_count) / (before[word] + FREQUENCY.last_pseudo_count)

    @cached_property
    def _last_and_before(self) -> tuple[Counter[str], Counter[str]]:
        names = [words for words in map(str.split, self._text.splitlines()) if len(words) > 1]
        return Counter(words[-1] for words in names), Counter(word for words in names for word in words[:-1])

    @cached_property
    def _pairs(self) -> dict[str, str]:
        """Word → the words after it, once for each occurrence; one string takes a tenth of the memory of a list."""
        found: dict[str, list[str]] = defaultdict(list)
        for line in self._text.splitlines():
            for word, next_word in pairwise(line.split()):
                found[word].append(next_word)
        return {word: " ".join(after) for word, after in found.items()}


@lru_cache(maxsize=1)
def load_name_bigrams() -> NameBigrams:
    """Return the counts of the package data, read once."""
    return NameBigrams(read_text("written_names.txt"))
