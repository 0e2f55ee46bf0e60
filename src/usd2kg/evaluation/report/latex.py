"""The tables of a report as LaTeX, to be put into a paper with \\input."""

from collections.abc import Iterable, Sequence

from usd2kg.evaluation.report.document import Section, Table, printable

__all__ = ["escape_latex", "format_latex"]

_SPECIAL = str.maketrans(
    {
        "\\": r"\textbackslash{}",
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
        "<": r"\textless{}",
        ">": r"\textgreater{}",
        "|": r"\textbar{}",
        '"': r"\textquotedbl{}",
        # Bare, these would belong to the line break of the row before.
        "[": "{[}",
        "*": "{*}",
        "\ufffd": "?",
        "–": "--",
        "…": r"\ldots{}",
        "±": r"$\pm$",
        "×": r"$\times$",
        **{c: "\\" + c for c in "{}$&#%_"},
    }
)
_HEAD = "% Needs \\usepackage[T1]{fontenc}.\n"
_LONGEST = 40
"""Rows that fit on a page; a tabular does not break by itself."""
_WIDE = 60
"""Characters beyond which a cell is set as a paragraph."""


def escape_latex(text: str) -> str:
    """Return text that LaTeX sets as it is; other scripts need a document in UTF-8 with fonts for them.

    >>> escape_latex("50 % of obj_1 & {x}")
    '50 \\\\% of obj\\\\_1 \\\\& \\\\{x\\\\}'
    """
    return printable(text).translate(_SPECIAL)


def format_latex(title: str, sections: Sequence[Section]) -> str:
    """Return all tables as `tabular`, each under its title; those longer than a page in several."""
    tables = [block for section in sections for block in section.blocks if isinstance(block, Table)]
    return f"% {escape_latex(title)}\n{_HEAD}\n" + "\n".join(_table(table) for table in tables)


def _table(table: Table) -> str:
    pages = [table.rows[at : at + _LONGEST] for at in range(0, len(table.rows), _LONGEST)] or [()]
    grids = "\n".join(_tabular(table, rows) for rows in pages)
    note = f"\n{escape_latex(table.note)}\n" if table.note else ""
    return f"\\paragraph{{{escape_latex(table.title)}}}\n{grids}{note}"


def _tabular(table: Table, rows: Sequence[Sequence[str]]) -> str:
    wide = [any(len(row[at]) > _WIDE for row in table.rows) for at in range(len(table.columns))]
    columns = "".join(r"p{0.5\linewidth}" if is_wide else "l" for is_wide in wide)
    body = "\n".join([_row(table.columns) + r" \hline", *map(_row, rows)])
    return f"\\begin{{tabular}}{{{columns}}}\n\\hline\n{body}\n\\hline\n\\end{{tabular}}\n"


def _row(cells: Iterable[str]) -> str:
    return " & ".join(map(escape_latex, cells)) + r" \\"
