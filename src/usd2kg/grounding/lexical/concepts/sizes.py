"""Likelihood of an object's size for everyday objects.

`data/everyday_objects.csv` has the typical extents of 1,450 objects with their spread.
"""

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.lexical.settings import SIZE
from usd2kg.knowledge import read_rows
from usd2kg.table_cache import open_table_cache

__all__ = [
    "Size",
    "everyday_nouns",
    "everyday_object_row",
    "everyday_object_rows",
    "log_likelihoods",
    "round_size",
    "size_log_likelihood_ratio",
    "size_log_likelihoods",
    "typical_extents",
]

_BROAD_DENSITY = SIZE.broad_share * math.factorial(3) / math.log(SIZE.max_extent / SIZE.min_extent) ** 3
"""Ordered triples are a sixth of all triples, so the uniform density over them is six times as high."""
_PEAK_DENSITY = 0.375
"""Density of Student's t with 4 degrees of freedom and scale 1 at its centre: Γ(5/2) / (Γ(2) √(4π))."""
_BLOCK = 8
"""Boxes evaluated at a time: their intermediate arrays fit into a processor's cache, which halves the time."""

Size = tuple[float, float, float]
"""Extents of an object in metres, in any order."""

_Floats = npt.NDArray[np.float64]


class _SizeTable(NamedTuple):
    """The rows of `everyday_objects.csv` as parameters of `log_likelihoods`."""

    nouns: tuple[str, ...]
    half_rates: _Floats
    """(3, rows), longest extent first: 1 / (2 s_k), so that t² / 4 = (x · half rate - scaled centre)²."""
    scaled_centres: _Floats
    """(3, rows): m_k / (2 s_k), with m_k the logarithm of the typical extent in metres."""
    peaks: _Floats
    """(rows,): density at the centres, without the broad share."""


def everyday_nouns() -> tuple[str, ...]:
    """Return the everyday objects, in the order of `log_likelihoods`.

    Each is a lemma of the taxonomy, in its most frequent sense at home and at work.
    """
    return _load_table().nouns


@lru_cache(maxsize=1)
def _rows() -> dict[str, int]:
    return {noun.replace(" ", ""): row for row, noun in enumerate(everyday_nouns())}


def everyday_object_row(noun: str) -> int | None:
    """Return the row of an everyday object by its noun without spaces; None if it has none."""
    return _rows().get(noun)


def typical_extents(noun: str) -> tuple[float, float, float] | None:
    """Return the typical extents of an everyday object in metres, longest first; None if unknown.

    Args:
        noun: the noun without spaces.
    """
    row = _rows().get(noun)
    if row is None:
        return None
    table = _load_table()
    long, middle, short = np.exp(table.scaled_centres[:, row] / table.half_rates[:, row])
    return float(long), float(middle), float(short)


def size_log_likelihood_ratio(size: Size, noun: str) -> float | None:
    """Return the log-likelihood ratio of a size for a noun against the average everyday object, natural logarithm.

        log p(size | noun) - log mean over nouns of p(size | noun)

    Args:
        size: extents in metres, in any order.
        noun: the noun without spaces.

    Returns:
        Positive where the size fits, negative where it does not; None if the noun's typical size is unknown.
    """
    row = _rows().get(noun)
    if row is None:
        return None
    logs, log_mean = _cached_likelihoods(round_size(size))
    return float(logs[row]) - log_mean


def size_log_likelihoods(size: Size) -> _Floats:
    """Return `log_likelihoods` of one size, cached and read-only."""
    return _cached_likelihoods(round_size(size))[0]


def round_size(size: Size) -> Size:
    """Return a size rounded to 0.1 mm: copies of one model differ by rounding errors."""
    x, y, z = size
    return round(x, 4), round(y, 4), round(z, 4)


@lru_cache(maxsize=256)
def _cached_likelihoods(size: Size) -> tuple[_Floats, float]:
    """Return `log_likelihoods`, and log mean over nouns of p(size | noun)."""
    densities = _densities(_log_extents(np.array([size])))[0]
    log_mean = math.log(densities.mean())
    logs = np.log(densities, out=densities)
    logs.flags.writeable = False
    return logs, log_mean


def log_likelihoods(sizes: npt.ArrayLike) -> _Floats:
    """Return log p(size | noun) for each everyday noun, natural logarithm; (3,) → (nouns,), (n, 3) → (n, nouns).

    `sizes` are extents of boxes in metres, in any order, along the objects' own axes where those are known. With
    x1 ≥ x2 ≥ x3 the logarithms of the extents, each at least 1 mm,

        p(x | noun) = 0.98 · Π_k t4((x_k - m_k) / s_k) / s_k / P + 0.02 · 6 / ln(100 m / 1 mm)³
        s_k² = spread² + 0.08² + (1 mm / e^m_k)²

    where t4 is the density of Student's t with 4 degrees of freedom, e^m_k are the typical extents, and P is the
    probability that three such draws are in descending order (one sixth for a ball). It is a density over ordered
    triples, so that values of different nouns compare. No value is -inf.

    Raises:
        ValueError: the last axis does not have 3 extents, or one is negative or not finite.
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
        raise ValueError("sizes hold a negative or non-finite extent; leave out objects without a box")
    return np.log(np.maximum(np.sort(extents, axis=-1)[:, ::-1], SIZE.min_extent))


def _densities(logs: _Floats) -> _Floats:
    """Return p(x | noun) for boxes, (n, nouns); `logs` are their log extents, (n, 3), longest first."""
    table = _load_table()
    offsets = logs[:, :, np.newaxis] * table.half_rates
    offsets -= table.scaled_centres
    offsets *= offsets
    offsets += 1.0
    product = offsets[:, 0] * offsets[:, 1]
    product *= offsets[:, 2]
    # (1 + t²/4)^(-5/2) is the slow part: one square root for all three extents.
    found: _Floats = np.sqrt(product)
    product *= product
    found *= product
    np.divide(table.peaks, found, out=found)
    found += _BROAD_DENSITY
    return found


@lru_cache(maxsize=1)
def everyday_object_rows() -> tuple[Mapping[str, str], ...]:
    """Return the rows of `data/everyday_objects.csv`, in the order of `log_likelihoods`."""
    return tuple(read_rows("everyday_objects.csv"))


@lru_cache(maxsize=1)
def _load_table() -> _SizeTable:
    rows = everyday_object_rows()
    extents = np.array([[float(row[side]) for row in rows] for side in ("long_m", "middle_m", "short_m")])
    extents = np.maximum(extents, SIZE.min_extent)
    spread = np.array([float(row["spread"]) for row in rows])
    scales = np.sqrt(spread**2 + SIZE.relative_error**2 + (SIZE.absolute_error / extents) ** 2)
    centres = np.log(extents)
    ordered = open_table_cache(()).get(
        "size-order",
        lambda kept: _checked(kept, len(rows)),
        lambda: _order_probability(centres, scales),
        np.ndarray.tolist,
    )
    peaks = (1 - SIZE.broad_share) * _PEAK_DENSITY**3 / scales.prod(axis=0) / ordered
    return _SizeTable(tuple(row["noun"] for row in rows), 0.5 / scales, centres * 0.5 / scales, peaks)


def _checked(kept: list[float], count: int) -> _Floats:
    """Return a kept table; raise ValueError if it is damaged."""
    found: _Floats = np.array(kept, np.float64)
    if found.shape != (count,):
        raise ValueError("expected a number for each row")
    return found


def _order_probability(centres: _Floats, scales: _Floats) -> _Floats:
    """Return the probability that draws around three centres are in descending order, (rows,).

    ∫ f2(x) (1 - F1(x)) F3(x) dx by the midpoint rule; t = 2 tan θ maps the real line to ±π/2, and
    f2 dx = 0.75 cos³θ dθ.
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
