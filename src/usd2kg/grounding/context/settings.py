"""Settings of the context of objects, one record per section of `knowledge/settings/context.toml`.

The TOML file documents each value beside it: unit, meaning and origin.
"""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "LABELS",
    "NEIGHBOURS",
    "PLACEMENT",
    "LabelSettings",
    "NeighbourSettings",
    "PlacementSettings",
]


class LabelSettings(NamedTuple):
    """Semantic labels on the stage."""

    min_confidence: float


class NeighbourSettings(NamedTuple):
    """Neighbours in the stage's tree and by size."""

    next_places: int
    max_siblings: int
    max_same_size: int
    max_similar_size: int
    same_size: float
    min_extent: float
    min_cached_words: int


class PlacementSettings(NamedTuple):
    """Ground and surroundings on the floor plan."""

    cell: float
    min_floor_width: float
    max_floor_height: float
    storey_height: float
    max_crowd: int
    layout_sample: int
    layout_neighbours: int


LABELS = read_settings("context", "labels", LabelSettings)
NEIGHBOURS = read_settings("context", "neighbours", NeighbourSettings)
PLACEMENT = read_settings("context", "placement", PlacementSettings)
