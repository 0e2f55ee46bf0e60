"""Settings of the grounders, from `knowledge/settings/grounding.toml`."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = [
    "BASELINES",
    "PLATT_SCALING",
    "QUEUE",
    "BaselineSettings",
    "PlattScalingSettings",
    "QueueSettings",
]


@dataclass(frozen=True, slots=True)
class BaselineSettings:
    """Settings of the baseline grounders."""

    max_candidates: int
    smallest_side_m: float


@dataclass(frozen=True, slots=True)
class QueueSettings:
    """Settings of the review queue."""

    max_alternatives: int


@dataclass(frozen=True, slots=True)
class PlattScalingSettings:
    """Settings of Platt scaling."""

    min_probability: float


BASELINES = read_settings("grounding", "baselines", BaselineSettings)
QUEUE = read_settings("grounding", "queue", QueueSettings)
PLATT_SCALING = read_settings("grounding", "platt_scaling", PlattScalingSettings)
