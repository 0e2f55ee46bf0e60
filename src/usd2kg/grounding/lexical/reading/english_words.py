"""Which runs of letters are English words, of whatever sort, so that they are neither misspelt nor short for others."""

import gzip
from functools import lru_cache

from usd2kg.grounding.baselines.embedding.bert_vocabulary import load_pieces
from usd2kg.knowledge import read_bytes

__all__ = ["SHORTEST_WORD", "is_common_word", "is_english_word"]

SHORTEST_WORD = 5
"""Of fewer letters none is: what looks like a word may be short for another."""


def is_common_word(word: str) -> bool:
    """Return whether a word, in lower case, is one that is often written: `exercise`, `splash`.

    The words are those that BERT has whole.
    """
    return len(word) >= SHORTEST_WORD and word in _common_words()


@lru_cache(maxsize=4096)
def is_english_word(word: str) -> bool:
    """Return whether a word, in lower case, is a common one or in a large dictionary: `mossy`, `telescopic`.

    The dictionary is SCOWL's up to class 60; it has inflected forms and no names.
    """
    return is_common_word(word) or _has_line(_dictionary(), word.encode())


@lru_cache(maxsize=1)
def _common_words() -> frozenset[str]:
    return frozenset(word for word in load_pieces() if len(word) >= SHORTEST_WORD and word.isascii() and word.isalpha())


@lru_cache(maxsize=1)
def _dictionary() -> bytes:
    """Return the words in order, a line each: few are asked for, and a set would take ten times the memory."""
    return gzip.decompress(read_bytes("english_words.txt.gz"))


def _has_line(ordered: bytes, line: bytes) -> bool:
    """Return whether one of the lines of a text, which are in order, is this one; found by halving."""
    low, high = 0, len(ordered)
    while low < high:
        start = ordered.rfind(b"\n", low, (low + high) // 2) + 1 or low
        end = ordered.index(b"\n", start)
        found = ordered[start:end]
        if found == line:
            return True
        low, high = (end + 1, high) if found < line else (low, start)
    return False
