"""How well the size of an object fits each of a thousand everyday things: evidence where a name says nothing."""

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from usd2kg.knowledge import read_rows

__all__ = [
    "SMALLEST_EXTENT",
    "Size",
    "likelihoods_of",
    "log_likelihoods",
    "rounded",
    "surprise",
    "thing_nouns",
    "thing_row",
    "thing_rows",
    "typical_extents",
]

SMALLEST_EXTENT = 0.001
"""Metres. A thinner extent counts as this: a sheet may be modelled without thickness, and zero has no logarithm."""

_LARGEST_EXTENT = 100.0
"""Metres. Where the broad share of the mixture ends."""
_RELATIVE_ERROR = 0.08
"""How far a model of a thing departs from the thing, as a standard deviation of the logarithm of an extent."""
_ABSOLUTE_ERROR = 0.001
"""Metres. The same for thin things, whose thickness is drawn freely."""
_BROAD_SHARE = 0.02
"""Part of the things of a kind that are of any size: a toy car, a giant chess piece, a wrong unit."""
_BROAD_DENSITY = _BROAD_SHARE * math.factorial(3) / math.log(_LARGEST_EXTENT / SMALLEST_EXTENT) ** 3
"""The ordered triples are a sixth of the cube of all triples, so the uniform density over them is six times as high."""
_PEAK = 0.375
"""Student's t density of 4 degrees of freedom and scale 1 at its centre: Γ(5/2) / (Γ(2) √(4π))."""

_BLOCK = 8
"""Boxes taken at a time: what they need fits into a processor's cache, which saves half the time and more."""

Size = tuple[float, float, float]
"""Extents of an object in metres, in any order."""

_Floats = npt.NDArray[np.float64]


class _Table(NamedTuple):
    """The rows of `everyday_objects.csv`, ready for `log_likelihoods`."""

    nouns: tuple[str, ...]
    half_rates: _Floats
    """(3, rows), longest extent first: 1 / (2 s_k), as t² / 4 = (x · half rate - scaled centre)²."""
    scaled_centres: _Floats
    """(3, rows): m_k / (2 s_k), with m_k the logarithm of the typical extent in metres."""
    peaks: _Floats
    """(rows,): the density at the centres, the broad share left out."""


def thing_nouns() -> tuple[str, ...]:
    """Return the nouns of the things whose size is known, in the order of `log_likelihoods`: lemmas of the taxonomy.

    The size is meant for what the noun is used for most in homes and at work: the first artifact, food or plant that
    WordNet has for it but for a few (a plate for eating, a notebook of paper, a log of wood, the fruit of a tree).
    """
    return _load_table().nouns


@lru_cache(maxsize=1)
def _rows() -> dict[str, int]:
    return {noun.replace(" ", ""): row for row, noun in enumerate(thing_nouns())}


def thing_row(noun: str) -> int | None:
    """Return the row of a thing, its name without spaces; None if it is not in the table."""
    return _rows().get(noun)


def typical_extents(noun: str) -> tuple[float, float, float] | None:
    """Return the typical extents of a thing in metres, longest first; None if its size is not known.

    Args:
        noun: the thing, without spaces.
    """
    row = _rows().get(noun)
    if row is None:
        return None
    table = _load_table()
    long, middle, short = np.exp(table.scaled_centres[:, row] / table.half_rates[:, row])
    return float(long), float(middle), float(short)


def surprise(size: Size, noun: str) -> float | None:
    """Return how much a size speaks for a thing, against all things whose size is known, as a natural logarithm.

        log p(size | thing) - log mean over things of p(size | thing)

    Args:
        size: extents in metres, in any order.
        noun: the thing, without spaces.

    Returns:
        More than 0 where the thing is of this size more often than things are, less for the wrong size; None where the
        thing's size is not known.
    """
    row = _rows().get(noun)
    if row is None:
        return None
    logs, usual = _kept(rounded(size))
    return float(logs[row]) - usual


def likelihoods_of(size: Size) -> _Floats:
    """Return `log_likelihoods` of one size, kept for when it is asked for again; not to be written to."""
    return _kept(rounded(size))[0]


def rounded(size: Size) -> Size:
    """Return a size to a tenth of a millimetre: copies of one model differ by what the arithmetic leaves."""
    x, y, z = size
    return round(x, 4), round(y, 4), round(z, 4)


@lru_cache(maxsize=256)
def _kept(size: Size) -> tuple[_Floats, float]:
    """Return `log_likelihoods`, and log mean over things of p(size | thing)."""
    densities = _densities(_log_extents(np.array([size])))[0]
    usual = math.log(densities.mean())
    logs = np.log(densities, out=densities)
    logs.flags.writeable = False
    return logs, usual


def log_likelihoods(sizes: npt.ArrayLike) -> _Floats:
    """Return log p(size | thing) for each thing, natural logarithm; shape (3,) → (things,), (n, 3) → (n, things).

    `sizes` are the extents of boxes in metres, in any order, along the objects' own axes if those are known. With
    x1 ≥ x2 ≥ x3 the logarithms of the extents, each at least `SMALLEST_EXTENT`,

        p(x | thing) = 0.98 · Π_k t4((x_k - m_k) / s_k) / s_k / P + 0.02 · 6 / ln(100 m / 1 mm)³
        s_k² = spread² + 0.08² + (1 mm / e^m_k)²

    with t4 the density of Student's t with 4 degrees of freedom, heavier in the tails than the normal, e^m_k the
    typical extents, and P the probability that three such draws come in order, one sixth for a ball. It is a density
    over ordered triples, so the values of different things can be compared and combined with a prior of the things.
    No value is -inf.

    Raises:
        ValueError: the last axis has not 3 extents, or one is negative or not finite.
    """
    extents = np.asarray(sizes, dtype=np.float64)
    if extents.ndim not in (1, 2) or extents.shape[-1] != 3:
        raise ValueError(f"sizes of shape {extents.shape}; expected (3,) or (n, 3)")
    logs = _log_extents(extents.reshape(-1, 3))
    found = np.empty((len(logs), len(_load_table().nouns)))
    for start in range(0, len(logs), _BLOCK):
        np.log(_densities(logs[start : start + _BLOCK]), out=found[start : start + _BLOCK])
    return found.reshape(*extents.shape[:-1], -1) if len(logs) else found


def _log_extents(extents: _Floats) -> _Floats:
    """Return the logarithms of the extents of boxes, longest first, (n, 3)."""
    if not (np.isfinite(extents).all() and (extents >= 0).all()):
        raise ValueError("sizes hold a negative or non-finite extent; leave objects without a box out")
    return np.log(np.maximum(np.sort(extents, axis=-1)[:, ::-1], SMALLEST_EXTENT))


def _densities(logs: _Floats) -> _Floats:
    """Return p(x | thing) for boxes of the log extents `logs`, (n, 3), longest first; (n, things)."""
    table = _load_table()
    offsets = logs[:, :, np.newaxis] * table.half_rates
    offsets -= table.scaled_centres
    offsets *= offsets
    offsets += 1.0
    product = offsets[:, 0] * offsets[:, 1]
    product *= offsets[:, 2]
    # One square root for all three extents: (1 + t²/4)^(-5/2) is the slow part.
    found: _Floats = np.sqrt(product)
    product *= product
    found *= product
    np.divide(table.peaks, found, out=found)
    found += _BROAD_DENSITY
    return found


@lru_cache(maxsize=1)
def thing_rows() -> tuple[Mapping[str, str], ...]:
    """Return the rows of `data/everyday_objects.csv`, in the order of `log_likelihoods`."""
    return tuple(read_rows("everyday_objects.csv"))


@lru_cache(maxsize=1)
def _load_table() -> _Table:
    rows = thing_rows()
    extents = np.array([[float(row[side]) for row in rows] for side in ("long_m", "middle_m", "short_m")])
    extents = np.maximum(extents, SMALLEST_EXTENT)
    spread = np.array([float(row["spread"]) for row in rows])
    scales = np.sqrt(spread**2 + _RELATIVE_ERROR**2 + (_ABSOLUTE_ERROR / extents) ** 2)
    centres = np.log(extents)
    peaks = (1 - _BROAD_SHARE) * _PEAK**3 / scales.prod(axis=0) / _order_probability(centres, scales)
    return _Table(tuple(row["noun"] for row in rows), 0.5 / scales, centres * 0.5 / scales, peaks)


def _order_probability(centres: _Floats, scales: _Floats) -> _Floats:
    """Return the probability that draws around three centres come in order, (rows,).

    ∫ f2(x) (1 - F1(x)) F3(x) dx by the midpoint rule, with t = 2 tan θ, which brings the whole line between ±π/2 and
    makes f2 dx = 0.75 cos³θ dθ.
    """
    step = math.pi / 400
    angles = (np.arange(400) + 0.5) * step - math.pi / 2
    x = centres[1] + scales[1] * 2 * np.tan(angles)[:, np.newaxis]
    weights = 0.75 * np.cos(angles)[:, np.newaxis] ** 3 * step
    below = [_cumulate((x - centres[k]) / scales[k]) for k in (0, 2)]
    probability: _Floats = (weights * (1 - below[0]) * below[1]).sum(axis=0)
    return probability


def _cumulate(t: _Floats) -> _Floats:
    """Return the distribution function of Student's t with 4 degrees of freedom: ½ + ¾ s - ¼ s³, s = t / √(4 + t²)."""
    s = t / np.sqrt(4 + t * t)
    return 0.5 + 0.75 * s - 0.25 * s**3
