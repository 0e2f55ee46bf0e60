"""Settings of the comparison, from `knowledge/settings/diff.toml`, except for the section `tolerances`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = ["COMPARISON", "MATCHING", "MEMORY"]


class _ComparisonSettings(NamedTuple):
    """Section `comparison`."""

    noise_m: float
    min_mass_change: float


class _MatchingSettings(NamedTuple):
    """Section `matching`."""

    same_place_m: float
    first_radius_m: float
    radius_doublings: int
    min_group_share: float
    class_only_reach: float


class _MemorySettings(NamedTuple):
    """Section `memory`."""

    pairs_per_chunk: int
    max_exhaustive_pairs: int
    statements_per_operation: int


COMPARISON = read_settings("diff", "comparison", _ComparisonSettings)
MATCHING = read_settings("diff", "matching", _MatchingSettings)
MEMORY = read_settings("diff", "memory", _MemorySettings)
