"""The tables and plots of a report as LaTeX floats with captions and labels, to copy into a paper or to \\input."""

from collections.abc import Iterable, Iterator, Sequence

from usd2kg.evaluation.report.blocks import Figure, Section, Table, printable
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
_HEAD = "% Needs \\usepackage[T1]{fontenc} and \\usepackage{graphicx}; paths of plots are relative to this file.\n"
_MOST_FLOATS = 16
"""Floats between two page breaks; LaTeX holds 18 that it has not placed, or more since 2015."""


def escape_latex(text: str) -> str:
    """Return text escaped for LaTeX; non-Latin scripts need a UTF-8 document with suitable fonts.

    >>> escape_latex("50 % of obj_1 & {x}")
    '50 \\\\% of obj\\\\_1 \\\\& \\\\{x\\\\}'
    """
    return printable(text).translate(_SPECIAL)


def format_latex(title: str, sections: Sequence[Section]) -> str:
    """Return all tables and plots as numbered floats with captions; long tables are split by pages."""
    floats = [text for section in sections for block in section.blocks for text in _floats(block)]
    parts = [f"% {escape_latex(title)}", _HEAD]
    for number, (kind, body) in enumerate(floats, 1):
        label = f"\\label{{{'tab' if kind == 'table' else 'fig'}:usd2kg-{number}}}"
        parts.append(f"\\begin{{{kind}}}[htbp]\n\\centering\n{body}\n{label}\n\\end{{{kind}}}\n")
        if number % _MOST_FLOATS == 0:
            parts.append("\\clearpage\n")
    return "\n".join(parts)


def _floats(block: str | Table | Figure) -> Iterator[tuple[str, str]]:
    """Yield the environment and the body of each float of a block. Captions are above tables and below figures."""
    if isinstance(block, Table):
        page = REPORT.latex_page_rows
        pages = [block.rows[start : start + page] for start in range(0, len(block.rows), page)] or [()]
        for number, rows in enumerate(pages, 1):
            part = f" ({number} of {len(pages)})" if len(pages) > 1 else ""
            yield "table", f"{_caption(f'{block.title}{part}', block.note)}\n{_tabular(block, rows)}"
    elif isinstance(block, Figure):
        picture = f"\\includegraphics[width=\\linewidth]{{plots/{block.name}.pdf}}"
        yield "figure", f"{picture}\n{_caption(block.caption)}"


def _caption(*sentences: str) -> str:
    whole = (sentence if sentence.endswith(".") else f"{sentence}." for sentence in sentences if sentence)
    return f"\\caption{{{escape_latex(' '.join(whole))}}}"


def _tabular(table: Table, rows: Sequence[Sequence[str]]) -> str:
    wide = [any(len(row[at]) > REPORT.latex_wide_cell for row in table.rows) for at in range(len(table.columns))]
    columns = "".join(r"p{0.5\linewidth}" if is_wide else "l" for is_wide in wide)
    body = "\n".join([_row(table.columns) + r" \hline", *map(_row, rows)])
    return f"\\begin{{tabular}}{{{columns}}}\n\\hline\n{body}\n\\hline\n\\end{{tabular}}"


def _row(cells: Iterable[str]) -> str:
    return " & ".join(map(escape_latex, cells)) + r" \\"
