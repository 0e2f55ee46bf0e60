"""Whether the top of a thing's box is a face of it, or only as high as something thin on it."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.thresholds import RelationRules
from usd2kg.scene import SceneObject

__all__ = ["has_protrusion"]

_BROAD = 0.5
"""Share of the footprint from which on a level is the top of a thing, whatever rises over it."""


def has_protrusion(boxed: BoxedObjects, rules: RelationRules) -> NDArray[np.bool_]:
    """Return for each body whether something thin rises over its broad top, as a tap or an upstand does over a worktop.

    Nothing stands on the top of its box then, nor meets it from above. The broad top is high up: the rim of a pot rises
    over its bottom, and carries a lid all the same.
    """
    return np.array([_has_protrusion(obj, rules) for obj in boxed.objects], np.bool_)


def _has_protrusion(obj: SceneObject, rules: RelationRules) -> bool:
    if obj.own_box is None or obj.part_boxes or not obj.support_levels:
        return False
    width, depth, height = obj.own_box.size
    top = max(obj.support_levels, key=lambda level: level.lower[2])
    is_broad = top.size[0] * top.size[1] >= _BROAD * width * depth
    is_high = top.lower[2] - obj.own_box.lower[2] > rules.inside.max_floor_share * height
    return is_broad and is_high and obj.own_box.upper[2] - top.lower[2] > rules.on.max_gap
