"""Settings of the readiness check, read from `knowledge/settings/readiness.toml`."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = ["HIERARCHY", "SUGGESTION", "HierarchySettings", "SuggestionSettings"]


@dataclass(frozen=True, slots=True)
class HierarchySettings:
    """Thresholds of the findings about the hierarchy."""

    min_flat_classes: int
    min_general_share: float
    max_names: int


@dataclass(frozen=True, slots=True)
class SuggestionSettings:
    """Suggested subclasses."""

    min_confidence: float


HIERARCHY = read_settings("readiness", "hierarchy", HierarchySettings)
SUGGESTION = read_settings("readiness", "suggestion", SuggestionSettings)
