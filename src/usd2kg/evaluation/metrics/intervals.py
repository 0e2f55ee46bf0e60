"""How sure a figure is, and whether two methods differ."""

import math
from collections.abc import Callable, Hashable, Sequence
from typing import NamedTuple

import numpy as np

from usd2kg.evaluation.sample import Score

__all__ = ["Interval", "McNemar", "bootstrap_interval", "mcnemar", "mean_spread"]

_RESAMPLES = 2000
_SEED = 20240229


class Interval(NamedTuple):
    """A 95 % interval."""

    lower: float
    upper: float


def bootstrap_interval(
    values: Sequence[float], clusters: Sequence[Hashable] | None = None, resamples: int = _RESAMPLES
) -> Interval:
    """Return the percentile bootstrap interval of the mean of `values`.

    With `clusters`, whole clusters are drawn, not single values: a hundred copies of one cup are one observation
    of the cup, not a hundred (Field and Welsh, 2007). The seed is fixed, so the same values give the same interval.

    Raises:
        ValueError: there are no values.
    """
    if not values:
        raise ValueError("an interval of no samples is undefined")
    keys = list(clusters) if clusters is not None else list(range(len(values)))
    index = {key: i for i, key in enumerate(dict.fromkeys(keys))}
    sums, sizes = np.zeros(len(index)), np.zeros(len(index))
    for key, value in zip(keys, values, strict=True):
        sums[index[key]] += value
        sizes[index[key]] += 1
    generator = np.random.default_rng(_SEED)
    draws = generator.integers(0, len(index), size=(resamples, len(index)))
    means = sums[draws].sum(axis=1) / sizes[draws].sum(axis=1)
    lower, upper = np.percentile(means, [2.5, 97.5])
    return Interval(float(lower), float(upper))


class McNemar(NamedTuple):
    """A comparison of two methods on the same objects."""

    only_first: int
    """Objects that only the first method has right."""
    only_second: int
    p_value: float
    """Two-sided exact probability of a split at least as uneven if both were equally good."""


def mcnemar(
    first: Sequence[Score], second: Sequence[Score], is_right: Callable[[Score], bool] = lambda score: score.is_exact
) -> McNemar:
    """Return McNemar's exact test (McNemar, 1947; binomial form) on the objects that both have scores for.

    Raises:
        ValueError: they have no object in common.
    """
    others = {score.id: score for score in second}
    pairs = [(is_right(score), is_right(others[score.id])) for score in first if score.id in others]
    if not pairs:
        raise ValueError("the two runs have no object in common")
    only_first = sum(a and not b for a, b in pairs)
    only_second = sum(b and not a for a, b in pairs)
    discordant = only_first + only_second
    tail = sum(math.comb(discordant, k) for k in range(min(only_first, only_second) + 1))
    return McNemar(only_first, only_second, min(1.0, 2 * tail / 2**discordant))


def mean_spread(values: Sequence[float]) -> tuple[float, float | None]:
    """Return mean and sample standard deviation of repeated runs; the spread of a single run is None."""
    if not values:
        raise ValueError("a mean of no runs is undefined")
    mean = sum(values) / len(values)
    if len(values) == 1:
        return mean, None
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))
