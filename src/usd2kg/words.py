"""Split identifiers into words: `SM_CupCBlue_01` becomes "cup blue"."""

import re
import unicodedata
from functools import lru_cache

from usd2kg.knowledge import word_set

__all__ = ["is_content_word", "split_identifier", "words_of"]

_PRODUCTION_TOKENS = word_set("identifiers", "production_tokens")

_ASCII_PARTS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|[0-9]+")
"""Equivalent of `_is_border` for ASCII text, the common case; many times faster."""


def split_identifier(identifier: str) -> tuple[str, ...]:
    """Return the parts of an identifier in order, with their case: words, single letters and runs of digits.

    Splits at case changes, between letters and digits, and at all other characters. The prefix and suffix that USD's
    transcoding adds are removed: `tn__knob1_f5` encodes "knob 1".

    >>> split_identifier("SM_CupCBlue_01")
    ('SM', 'Cup', 'C', 'Blue', '01')
    >>> split_identifier("TVCabinet2b")
    ('TV', 'Cabinet', '2', 'b')
    >>> split_identifier("tn__knob1_f5")
    ('knob', '1')
    """
    text = identifier if identifier.isascii() else unicodedata.normalize("NFC", identifier)
    if text.startswith("tn__"):
        text = text[4:].rpartition("_")[0] or text[4:]
    if text.isascii():
        return tuple(_ASCII_PARTS.findall(text))
    parts: list[str] = []
    start = 0
    for end in range(1, len(text) + 1):
        if end == len(text) or _is_border(text, end):
            if _is_word_character(text[start]):
                parts.append(text[start:end])
            start = end
    return tuple(parts)


def _is_border(text: str, at: int) -> bool:
    before, after = text[at - 1], text[at]
    if _is_word_character(before) != _is_word_character(after) or before.isdigit() != after.isdigit():
        return True
    if not _is_word_character(before):
        return False
    if before.islower() and after.isupper():
        return True
    # The last capital of a run starts the next word: TVCabinet is TV + Cabinet.
    return before.isupper() and after.isupper() and at + 1 < len(text) and text[at + 1].islower()


def _is_word_character(c: str) -> bool:
    # Vowel signs (Devanagari, Thai…) are marks that combine with the preceding letter.
    return c.isalnum() or unicodedata.category(c) in {"Mn", "Mc"}


@lru_cache(maxsize=65536)
def words_of(identifier: str) -> tuple[str, ...]:
    """Return the content words of an identifier, lower case, in order.

    Numbers, single Latin letters and tokens of asset pipelines (`SM_`, `_LOW`, `_geo`) are omitted.

    >>> words_of("SM_CupCBlue_01")
    ('cup', 'blue')
    >>> words_of("Küchentisch_LOD0")
    ('küchentisch',)
    >>> words_of("geo_01")
    ()
    """
    parts = [part.lower() for part in split_identifier(identifier)]
    return tuple(part for part in parts if is_content_word(part))


def is_content_word(word: str) -> bool:
    """Return whether a lower-case word may describe an object: no number, single Latin letter or pipeline token."""
    return (len(word) > 1 or not word.isascii()) and not word.isdigit() and word not in _PRODUCTION_TOKENS
