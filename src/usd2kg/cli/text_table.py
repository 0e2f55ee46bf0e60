"""Rows as aligned text that fits the terminal."""

import re
import sys
from collections.abc import Collection, Sequence

from usd2kg.cli.limits import NARROWEST_COLUMN, READABLE_COLUMN
from usd2kg.cli.output import replace_controls
from usd2kg.cli.terminal import Style, paint, terminal_width

__all__ = ["fit_columns", "format_table"]

_GAP = "  "
_NUMBERS = re.compile(r"[-+\d.e×% ]*")
"""Numeric cells, which must not be shortened."""


def format_table(
    columns: Sequence[str], rows: Sequence[Sequence[str | None]], dispensable: Collection[str] = ()
) -> str:
    """Return rows as aligned text.

    On a terminal, a table that is too wide is fitted: a column with one value in all rows becomes a line below the
    table, dispensable columns are left out, and long cells other than numbers are shortened in the middle. Columns
    without any value are left out there.

    >>> print(format_table(("name", "size"), [("mug", "0.09"), ("table", None)]), end="")
    name   size
    mug    0.09
    table
    """
    cells = [[" ".join(replace_controls(cell or "").splitlines()) for cell in row] for row in [columns, *rows]]
    below: list[str] = []
    width = terminal_width()
    if width is not None:
        cells, below = fit_columns(cells, width, dispensable)
    widths = _widths(cells)
    head, *lines = [
        _GAP.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells
    ]
    return "\n".join([paint(head, Style.HEADER, sys.stdout), *lines, *below]) + "\n"


def fit_columns(
    cells: list[list[str]], width: int, dispensable: Collection[str] = ()
) -> tuple[list[list[str]], list[str]]:
    """Return a table, header first, fitted to a width if `NARROWEST_COLUMN` allows it, and lines to print below it.

    Numbers are shortened only if the other columns cannot give enough space. Dispensable columns are left out from
    the right as long as others would be narrower than `READABLE_COLUMN`.

    >>> fit_columns([["name", "made by", "mass"], ["a" * 12, "Oak", ""], ["b" * 12, "Oak", ""]], 16)
    ([['name'], ['aaaaaaaaaaaa'], ['bbbbbbbbbbbb']], ['all: made by Oak'])
    """
    head, *rows = cells
    if not rows:
        return cells, []
    kept = [i for i in range(len(head)) if any(row[i] for row in rows)] or list(range(len(head)))
    below: list[str] = []
    if _total(_widths([[row[i] for i in kept] for row in cells])) > width and len(rows) > 1:
        same = [i for i in kept if len({row[i] for row in rows}) == 1]
        if len(same) < len(kept):
            kept = [i for i in kept if i not in same]
            below = [f"all: {head[i]} {rows[0][i]}" for i in same]
    left_out: list[str] = []
    for i in reversed([i for i in kept if head[i] in dispensable]):
        table = [[row[j] for j in kept] for row in cells]
        pairs = zip(_limits(table, width), _widths(table), strict=True)
        if all(limit >= min(READABLE_COLUMN, one) for limit, one in pairs):
            break
        kept.remove(i)
        left_out.insert(0, head[i])
    if left_out:
        below.append(f"left out for the width of the terminal: {', '.join(left_out)}")
    table = [[row[i] for i in kept] for row in cells]
    limits = _limits(table, width)
    return [[_shorten(cell, limit) for cell, limit in zip(row, limits, strict=True)] for row in table], below


def _widths(cells: Sequence[Sequence[str]]) -> list[int]:
    return [max(map(len, column)) for column in zip(*cells, strict=True)]


def _total(widths: Sequence[int]) -> int:
    return sum(widths) + len(_GAP) * (len(widths) - 1)


def _limits(table: Sequence[Sequence[str]], width: int) -> list[int]:
    """Return the widths of columns with which a table, the header first, fits if `NARROWEST_COLUMN` allows it."""
    widths = _widths(table)
    is_number = [all(_NUMBERS.fullmatch(cell) for cell in column) for column in zip(*table[1:], strict=True)]
    fixed = [one if numbers else 0 for one, numbers in zip(widths, is_number, strict=True)]
    limit = _largest_limit(widths, fixed, width)
    limits = [max(min(one, limit), kept) for one, kept in zip(widths, fixed, strict=True)]
    if _total(limits) > width:
        limit = _largest_limit(widths, [0] * len(widths), width)
        limits = [min(one, limit) for one in widths]
    return limits


def _largest_limit(widths: Sequence[int], fixed: Sequence[int], width: int) -> int:
    """Return the largest width of a column, not below `NARROWEST_COLUMN`, with which the table fits."""
    limit = max(widths)
    while (
        limit > NARROWEST_COLUMN and _total([max(min(w, limit), f) for w, f in zip(widths, fixed, strict=True)]) > width
    ):
        limit -= 1
    return limit


def _shorten(text: str, limit: int) -> str:
    """Return text cut to a length; a third is its start, since the end of a path identifies it best."""
    if len(text) <= limit:
        return text
    head = limit // 3
    return f"{text[:head]}…{text[len(text) - (limit - head - 1) :]}"
