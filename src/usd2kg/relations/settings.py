"""Numerical settings of relation finding, one class per section of `knowledge/settings/relations.toml`."""

from dataclasses import dataclass

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


@dataclass(frozen=True, slots=True)
class FootprintSettings:
    """Recognition of footprints that are rotated about z."""

    min_upright: float
    max_misfit: float


@dataclass(frozen=True, slots=True)
class DistanceSettings:
    """Distances between the parts of objects."""

    max_part_pairs: int


@dataclass(frozen=True, slots=True)
class EnclosureSettings:
    """Points of an object from which rays are cast."""

    grid: int
    max_points: int
    inset: float


@dataclass(frozen=True, slots=True)
class FeetSettings:
    """Sampling of the underside of an object."""

    grid: int
    min_grid_share: float
    flatness: float


@dataclass(frozen=True, slots=True)
class BetweenSettings:
    """Sampling of footprints."""

    samples: int


FOOTPRINT = read_settings("relations", "footprint", FootprintSettings)
DISTANCE = read_settings("relations", "distance", DistanceSettings)
ENCLOSURE = read_settings("relations", "enclosure", EnclosureSettings)
FEET = read_settings("relations", "feet", FeetSettings)
BETWEEN = read_settings("relations", "between", BetweenSettings)
