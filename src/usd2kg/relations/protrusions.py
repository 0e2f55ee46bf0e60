"""Objects whose box is higher than their broad top: a worktop with a tap or an upstand."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.thresholds import RelationRules
from usd2kg.scene import SceneObject

__all__ = ["has_protrusion"]


def has_protrusion(boxed: BoxedObjects, rules: RelationRules) -> NDArray[np.bool_]:
    """Return for each object whether something thin protrudes above its broad top.

    If so, nothing rests on or touches the top of its box. The broad top must be in the upper third: the rim of a pot
    rises above its bottom and still supports a lid.
    """
    return np.array([_has_protrusion(obj, rules) for obj in boxed.objects], np.bool_)


def _has_protrusion(obj: SceneObject, rules: RelationRules) -> bool:
    if obj.own_box is None or obj.part_boxes or not obj.support_levels:
        return False
    width, depth, height = obj.own_box.size
    top = max(obj.support_levels, key=lambda level: level.lower[2])
    is_broad = top.size[0] * top.size[1] >= rules.geometry.min_broad_ratio * width * depth
    is_high = top.lower[2] - obj.own_box.lower[2] > rules.inside.max_floor_share * height
    return is_broad and is_high and obj.own_box.upper[2] - top.lower[2] > rules.on.max_gap
