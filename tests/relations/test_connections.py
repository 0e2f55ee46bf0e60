"""connects: doors and windows, and the rooms on their two sides."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.graph.records import thing
from tests.relations.room_builder import RULES, Placed, artifact, relate
from tests.relations.test_derived_rooms import BED, FLAT, SOFA, door, shell, wall
from usd2kg.relations import Relation
from usd2kg.relations.connections import OUTSIDE, locate_in_boxes

LEAF = door("leaf", (5.02, 3.1, 0), (0.06, 0.9, 2.1))


def connected(*placed: Placed) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for r in links(*placed):
        found.setdefault(r.target.lstrip("/"), []).append(r.anchor.lstrip("/"))
    return found


def links(*placed: Placed) -> tuple[Relation, ...]:
    return relate(*placed, kinds=("connects",))


def test_a_door_connects_the_rooms_on_its_sides():
    assert connected(*FLAT, LEAF) == {"leaf": ["room 1", "room 2"]}


def test_its_numbers():
    for relation in links(*FLAT, LEAF):
        assert relation.rule == RULES.connects.rule
        assert relation.numbers == {"insideRatio": 1.0}
        assert relation.confidence == 1.0
        assert relation.room is not None and relation.room.name == relation.anchor


def test_a_door_outdoors_connects_one_room():
    entrance = door("entrance", (1, -0.08, 0), (0.9, 0.06, 2.1))
    assert connected(*FLAT, entrance) == {"entrance": ["room 1"]}


def test_a_door_that_stands_open_connects_nothing():
    leaf = door("leaf", (5.1, 3.05, 0), (0.9, 0.06, 2.1))
    assert connected(*FLAT, leaf) == {}


def test_a_cupboard_door_connects_nothing():
    wardrobe = (thing("/wardrobe", (0, 0.5, 0), (0.6, 1, 2)), "Cupboard")
    front = (thing("/wardrobe/front", (0.6, 0.5, 0), (0.02, 1, 2)), "Door")
    assert connected(*FLAT, wardrobe, front, SOFA, BED) == {}


def test_doors_of_rooms_that_are_prims():
    kitchen = (thing("/kitchen", (0, 0, 0), (4, 3, 2.5)), "Kitchen")
    hall = (thing("/hall", (4.1, 0, 0), (2, 3, 2.5)), "Room")
    partition = wall("partition", (4, 0), (4.1, 2))
    leaf = door("leaf", (4.02, 2, 0), (0.06, 0.9, 2.1))
    assert connected(kitchen, hall, partition, leaf) == {"leaf": ["kitchen", "hall"]}
    # Without a wall beside it, a door may be a cupboard's.
    assert connected(kitchen, hall, leaf) == {}


def test_groups_are_connected():
    walls = [wall("kitchen/south", (0, 0), (4, 0.1)), wall("hall/south", (4.1, 0), (6, 0.1))]
    walls += [wall("kitchen/north", (0, 3), (4, 3.1)), wall("hall/north", (4.1, 3), (6, 3.1))]
    walls += [wall("kitchen/east", (3.9, 0.1), (4.0, 2))]
    leaf = door("leaf", (4.0, 2, 0), (0.06, 0.9, 2.1))
    assert connected(*walls, leaf) == {"leaf": ["hall", "kitchen"]}


@pytest.mark.parametrize("height", [1.4, 2.1])
def test_low_doors_belong_to_cupboards(height: float):
    hatch = door("hatch", (1, -0.08, 0), (0.9, 0.06, height))
    assert bool(connected(*shell(), hatch)) == (height > RULES.room_plan.min_door_height)


def test_furniture_connects_nothing():
    assert connected(*FLAT, artifact("shelf", (5.02, 3.1, 0), (0.06, 0.9, 2.1))) == {}


@given(st.integers(0, 2**32 - 1), st.integers(1, 60))
def test_points_are_in_the_smallest_box_around_them(seed: int, boxes: int):
    chance = np.random.default_rng(seed)
    lower = chance.uniform(0, 10, (boxes, 3))
    upper = lower + chance.uniform(0.5, 8, (boxes, 3))
    points = chance.uniform(-1, 19, (200, 3))
    found = locate_in_boxes(np.arange(boxes) + 100, lower, upper)(points)
    for point, number in zip(points, found.tolist(), strict=True):
        around = np.flatnonzero(((point >= lower) & (point <= upper)).all(axis=1))
        expected = min(around, key=lambda box: (upper - lower)[box].prod()) + 100 if len(around) else OUTSIDE
        assert number == expected
