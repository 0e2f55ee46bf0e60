"""From the confidence of any grounder to a probability of being right, by two numbers (Platt, 1999)."""

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path

from usd2kg.errors import GroundingError

__all__ = ["PlattScaling", "logit", "read_scaling"]

_LEAST = 1e-4
"""Confidences nearer to 0 or 1 than this count as this near: certainty has no logarithm of odds."""
_FORMAT = "usd2kg-calibration/1"


@dataclass(frozen=True, slots=True)
class PlattScaling:
    """p = 1 / (1 + exp(-(intercept + slope · logit(confidence))))."""

    intercept: float
    slope: float
    grounder: str
    """What it was fitted for: grounder and settings in a line."""
    answers: int
    """Answers that it was fitted on."""

    def __call__(self, confidence: float) -> float:
        """Return the probability of being right, to four decimals."""
        return round(1 / (1 + math.exp(-(self.intercept + self.slope * logit(confidence)))), 4)

    def as_json(self) -> str:
        """Return it as a file's text."""
        return json.dumps({"format": _FORMAT, **asdict(self)}, indent=1, ensure_ascii=False) + "\n"


def logit(confidence: float) -> float:
    """Return the logarithm of the odds, of a confidence from 0 to 1."""
    inside = min(max(confidence, _LEAST), 1 - _LEAST)
    return math.log(inside / (1 - inside))


def read_scaling(path: Path) -> PlattScaling:
    """Return the scaling in a file that `usd2kg eval calibrate` wrote.

    Raises:
        GroundingError: the file is missing or is no such JSON.
    """
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
