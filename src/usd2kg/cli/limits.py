"""Limits on the output of the commands."""

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
"""Smallest number of objects with the same displacement that `diff` shows on one line."""
SIMILAR_DIAGNOSTICS = 3
"""Diagnostics of one kind that `inspect` shows."""
NAMES_PER_CELL = 6
"""Names of materials or parts in a cell of the table of `inspect`."""
PATHS_PER_REASON = 3
"""Prim paths that `label` shows for one reason."""
SUGGESTIONS = 10
"""Suggested classes that `ontology align` shows."""
DEMO_ROWS = 12
"""Rows of each answer that `demo` shows."""
NARROWEST_COLUMN = 12
"""Smallest width to which a column is cut if the table is wider than the terminal, in characters."""
READABLE_COLUMN = 24
"""Smallest width to which a column is cut before dispensable columns are dropped, in characters."""
