"""Platt scaling: the probability that a prediction is correct, from the confidence of any grounder (Platt, 1999)."""

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.settings import PLATT_SCALING

__all__ = ["PlattScaling", "logit", "read_scaling"]

_FORMAT = "usd2kg-calibration/1"


@dataclass(frozen=True, slots=True)
class PlattScaling:
    """Probability that a prediction is correct: p = 1 / (1 + exp(-(intercept + slope · logit(confidence))))."""

    intercept: float
    slope: float
    grounder: str
    """The grounder and its settings that the scaling was fitted for, as text."""
    answers: int
    """Number of predictions that it was fitted on."""

    def __call__(self, confidence: float) -> float:
        """Return the probability that the prediction is correct, rounded to four decimals."""
        return round(1 / (1 + math.exp(-(self.intercept + self.slope * logit(confidence)))), 4)

    def as_json(self) -> str:
        """Return the text of the file that `read_scaling` reads."""
        return json.dumps({"format": _FORMAT, **asdict(self)}, indent=1, ensure_ascii=False) + "\n"


def logit(confidence: float) -> float:
    """Return the log-odds of a confidence from 0 to 1, clipped where it would be infinite."""
    clipped = min(max(confidence, PLATT_SCALING.min_probability), 1 - PLATT_SCALING.min_probability)
    return math.log(clipped / (1 - clipped))


def read_scaling(path: Path) -> PlattScaling:
    """Return the scaling in a file that `usd2kg eval calibrate` wrote.

    Raises:
        GroundingError: the file is missing or has another format.
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
