"""What the tokens of a vocabulary can do inside a JSON string."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["JsonStringTokens", "classify_tokens"]

_INSIDE = rb'(?:[^\x00-\x1f"\\\x7f]|\\["\\/bfnrt])'
"""RFC 8259, section 7, without \\u: what may stand between quotes. A part of a UTF-8 sequence may, too."""
_TEXT = re.compile(_INSIDE + b"+")
_END = re.compile(b"(" + _INSIDE + b'*)"')


@dataclass(frozen=True, slots=True)
class JsonStringTokens:
    """The tokens that matter inside a JSON string."""

    closers: npt.NDArray[np.intp]
    """Those that begin with the closing quote."""
    texts: npt.NDArray[np.intp]
    """Those that may stand in a free text or end it, in order."""
    heads: dict[int, bytes]
    """Of those that end it: what they write before the quote."""


def classify_tokens(pieces: Sequence[bytes], ends: Iterable[int]) -> JsonStringTokens:
    """Return what the tokens can do.

    Args:
        pieces: what each token writes.
        ends: those by which the model says that it is done; in a free text they stand for the closing quote.
    """
    closers = [token for token, piece in enumerate(pieces) if piece.startswith(b'"')]
    heads = {token: match[1] for token, piece in enumerate(pieces) if (match := _END.match(piece))}
    heads |= dict.fromkeys(ends, b"")
    plain = [token for token, piece in enumerate(pieces) if _TEXT.fullmatch(piece) and token not in heads]
    return JsonStringTokens(np.array(closers, np.intp), np.array(sorted([*plain, *heads]), np.intp), heads)
