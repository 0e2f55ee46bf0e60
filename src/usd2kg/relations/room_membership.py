"""`room`: the room that an object is in."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import first_of_each_group
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.model import Links, margin_above, margin_score
from usd2kg.relations.thresholds import RoomRule
from usd2kg.scene import Box, SceneObject
from usd2kg.shapes import overlapping_pairs
from usd2kg.words import words_of

__all__ = ["RoomBoxes", "RoomLinks", "find_rooms", "placed_in_rooms"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


class RoomBoxes(NamedTuple):
    """The boxes of rooms."""

    number: Indices
    """Index of the object; beyond the last object, of the group."""
    lower: Array
    """(n, 3), metres, world frame."""
    upper: Array


class RoomLinks(NamedTuple):
    """The `room` links, and the group prims that are rooms."""

    links: Links
    """Anchors beyond the last object are indices into `groups`."""
    groups: list[str]
    """Paths of the group prims that are rooms."""
    boxes: RoomBoxes
    """The boxes of the rooms; none if no prim is a room."""


class _Room(NamedTuple):
    number: int
    lower: Array
    upper: Array


def find_rooms(
    objects: Sequence[SceneObject], boxed: BoxedObjects, classes: ClassMembership, rule: RoomRule
) -> RoomLinks:
    """Return the smallest room that contains the centre of each object.

    The box of a room includes the objects below it, since floor and walls are often objects of their own.
    """
    boxes = [objects[number].box for number in boxed.scene_index.tolist()]
    named = np.flatnonzero(classes.are_in("rooms")[boxed.scene_index]).tolist()
    rooms = [room for index in named if (room := _room(index, boxes[index], rule))]
    groups: list[str] = []
    if not rooms:
        grouped = _group_boxes(objects, rule)
        made = [_room(len(boxed) + place, box, rule) for place, box in enumerate(grouped.values())]
        rooms, groups = [room for room in made if room], list(grouped)
    rule_id = rule.group_rule if groups else rule.rule
    found = RoomBoxes(
        np.array([room.number for room in rooms], np.int64),
        np.array([room.lower for room in rooms]).reshape(-1, 3),
        np.array([room.upper for room in rooms]).reshape(-1, 3),
    )
    links = _members(boxed, found, placed_in_rooms(boxed, classes), rule)
    return RoomLinks(links._replace(rule=rule_id), groups, found)


def placed_in_rooms(boxed: BoxedObjects, classes: ClassMembership) -> Indices:
    """Return the objects that may be in a room: not what bounds one."""
    is_placed = ~classes.are_in("not_neighbours") | classes.are_in("handles")
    return np.flatnonzero(is_placed[boxed.scene_index])


def _room(number: int, box: Box | None, rule: RoomRule) -> _Room | None:
    if box is None or min(box.size[:2]) < rule.min_side or box.size[2] < rule.min_height:
        return None
    return _Room(number, np.array(box.lower), np.array(box.upper))


def _group_boxes(objects: Sequence[SceneObject], rule: RoomRule) -> dict[str, Box]:
    """Return path → box of all objects below, for each group prim whose name ends in a word for a room."""
    paths = {obj.prim_path for obj in objects}
    words = frozenset(rule.words)
    is_room: dict[str, bool] = {}
    below: dict[str, list[Box]] = {}
    for obj in objects:
        above = obj.prim_path.rpartition("/")[0]
        while above and obj.box is not None:
            if above not in is_room:
                named = words_of(above.rpartition("/")[2])
                is_room[above] = bool(named) and named[-1] in words and above not in paths
            if is_room[above]:
                below.setdefault(above, []).append(obj.box)
            above = above.rpartition("/")[0]
    return {path: _union(boxes) for path, boxes in sorted(below.items())}


def _union(boxes: list[Box]) -> Box:
    lower = np.array([box.lower for box in boxes]).min(axis=0).tolist()
    upper = np.array([box.upper for box in boxes]).max(axis=0).tolist()
    return Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))


def _members(boxed: BoxedObjects, rooms: RoomBoxes, placed: Indices, rule: RoomRule) -> Links:
    number, lower, upper = rooms
    volume = (upper - lower).prod(axis=1)
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))]
    at = boxed.middle[placed, :2]
    for i, j in overlapping_pairs(at, at, (lower[:, :2], upper[:, :2])):
        inner = np.minimum(boxed.middle[placed[i]] - lower[j], upper[j] - boxed.middle[placed[i]])
        is_in = (inner.min(axis=1) >= 0) & (placed[i] != number[j])
        found.append((placed[i[is_in]], j[is_in], inner[is_in, :2].min(axis=1)))
    target, room, margin = (np.concatenate(column) for column in zip(*found, strict=True))
    best = first_of_each_group(target, (number[room], volume[room]))
    clear = margin_score(margin_above(margin[best], 0.0, rule.clear_margin))
    return Links("room", rule.rule, target[best], number[room[best]], {"margin": margin[best]}, clear)
