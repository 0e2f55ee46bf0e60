"""JsonStringTokens: the tokens of a vocabulary that can occur in a JSON string or end it."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["JsonStringTokens", "classify_tokens"]

_INSIDE = rb'(?:[^\x00-\x1f"\\\x7f]|\\["\\/bfnrt])'
"""Bytes of a string by RFC 8259, section 7, without `\\u` escapes; parts of UTF-8 sequences are allowed."""
_TEXT = re.compile(_INSIDE + b"+")
_END = re.compile(b"(" + _INSIDE + b'*)"')


@dataclass(frozen=True, slots=True)
class JsonStringTokens:
    """Token ids by their role in a JSON string."""

    closers: npt.NDArray[np.intp]
    """Tokens that begin with the closing quote."""
    texts: npt.NDArray[np.intp]
    """Tokens that may continue or end a free text, in order."""
    heads: dict[int, bytes]
    """Token that ends a free text → bytes it adds before the quote."""


def classify_tokens(pieces: Sequence[bytes], ends: Iterable[int]) -> JsonStringTokens:
    """Return the tokens by their role in a JSON string.

    Args:
        pieces: the bytes of each token.
        ends: the end-of-generation tokens, which count as a closing quote in a free text.
    """
    closers = [token for token, piece in enumerate(pieces) if piece.startswith(b'"')]
    heads = {token: match[1] for token, piece in enumerate(pieces) if (match := _END.match(piece))}
    heads |= dict.fromkeys(ends, b"")
    plain = [token for token, piece in enumerate(pieces) if _TEXT.fullmatch(piece) and token not in heads]
    return JsonStringTokens(np.array(closers, np.intp), np.array(sorted([*plain, *heads]), np.intp), heads)
