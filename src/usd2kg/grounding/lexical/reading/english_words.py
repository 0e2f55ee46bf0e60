"""English words of all parts of speech: a token in this list is neither misspelt nor abbreviated."""

from functools import lru_cache

from usd2kg.grounding.baselines.embedding.bert_vocabulary import load_pieces
from usd2kg.knowledge import read_compressed

__all__ = ["SHORTEST_WORD", "is_common_word", "is_english_word"]

SHORTEST_WORD = 5
"""Letters of the shortest word that counts: shorter ones may be abbreviations too."""


def is_common_word(word: str) -> bool:
    """Return whether a lower-case word is a whole word in BERT's vocabulary: `exercise`, `splash`."""
    return len(word) >= SHORTEST_WORD and word in _common_words()


@lru_cache(maxsize=4096)
def is_english_word(word: str) -> bool:
    """Return whether a lower-case word is a common word or in SCOWL up to class 60, inflected or not: `mossy`."""
    return is_common_word(word) or _has_line(_dictionary(), word.encode())


@lru_cache(maxsize=1)
def _common_words() -> frozenset[str]:
    return frozenset(word for word in load_pieces() if len(word) >= SHORTEST_WORD and word.isascii() and word.isalpha())


@lru_cache(maxsize=1)
def _dictionary() -> bytes:
    """Return the words in alphabetical order, one a line; a set takes ten times the memory."""
    return read_compressed("english_words.txt.gz")


def _has_line(lines: bytes, line: bytes) -> bool:
    """Return whether sorted lines contain a line, by binary search."""
    low, high = 0, len(lines)
    while low < high:
        start = lines.rfind(b"\n", low, (low + high) // 2) + 1 or low
        end = lines.index(b"\n", start)
        found = lines[start:end]
        if found == line:
            return True
        low, high = (end + 1, high) if found < line else (low, start)
    return False
