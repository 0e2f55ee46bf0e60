"""How objects meet the surfaces below them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import ratios
from usd2kg.relations.feet import find_tops, underside_at
from usd2kg.relations.settings import FEET
from usd2kg.relations.thresholds import RelationRules
from usd2kg.shapes.surface import Surface

__all__ = ["Standing", "SurfaceContacts", "measure_contacts"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_UP = 2


class Standing(NamedTuple):
    """Pairs of an object that may rest on something, and a surface that may support it."""

    feet: Sequence[Array]
    """(n, 3): points on the underside of the object."""
    surfaces: Sequence[Surface]
    """What may support it."""
    own_surfaces: Sequence[Surface | None]
    """Of the object; None for a box, whose underside is level."""
    lower: Array
    """(n, 3): lower corner of its box."""
    upper: Array
    foot_area: Array
    """Square metres that the feet stand for."""
    tolerance: Array
    """Tolerated gap in metres."""
    max_sink: Array
    """Depth in metres below the surface from which the object is not on it, whatever the thickness there."""
    is_grounded: Mask
    """Whether it may sink in deeper than the surface is thick: nothing is below the ground."""


class SurfaceContacts(NamedTuple):
    """How the feet of objects meet a surface, one row per pair; NaN where they do not."""

    gap: Array
    """Metres from the surface up to the feet; negative if they sink into it."""
    ratio: Array
    """Share of the feet over the surface."""
    area: Array
    """Square metres of the object's footprint that the surface supports."""
    allowed: Array
    """Tolerated gap, or penetration for a negative gap, in metres."""
    height: Array
    """Height of the surface below the feet."""
    underside: Array
    """Height of the underside of what supports the feet; equal to `height` for a sheet, -inf if it is not known."""


def measure_contacts(standing: Standing, rules: RelationRules) -> SurfaceContacts:
    """Return how objects meet the surfaces below them, within the limits of the rules.

    The feet are measured down to the surface. If few of them are over it, as those of a lid over the rim of a pot, the
    faces of the surface are measured up to the object. The object is supported between points of contact as well.
    """
    contacts = _from_feet(standing, rules)
    for pair in np.flatnonzero(~(contacts.ratio > rules.hovering.min_overlap_ratio)).tolist():
        rim = _from_rim(standing, pair)
        if rim is not None and not rim[1] <= contacts.ratio[pair]:
            for column, value in zip(contacts, rim, strict=True):
                column[pair] = value
    return contacts


def _from_feet(standing: Standing, rules: RelationRules) -> SurfaceContacts:
    count = np.array([len(feet) for feet in standing.feet], np.int64)
    pair = np.repeat(np.arange(len(count)), count)
    tops = find_tops(standing.feet, standing.surfaces, standing.max_sink[pair])
    level = np.concatenate([np.zeros(0), *(feet[:, _UP] for feet in standing.feet)])
    gap = (level - tops.height) * tops.cosine
    tolerance = standing.tolerance[pair]
    sinks = np.where(standing.is_grounded[pair], np.inf, np.maximum(tolerance, tops.thickness))
    sinks = np.minimum(sinks, np.maximum(standing.max_sink[pair], tolerance))
    is_met = (gap >= -sinks) & (gap <= np.maximum(tolerance, rules.hovering.max_gap))
    bottom = np.full(len(count), np.inf)
    np.minimum.at(bottom, pair, level)
    is_lowest = is_met & (level <= bottom[pair] + FEET.flatness)
    has_lowest = np.bincount(pair[is_lowest], minlength=len(count)) > 0
    chosen = np.where(has_lowest[pair], is_lowest, is_met)
    middle = _medians(gap, pair, chosen, len(count))
    slack = np.maximum(standing.tolerance, rules.geometry.foot_height)
    is_supported = is_met & (np.abs(gap - middle[pair]) <= slack[pair])
    is_supported = _are_between(np.concatenate([np.zeros((0, 3)), *standing.feet]), pair, is_supported, len(count))
    ratio = np.where(np.isfinite(middle), np.bincount(pair[is_supported], minlength=len(count)) / count, np.nan)
    allowed = np.where(middle < 0, _medians(sinks, pair, chosen, len(count)), standing.tolerance)
    height = _medians(tops.height, pair, chosen, len(count))
    thickness = _medians(tops.thickness, pair, chosen, len(count))
    return SurfaceContacts(middle, ratio, ratio * standing.foot_area, allowed, height, height - thickness)


def _are_between(feet: Array, pair: Indices, is_supported: Mask, count: int) -> Mask:
    """Return for each foot whether it is in the rectangle around the supported feet of its pair."""
    low, high = np.full((count, _UP), np.inf), np.full((count, _UP), -np.inf)
    np.minimum.at(low, pair[is_supported], feet[is_supported, :_UP])
    np.maximum.at(high, pair[is_supported], feet[is_supported, :_UP])
    return np.asarray(((feet[:, :_UP] >= low[pair]) & (feet[:, :_UP] <= high[pair])).all(axis=1))


def _medians(values: Array, groups: Indices, chosen: Mask, count: int) -> Array:
    """Return the median of the chosen values of each group, the lower one of two; NaN for a group without any."""
    groups, values = groups[chosen], values[chosen]
    order = np.lexsort((values, groups))
    size = np.bincount(groups, minlength=count)
    found = np.full(count, np.nan)
    some = np.flatnonzero(size)
    found[some] = values[order[(np.cumsum(size) - size + (size - 1) // 2)[some]]]
    return found


def _meet_rectangle(triangles: Array, lower: Array, upper: Array) -> Mask:
    """Return for each triangle (n, 3, 2) whether none of its sides separates it from a rectangle.

    The boxes of large oblique triangles, such as those of a turned tablecloth, cover much beside them.
    """
    meets = np.ones(len(triangles), np.bool_)
    middle, half = (lower + upper) / 2, (upper - lower) / 2
    for corner in range(3):
        side = triangles[:, (corner + 1) % 3] - triangles[:, corner]
        normal = np.stack([-side[:, 1], side[:, 0]], axis=1)
        along = np.einsum("ijk,ik->ij", triangles - middle, normal)
        reach = np.abs(normal) @ half
        meets &= (along.min(axis=1) <= reach) & (along.max(axis=1) >= -reach)
    return meets


def _from_rim(standing: Standing, pair: int) -> tuple[float, ...] | None:
    """Return the contact of the highest faces of a surface with the underside of an object; None if there is none."""
    surface, own = standing.surfaces[pair], standing.own_surfaces[pair]
    lower, upper = standing.lower[pair], standing.upper[pair]
    tolerance, bottom = float(standing.tolerance[pair]), float(standing.feet[pair][:, _UP].min())
    # The part of each triangle under the object, as a box.
    low, high = np.maximum(surface.lower, lower)[:, :_UP], np.minimum(surface.upper, upper)[:, :_UP]
    top = surface.upper[:, _UP]
    rim = np.flatnonzero((np.abs(top - bottom) <= tolerance) & (low <= high).all(axis=1))
    rim = rim[_meet_rectangle(surface.corners[rim, :, :_UP], lower[:_UP], upper[:_UP])]
    if own is not None and len(rim):
        middle = np.column_stack([(low[rim] + high[rim]) / 2, top[rim]])
        rim = rim[underside_at([middle], [own]) - top[rim] <= tolerance]
    if not len(rim):
        return None
    area = float((high[rim].max(axis=0) - low[rim].min(axis=0)).prod())
    ratio = min(float(ratios(np.array(area), standing.foot_area[pair])), 1.0)
    height = float(top[rim].max())
    return bottom - height, ratio, area, tolerance, height, -np.inf
