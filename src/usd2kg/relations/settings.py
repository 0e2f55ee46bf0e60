"""Numerical settings of relation finding, one class per section of `knowledge/settings/relations.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "BETWEEN",
    "DISTANCE",
    "ENCLOSURE",
    "FEET",
    "FOOTPRINT",
    "BetweenSettings",
    "DistanceSettings",
    "EnclosureSettings",
    "FeetSettings",
    "FootprintSettings",
]


class FootprintSettings(NamedTuple):
    """Recognition of footprints that are rotated about z."""

    min_upright: float
    max_misfit: float


class DistanceSettings(NamedTuple):
    """Distances between the parts of objects."""

    max_part_pairs: int


class EnclosureSettings(NamedTuple):
    """Points of an object from which rays are cast."""

    grid: int
    max_points: int
    inset: float


class FeetSettings(NamedTuple):
    """Sampling of the underside of an object."""

    grid: int
    min_grid_share: float
    flatness: float


class BetweenSettings(NamedTuple):
    """Sampling of footprints."""

    samples: int


FOOTPRINT = read_settings("relations", "footprint", FootprintSettings)
DISTANCE = read_settings("relations", "distance", DistanceSettings)
ENCLOSURE = read_settings("relations", "enclosure", EnclosureSettings)
FEET = read_settings("relations", "feet", FeetSettings)
BETWEEN = read_settings("relations", "between", BetweenSettings)
