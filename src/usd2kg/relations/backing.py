"""Backing: what is between an object and the wall behind it, such as the back of a rack."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.enclosure import points_of
from usd2kg.shapes.axis_rays import find_crossings

__all__ = ["are_between", "first_hits"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def are_between(boxed: BoxedObjects, between: Indices, target: Indices, wall: Indices, min_share: float) -> Mask:
    """Return for each row whether a surface is between the target and the wall, in the direction of its nearest face.

    The box of a wall may be that of all walls of a flat, so that its surface counts where it is known.

    Args:
        boxed: the objects.
        between: indices of the objects that may be between; those without a surface are not.
        target: indices of the objects beside the walls.
        wall: indices of the walls.
        min_share: share of the rays from the target to the wall that meet what is between.
    """
    found = np.zeros(len(target), np.bool_)
    rows = np.flatnonzero(boxed.has_surface[between])
    if not len(rows):
        return found
    points = {index: points_of(boxed, index) for index in np.unique(target[rows]).tolist()}
    starts = [points[index] for index in target[rows].tolist()]
    count = np.array([len(some) for some in starts], np.int64)
    to_wall = first_hits(boxed, starts, wall[rows])
    to_other = first_hits(boxed, starts, between[rows])
    row = np.repeat(np.arange(len(rows)), count)
    reach = np.full((len(rows), to_wall.shape[1]), np.inf)
    np.minimum.at(reach, row, to_wall)
    side = reach.argmin(axis=1)[row]
    line = np.arange(len(row))
    is_met = to_other[line, side] <= to_wall[line, side]
    is_met &= np.isfinite(to_other[line, side])
    found[rows] = np.bincount(row, is_met, len(rows)) >= min_share * count
    return found


def first_hits(boxed: BoxedObjects, points: list[Array], others: Indices) -> Array:
    """Return how far it is from each point to an object (points, directions), against and along x, y and z; else inf.

    An object without a surface is as far as the faces of its box, beside the point or not.
    """
    axes = boxed.lower.shape[1]
    begin = np.concatenate(points)
    row = np.repeat(np.arange(len(points)), [len(some) for some in points])
    hits = np.full((len(begin), 2 * axes), np.inf)
    known = np.flatnonzero(boxed.has_surface[others])
    surfaces = [surface for index in others[known].tolist() if (surface := boxed.surfaces[index]) is not None]
    lines = np.flatnonzero(boxed.has_surface[others][row])
    boxes = np.flatnonzero(~boxed.has_surface[others][row])
    for axis in range(axes):
        away = boxed.lower[others[row[boxes]], axis] - begin[boxes, axis]
        hits[boxes[away >= 0], 2 * axis + 1] = away[away >= 0]
        away = begin[boxes, axis] - boxed.upper[others[row[boxes]], axis]
        hits[boxes[away >= 0], 2 * axis] = away[away >= 0]
        if len(known):
            crossings = find_crossings([points[place] for place in known.tolist()], surfaces, axis)
            line = lines[crossings.line]
            away = crossings.at - begin[line, axis]
            np.minimum.at(hits, (line, 2 * axis + (away >= 0)), np.abs(away))
    return hits
