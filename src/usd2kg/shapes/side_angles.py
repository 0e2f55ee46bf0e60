"""Angles between the sides of an object as seen by a viewer and the directions to other objects."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["SIDES", "angles_off_side", "turns_from_gaze"]

Array = NDArray[np.float64]

_TURNS = {"behind": 0.0, "left": 90.0, "front": 180.0, "right": -90.0}
"""Degrees from the gaze direction to the direction from anchor to target, counter-clockwise from above."""
SIDES = tuple(_TURNS)


def turns_from_gaze(gaze: Array, away: Array) -> Array:
    """Return the angles (n,) from directions of gaze to directions from anchor to target, both (n, 2) or (2,).

    Degrees, counter-clockwise from above, from -180 to 180.
    """
    cross, dot = gaze[..., 0] * away[..., 1] - gaze[..., 1] * away[..., 0], (gaze * away).sum(axis=-1)
    return np.asarray(np.degrees(np.arctan2(cross, dot)))


def angles_off_side(turns: Array, side: str) -> Array:
    """Return the angles (n,) between turns from the gaze and the direction of a side, from 0 to 180 degrees."""
    return np.asarray(np.abs((turns - _TURNS[side] + 180) % 360 - 180))
