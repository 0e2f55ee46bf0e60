"""Backing: what is between an object and the wall behind it, such as the back of a rack."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.distances import box_gaps
from usd2kg.relations.enclosure import points_of
from usd2kg.shapes.axis_rays import find_crossings

__all__ = ["are_between"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def are_between(boxed: BoxedObjects, between: Indices, target: Indices, wall: Indices, min_share: float) -> Mask:
    """Return for each row whether a surface is between the target and the wall, along the axis on which they are apart.

    Args:
        boxed: the objects.
        between: indices of the objects that may be between; those without a surface are not.
        target: indices of the objects beside the walls.
        wall: indices of the walls.
        min_share: share of the rays from the target to the wall that meet what is between.
    """
    axes = box_gaps(boxed, target, wall).argmax(axis=1)
    found = np.zeros(len(target), np.bool_)
    for axis in range(boxed.lower.shape[1]):
        rows = np.flatnonzero((axes == axis) & boxed.has_surface[between])
        points = [points_of(boxed, index) for index in target[rows].tolist()]
        surfaces = [surface for index in between[rows].tolist() if (surface := boxed.surfaces[index]) is not None]
        count = np.array([len(some) for some in points], np.int64)
        owner = np.repeat(rows, count)
        start = np.concatenate([np.zeros(0), *(some[:, axis] for some in points)])
        crossings = find_crossings(points, surfaces, axis)
        row, begin = owner[crossings.line], start[crossings.line]
        low, high = boxed.lower[wall[row], axis], boxed.upper[wall[row], axis]
        is_met = ((begin < crossings.at) & (crossings.at <= low)) | ((high <= crossings.at) & (crossings.at < begin))
        met = np.bincount(owner[np.unique(crossings.line[is_met])], minlength=len(target))
        found[rows] = met[rows] >= min_share * count
    return found
