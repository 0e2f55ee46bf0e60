"""What a report is made of, before it is Markdown, LaTeX or HTML; and how figures become text.

Text is plain throughout: each format escapes it for itself. Figures are rounded here and nowhere before.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usd2kg.evaluation.metrics.intervals import Interval, mean_spread
from usd2kg.ontology import ClassIRI, TBox

__all__ = [
    "ABSENT",
    "Figure",
    "Section",
    "Table",
    "class_text",
    "interval_text",
    "number_text",
    "p_value_text",
    "plain_number",
    "printable",
    "spread_text",
]

ABSENT = "–"
"""What stands in a cell that has no figure: nothing was run, or nothing can be said."""


@dataclass(frozen=True, slots=True)
class Table:
    """Text in rows and columns."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""
    """What a reader must know beside the figures."""
    is_long: bool = False
    """Whether it may be folded away where the format can."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A plot."""

    file: str
    """Name of its file in the folder `plots`."""
    caption: str
    """What it shows, for those who see it and those who do not."""
    svg: str
    """The drawing: one `svg` element."""


@dataclass(frozen=True, slots=True)
class Section:
    """A heading and what stands under it: paragraphs, tables and plots."""

    title: str
    blocks: tuple[str | Table | Figure, ...]


def printable(text: str) -> str:
    """Return text on one line, what is not printable replaced: names on a stage may hold anything.

    >>> printable("a\\nb\\x00")
    'a b\ufffd'
    """
    return "".join(c if c.isprintable() else " " if c in "\t\r\n" else "\ufffd" for c in text)


def number_text(value: float | None, digits: int) -> str:
    """Return a figure with so many decimals.

    >>> number_text(0.125, 2), number_text(None, 2)
    ('0.12', '–')
    """
    return ABSENT if value is None else f"{value:.{digits}f}"


def spread_text(values: Sequence[float], digits: int, without: str = "") -> str:
    """Return the mean of repeated runs ± their standard deviation, or the one run there is.

    Args:
        values: one figure for each repeat; none if nothing was run.
        digits: decimals.
        without: what to leave off the front; the study writes .98.

    >>> spread_text([90.0, 94.0], 1), spread_text([0.98], 2, without="0"), spread_text([], 1)
    ('92.0 ± 2.8', '.98', '–')
    """
    if not values:
        return ABSENT
    parts = [number_text(value, digits) for value in mean_spread(values) if value is not None]
    return " ± ".join(part.removeprefix(without) for part in parts)


def interval_text(interval: Interval, digits: int) -> str:
    """Return an interval in words: `81.3 to 92.0`."""
    return f"{interval.lower:.{digits}f} to {interval.upper:.{digits}f}"


def p_value_text(value: float) -> str:
    """Return a probability with four decimals, or that it is smaller."""
    return "< 0.0001" if value < 0.0001 else f"{value:.4f}"


def plain_number(value: float, digits: int = 2) -> str:
    """Return a figure with so many significant digits and no exponent.

    >>> plain_number(0.0000134), plain_number(12.3)
    ('0.000013', '12')
    """
    return np.format_float_positional(value, precision=digits, fractional=False, trim="-")


def class_text(iri: ClassIRI | None, tbox: TBox) -> str:
    """Return a class's local name; `no answer` for None."""
    return tbox.by_iri[iri].readable_name if iri is not None else "no answer"
