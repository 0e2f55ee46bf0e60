"""check_text: refuse texts that are not Unicode, such as half of an emoji, which no engine can be asked about."""

from usd2kg.errors import GraphError

__all__ = ["check_text"]


def check_text(text: str, name: str) -> None:
    r"""Raise GraphError if a text has a surrogate, which JSON can hold and UTF-8 cannot.

    Args:
        text: what a user asks.
        name: what it is, for the message.

    >>> check_text("a mug \ud83d", "question")
    Traceback (most recent call last):
    usd2kg.errors.GraphError: question: character 7 is '\ud83d', half of a character; expected text in Unicode
    """
    try:
        text.encode()
    except UnicodeEncodeError as error:
        found = ascii(text[error.start])
        raise GraphError(
            f"{name}: character {error.start + 1} is {found}, half of a character; expected text in Unicode"
        ) from error
