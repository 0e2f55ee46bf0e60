"""draw_boxes: a small picture of boxes, for objects without available geometry."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.pictures import Size, picture_of_scene
from usd2kg.render.png import encode_png
from usd2kg.render.triangle_soup import gather
from usd2kg.scene.meshes import ObjectMesh
from usd2kg.scene.model import Vector

__all__ = ["ColoredBox", "draw_boxes"]

_CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
_SIDES = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
_TRIANGLES = np.concatenate([_SIDES[:, [0, 1, 2]], _SIDES[:, [0, 2, 3]]]).astype(np.int32)
"""Counter-clockwise seen from outside, of the corners in the order of `_CORNERS`."""
_ENCLOSED_SHARE = 0.5
"""Fraction of the other boxes above which an enclosing box, such as that of a room, is not drawn."""


class ColoredBox(NamedTuple):
    """An axis-aligned box."""

    lower: NDArray[np.float64]
    """(3,) metres, z-up world frame."""
    upper: NDArray[np.float64]
    color: Vector
    """Linear RGB from 0 to 1."""


def draw_boxes(boxes: Sequence[ColoredBox], size: Size) -> bytes | None:
    """Return a PNG of boxes from a corner above; None if there are none.

    A box that encloses the centres of most others would hide them and is left out.

    Args:
        boxes: what to draw.
        size: width and height in pixels.
    """
    if not boxes:
        return None
    lower = np.array([box.lower for box in boxes])
    upper = np.array([box.upper for box in boxes])
    enclosed = _count_enclosed(lower, upper)
    is_drawn = enclosed <= max(1, _ENCLOSED_SHARE * (len(boxes) - 1))
    meshes = [
        ObjectMesh(
            f"/box_{number}",
            (lower[number] + _CORNERS * (upper[number] - lower[number])).astype(np.float32),
            _TRIANGLES,
            boxes[number].color,
            1.0,
        )
        for number in np.flatnonzero(is_drawn).tolist()
    ]
    return encode_png(picture_of_scene(gather(meshes), size))


def _count_enclosed(lower: NDArray[np.float64], upper: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return (n,): the number of other boxes whose centre each box encloses."""
    centers = (lower + upper) / 2
    counts = np.array(
        [((centers >= low) & (centers <= high)).all(axis=1).sum() for low, high in zip(lower, upper, strict=True)]
    )
    # Subtract the box itself.
    enclosed: NDArray[np.int64] = counts - 1
    return enclosed
