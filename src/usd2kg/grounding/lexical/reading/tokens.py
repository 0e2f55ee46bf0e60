"""Split a prim name into tokens, and compare them with the names above."""

from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding.lexical.settings import READING
from usd2kg.words import is_content_word, split_identifier

__all__ = ["ParentTokens", "Token", "is_compound_part", "is_reference", "parent_tokens", "tokens_of"]


class Token(NamedTuple):
    """One run of letters of a name."""

    text: str
    """Lower case."""
    number: str
    """Digits directly after the letters; empty if there are none."""
    is_glued: bool = False
    """Whether it follows the token before without a separator, as in `RoomWindow`."""


class ParentTokens(NamedTuple):
    """The tokens of a parent's name that a name may refer to."""

    content: frozenset[str]
    """Tokens that are not pipeline tokens; a name refers to the parent by words only if it repeats all of them."""
    numbered: frozenset[tuple[str, str]]
    """(text, number) of all tokens."""


def tokens_of(name: str) -> list[Token]:
    """Return the tokens of a name without measures such as `6kg`."""
    tokens: list[Token] = []
    at = 0
    is_amount = False
    for part in split_identifier(name):
        start = name.find(part, at)
        is_glued = start == at and start > 0
        at = start + len(part)
        if part.isdigit() and tokens and is_glued and name[start - 1].isalpha():
            tokens[-1] = tokens[-1]._replace(number=part)
        elif not (is_amount and is_glued and len(part) <= READING.max_unit_letters):
            tokens.append(Token(part.lower(), "", is_glued))
        # A separate number may begin a measure (_6kg, _4tier), unlike the number in Room1Door.
        is_amount = part.isdigit() and start > 0 and not name[start - 1].isalpha()
    return tokens


@lru_cache(maxsize=4096)
def parent_tokens(name: str) -> ParentTokens:
    """Return the tokens of the name of a prim above."""
    tokens = tokens_of(name)
    content = frozenset(token.text for token in tokens if is_content_word(token.text))
    return ParentTokens(content, frozenset((token.text, token.number) for token in tokens))


def is_reference(token: Token, above: set[tuple[str, str]]) -> bool:
    """Return whether a token repeats a (text, number) of the names above, or abbreviates one with the same number."""
    if (token.text, token.number) in above:
        return True
    # `cab10` below `cabinet10`.
    return bool(token.number) and any(token.number == number and text.startswith(token.text) for text, number in above)


def is_compound_part(token: Token, pair: tuple[Token, Token], references: list[Token]) -> bool:
    """Return whether a reference is half of a compound whose other half is not a reference."""
    return token in pair and any(other not in references for other in pair)
