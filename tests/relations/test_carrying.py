"""What carries a thing comes before what is near it: hooks, pins, rails, stands and pots."""

import pytest

from tests.graph.records import thing
from tests.relations.room_builder import FLOOR, Placed, artifact, relate
from tests.relations.test_surfaces import WALLS, Room, flat
from tests.shapes.solids import boxes, open_box, surface_of

WALL: Placed = (thing("/wall", (-3, 3, 0), (6, 0.2, 2.5)), "Wall")
HOOK = artifact("hook", (0, 2.94, 1.6), (0.05, 0.06, 0.1))
"""On the wall."""


def held(*placed: Placed) -> set[tuple[str, str, str]]:
    found = relate(FLOOR, *placed, kinds=("on", "attached-to"))
    return {(r.target[1:], r.kind, r.anchor[1:]) for r in found}


class TestHooks:
    def test_a_coat_hangs_from_the_hook_that_goes_through_it(self):
        # It touches the wall as well.
        coat = artifact("coat", (-0.2, 2.9, 0.7), (0.5, 0.1, 0.94))
        assert held(WALL, HOOK, coat) == {("hook", "attached-to", "wall"), ("coat", "attached-to", "hook")}

    def test_what_meets_another_from_below_hangs_on_the_wall(self):
        upper = artifact("upper", (-0.2, 2.9, 1.5), (0.5, 0.1, 0.5))
        lower = artifact("lower", (-0.2, 2.9, 1.0), (0.5, 0.1, 0.5))
        assert held(WALL, upper, lower) == {("upper", "on", "lower"), ("lower", "attached-to", "wall")}

    def test_a_roll_hangs_on_its_pin_rather_than_on_the_wall_behind(self):
        pin = artifact("pin", (0, 2.9, 0.73), (0.15, 0.1, 0.04))
        roll = artifact("roll", (0.02, 2.87, 0.68), (0.1, 0.11, 0.11))
        assert held(WALL, pin, roll) == {("pin", "attached-to", "wall"), ("roll", "attached-to", "pin")}

    def test_a_hanger_hangs_from_the_rail_and_not_on_the_coat_that_it_carries(self):
        coat = boxes(((3.0, 2.0, 0.5), (3.1, 2.5, 1.4)))
        hanger = boxes(((3.02, 2.05, 1.38), (3.08, 2.45, 1.42)), ((3.04, 2.24, 1.42), (3.06, 2.26, 1.53)))
        rail = boxes(
            ((2, 2.23, 1.48), (4, 2.27, 1.52)), ((2, 2.2, 0), (2.05, 2.3, 1.5)), ((3.95, 2.2, 0), (4, 2.3, 1.5))
        )
        room = flat()
        for name, surface in (("coat", coat), ("hanger", hanger), ("rail", rail)):
            room.mesh(name, "DesignedArtifact", surface)
        assert room.of("hanger") == {("attached-to", "rail")}
        assert room.of("coat") == {("attached-to", "hanger")}

    def test_a_magnet_is_on_the_board_in_front_of_the_walls_of_a_flat(self):
        # All walls are one mesh, whose box is around the magnet.
        room = flat().mesh("board", "DesignedArtifact", boxes(((3, 4.78, 1.3), (3.8, 4.8, 1.9))))
        room.mesh("magnet", "DesignedArtifact", boxes(((3.4, 4.77, 1.7), (3.42, 4.782, 1.72))))
        assert room.of("magnet") == {("attached-to", "board")}
        assert room.of("board") == {("attached-to", "walls")}


class TestSupport:
    def test_a_basin_stands_on_a_narrower_stand_by_the_wall(self):
        stand = (thing("/stand", (0.1, 2.5, 0), (0.36, 0.4, 0.78)), "DesignedFurniture")
        basin = artifact("basin", (0, 2.42, 0.78), (0.6, 0.55, 0.2))
        assert ("basin", "on", "stand") in held(WALL, stand, basin)

    def test_a_book_on_a_wall_shelf_stays_there(self):
        shelf = artifact("shelf", (0, 2.8, 1.2), (0.8, 0.2, 0.02))
        book = artifact("book", (0.2, 2.8, 1.22), (0.1, 0.2, 0.25))
        assert held(WALL, shelf, book) == {("shelf", "attached-to", "wall"), ("book", "on", "shelf")}

    def test_a_sheet_that_an_object_pierces_does_not_carry_it(self):
        table = (thing("/table", (0, 0, 0), (1, 1, 0.745)), "DesignedFurniture")
        plate = artifact("plate", (0.2, 0.2, 0.741), (0.24, 0.24, 0.005))
        cloth = artifact("cloth", (0, 0, 0.747), (1, 1, 0.003))
        bun = artifact("bun", (0.26, 0.26, 0.743), (0.11, 0.11, 0.08))
        assert ("bun", "on", "plate") in held(table, plate, cloth, bun)

    def test_a_knife_beside_a_turned_cloth_is_on_the_table(self):
        # Of the cloth's box, the knife is in a corner that the cloth does not reach.
        corners = [(0.3, 0, 0.703), (0, 0.3, 0.703), (-0.3, 0, 0.703), (0, -0.3, 0.703)]
        cloth = surface_of(corners, [(0, 1, 2), (0, 2, 3)])
        room = Room().box("table", "Table", (-1, -1, 0), (2, 2, 0.7)).mesh("cloth", "DesignedArtifact", cloth)
        room.mesh("knife", "DesignedArtifact", boxes(((0.2, 0.2, 0.7), (0.24, 0.28, 0.703))))
        assert room.of("knife") == {("on", "table")}


class TestContainers:
    def test_a_lid_over_a_box_is_on_it(self):
        room = Room().mesh("box", "Box", open_box((0, 0, 0), (0.3, 0.38, 0.2), 0.004))
        room.mesh("lid", "DesignedArtifact", boxes(((-0.005, -0.005, 0.183), (0.305, 0.385, 0.203))))
        assert ("inside", "box") not in room.of("lid")

    def test_contents_hover_over_each_other_but_not_through_the_container(self):
        room = Room().mesh("box", "Box", open_box((0, 0, 0), (0.5, 0.5, 0.4), 0.01))
        room.mesh("bread", "DesignedArtifact", boxes(((0.1, 0.1, 0.01), (0.3, 0.3, 0.1))))
        room.mesh("milk", "DesignedArtifact", boxes(((0.12, 0.12, 0.13), (0.22, 0.22, 0.33))))
        assert room.of("milk") == {("inside", "box"), ("on", "bread")}
        assert room.of("bread") == {("inside", "box")}


@pytest.mark.parametrize(("pulled", "is_part"), [(0.0, True), (0.23, True), (0.25, False)])
def test_a_drawer_in_a_sibling_of_any_class_is_a_part_of_it(pulled: float, is_part: bool):
    frame = (thing("/frame", (0, 0, 0), (0.5, 0.4, 0.9)), "DesignedArtifact")
    drawer = (thing("/drawer", (0.02, -pulled, 0.2), (0.46, 0.4, 0.13)), "Drawer")
    found = {(r.target, r.anchor) for r in relate(frame, drawer, kinds=("part-of",))}
    assert found == ({("/drawer", "/frame")} if is_part else set())


def test_the_walls_of_a_flat_hold_no_drawer():
    drawer = (thing("/drawer", (1, 1, 0.2), (0.46, 0.4, 0.13)), "Drawer")
    assert Room(drawer).mesh("walls", "Wall", WALLS).of("drawer", ("part-of",)) == set()
