"""Settings of the readiness check, read from `knowledge/settings/readiness.toml`."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = ["HIERARCHY", "HierarchySettings"]


@dataclass(frozen=True, slots=True)
class HierarchySettings:
    """Thresholds of the findings about the hierarchy."""

    min_flat_classes: int
    min_general_share: float
    max_names: int


HIERARCHY = read_settings("readiness", "hierarchy", HierarchySettings)
