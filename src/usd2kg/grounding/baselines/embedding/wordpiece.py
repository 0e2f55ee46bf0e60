"""BERT's WordPiece tokenizer for lower-case English.

Follows Devlin et al., "BERT" (2018), and its published code (`tokenization.py` of google-research/bert): clean,
lower-case, strip accents, split at white space, punctuation and CJK characters, then split each word greedily into the
longest word pieces of the vocabulary.
"""

import unicodedata
from collections.abc import Iterator, Sequence
from functools import lru_cache

from usd2kg.grounding.baselines.embedding.bert_vocabulary import load_pieces

__all__ = ["WordPieceTokenizer", "load_tokenizer", "split_words"]

_UNKNOWN, _START, _END = "[UNK]", "[CLS]", "[SEP]"
_MAX_WORD_CHARACTERS = 100
"""A longer word becomes one unknown token, as in the published code."""
_MAX_TOKENS = 256
"""The published sequence length of all-MiniLM-L6-v2, start and end included; longer texts are truncated."""
_REMOVED = frozenset(["Cc", "Cf", "Co", "Cs"])
"""Unicode categories that are removed: control, format, private use, surrogate. Unassigned characters stay."""
_CJK = (
    (0x4E00, 0x9FFF),
    (0x3400, 0x4DBF),
    (0x20000, 0x2A6DF),
    (0x2A700, 0x2B73F),
    (0x2B740, 0x2B81F),
    (0x2B920, 0x2CEAF),
    (0xF900, 0xFAFF),
    (0x2F800, 0x2FA1F),
)
"""First and last code point of the blocks whose characters are words; kana and hangul are not among them."""


class WordPieceTokenizer:
    """Splits texts into word pieces of a vocabulary."""

    def __init__(self, vocabulary: Sequence[str]) -> None:
        """Create a tokenizer from word pieces in the order of their ids; suffixes begin with `##`."""
        self._ids = {piece: number for number, piece in enumerate(vocabulary)}

    def encode(self, text: str) -> list[int]:
        """Return the token ids of a text, from `[CLS]` to `[SEP]`, at most 256.

        Special tokens in the text are plain text: the name `[SEP]` is a word in brackets.
        """
        pieces = [piece for word in split_words(text) for piece in self._split_word(word)]
        return [self._ids[piece] for piece in (_START, *pieces[: _MAX_TOKENS - 2], _END)]

    def _split_word(self, word: str) -> list[str]:
        if len(word) > _MAX_WORD_CHARACTERS:
            return [_UNKNOWN]
        pieces: list[str] = []
        start = 0
        while start < len(word):
            piece = self._longest_piece(word, start)
            if piece is None:
                return [_UNKNOWN]
            pieces.append(piece)
            start += len(piece) - (2 if start else 0)
        return pieces

    def _longest_piece(self, word: str, start: int) -> str | None:
        prefix = "##" if start else ""
        candidates = (prefix + word[start:end] for end in range(len(word), start, -1))
        return next((piece for piece in candidates if piece in self._ids), None)


@lru_cache(maxsize=1)
def load_tokenizer() -> WordPieceTokenizer:
    """Return the tokenizer over the vocabulary of `bert-base-uncased`, which all-MiniLM-L6-v2 shares."""
    return WordPieceTokenizer(load_pieces())


def split_words(text: str) -> list[str]:
    """Return the lower-case words of a text without accents; punctuation and CJK characters are words.

    >>> split_words("Küchentisch_2 (Café)")
    ['kuchentisch', '_', '2', '(', 'cafe', ')']
    """
    decomposed = unicodedata.normalize("NFD", "".join(_clean(text)))
    # Character by character, like the published code: str.lower() on the text would change a final sigma.
    plain = "".join(c.lower() for c in decomposed if unicodedata.category(c) != "Mn")
    return "".join(f" {c} " if _is_punctuation(c) else c for c in plain).split()


def _clean(text: str) -> Iterator[str]:
    for c in text:
        if c in "\t\n\r":
            yield " "
        elif c == "\ufffd" or unicodedata.category(c) in _REMOVED:
            continue
        elif _is_cjk(c):
            yield f" {c} "
        else:
            yield c


def _is_cjk(c: str) -> bool:
    return c >= "\u3400" and any(first <= ord(c) <= last for first, last in _CJK)


def _is_punctuation(c: str) -> bool:
    # ASCII symbols such as $ and + count as punctuation here, but not in Unicode.
    return unicodedata.category(c).startswith("P") or (
        c.isascii() and c.isprintable() and not (c.isalnum() or c == " ")
    )
