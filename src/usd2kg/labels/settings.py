"""Settings of the label linter, from `knowledge/settings/labels.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = ["LINT"]


class _LintSettings(NamedTuple):
    """Section `lint`."""

    min_name_similarity: float
    max_quoted_labels: int


LINT = read_settings("labels", "lint", _LintSettings)
