"""How often people use a word in the names of a scene, and which words follow one another there.

Texts tell little of that: `left`, `steel` and `lid` are in more names than one would think. The data are 11,000 names
that the authors of this project wrote (`tools/build_written_names.py`).
"""

import math
from collections import Counter, defaultdict
from collections.abc import Mapping
from functools import cached_property, lru_cache
from itertools import pairwise

from usd2kg.knowledge import read_text

__all__ = ["WrittenNames", "load_written_names"]

_UNSEEN = 5
"""So many uses of a word are taken to be before words that it was not seen before."""

_RARE = 0.5
"""So many uses of each kind are supposed of any word."""


class WrittenNames:
    """The words of names, in the singular."""

    def __init__(self, text: str) -> None:
        """Read names, one a line, their words parted by spaces."""
        self._text = text
        self.counts: Mapping[str, int] = Counter(text.split())
        """Word → how often it is used."""
        self._total = sum(self.counts.values())

    def log_share(self, word: str) -> float:
        """Return the logarithm of a word's share of all words; -inf for one that is in no name."""
        return math.log(self.counts[word] / self._total) if word in self.counts else -math.inf

    def followers(self, word: str) -> Mapping[str, float]:
        """Return the words that stand directly behind a word in some name, with how often one does that."""
        total = self.counts[word] + _UNSEEN
        return {follower: count / total for follower, count in Counter(self._pairs.get(word, "").split()).items()}

    def odds_of_last(self, word: str) -> float:
        """Return how many times oftener a word stands last in names of several than before another word."""
        last, before = self._last_and_before
        return (last[word] + _RARE) / (before[word] + _RARE)

    @cached_property
    def _last_and_before(self) -> tuple[Counter[str], Counter[str]]:
        names = [words for words in map(str.split, self._text.splitlines()) if len(words) > 1]
        return Counter(words[-1] for words in names), Counter(word for words in names for word in words[:-1])

    @cached_property
    def _pairs(self) -> dict[str, str]:
        """Word → the words behind it, as often as they are there: as one text they take a tenth of the memory."""
        found: dict[str, list[str]] = defaultdict(list)
        for line in self._text.splitlines():
            for word, next_word in pairwise(line.split()):
                found[word].append(next_word)
        return {word: " ".join(behind) for word, behind in found.items()}


@lru_cache(maxsize=1)
def load_written_names() -> WrittenNames:
    """Return the names that ship with the package, read once."""
    return WrittenNames(read_text("written_names.txt"))
