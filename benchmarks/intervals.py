"""Confidence intervals of shares and of slopes."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Slope", "slope", "wilson"]

_Z = 1.959964
"""97.5 % point of the standard normal distribution."""
_RESAMPLES = 2000
_BLOCKS = 10
"""Blocks of a series that is resampled; each is long enough to keep what neighbours have in common."""


def wilson(right: int, count: int) -> tuple[float, float]:
    """Return the 95 % score interval of a share (Wilson, 1927), which holds near 0 and 1 and for small counts.

    >>> [round(bound, 3) for bound in wilson(9, 10)]
    [0.596, 0.982]
    """
    share, spread = right / count, _Z**2 / count
    middle = (share + spread / 2) / (1 + spread)
    half = _Z * math.sqrt(share * (1 - share) / count + spread / (4 * count)) / (1 + spread)
    return max(0.0, middle - half), min(1.0, middle + half)


class Slope(NamedTuple):
    """How fast a series grows."""

    value: float
    """Units of y for one unit of x, by least squares."""
    interval: tuple[float, float]
    """95 %."""


def slope(x: NDArray[np.float64], y: NDArray[np.float64], seed: int = 0) -> Slope:
    """Return the slope of a series and its interval by the moving block bootstrap of residuals (Künsch, 1989).

    Neighbours of a series are alike, so that the interval for independent errors would be too narrow.

    Args:
        x: (n,), increasing.
        y: (n,).
        seed: of the resampling.

    >>> x = np.arange(200.0)
    >>> found = slope(x, 3 * x + np.sin(x))
    >>> round(found.value, 2), found.interval[0] < 3 < found.interval[1]
    (3.0, True)
    """
    fitted, intercept = np.polyfit(x, y, 1)
    residuals = y - (fitted * x + intercept)
    length = max(1, len(x) // _BLOCKS)
    starts = np.random.default_rng(seed).integers(0, len(x) - length + 1, (_RESAMPLES, -(-len(x) // length)))
    drawn = residuals[(starts[..., None] + np.arange(length)).reshape(_RESAMPLES, -1)[:, : len(x)]]
    centered = x - x.mean()
    slopes = fitted + (drawn @ centered) / (centered @ centered)
    low, high = np.quantile(slopes, [0.025, 0.975])
    return Slope(float(fitted), (float(low), float(high)))
