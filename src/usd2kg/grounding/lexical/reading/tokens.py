"""The runs of letters that a name is written with, and how they refer to the names above."""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from usd2kg.words import is_telling, split_identifier

__all__ = [
    "Parent",
    "Token",
    "is_half",
    "is_reference",
    "read_parent",
    "shared_beginning",
    "tokens_of",
]

_NO_MEASURE = 7
"""Letters of a word that is too long to be a measure."""


class Token(NamedTuple):
    """One run of letters."""

    text: str
    """In lower case."""
    number: str
    """Digits written on to the word, without a separator; empty if none."""
    is_glued: bool = False
    """Whether it is written on to the word before."""


class Parent(NamedTuple):
    """A name above, as a name may refer to it."""

    telling: frozenset[str]
    """The words that a name has to repeat, all of them, to refer to it by words alone."""
    words: frozenset[tuple[str, str]]
    """(word, digits written on to it), empty if it has none."""


def tokens_of(name: str) -> list[Token]:
    """Return the tokens of a name, without measures."""
    tokens: list[Token] = []
    at = 0
    is_amount = False
    for part in split_identifier(name):
        start = name.find(part, at)
        is_glued = start == at and start > 0
        at = start + len(part)
        if part.isdigit() and tokens and is_glued and name[start - 1].isalpha():
            tokens[-1] = Token(tokens[-1].text, part, tokens[-1].is_glued)
        elif not (is_amount and is_glued and len(part) < _NO_MEASURE):
            tokens.append(Token(part.lower(), "", is_glued))
        # A number that stands apart may begin a measure: _6kg, _4tier; but Room1Door is a door.
        is_amount = part.isdigit() and start > 0 and not name[start - 1].isalpha()
    return tokens


def shared_beginning(tokens: list[Token], parents: tuple[str, ...]) -> int:
    """Return with how many tokens of its parent's name a name begins."""
    above = tokens_of(parents[-1]) if parents else []
    pairs = enumerate(zip(tokens, above, strict=False))
    return next((at for at, (own, other) in pairs if own.text != other.text), min(len(tokens), len(above)))


@lru_cache(maxsize=4096)
def read_parent(name: str) -> Parent:
    """Return how a name below may refer to this one."""
    tokens = tokens_of(name)
    telling = frozenset(token.text for token in tokens if is_telling(token.text))
    return Parent(telling, frozenset((token.text, token.number) for token in tokens))


def is_reference(token: Token, above: set[tuple[str, str]]) -> bool:
    """Return whether a token is one of the (word, number) of the names above, or short for one with its number."""
    if (token.text, token.number) in above:
        return True
    # `cab10` below `cabinet10`: the same number on a word that begins alike.
    return bool(token.number) and any(token.number == number and word.startswith(token.text) for word, number in above)


def is_half(token: Token, pair: tuple[Token, Token], references: Sequence[Token]) -> bool:
    """Return whether a reference is one of two words of which the other is none."""
    return token in pair and any(other not in references for other in pair)
