"""Settings of graph queries, read from `knowledge/settings/query.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "CACHE",
    "COMPLEXITY",
    "DIRECTIONS",
    "LOOKUP",
    "PASSAGE",
    "SWEEP",
    "WORDS",
    "CacheSettings",
    "ComplexitySettings",
    "DirectionSettings",
    "LookupSettings",
    "PassageSettings",
    "SweepSettings",
    "WordSettings",
]


class SweepSettings(NamedTuple):
    """How the movement of a joint is simulated; lengths are metres."""

    step: float
    max_steps: int
    tolerated_overlap: float
    door_thickness: float
    max_panel_thickness: float
    max_hinge_depth: float
    max_level_slope: float


class LookupSettings(NamedTuple):
    """What is offered for an unknown name, and how much is listed for a known one."""

    min_label_similarity: float
    max_suggestions: int
    max_listed: int
    same_gap: float


class WordSettings(NamedTuple):
    """How words of a name are matched with those of the graph."""

    min_confidence: float
    min_similarity: float
    min_letters: int
    max_label_share: float
    min_general_share: float


class DirectionSettings(NamedTuple):
    """Where a viewer stands, and what is beside a thing; lengths are metres, the angle is degrees."""

    surroundings: float
    min_offset: float
    reach: float
    tolerance: float
    vertical: float
    feet: float
    cover: float


class ComplexitySettings(NamedTuple):
    """Limits of queries that the engine can run without a stack overflow."""

    max_nesting: int
    max_operators: int
    max_triples: int


class CacheSettings(NamedTuple):
    """Which graph files are indexed, and how much is kept."""

    min_mib: float
    max_mib: float
    lock_wait_s: float
    abandoned_h: float


class PassageSettings(NamedTuple):
    """Which openings people walk through; lengths are metres."""

    min_door_height: float


SWEEP = read_settings("query", "sweep", SweepSettings)
PASSAGE = read_settings("query", "passage", PassageSettings)
LOOKUP = read_settings("query", "lookup", LookupSettings)
WORDS = read_settings("query", "words", WordSettings)
DIRECTIONS = read_settings("query", "directions", DirectionSettings)
COMPLEXITY = read_settings("query", "complexity", ComplexitySettings)
CACHE = read_settings("query", "cache", CacheSettings)
