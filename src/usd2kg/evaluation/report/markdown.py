"""Reports as GitHub Flavored Markdown."""

import re
from collections.abc import Sequence

from usd2kg.evaluation.report.blocks import Figure, Section, Table, printable

__all__ = ["escape_markdown", "format_markdown"]

_ACTIVE = re.compile(r"([\\`*_{}\[\]|~$])")
_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;"})


def escape_markdown(text: str) -> str:
    """Return text escaped for Markdown, including table cells.

    >>> escape_markdown("a|b `c` <i>")
    'a\\\\|b \\\\`c\\\\` &lt;i&gt;'
    """
    return _ACTIVE.sub(r"\\\1", printable(text).translate(_ENTITIES))


def format_markdown(title: str, sections: Sequence[Section]) -> str:
    """Return the report, which links to its plots in the folder `plots`."""
    parts = [f"# {escape_markdown(title)}"]
    for section in sections:
        parts.append(f"## {escape_markdown(section.title)}")
        parts += [_block(block) for block in section.blocks]
    return "\n\n".join(parts) + "\n"


def _block(block: str | Table | Figure) -> str:
    if isinstance(block, Table):
        return _table(block)
    if isinstance(block, Figure):
        return f"![{escape_markdown(block.caption)}](plots/{block.name}.svg)"
    return escape_markdown(block)


def _table(table: Table) -> str:
    lines = [_row(table.columns), "| " + " | ".join("---" for _ in table.columns) + " |", *map(_row, table.rows)]
    note = f"\n\n{escape_markdown(table.note)}" if table.note else ""
    return f"**{escape_markdown(table.title)}**\n\n" + "\n".join(lines) + note


def _row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(escape_markdown(cell) for cell in cells) + " |"
