"""Settings of the label linter, from `knowledge/settings/labels.toml`."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = ["LINT"]


@dataclass(frozen=True, slots=True)
class _LintSettings:
    """Section `lint`."""

    min_name_similarity: float
    max_quoted_labels: int


LINT = read_settings("labels", "lint", _LintSettings)
