"""Bootstrap and Wilson intervals, and which of them a mean has, McNemar's test, and the spread of repeated runs."""

import math
from collections.abc import Callable, Hashable, Sequence
from statistics import NormalDist, fmean, stdev
from typing import NamedTuple

import numpy as np

from usd2kg.evaluation.score import Score
from usd2kg.evaluation.settings import BOOTSTRAP

__all__ = [
    "Interval",
    "McNemar",
    "bootstrap_interval",
    "mcnemar",
    "mean_and_deviation",
    "mean_interval",
    "wilson_interval",
]

_PERCENTILES = (2.5, 97.5)
_Z = NormalDist().inv_cdf(_PERCENTILES[1] / 100)


class Interval(NamedTuple):
    """A 95 % interval."""

    lower: float
    upper: float


def bootstrap_interval(
    values: Sequence[float], clusters: Sequence[Hashable] | None = None, resamples: int = BOOTSTRAP.resamples
) -> Interval:
    """Return the percentile bootstrap interval of the mean of `values`, with a fixed seed.

    With `clusters` (one per value), whole clusters are resampled: a hundred copies of a cup are one observation, not a
    hundred (Field and Welsh 2007).

    Raises:
        ValueError: there are no values.
    """
    if not values:
        raise ValueError("the interval of no samples is undefined")
    keys = list(clusters) if clusters is not None else list(range(len(values)))
    index = {key: i for i, key in enumerate(dict.fromkeys(keys))}
    sums, sizes = np.zeros(len(index)), np.zeros(len(index))
    for key, value in zip(keys, values, strict=True):
        sums[index[key]] += value
        sizes[index[key]] += 1
    generator = np.random.default_rng(BOOTSTRAP.seed)
    draws = generator.integers(0, len(index), size=(resamples, len(index)))
    means = sums[draws].sum(axis=1) / sizes[draws].sum(axis=1)
    lower, upper = np.percentile(means, _PERCENTILES)
    return Interval(float(lower), float(upper))


def wilson_interval(right: int, total: int) -> Interval:
    """Return the Wilson score interval of a proportion (Wilson 1927), which also holds near 0 and 1 and for small n.

    Raises:
        ValueError: there are no draws.
    """
    if total <= 0:
        raise ValueError("the interval of no samples is undefined")
    share, scale = right / total, 1 + _Z**2 / total
    center = (share + _Z**2 / (2 * total)) / scale
    half = _Z / scale * math.sqrt(share * (1 - share) / total + _Z**2 / (4 * total**2))
    return Interval(max(center - half, 0.0), min(center + half, 1.0))


def mean_interval(
    values: Sequence[float], clusters: Sequence[Hashable] | None = None, *, highest: float = 1.0
) -> Interval:
    """Return the interval of the mean of values from 0 to `highest`: by bootstrap, or Wilson's if all are at one end.

    There, the bootstrap interval has no width. Wilson's bounds the share of values that are not at this end, and so the
    mean; the values of a cluster count once.

    Raises:
        ValueError: there are no values.
    """
    if not values or not (all(value == 0 for value in values) or all(value == highest for value in values)):
        return bootstrap_interval(values, clusters)
    total = len(set(clusters)) if clusters is not None else len(values)
    if values[0] == 0:
        return Interval(0.0, highest * wilson_interval(0, total).upper)
    return Interval(highest * wilson_interval(total, total).lower, highest)


class McNemar(NamedTuple):
    """McNemar's test of two methods on the same objects."""

    only_first: int
    """Objects that only the first method gets right."""
    only_second: int
    p_value: float
    """Two-sided exact p-value under the null hypothesis of equal accuracy."""


def mcnemar(
    first: Sequence[Score], second: Sequence[Score], is_right: Callable[[Score], bool] = lambda score: score.is_exact
) -> McNemar:
    """Return McNemar's exact test (McNemar 1947; binomial form) on the objects that both methods have scores for.

    Raises:
        ValueError: they have no object in common.
    """
    by_id = {score.id: score for score in second}
    pairs = [(is_right(score), is_right(by_id[score.id])) for score in first if score.id in by_id]
    if not pairs:
        raise ValueError("the two runs have no object in common")
    only_first = sum(a and not b for a, b in pairs)
    only_second = sum(b and not a for a, b in pairs)
    discordant = only_first + only_second
    tail = sum(math.comb(discordant, k) for k in range(min(only_first, only_second) + 1))
    return McNemar(only_first, only_second, min(1.0, 2 * tail / 2**discordant))


def mean_and_deviation(values: Sequence[float]) -> tuple[float, float | None]:
    """Return the mean and sample standard deviation of repeated runs; the deviation of a single run is None."""
    return fmean(values), stdev(values) if len(values) > 1 else None
