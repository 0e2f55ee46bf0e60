"""`part-of`: parthood from joints, kinds, classes and fit. A group prim is not a whole."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.prim_paths import nearest_in
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.model import Links
from usd2kg.relations.part_fit import find_fitted
from usd2kg.relations.part_nouns import NounConcepts
from usd2kg.relations.part_roles import find_roles
from usd2kg.relations.thresholds import PartOfRule
from usd2kg.scene import Joint, Scene

__all__ = ["PartLinks", "boxed_ends", "find_parts", "wholes_of"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_MOVING = frozenset({"revolute", "prismatic", "spherical"})
"""Joint types that connect a part to its whole; a fixed joint may just anchor a robot to the floor."""
_PART_KIND = "subcomponent"


class PartLinks(NamedTuple):
    """`part-of` links by their evidence; indices count all objects of the scene."""

    stated: Links
    """A movable joint, or the kind subcomponent below another object."""
    nested: Links
    """A component, by its class, below another object."""
    fitted: Links
    """A part by its class, concept or name, fitted to a whole of its group or of the group above."""


def find_parts(
    scene: Scene,
    boxed: BoxedObjects,
    classes: ClassMembership,
    nouns: Sequence[NounConcepts],
    rule: PartOfRule,
) -> PartLinks:
    """Return the `part-of` links; each object has at most one whole.

    Args:
        scene: the objects and joints.
        boxed: the objects with a box.
        classes: the classes of all objects.
        nouns: for each object, what the nouns of its name mean.
        rule: the thresholds.
    """
    is_whole = ~classes.are_in("not_wholes")
    number = {obj.prim_path: index for index, obj in enumerate(scene.objects)}
    stated: dict[int, int] = {}
    tree: dict[int, int] = {}
    is_component = classes.are_in("components")
    for part, whole in _iter_jointed(scene, number, is_component):
        if is_whole[whole]:
            stated.setdefault(part, whole)
    for part, obj in enumerate(scene.objects):
        above = number.get(obj.parent_path) if obj.parent_path is not None else None
        if above is None or part in stated or not is_whole[above] or stated.get(above) == part:
            continue
        if obj.kind == _PART_KIND:
            stated[part] = above
        elif is_component[part]:
            tree[part] = above
    is_free = np.ones(len(scene.objects), np.bool_)
    is_free[[*stated, *tree]] = False
    roles = find_roles(boxed, classes, nouns)
    fitted = find_fitted(boxed, roles, is_free[boxed.scene_index], rule)
    return PartLinks(_links(rule.stated_rule, stated), _links(rule.tree_rule, tree), fitted)


def wholes_of(boxed: BoxedObjects, parts: PartLinks) -> Indices:
    """Return the index of the whole of each object, -1 for none."""
    wholes = np.full(len(boxed), -1)
    for links in parts:
        part, whole = boxed_ends(boxed, links)
        known = (part >= 0) & (whole >= 0)
        wholes[part[known]] = whole[known]
    return wholes


def boxed_ends(boxed: BoxedObjects, links: Links) -> tuple[Indices, Indices]:
    """Return targets and anchors as indices among the boxed objects, -1 without a box."""
    place = np.full(int(boxed.scene_index.max(initial=-1)) + 2, -1)
    place[boxed.scene_index] = np.arange(len(boxed))
    return place[np.minimum(links.target, len(place) - 1)], place[np.minimum(links.anchor, len(place) - 1)]


def _links(rule: str, found: dict[int, int]) -> Links:
    part = np.array(sorted(found), np.int64)
    whole = np.array([found[index] for index in part.tolist()], np.int64)
    return Links("part-of", rule, part, whole, {}, None)


def _iter_jointed(scene: Scene, number: dict[str, int], is_component: Mask) -> Iterator[tuple[int, int]]:
    """Yield (part, whole) for each movable joint between two objects."""
    fixed = {number_of for joint in scene.joints if (number_of := _fixed_to_world(joint, number)) is not None}
    for joint in scene.joints:
        ends = _joint_ends(joint, number)
        if ends is None:
            continue
        hung, moved = ends
        hung_path, moved_path = scene.objects[hung].prim_path, scene.objects[moved].prim_path
        # Some exporters swap the two bodies.
        if (hung in fixed) != (moved in fixed):
            is_reversed = moved in fixed
        else:
            is_reversed = hung_path.startswith(moved_path + "/") or (
                not moved_path.startswith(hung_path + "/") and is_component[hung] and not is_component[moved]
            )
        yield (hung, moved) if is_reversed else (moved, hung)


def _fixed_to_world(joint: Joint, number: dict[str, int]) -> int | None:
    """Return the index of the object that a joint fixes to the world; None if it fixes none."""
    if joint.type != "fixed" or (joint.body0 is None) == (joint.body1 is None):
        return None
    return _object_at(joint.body0 or joint.body1 or "", number)


def _joint_ends(joint: Joint, number: dict[str, int]) -> tuple[int, int] | None:
    if joint.type not in _MOVING or joint.body0 is None or joint.body1 is None:
        return None
    hung, moved = _object_at(joint.body0, number), _object_at(joint.body1, number)
    return None if hung is None or moved is None or hung == moved else (hung, moved)


def _object_at(path: str, number: dict[str, int]) -> int | None:
    """Return the index of the object at or above a prim."""
    found = nearest_in(path, number)
    return None if found is None else number[found]
