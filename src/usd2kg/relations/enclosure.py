"""Enclosure: how far the surface of one object surrounds another, by rays along the axes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.pair_blocks import measure_in_blocks
from usd2kg.relations.settings import ENCLOSURE
from usd2kg.shapes.axis_rays import find_crossings
from usd2kg.shapes.surface import Surface

__all__ = ["Enclosures", "measure_enclosures", "measure_flanks", "points_of"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_UP = 2
_AXES = 3


class Enclosures(NamedTuple):
    """For pairs of objects: shares of the points of the one from which rays meet the surface of the other."""

    below: Array
    """Downward."""
    above: Array
    """Upward."""
    beside: Array
    """In the four horizontal directions, the mean."""
    buried: Array
    """Of the rays from above the feet: those that start within the material, not in a cavity. Nothing is within it
    below the open sky: the faces of a basin may point either way. The feet may be drawn into the floor of a basket."""
    caged: Array
    """Share of the four sides beyond which the surface has corners, at the height of the object and no farther than it
    is long: the wires of a rack, which rays miss."""


def measure_enclosures(boxed: BoxedObjects, target: Indices, anchor: Indices) -> Enclosures:
    """Return how far objects with a surface enclose the part of another that is in their box.

    Args:
        boxed: the objects.
        target: indices of the objects that may be inside.
        anchor: indices of the objects that may contain them; they have a surface.
    """
    return measure_in_blocks(lambda some: _measure_some(boxed, target[some], anchor[some]), len(target))


def _measure_some(boxed: BoxedObjects, target: Indices, anchor: Indices) -> Enclosures:
    points = {index: points_of(boxed, index) for index in np.unique(target).tolist()}
    pairs = list(zip(target.tolist(), anchor.tolist(), strict=True))
    within = [_within(points[one], boxed.lower[other], boxed.upper[other]) for one, other in pairs]
    some = np.array([pair for pair, inner in enumerate(within) if len(inner)], np.int64)
    surfaces = [surface for pair in some.tolist() if (surface := boxed.surfaces[pairs[pair][1]]) is not None]
    found = Enclosures(*(np.zeros(len(pairs)) for _ in Enclosures._fields))
    if len(some):
        hits, buried = _cast([within[pair] for pair in some.tolist()], surfaces)
        found.below[some], found.above[some] = hits[_UP]
        found.beside[some] = hits[:_UP].mean(axis=(0, 1))
        found.buried[some] = _raised_share(boxed, target[some], [within[pair] for pair in some.tolist()], buried)
    for pair in some.tolist():
        one, other = pairs[pair]
        surface = boxed.surfaces[other]
        assert surface is not None, "anchors have a surface"
        found.caged[pair] = _caged(surface, boxed.lower[one], boxed.upper[one])
    return found


def _raised_share(boxed: BoxedObjects, target: Indices, points: Sequence[Array], buried: Array) -> Array:
    """Return the mean of `buried` over the points of each target that are above its feet; over all if none is."""
    level = boxed.lower[target, _UP] + boxed.geometry.foot_height
    raised = [some[:, _UP] > low for some, low in zip(points, level.tolist(), strict=True)]
    weights = np.concatenate([some if some.any() else ~some for some in raised]).astype(np.float64)
    row = np.repeat(np.arange(len(points)), [len(some) for some in points])
    return np.asarray(np.bincount(row, weights * buried, len(points)) / np.bincount(row, weights, len(points)))


def measure_flanks(boxed: BoxedObjects, target: Indices, anchor: Indices, depth_share: float) -> Array:
    """Return for each pair the share of rays that meet the sides of a compartment beside its open side.

    They start in front of the target, if need be: posts beside what hangs at the back of an open rack are no sides.

    Args:
        boxed: the objects.
        target: indices of the objects that may be in a compartment; part of each is in the box of its anchor.
        anchor: indices of the objects that may have the compartment; they have a surface.
        depth_share: depth from the back at which there are sides, as a share of the shorter side of the anchor's front.
    """
    if not len(target):
        return np.zeros(0)
    low, high = boxed.lower[anchor], boxed.upper[anchor]
    points = [_within(points_of(boxed, one), *ends) for one, *ends in zip(target.tolist(), low, high, strict=True)]
    surfaces = [surface for other in anchor.tolist() if (surface := boxed.surfaces[other]) is not None]
    hits = _cast(points, surfaces)[0][:_UP]
    axis, side = np.unravel_index(hits.reshape(2 * _UP, -1).argmin(axis=0), (_UP, 2))
    pair = np.arange(len(target))
    front = boxed.size[anchor]
    front[pair, axis] = np.inf
    depth = depth_share * front.min(axis=1)
    sign = np.where(side == 0, -1.0, 1.0)
    back = np.where(side == 0, high[pair, axis], low[pair, axis])
    moved = []
    for number, inner in enumerate(points):
        at = sign[number] * (inner[:, axis[number]] - back[number])
        ahead = inner.copy()
        ahead[:, axis[number]] += sign[number] * max(0.0, depth[number] - float(at.max()))
        moved.append(ahead)
    return np.asarray(_cast(moved, surfaces)[0][1 - axis, :, pair].mean(axis=1))


def _within(points: Array, lower: Array, upper: Array) -> Array:
    return np.asarray(points[((points >= lower) & (points <= upper)).all(axis=1)])


def points_of(boxed: BoxedObjects, index: int) -> Array:
    """Return points (n, 3) of an object, slightly within its surface: a grid for a box."""
    surface, middle = boxed.surfaces[index], boxed.middle[index]
    if surface is None:
        return np.asarray(middle + ENCLOSURE.inset * _GRID * boxed.size[index] / 2)
    corners = surface.corners.reshape(-1, 3)
    step = max(1, len(corners) // ENCLOSURE.max_points)
    return np.asarray(middle + ENCLOSURE.inset * (corners[::step] - middle))


_STEPS = np.linspace(-1.0, 1.0, ENCLOSURE.grid)
_GRID = np.stack(np.meshgrid(_STEPS, _STEPS, _STEPS), axis=-1).reshape(-1, 3)


def _cast(points: Sequence[Array], surfaces: Sequence[Surface]) -> tuple[Array, Array]:
    """Return the shares of rays (axis, against or along it, pair) that meet a surface, and of buried ones (point)."""
    count = np.array([len(inner) for inner in points], np.int64)
    pair = np.repeat(np.arange(len(points)), count)
    orientation = np.repeat(np.array([surface.orientation for surface in surfaces]), count)
    lines = np.concatenate(points)
    hits, within = np.zeros((_AXES, 2, len(points))), np.zeros(len(lines))
    is_covered = np.zeros(len(lines), np.bool_)
    for axis in range(_AXES):
        found = find_crossings(points, surfaces, axis)
        is_after = found.at > lines[found.line, axis]
        for place, (is_ahead, sign) in enumerate(((~is_after, -1.0), (is_after, 1.0))):
            line = found.line[is_ahead]
            is_hit = np.bincount(line, minlength=len(lines)) > 0
            # A ray that leaves the material more often than it enters it starts within.
            leaves = np.bincount(line, sign * orientation[line] * np.sign(found.faces[is_ahead]), len(lines))
            hits[axis, place] = np.bincount(pair[is_hit], minlength=len(points)) / count
            within += leaves > 0
            # The last rays go up.
            is_covered = is_hit
    return hits, within * is_covered / (2 * _AXES)


def _caged(surface: Surface, lower: Array, upper: Array) -> float:
    """Return the share of the four sides of a box beyond which a surface has corners close by."""
    corners = surface.corners.reshape(-1, 3)
    around = np.array([1.0, 1.0, 0.0]) * (upper - lower)[:_UP].max()
    near = corners[((corners >= lower - around) & (corners <= upper + around)).all(axis=1)]
    return float(
        np.mean([[(near[:, side] < lower[side]).any(), (near[:, side] > upper[side]).any()] for side in (0, 1)])
    )
