"""Settings of the comparison, from `knowledge/settings/diff.toml`, except for the section `tolerances`."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = ["COMPARISON", "MATCHING", "MEMORY"]


@dataclass(frozen=True, slots=True)
class _ComparisonSettings:
    """Section `comparison`."""

    noise_m: float
    min_mass_change: float


@dataclass(frozen=True, slots=True)
class _MatchingSettings:
    """Section `matching`."""

    same_place_m: float
    first_radius_m: float
    radius_doublings: int
    min_group_share: float
    class_only_reach: float


@dataclass(frozen=True, slots=True)
class _MemorySettings:
    """Section `memory`."""

    pairs_per_chunk: int
    max_exhaustive_pairs: int
    statements_per_operation: int


COMPARISON = read_settings("diff", "comparison", _ComparisonSettings)
MATCHING = read_settings("diff", "matching", _MatchingSettings)
MEMORY = read_settings("diff", "memory", _MemorySettings)
