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
        # Bare, these would belong to the \\\\ of the row before.
        "[": "{[}",
        "*": "{*}",
        "–": "--",
        "…": r"\ldots{}",
        "±": r"$\pm$",
        "×": r"$\times$",
        **{c: "\\" + c for c in "{}$&#%_"},
    }
)
_HEAD = "% Needs \\usepackage[T1]{fontenc}, and \\usepackage{longtable} for tables longer than a page.\n"


def escape_latex(text: str) -> str:
    """Return text that LaTeX sets as it is; other scripts need a document in UTF-8 with fonts for them.

    >>> escape_latex("50 % of obj_1 & {x}")
    '50 \\\\% of obj\\\\_1 \\\\& \\\\{x\\\\}'
    """
    return printable(text).translate(_SPECIAL)


def format_latex(title: str, sections: Sequence[Section]) -> str:
    """Return all tables as `tabular`, each under its title; long ones as `longtable`."""
    tables = [block for section in sections for block in section.blocks if isinstance(block, Table)]
    return f"% {escape_latex(title)}\n{_HEAD}\n" + "\n".join(_table(table) for table in tables)


def _table(table: Table) -> str:
    environment = "longtable" if table.is_long else "tabular"
    columns = "l" * len(table.columns)
    lines = [_row(table.columns) + r" \hline", *map(_row, table.rows)]
    body = "\n".join(lines)
    note = f"\n\n{escape_latex(table.note)}" if table.note else ""
    heading = f"\\paragraph{{{escape_latex(table.title)}}}\n"
    return f"{heading}\\begin{{{environment}}}{{{columns}}}\n\\hline\n{body}\n\\hline\n\\end{{{environment}}}{note}\n"


def _row(cells: Iterable[str]) -> str:
    return " & ".join(map(escape_latex, cells)) + r" \\"
