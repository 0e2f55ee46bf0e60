"""BERT's tokenizer for lower-case English: text to numbers of word pieces.

After Devlin et al., "BERT" (2018), and the code they published with it (`tokenization.py` of google-research/bert):
clean, lower-case, strip accents, split at blanks, punctuation and CJK characters, then cut each word greedily into
the longest pieces that the vocabulary has.
"""

import unicodedata
from collections.abc import Iterator, Sequence
from functools import lru_cache

from usd2kg.grounding.baselines.embedding.bert_vocabulary import load_pieces

__all__ = ["WordPieceTokenizer", "load_tokenizer", "split_words"]

_UNKNOWN, _START, _END = "[UNK]", "[CLS]", "[SEP]"
_LONGEST_WORD = 100
"""Characters; a longer word is unknown as a whole."""
_MAX_TOKENS = 256
"""What all-MiniLM-L6-v2 was published to read of a text, start and end included; the rest is cut off."""
_REMOVED = frozenset(["Cc", "Cf", "Co", "Cs"])
"""Unicode categories: control, format, private use, surrogate. What is not yet assigned stays, and is unknown."""
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
"""First and last code point of the blocks whose characters stand alone; kana and hangul do not."""


class WordPieceTokenizer:
    """Cuts texts into pieces of a vocabulary."""

    def __init__(self, vocabulary: Sequence[str]) -> None:
        """Make the tokenizer from pieces in order of their ids; pieces inside a word begin with `##`."""
        self._ids = {piece: number for number, piece in enumerate(vocabulary)}

    def encode(self, text: str) -> list[int]:
        """Return the ids of the text's pieces between those of `[CLS]` and `[SEP]`, 256 at most.

        The text is never read as markup: a name `[SEP]` is a word in brackets.
        """
        pieces = [piece for word in split_words(text) for piece in self._cut(word)]
        return [self._ids[piece] for piece in (_START, *pieces[: _MAX_TOKENS - 2], _END)]

    def _cut(self, word: str) -> list[str]:
        if len(word) > _LONGEST_WORD:
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
    """Return the words of a text, lower case and without accents; punctuation and CJK characters stand alone.

    >>> split_words("Küchentisch_2 (Café)")
    ['kuchentisch', '_', '2', '(', 'cafe', ')']
    """
    decomposed = unicodedata.normalize("NFD", "".join(_clean(text)))
    # Letter by letter, as BERT's vocabulary was made: str.lower() would give a final sigma its other form.
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
    # ASCII symbols such as $ and + count too, though Unicode does not call them punctuation.
    return unicodedata.category(c).startswith("P") or (
        c.isascii() and c.isprintable() and not (c.isalnum() or c == " ")
    )
