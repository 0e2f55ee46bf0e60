"""`left`, `right`, `front` and `behind`: where things are to each other, as someone sees them from a viewpoint."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.columns import taken
from usd2kg.relations.model import Links, Viewpoint, clearness, share_below
from usd2kg.relations.neighbours import Pairs, heights_beside, keep_nearest
from usd2kg.relations.objects import Bodies
from usd2kg.relations.thresholds import Side

__all__ = ["find_sides"]

Array = NDArray[np.float64]

_TURNS = {"behind": 0.0, "left": 90.0, "front": 180.0, "right": -90.0}
"""Degrees from the direction of view to that from the anchor to the target, counter-clockwise seen from above."""
_OPPOSITE = {"behind": "front", "front": "behind", "left": "right", "right": "left"}


def find_sides(bodies: Bodies, pairs: Pairs, viewpoint: Viewpoint, rule: Side) -> list[Links]:
    """Return which of two things close together is left of, right of, in front of or behind the other.

    In the frame of the viewer (the relative frame of reference, Levinson 2003): what is in front of a thing is nearer
    to the viewer. The direction of view is the one given, or that to the middle between the two. What is said of one
    holds the other way round of the other.
    """
    pairs = taken(pairs, heights_beside(bodies, pairs) >= rule.min_height_share)
    pairs = taken(pairs, keep_nearest(bodies, pairs, rule.most))
    view = _directions(bodies, pairs, viewpoint)
    away = bodies.middle[pairs.one, :2] - bodies.middle[pairs.other, :2]
    is_apart = (np.hypot(away[:, 0], away[:, 1]) > 1e-9) & (np.hypot(view[:, 0], view[:, 1]) > 1e-9)
    cross, dot = view[:, 0] * away[:, 1] - view[:, 1] * away[:, 0], (view * away).sum(axis=1)
    angle = np.degrees(np.arctan2(cross, dot))
    links = []
    for kind, turn in _TURNS.items():
        off = np.abs((angle - turn + 180) % 360 - 180)
        chosen = is_apart & (off <= rule.tolerance_deg)
        one, other = pairs.one[chosen], pairs.other[chosen]
        numbers = {"angle": off[chosen], "distance": pairs.distance[chosen]}
        confidence = clearness(share_below(off[chosen], rule.tolerance_deg))
        links.append(Links(kind, rule.rule, one, other, numbers, confidence))
        links.append(Links(_OPPOSITE[kind], rule.rule, other, one, numbers, confidence))
    return links


def _directions(bodies: Bodies, pairs: Pairs, viewpoint: Viewpoint) -> Array:
    if viewpoint.direction is not None:
        return np.tile(np.array(viewpoint.direction[:2]), (len(pairs.one), 1))
    middle = (bodies.middle[pairs.one] + bodies.middle[pairs.other]) / 2
    return np.asarray(middle[:, :2] - np.array(viewpoint.position[:2]))
