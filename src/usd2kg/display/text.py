"""to_text: record → a summary and a table as text."""

from usd2kg.display.cells import format_cell
from usd2kg.display.views import make_view

__all__ = ["to_text"]


def to_text(record: object) -> str:
    """Return a record as lines of text: title, notes, the first rows of the table, and how many more there are."""
    view = make_view(record)
    lines = [*view.lines]
    if view.columns:
        cells = [[format_cell(cell) for cell in row] for row in (view.columns, *view.rows)]
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        lines += (
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells
        )
    if more := view.count - len(view.rows):
        lines.append(f"and {more} more")
    return "\n".join(lines)
