"""Interlocking objects: a coat on its hook, a roll on its pin, a hanger on its rail."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.distances import box_gaps

__all__ = ["are_interlocked", "are_over", "held_at"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_ROUNDING = 1e-6
"""Metres: extents that differ by less are equal."""


def are_interlocked(boxed: BoxedObjects, one: Indices, other: Indices, least: float) -> Mask:
    """Return for each pair whether the boxes overlap along all axes, by `least` metres or all of the thinner object.

    Faces that meet do not overlap, whereas a hook reaches into what hangs from it.
    """
    needed = np.minimum(least, np.minimum(boxed.size[one], boxed.size[other]))
    return np.asarray((box_gaps(boxed, one, other) <= _ROUNDING - needed).all(axis=1))


def are_over(boxed: BoxedObjects, one: Indices, other: Indices) -> Mask:
    """Return for each pair whether the middle of `one` is over the box of `other`."""
    middle = boxed.middle[one, :2]
    return np.asarray(((middle >= boxed.lower[other, :2]) & (middle <= boxed.upper[other, :2])).all(axis=1))


def held_at(boxed: BoxedObjects, one: Indices, other: Indices) -> Array:
    """Return the height at which `other` holds `one`, from its middle, as a share of its own height: -0.5 to 0.5.

    It is that of the middle of what the two boxes share. Of two interlocking objects, the one that is held nearer to
    its top hangs from the other.
    """
    low = np.maximum(boxed.lower[one, 2], boxed.lower[other, 2])
    high = np.minimum(boxed.upper[one, 2], boxed.upper[other, 2])
    height = np.maximum(boxed.size[one, 2], _ROUNDING)
    return np.asarray(((low + high) / 2 - boxed.middle[one, 2]) / height)
