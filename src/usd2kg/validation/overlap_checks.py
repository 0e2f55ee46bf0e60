"""Checks for duplicates and for objects that interpenetrate."""

from collections.abc import Iterator

import numpy as np

from usd2kg.shapes import overlapping_pairs
from usd2kg.validation.checked_scene import (
    CheckedScene,
    Implausible,
    is_nested,
    length_text,
    name_of,
    size_text,
    volume_of,
)
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.plausibility_rules import Rule

__all__ = ["check_duplicates", "check_interpenetration"]


def _same_place(scene: CheckedScene, tolerance: float) -> list[list[int]]:
    """Return the indices of boxes that have the same corners, grouped; each box is in one group."""
    step = max(tolerance, 1e-9)
    corners = np.round(np.hstack([scene.boxes.lower, scene.boxes.upper]) / step)
    groups: dict[bytes, list[int]] = {}
    for index, row in enumerate(corners + 0.0):
        groups.setdefault(row.tobytes(), []).append(index)
    return list(groups.values())


def check_duplicates(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects with the position and size of another, unless one is nested in the other."""
    objects = scene.boxes.objects
    for first, *others in _same_place(scene, rule.number("tolerance")):
        for other in others:
            size = objects[other].size or (0, 0, 0)
            if max(size) >= rule.number("least_extent") and not is_nested(objects[first], objects[other]):
                found = f"it has the position and size of {name_of(objects[first])}: {size_text(size)}"
                yield Implausible(objects[other], found, "one object per place")


def check_interpenetration(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield pairs of objects whose boxes are largely the same space, without a relation that explains it."""
    boxes, volumes = scene.boxes, scene.boxes.volumes
    # Duplicates have their own rule, and would give too many pairs.
    chosen = np.array(
        [group[0] for group in _same_place(scene, scene.rules["duplicate"].number("tolerance"))],
        np.int64,
    )
    chosen = chosen[[_is_solid(scene, boxes.objects[i], rule) for i in chosen.tolist()]]
    lower, upper = boxes.lower[chosen], boxes.upper[chosen]
    for i, j in overlapping_pairs(lower[:, :2], upper[:, :2]):
        sides = np.minimum(upper[i], upper[j]) - np.maximum(lower[i], lower[j])
        shared = np.maximum(sides, 0).prod(axis=1)
        share = shared / (volumes[chosen[i]] + volumes[chosen[j]] - shared)
        for k in np.flatnonzero(share >= rule.number("share")).tolist():
            first, second = (boxes.objects[chosen[each[k]]] for each in (i, j))
            if not is_nested(first, second) and not _are_related(first, second):
                depth = length_text(float(sides[k].min()))
                found = (
                    f"its box shares {share[k]:.0%} of the joint volume with {name_of(second)}; "
                    f"the two overlap by {depth} at least"
                )
                yield Implausible(first, found, f"less than {rule.number('share'):.0%}, or one inside or on the other")


def _is_solid(scene: CheckedScene, obj: GraphObject, rule: Rule) -> bool:
    """Return whether the box of an object approximates its volume well."""
    if scene.classes.is_a(obj, rule, "hollow_words", "hollow") or obj.size is None:
        return False
    if max(obj.size) < rule.number("least_extent"):
        return False
    # The box of a rotated object along the world's axes is larger than the object.
    return obj.oriented_size is None or volume_of(obj.oriented_size) >= rule.number("fill") * volume_of(obj.size)


def _are_related(first: GraphObject, second: GraphObject) -> bool:
    links = [{*obj.supporters, *obj.containers, *obj.holders} for obj in (first, second)]
    return second.iri in links[0] or first.iri in links[1]
