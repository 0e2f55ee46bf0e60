"""`left`, `right`, `front` and `behind`, relative to a viewer."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.adjacency import NearbyPairs, are_nearest, height_overlaps
from usd2kg.relations.array_records import select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.model import Links, Viewpoint, margin_below, margin_score
from usd2kg.relations.thresholds import SideRule
from usd2kg.shapes.side_angles import SIDES, angles_off_side, turns_from_gaze

__all__ = ["find_sides"]

Array = NDArray[np.float64]

_APART = 1e-9
"""Metres above which a horizontal offset has a direction."""
_OPPOSITE = {"behind": "front", "front": "behind", "left": "right", "right": "left"}


def find_sides(boxed: BoxedObjects, pairs: NearbyPairs, viewpoint: Viewpoint, rule: SideRule) -> list[Links]:
    """Return the links of all four sides and their inverses between nearby objects.

    Viewer's frame (relative frame of reference, Levinson 2003): the object in front is nearer to the viewer. The gaze
    is the given direction, or towards the midpoint of the pair.
    """
    pairs = select_rows(pairs, height_overlaps(boxed, pairs) >= rule.min_height_share)
    pairs = select_rows(pairs, are_nearest(boxed, pairs, rule.most))
    view = _directions(boxed, pairs, viewpoint)
    away = boxed.middle[pairs.one, :2] - boxed.middle[pairs.other, :2]
    is_apart = (np.hypot(away[:, 0], away[:, 1]) > _APART) & (np.hypot(view[:, 0], view[:, 1]) > _APART)
    turns = turns_from_gaze(view, away)
    links = []
    for kind in SIDES:
        off = angles_off_side(turns, kind)
        chosen = is_apart & (off <= rule.tolerance_deg)
        one, other = pairs.one[chosen], pairs.other[chosen]
        numbers = {"angle": off[chosen], "distance": pairs.distance[chosen]}
        confidence = margin_score(margin_below(off[chosen], rule.tolerance_deg))
        links.append(Links(kind, rule.rule, one, other, numbers, confidence))
        links.append(Links(_OPPOSITE[kind], rule.rule, other, one, numbers, confidence))
    return links


def _directions(boxed: BoxedObjects, pairs: NearbyPairs, viewpoint: Viewpoint) -> Array:
    if viewpoint.direction is not None:
        return np.tile(np.array(viewpoint.direction[:2]), (len(pairs.one), 1))
    middle = (boxed.middle[pairs.one] + boxed.middle[pairs.other]) / 2
    return np.asarray(middle[:, :2] - np.array(viewpoint.position[:2]))
