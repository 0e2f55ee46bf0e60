"""Guard texts against evaluation as formulas when a spreadsheet opens a CSV or TSV file (CWE-1236)."""

import re

__all__ = ["guard_formula", "unguard_formula"]

_FORMULA = re.compile(r"'*[=+\-@\t\r]")
"""What a formula begins with, possibly guarded already."""


def guard_formula(text: str) -> str:
    """Return a text with an apostrophe before what a spreadsheet would evaluate.

    >>> guard_formula("=1+1"), guard_formula("'=1+1"), guard_formula("'90s lamp")
    ("'=1+1", "''=1+1", "'90s lamp")
    """
    return f"'{text}" if _FORMULA.match(text) else text


def unguard_formula(cell: str) -> str:
    """Return the text that `guard_formula` was given."""
    return cell[1:] if cell.startswith("'") and _FORMULA.match(cell) else cell
