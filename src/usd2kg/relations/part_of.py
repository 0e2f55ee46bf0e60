"""`part-of`: parthood from joints, kinds, classes and fit. A group prim is not a whole."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.prim_paths import nearest_in
from usd2kg.relations.array_records import first_of_each_group, ratios, rounded
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.distances import box_gaps
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.thresholds import PartOfRule
from usd2kg.scene import Joint, Scene
from usd2kg.shapes import overlapping_pairs

__all__ = ["PartLinks", "boxed_ends", "find_parts", "wholes_of"]

Array = NDArray[np.float64]
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
    """A front or a handle fitted to a sibling."""


def find_parts(scene: Scene, boxed: BoxedObjects, classes: ClassMembership, rule: PartOfRule) -> PartLinks:
    """Return the `part-of` links; each object has at most one whole."""
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
    fitted = _fitted(scene, boxed, classes, is_free, rule)
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
    for joint in scene.joints:
        ends = _joint_ends(joint, number)
        if ends is None:
            continue
        hung, moved = ends
        hung_path, moved_path = scene.objects[hung].prim_path, scene.objects[moved].prim_path
        # Some exporters swap the two bodies.
        is_reversed = hung_path.startswith(moved_path + "/") or (
            not moved_path.startswith(hung_path + "/") and is_component[hung] and not is_component[moved]
        )
        yield (hung, moved) if is_reversed else (moved, hung)


def _joint_ends(joint: Joint, number: dict[str, int]) -> tuple[int, int] | None:
    if joint.type not in _MOVING or joint.body0 is None or joint.body1 is None:
        return None
    hung, moved = _object_at(joint.body0, number), _object_at(joint.body1, number)
    return None if hung is None or moved is None or hung == moved else (hung, moved)


def _object_at(path: str, number: dict[str, int]) -> int | None:
    """Return the index of the object at or above a prim."""
    found = nearest_in(path, number)
    return None if found is None else number[found]


def _fitted(scene: Scene, boxed: BoxedObjects, classes: ClassMembership, is_free: Mask, rule: PartOfRule) -> Links:
    is_drawer, is_handle = classes.are_drawers[boxed.scene_index], classes.are_handles[boxed.scene_index]
    is_case = classes.are_in("cases")[boxed.scene_index] & ~is_drawer
    is_front = (classes.are_in("fronts")[boxed.scene_index] & ~is_case) | is_drawer
    is_body = (classes.are_in("bodies") | classes.are_in("frames"))[boxed.scene_index] | is_case
    is_body &= ~is_front & ~is_handle
    never = classes.are_in("not_wholes") | classes.are_in("not_neighbours")
    may_hold_drawers = ~(never[boxed.scene_index] | is_front | is_handle)
    is_component = classes.are_in("components")[boxed.scene_index] & ~(is_front | is_handle | is_body)
    parts = np.flatnonzero((is_front | is_handle | is_component) & is_free[boxed.scene_index])
    above = [obj.prim_path.rpartition("/")[0] for obj in boxed.objects]
    group = {path: index for index, path in enumerate(dict.fromkeys(above))}
    family = np.array([group[path] for path in above], np.int64)
    may_hold_drawers &= np.isin(family, family[parts[is_drawer[parts]]])
    wholes = np.flatnonzero(is_body | is_front | may_hold_drawers | is_component)
    lower, upper = boxed.lower[parts] - rule.max_gap, boxed.upper[parts] + rule.max_gap
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64))]
    for i, j in overlapping_pairs(lower, upper, (boxed.lower[wholes], boxed.upper[wholes])):
        part, whole = parts[i], wholes[j]
        is_in = is_drawer[part] & may_hold_drawers[whole] & (_share_within(boxed, part, whole) >= rule.min_slid_in)
        is_good = (part != whole) & (family[part] == family[whole])
        is_fitted = (is_front | is_handle)[part] & is_body[whole]
        is_fitted |= is_handle[part] & is_front[whole]
        is_good &= is_fitted | is_in | (is_component[part] & _are_covers(boxed, part, whole, rule))
        is_good &= boxed.upright_volume[part] < boxed.upright_volume[whole]
        part, whole = part[is_good], whole[is_good]
        is_met = (box_gaps(boxed, part, whole) <= rule.max_gap).all(axis=1)
        found.append((part[is_met], whole[is_met]))
    part, whole = (np.concatenate(column) for column in zip(*found, strict=True))
    return _best_fit(boxed, part, whole, is_front, is_body, rule)


def _share_within(boxed: BoxedObjects, part: Indices, whole: Indices) -> Array:
    shared = np.clip(-box_gaps(boxed, part, whole), 0, None).prod(axis=1)
    return ratios(shared, boxed.volume[part])


def _are_covers(boxed: BoxedObjects, part: Indices, whole: Indices, rule: PartOfRule) -> Mask:
    """Return for each pair whether the part is a sheet that covers an upright face of the whole: a door by its form."""
    gaps = box_gaps(boxed, part, whole)
    shared = ratios(-gaps, np.maximum(boxed.size[part], boxed.size[whole]))
    found = np.zeros(len(part), np.bool_)
    for axis, across in ((0, 1), (1, 0)):
        is_before = np.abs(gaps[:, axis]) <= rule.max_gap
        is_thin = (boxed.size[part].argmin(axis=1) == axis) & (boxed.size[part, axis] < boxed.size[whole, axis])
        found |= is_before & is_thin & (shared[:, [across, 2]] >= rule.min_covered).all(axis=1)
    return found


def _best_fit(
    boxed: BoxedObjects, part: Indices, whole: Indices, is_front: Mask, is_body: Mask, rule: PartOfRule
) -> Links:
    """Return the best-fitting whole of each part; fronts take precedence for handles, bodies by class for drawers."""
    gaps = box_gaps(boxed, part, whole)
    met = np.clip((rule.max_gap - gaps) / (boxed.size[part] + rule.max_gap), 0, 1).prod(axis=1)
    best = first_of_each_group(part, (boxed.rank[whole], -rounded(met), ~is_body[whole], ~is_front[whole]))
    gap = np.clip(gaps[best].max(axis=1, initial=0), 0, None)
    links = Links(
        "part-of",
        rule.fitted_rule,
        part[best],
        whole[best],
        {"gap": gap},
        margin_score(margin_below(gap, rule.max_gap)),
    )
    return links._replace(target=boxed.scene_index[links.target], anchor=boxed.scene_index[links.anchor])
