"""Limits on how much the commands show."""

__all__ = [
    "CHANGES_PER_KIND",
    "DEMO_ROWS",
    "FINDINGS_PER_RULE",
    "MOVES_TO_GROUP",
    "NAMES_PER_CELL",
    "NARROWEST_COLUMN",
    "PATHS_PER_REASON",
    "READABLE_COLUMN",
    "SIMILAR_DIAGNOSTICS",
    "SUGGESTIONS",
]

FINDINGS_PER_RULE = 20
"""Findings of one rule that `validate`, `label lint` and `ontology check` show without --all."""
CHANGES_PER_KIND = 20
"""Changes of one kind that `diff` shows without --all."""
MOVES_TO_GROUP = 5
"""`diff` shows this many objects with the same displacement, or more, in one line."""
SIMILAR_DIAGNOSTICS = 3
"""Diagnostics with the same message that `inspect` shows."""
NAMES_PER_CELL = 6
"""Names of materials or parts in a cell of the table of `inspect`."""
PATHS_PER_REASON = 3
"""Prim paths that `label` shows for one reason."""
SUGGESTIONS = 10
"""Suggested classes that `ontology align` shows."""
DEMO_ROWS = 12
"""Rows of each answer that `demo` shows."""
NARROWEST_COLUMN = 12
"""Characters to which a column of a table that is wider than the terminal is cut at most."""
READABLE_COLUMN = 24
"""Characters to which a column is cut at most before columns that a table can do without are left out."""
