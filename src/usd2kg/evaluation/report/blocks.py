"""Building blocks of reports, independent of the format: sections of paragraphs, tables and plots.

All text is plain; each format escapes it.
"""

from dataclasses import dataclass

__all__ = ["Figure", "Section", "Table", "printable"]


@dataclass(frozen=True, slots=True)
class Table:
    """A table of text cells."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""
    """A caveat, printed below the table; may be empty."""
    is_long: bool = False
    """Whether to collapse the table in formats that support it."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A plot in several formats."""

    name: str
    """Name of its files in the folder `plots`, without an ending."""
    caption: str
    """Caption, also the text alternative of the image."""
    svg: str
    """One `svg` element."""
    png: bytes
    pdf: bytes


@dataclass(frozen=True, slots=True)
class Section:
    """A heading with its paragraphs, tables and plots."""

    title: str
    blocks: tuple[str | Table | Figure, ...]


def printable(text: str) -> str:
    """Return text on one line with U+FFFD for unprintable characters, which names on a stage may contain.

    >>> printable("a\\nb\\x00")
    'a b\ufffd'
    """
    return "".join(c if c.isprintable() else " " if c in "\t\r\n" else "\ufffd" for c in text)
