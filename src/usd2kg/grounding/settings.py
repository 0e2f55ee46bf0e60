"""Settings of the grounders, from `knowledge/settings/grounding.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "BASELINES",
    "BUILT_IN_CHOICE",
    "PLATT_SCALING",
    "QUEUE",
    "BaselineSettings",
    "BuiltInChoiceSettings",
    "PlattScalingSettings",
    "QueueSettings",
]


class BaselineSettings(NamedTuple):
    """Settings of the baseline grounders."""

    max_candidates: int
    smallest_side_m: float


class BuiltInChoiceSettings(NamedTuple):
    """Settings of the choice of a built-in TBox."""

    min_share: float
    min_names: int
    named_examples: int


class QueueSettings(NamedTuple):
    """Settings of the review queue."""

    max_alternatives: int


class PlattScalingSettings(NamedTuple):
    """Settings of Platt scaling."""

    min_probability: float


BASELINES = read_settings("grounding", "baselines", BaselineSettings)
BUILT_IN_CHOICE = read_settings("grounding", "built_in_choice", BuiltInChoiceSettings)
QUEUE = read_settings("grounding", "queue", QueueSettings)
PLATT_SCALING = read_settings("grounding", "platt_scaling", PlattScalingSettings)
