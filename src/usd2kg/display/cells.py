"""Values as text on one line."""

from collections.abc import Sequence

__all__ = ["clean_line", "format_cell", "size_text"]

_MAX_LENGTH = 80
"""Characters of a cell."""


def clean_line(text: str, max_length: int) -> str:
    """Return text on one line, cut to a length.

    Names of a stage are untrusted: characters that do not print, such as those that control a terminal or reverse the
    writing direction, become U+FFFD.

    >>> clean_line("a\\nb\\u202e and more", 8)
    'a b\ufffd an…'
    """
    text = " ".join(text.split())
    text = text if len(text) <= max_length else f"{text[: max_length - 1]}…"
    return "".join(letter if letter.isprintable() else "\ufffd" for letter in text)


def format_cell(value: object) -> str:
    """Return a value as the text of a cell; empty for None.

    >>> format_cell(0.5), format_cell(12345.678), format_cell(None)
    ('0.5', '12345.7', '')
    """
    if value is None:
        return ""
    return clean_line(f"{value:.6g}" if isinstance(value, float) else str(value), _MAX_LENGTH)


def size_text(size: Sequence[float | None] | None) -> str:
    """Return the extents of a box in metres; empty if unknown.

    >>> size_text((1.2, 0.8, 0.745))
    '1.20 × 0.80 × 0.74'
    """
    known = [side for side in size or () if side is not None]
    return " × ".join(f"{side:.2f}" for side in known)
