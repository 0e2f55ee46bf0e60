"""room: the room that an object is in."""

import pytest

from tests.graph.records import box_at, related, thing
from tests.relations.room_builder import RULES, artifact, cup, relate

KITCHEN = (thing("/kitchen", (0, 0, 0), (4, 3, 2.5)), "Kitchen")
HALL = (thing("/hall", (4, 0, 0), (6, 3, 2.5)), "Room")


def rooms(*placed, **options):
    return related(relate(*placed, kinds=("room",), **options))


def test_objects_are_in_one_of_two_rooms():
    found = rooms(KITCHEN, HALL, cup((1, 1, 0.7)), artifact("coat", (5, 1, 1), (0.3, 0.1, 1)))
    assert found == {("cup", "room", "kitchen"), ("coat", "room", "hall")}


def test_its_numbers():
    # The cup's middle is 1.05 m from the wall at x = 0 and 0.15 m from that at y = 0; half of 0.3 m is half clear.
    (relation,) = relate(KITCHEN, cup((1, 0.1, 0.7)), kinds=("room",))
    assert relation.rule == RULES.room.rule
    assert relation.numbers == pytest.approx({"margin": 0.15})
    assert relation.confidence == pytest.approx(0.5)


def test_centre_determines_the_room():
    assert rooms(KITCHEN, HALL, artifact("rug", (3.4, 1, 0), (1, 1, 0.01))) == {("rug", "room", "kitchen")}
    assert rooms(KITCHEN, artifact("antenna", (1, 1, 2.4), (0.1, 0.1, 0.4))) == set()


def test_smallest_room_wins():
    flat = (thing("/flat", (0, 0, 0), (10, 3, 2.5)), "Room")
    assert rooms(flat, KITCHEN, cup((1, 1, 0.7))) == {("cup", "room", "kitchen")}
    assert rooms(flat, KITCHEN, cup((6, 1, 0.7))) == {("cup", "room", "flat")}


def test_contents_of_a_cupboard_are_in_its_room():
    cupboard = (thing("/cupboard", (0, 0, 1.4), (0.6, 0.4, 0.7)), "Cupboard")
    assert ("cup", "room", "kitchen") in rooms(KITCHEN, cupboard, cup((0.2, 0.1, 1.5)))


def test_a_rooms_box_includes_the_objects_below_it():
    # A prim for the room with a floor mesh of its own, walls nested below it.
    whole = box_at((0, 0, 0), (4, 3, 2.5))
    room = (thing("/room", (0, 0, 0), (4, 3, 0.01), box=whole), "Room")
    assert rooms(room, cup((1, 1, 0.7))) == {("cup", "room", "room")}


def test_floor_and_walls_are_not_in_the_room():
    floor = (thing("/floor", (0, 0, 0), (4, 3, 0.02)), "Floor")
    wall = (thing("/wall", (0, 0, 0), (4, 0.1, 2.5)), "Wall")
    assert rooms(KITCHEN, floor, wall) == set()


def test_flat_boxes_are_not_rooms():
    panel = (thing("/panel", (0, 0, 0), (4, 0.02, 2.5)), "Kitchen")
    low = (thing("/low", (0, 0, 0), (4, 3, 0.9)), "Kitchen")
    assert rooms(panel, low, cup((1, 0.001, 0.1), (0.01,) * 3)) == set()


class TestGroups:
    """Without room objects, groups named after a room count."""

    def test_groups_with_room_names_are_rooms(self):
        fridge = (thing("/Flat/kitchen_01/fridge", (0, 0, 0), (0.6, 0.6, 2)), "Refrigerator")
        table = (thing("/Flat/kitchen_01/props/table", (2, 2, 0), (1, 1, 0.7)), "Table")
        bed = (thing("/Flat/BedRoom/bed", (6, 0, 0), (2, 2, 0.5)), "DesignedFurniture")
        lamp = (thing("/Flat/BedRoom/lamp", (6, 2.5, 1.5), (0.3, 0.3, 0.3)), "Appliance")
        (relations) = relate(fridge, table, bed, lamp, kinds=("room",))
        assert {(r.target, r.anchor, r.rule) for r in relations} == {
            ("/Flat/kitchen_01/fridge", "/Flat/kitchen_01", RULES.room.group_rule),
            ("/Flat/kitchen_01/props/table", "/Flat/kitchen_01", RULES.room.group_rule),
            ("/Flat/BedRoom/bed", "/Flat/BedRoom", RULES.room.group_rule),
            ("/Flat/BedRoom/lamp", "/Flat/BedRoom", RULES.room.group_rule),
        }

    def test_position_decides_the_room_not_the_hierarchy(self):
        walls = [(thing(f"/Flat/kitchen/wall{i}", (0, 4 * i, 0), (4, 0.1, 2.5)), "Wall") for i in range(2)]
        robot = artifact("robot", (1, 1, 0), (0.5, 0.5, 1))
        assert rooms(*walls, robot) == {("robot", "room", "kitchen")}

    @pytest.mark.parametrize("name", ["KitchenCabinets", "diningArea", "props", "roomba", "kitchen_sink"])
    def test_groups_with_other_names_are_not_rooms(self, name: str):
        things = [(thing(f"/Flat/{name}/box{i}", (i, i, i), (1, 1, 1)), "Box") for i in range(3)]
        assert rooms(*things) == set()

    def test_small_groups_are_not_rooms(self):
        things = [(thing(f"/Flat/kitchen/box{i}", (0.1 * i, 0, 0), (0.1, 0.1, 0.1)), "Box") for i in range(3)]
        assert rooms(*things) == set()

    def test_groups_are_ignored_if_an_object_is_a_room(self):
        things = [(thing(f"/Flat/kitchen/box{i}", (i, i, i), (1, 1, 1)), "Box") for i in range(3)]
        assert rooms(*things[:2], KITCHEN) == {("box0", "room", "kitchen"), ("box1", "room", "kitchen")}
        assert {r.anchor for r in relate(*things, KITCHEN, kinds=("room",))} == {"/kitchen"}
