"""Reports of results: tables, error analysis and plots, as Markdown, LaTeX, HTML, CSV and JSON."""

from usd2kg.evaluation.report.write import write_report

__all__ = [
    "write_report",
]
