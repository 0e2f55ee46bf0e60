"""Settings of the readiness check, read from `knowledge/settings/readiness.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = ["HIERARCHY", "SUGGESTION", "HierarchySettings", "SuggestionSettings"]


class HierarchySettings(NamedTuple):
    """Thresholds of the findings about the hierarchy."""

    min_flat_classes: int
    min_general_share: float
    max_names: int


class SuggestionSettings(NamedTuple):
    """Suggested subclasses."""

    min_class_confidence: float
    max_examples: int
    min_confidence: float


HIERARCHY = read_settings("readiness", "hierarchy", HierarchySettings)
SUGGESTION = read_settings("readiness", "suggestion", SuggestionSettings)
