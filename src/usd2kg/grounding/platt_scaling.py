"""Platt scaling: the probability that a prediction is correct, from the confidence of any grounder (Platt, 1999)."""

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.settings import PLATT_SCALING

__all__ = ["PlattScaling", "describe_settings", "logit", "read_scaling"]

_FORMAT = "usd2kg-calibration/1"
_OTHER_SETTINGS = frozenset({"regime", "abbreviated_length", "evidence", "first_sample", "calibration"})
"""Settings of a run that are not settings of the model and its prompts."""


@dataclass(frozen=True, slots=True)
class PlattScaling:
    """Probability that a prediction is correct: p = 1 / (1 + exp(-(intercept + slope · logit(confidence))))."""

    intercept: float
    slope: float
    grounder: str
    """What it was fitted for: of a language model, its `describe_settings`."""
    answers: int
    """Number of predictions that it was fitted on."""

    def __call__(self, confidence: float) -> float:
        """Return the probability that the prediction is correct, rounded to four decimals."""
        return round(1 / (1 + math.exp(-(self.intercept + self.slope * logit(confidence)))), 4)

    @property
    def formula(self) -> str:
        """The log-odds that the prediction is correct, as text."""
        return f"{self.intercept:g} {self.slope:+g} logit"

    def as_json(self) -> str:
        """Return the text of the file that `read_scaling` reads."""
        return json.dumps({"format": _FORMAT, **asdict(self)}, indent=1, ensure_ascii=False) + "\n"


def describe_settings(settings: Mapping[str, str]) -> str:
    """Return the model and the form of its prompts in one line: a scaling is valid for runs with the same line.

    Args:
        settings: those of a run, or of its grounder.
    """
    return ", ".join(f"{key} {value}" for key, value in sorted(settings.items()) if key not in _OTHER_SETTINGS)


def logit(confidence: float) -> float:
    """Return the log-odds of a confidence from 0 to 1, clipped where it would be infinite."""
    clipped = min(max(confidence, PLATT_SCALING.min_probability), 1 - PLATT_SCALING.min_probability)
    return math.log(clipped / (1 - clipped))


def read_scaling(path: Path | str) -> PlattScaling:
    """Return the scaling in a file that `usd2kg eval calibrate` wrote.

    Raises:
        GroundingError: the file is missing or has another format.
    """
    path = Path(path)
    try:
        data = json.loads(path.read_text("utf-8"))
        if data.pop("format") != _FORMAT:
            raise ValueError("another format")
        scaling = PlattScaling(**data)
        if not (math.isfinite(scaling.intercept) and math.isfinite(scaling.slope)):
            raise ValueError("numbers that are not finite")
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise GroundingError(
            f"{path}: cannot be read as a calibration ({error}); expected JSON written by usd2kg eval calibrate"
        ) from error
    return scaling
