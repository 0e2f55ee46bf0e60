"""The tables of a report as LaTeX, to include in a paper with \\input."""

from collections.abc import Iterable, Sequence

from usd2kg.evaluation.report.blocks import Section, Table, printable
from usd2kg.evaluation.settings import REPORT

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
        # Unbraced at the start of a row, LaTeX reads these as arguments of the preceding line break.
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


def escape_latex(text: str) -> str:
    """Return text escaped for LaTeX; non-Latin scripts need a UTF-8 document with suitable fonts.

    >>> escape_latex("50 % of obj_1 & {x}")
    '50 \\\\% of obj\\\\_1 \\\\& \\\\{x\\\\}'
    """
    return printable(text).translate(_SPECIAL)


def format_latex(title: str, sections: Sequence[Section]) -> str:
    """Return all tables as titled `tabular` environments, split by pages."""
    tables = [block for section in sections for block in section.blocks if isinstance(block, Table)]
    return f"% {escape_latex(title)}\n{_HEAD}\n" + "\n".join(_table(table) for table in tables)


def _table(table: Table) -> str:
    page = REPORT.latex_page_rows
    pages = [table.rows[start : start + page] for start in range(0, len(table.rows), page)] or [()]
    grids = "\n".join(_tabular(table, rows) for rows in pages)
    note = f"\n{escape_latex(table.note)}\n" if table.note else ""
    return f"\\paragraph{{{escape_latex(table.title)}}}\n{grids}{note}"


def _tabular(table: Table, rows: Sequence[Sequence[str]]) -> str:
    wide = [any(len(row[at]) > REPORT.latex_wide_cell for row in table.rows) for at in range(len(table.columns))]
    columns = "".join(r"p{0.5\linewidth}" if is_wide else "l" for is_wide in wide)
    body = "\n".join([_row(table.columns) + r" \hline", *map(_row, rows)])
    return f"\\begin{{tabular}}{{{columns}}}\n\\hline\n{body}\n\\hline\n\\end{{tabular}}\n"


def _row(cells: Iterable[str]) -> str:
    return " & ".join(map(escape_latex, cells)) + r" \\"
