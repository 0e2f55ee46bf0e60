"""Relations of hollow, L-shaped and many-levelled things in one mesh, worked by hand."""

import numpy as np
import pytest

from tests.graph.records import thing
from tests.relations.room_builder import FLOOR, RULES, Placed, artifact, relate
from tests.relations.test_part_of import joint
from tests.shapes.solids import Surface, boxes, open_box, surface_of, table, turned
from usd2kg.relations import Relation
from usd2kg.scene import Box

ALL = ("on", "inside", "attached-to", "touching", "next-to", "near")


class Room:
    """Objects with and without meshes."""

    def __init__(self, *placed: Placed) -> None:
        self.placed = list(placed)
        self.surfaces: dict[str, Surface] = {}

    def mesh(self, name: str, cls: str, surface: Surface, **known) -> "Room":
        low, high = surface.lower.min(axis=0), surface.upper.max(axis=0)
        self.placed.append((thing(f"/{name}", tuple(low.tolist()), tuple((high - low).tolist()), **known), cls))
        self.surfaces[f"/{name}"] = surface
        return self

    def box(self, name: str, cls: str, lower, size) -> "Room":
        self.placed.append((thing(f"/{name}", lower, size), cls))
        return self

    def relate(self, kinds=ALL) -> dict[tuple[str, str, str], Relation]:
        found = relate(*self.placed, kinds=kinds, surfaces=self.surfaces)
        return {(r.target[1:], r.kind, r.anchor[1:]): r for r in found}

    def of(self, name: str, kinds=("on", "inside", "attached-to")) -> set[tuple[str, str]]:
        return {(kind, anchor) for target, kind, anchor in self.relate(kinds) if target == name}


WALLS = boxes(
    ((0, 0, 0), (8, 0.2, 2.5)), ((0, 4.8, 0), (8, 5, 2.5)), ((0, 0, 0), (0.2, 5, 2.5)), ((7.8, 0, 0), (8, 5, 2.5))
)


def flat() -> Room:
    return Room().box("floor", "Floor", (0, 0, -0.1), (8, 5, 0.1)).mesh("walls", "Wall", WALLS)


class TestWallsAroundAFlat:
    def test_they_are_not_near_and_contain_nothing(self):
        room = flat().mesh("table", "Table", table((3, 2, 0), (4.5, 3, 0.7)))
        assert room.of("table", ALL) == {("on", "floor")}

    def test_a_picture_hangs_on_the_inner_face(self):
        picture = ((3, 4.77, 1.4), (3.6, 4.79, 1.9))
        room = flat().mesh("picture", "DesignedArtifact", boxes(picture))
        relation = room.relate()["picture", "attached-to", "walls"]
        assert relation.rule == RULES.attached.rule
        assert relation.numbers["gap"] == pytest.approx(0.01)
        # 1 cm of the 6 cm that are tolerated.
        margin = 1 - 0.01 / 0.06
        assert relation.confidence == pytest.approx(margin**2 * (3 - 2 * margin))

    def test_a_socket_sunk_into_the_wall_has_a_negative_gap(self):
        room = flat().box("socket", "DesignedComponent", (2, 4.796, 0.3), (0.08, 0.01, 0.08))
        assert room.relate()["socket", "attached-to", "walls"].numbers["gap"] == pytest.approx(-0.004, abs=1e-6)

    def test_what_stands_by_the_wall_is_on_the_floor(self):
        room = flat().mesh("box", "DesignedArtifact", boxes(((1, 4.3, 0), (2, 4.79, 1))))
        assert room.of("box") == {("on", "floor")}

    def test_a_wall_cupboard_hangs_and_a_cupboard_on_a_plinth_stands(self):
        room = Room().mesh("walls", "Wall", WALLS)
        room.box("high", "KitchenCabinet", (1, 4.4, 1.4), (0.6, 0.38, 0.7))
        room.box("low", "KitchenCabinet", (2, 4.2, 0.1), (0.6, 0.58, 0.8))
        assert room.of("high") == {("attached-to", "walls")}
        # No floor is drawn.
        assert room.of("low") == set()

    def test_a_thing_in_mid_air_is_attached_to_nothing(self):
        assert flat().box("ball", "DesignedArtifact", (4, 2.5, 1), (0.2, 0.2, 0.2)).of("ball") == set()


class TestHanging:
    def test_a_pendant_lamp_hangs_from_the_ceiling(self):
        lamp = boxes(((2.99, 2.99, 1.8), (3.01, 3.01, 2.5)), ((2.8, 2.8, 1.6), (3.2, 3.2, 1.8)))
        room = flat().box("ceiling", "Ceiling", (0, 0, 2.5), (8, 5, 0.1)).mesh("lamp", "Appliance", lamp)
        assert room.of("lamp") == {("attached-to", "ceiling")}

    def test_a_curtain_hangs_from_its_rod_and_the_rod_on_the_wall(self):
        room = flat().box("rod", "DesignedComponent", (3, 4.7, 2.2), (2, 0.1, 0.04))
        room.box("curtain", "DesignedFurniture", (3.2, 4.72, 0.2), (0.8, 0.04, 1.995))
        assert room.of("rod") == {("attached-to", "walls")}
        # The wall behind it is within reach as well.
        assert room.of("curtain") == {("attached-to", "rod")}

    @staticmethod
    def by_a_wall(lower, size) -> set[tuple[str, str]]:
        room = Room(FLOOR).box("wall", "Wall", (0, 4.8, 0), (3, 0.2, 2.5))
        return room.box("piece", "Wall", lower, size).of("piece")

    def test_a_panel_hangs_on_a_wall_though_its_class_is_that_of_a_wall(self):
        assert self.by_a_wall((1, 4.7, 1), (1, 0.08, 0.6)) == {("attached-to", "wall")}

    @pytest.mark.parametrize(
        ("lower", "size"), [((1, 3.8, 1), (0.1, 1, 1)), ((3, 4.8, 2), (1, 0.2, 0.5))], ids=["partition", "lintel"]
    )
    def test_walls_that_meet_at_an_edge_do_not_hold_each_other(self, lower, size):
        # Both are off the ground.
        assert self.by_a_wall(lower, size) == set()

    def test_things_that_hang_from_each_other_only_are_attached_to_nothing(self):
        room = Room(FLOOR, artifact("one", (0, 0, 1), (0.2, 0.2, 0.2)), artifact("two", (0, 0, 1.2), (0.2, 0.2, 0.01)))
        assert room.of("one") == set()


class TestBesideWallCupboards:
    """Two cupboards of 0.6 m × 0.38 m × 0.7 m in a row, over the floor."""

    @staticmethod
    def row(*, has_wall: bool) -> Room:
        room = flat() if has_wall else Room(FLOOR)
        room.box("left", "KitchenCabinet", (1, 4.4, 1.4), (0.6, 0.38, 0.7))
        return room.box("right", "KitchenCabinet", (1.6, 4.4, 1.4), (0.7, 0.38, 0.7))

    def test_the_wall_holds_both(self):
        assert self.row(has_wall=True).of("left") == self.row(has_wall=True).of("right") == {("attached-to", "walls")}

    def test_without_a_wall_neither_holds_the_other(self):
        assert self.row(has_wall=False).of("left") == self.row(has_wall=False).of("right") == set()

    def test_a_much_smaller_thing_at_their_side_is_held(self):
        room = self.row(has_wall=False).box("clock", "DesignedArtifact", (0.97, 4.5, 1.7), (0.03, 0.2, 0.2))
        assert room.of("clock") == {("attached-to", "left")}

    def test_a_thing_of_half_the_size_is_not(self):
        room = self.row(has_wall=False).box("rack", "DesignedArtifact", (0.7, 4.4, 1.4), (0.3, 0.38, 0.7))
        assert room.of("rack") == set()

    @pytest.mark.parametrize(("height", "expected"), [(1.7, set()), (1.8, {("attached-to", "fridge")})])
    def test_what_stands_beside_holds_them_if_it_reaches_their_middle(self, height: float, expected: set):
        # The middle is at 1.75 m.
        room = Room(FLOOR).box("cupboard", "KitchenCabinet", (1, 0, 1.4), (0.6, 0.38, 0.7))
        room.box("fridge", "Refrigerator", (1.6, 0, 0), (0.7, 0.7, height))
        assert room.of("cupboard") == expected


class TestOverWallMountedThings:
    """A hood or a shelf on the wall, at a height of 1.5 m."""

    @staticmethod
    def over_hood(start: float, y: float = 4.4) -> set[tuple[str, str]]:
        """Return where a cupboard that is 0.5 m wide belongs, over a hood from x = 2 to 3."""
        room = flat().box("hood", "DesignedArtifact", (2, 4.3, 1.5), (1, 0.5, 0.2))
        return room.box("cupboard", "KitchenCabinet", (start, y, 1.7), (0.5, 0.38, 0.7)).of("cupboard")

    def test_what_overhangs_and_reaches_the_wall_hangs_there(self):
        assert self.over_hood(1.75) == {("attached-to", "walls")}

    def test_what_has_all_its_feet_on_it_lies_there(self):
        assert self.over_hood(2.2) == {("on", "hood")}

    def test_what_does_not_reach_the_wall_lies_there(self):
        # 10 cm off the wall.
        assert self.over_hood(1.75, 4.32) == {("on", "hood")}

    def test_what_overhangs_a_thing_that_stands_is_on_it(self):
        room = flat().box("block", "DesignedArtifact", (2, 4.3, 0), (1, 0.5, 1.7))
        assert room.box("cupboard", "KitchenCabinet", (1.75, 4.4, 1.7), (0.5, 0.38, 0.7)).of("cupboard") == {
            ("on", "block")
        }

    def test_it_no_longer_counts_as_support(self):
        room = flat().box("hood", "DesignedArtifact", (2, 4.3, 1.5), (1, 0.5, 0.2))
        room.box("cupboard", "KitchenCabinet", (1.75, 4.4, 1.7), (0.5, 0.38, 0.7))
        assert ("cupboard", "touching", "hood") in room.relate() or ("hood", "touching", "cupboard") in room.relate()


def shelf(*, has_back: bool) -> Room:
    boards = [((0, 0, z), (1, 0.3, z + 0.02)) for z in (0.1, 0.5, 0.9)]
    sides = [((0, 0, 0), (0.02, 0.3, 0.92)), ((0.98, 0, 0), (1, 0.3, 0.92))]
    back = [((0, 0.29, 0), (1, 0.3, 0.92))] if has_back else []
    room = Room(FLOOR).mesh("shelf", "DesignedFurniture", boxes(*boards, *sides, *back))
    for name, z in (("low", 0.12), ("middle", 0.52), ("top", 0.92)):
        room.mesh(name, "DesignedArtifact", boxes(((0.4, 0.05, z), (0.45, 0.25, z + 0.25))))
    return room


class TestShelfInOneMesh:
    @pytest.mark.parametrize("name", ["low", "middle", "top"])
    def test_each_board_carries_what_stands_on_it(self, name: str):
        relation = shelf(has_back=False).relate()[name, "on", "shelf"]
        assert (relation.rule, relation.numbers) == (RULES.on.rule, {"gap": pytest.approx(0), "overlapRatio": 1})

    def test_compartments_with_a_back_contain(self):
        found = shelf(has_back=True).relate()
        assert found["low", "inside", "shelf"].rule == RULES.inside.surrounded_rule
        assert {("middle", "inside", "shelf"), ("top", "on", "shelf")} <= found.keys()


BOX = ((0, 0, 0), (0.6, 0.4, 0.4))
BALL = ((0.25, 0.15, 0.011), (0.35, 0.25, 0.111))


def machine_with_part(part: Surface) -> set[tuple[str, str, str]]:
    """Return the relations of a part that slides in a case with an open front."""
    case = boxes(
        ((0, 0, 0), (0.6, 0.6, 0.02)),
        ((0, 0, 0.58), (0.6, 0.6, 0.6)),
        ((0, 0, 0), (0.02, 0.6, 0.6)),
        ((0.58, 0, 0), (0.6, 0.6, 0.6)),
        ((0, 0.58, 0), (0.6, 0.6, 0.6)),
    )
    room = Room(FLOOR).mesh("case", "DesignedArtifact", case).mesh("part", "DesignedArtifact", part)
    rail = [joint("/case", "/part", "prismatic")]
    found = relate(*room.placed, kinds=("on", "inside", "part-of"), joints=rail, surfaces=room.surfaces)
    return {(r.target[1:], r.kind, r.anchor[1:]) for r in found if r.target == "/part"}


class TestPartsInCavities:
    def test_a_basket_is_in_its_machine(self):
        basket = open_box((0.05, 0.05, 0.2), (0.55, 0.55, 0.3))
        assert machine_with_part(basket) == {("part", "part-of", "case"), ("part", "inside", "case")}

    def test_one_that_is_pulled_out_is_not(self):
        basket = open_box((0.05, -0.4, 0.2), (0.55, 0.1, 0.3))
        assert machine_with_part(basket) == {("part", "part-of", "case")}

    def test_a_front_is_not(self):
        assert machine_with_part(boxes(((0, 0, 0), (0.6, 0.015, 0.6)))) == {("part", "part-of", "case")}


class TestContainers:
    @pytest.mark.parametrize(("has_back", "kind"), [(True, "inside"), (False, "on")])
    def test_a_rack_contains_only_with_sides_and_a_back(self, has_back: bool, kind: str):
        # Four posts stop no rays; a back and two sides are three sides of four.
        boards = [((0, 0, z), (1, 0.3, z + 0.02)) for z in (0.1, 0.5, 0.9)]
        sides = [((0, 0, 0), (0.02, 0.3, 1)), ((0.98, 0, 0), (1, 0.3, 1)), ((0, 0.29, 0), (1, 0.3, 1))]
        room = Room(FLOOR).mesh("rack", "Rack", boxes(*boards, *(sides if has_back else [])))
        room.mesh("crate", "DesignedArtifact", boxes(((0.3, 0.05, 0.52), (0.6, 0.25, 0.75))))
        assert room.of("crate") == {(kind, "rack")}

    def test_an_open_box_contains(self):
        room = Room(FLOOR).mesh("box", "Box", open_box(*BOX)).mesh("ball", "DesignedArtifact", boxes(BALL))
        assert room.of("ball") == {("inside", "box")}

    @pytest.mark.parametrize(("height", "kind"), [(0.4, "inside"), (0.08, "on")])
    def test_a_thing_of_any_class_contains_in_a_deep_cavity(self, height: float, kind: str):
        tray = open_box((0, 0, 0), (0.6, 0.4, height))
        room = Room(FLOOR).mesh("thing", "DesignedArtifact", tray)
        room.mesh("ball", "DesignedArtifact", boxes(((0.25, 0.15, 0.01), (0.35, 0.25, 0.07))))
        assert room.of("ball") == {(kind, "thing")}

    def test_a_sofa_with_arms_does_not_contain(self):
        arms = [((x, 0, 0), (x + 0.2, 0.9, 0.7)) for x in (0, 1.8)]
        sofa = boxes(((0, 0, 0), (2, 0.9, 0.4)), ((0, 0.8, 0), (2, 0.9, 0.9)), *arms)
        room = Room(FLOOR).mesh("sofa", "DesignedArtifact", sofa)
        room.mesh("cushion", "DesignedArtifact", boxes(((0.8, 0.3, 0.4), (1.2, 0.7, 0.55))))
        assert room.of("cushion") == {("on", "sofa")}

    def test_a_solid_one_does_not(self):
        solid = boxes(((0, 0, 0), (0.6, 0.4, 0.3)), ((0, 0, 0.3), (0.3, 0.4, 0.4)))
        room = Room(FLOOR).mesh("box", "Box", solid).mesh("ball", "DesignedArtifact", boxes(BALL))
        assert ("inside", "box") not in room.of("ball")

    def test_a_closed_container_may_be_drawn_solid(self):
        solid = boxes(((0, 0, 0), (0.6, 0.6, 1.5)), ((0, 0, 1.5), (0.5, 0.6, 1.6)))
        room = Room(FLOOR).mesh("fridge", "Refrigerator", solid).mesh("ball", "DesignedArtifact", boxes(BALL))
        assert room.of("ball") == {("inside", "fridge")}

    def test_the_free_corner_of_an_l_shaped_one_does_not_contain(self):
        corner = boxes(((0, 0, 0), (2, 0.6, 0.8)), ((0, 0.6, 0), (0.6, 2, 0.8)))
        room = Room(FLOOR).mesh("unit", "KitchenCabinet", corner)
        room.box("bin", "TrashContainer", (1.2, 1.2, 0), (0.3, 0.3, 0.5))
        assert room.of("bin") == {("on", "floor")}

    # A jar is closed by its class, but this one has no lid; the last is no container by its class.
    @pytest.mark.parametrize("cls", ["Pot", "Jar", "DesignedArtifact"])
    def test_a_tall_thing_in_a_pot_stands_in_it(self, cls: str):
        pot = turned((0, 0), (0.15, 0), (0.15, 0.3), (0.14, 0.3), (0.14, 0.01), (0, 0.01))
        room = Room(FLOOR).mesh("pot", cls, pot)
        room.mesh("stick", "DesignedArtifact", boxes(((0.05, 0.0, 0.01), (0.07, 0.02, 1.2))))
        assert room.of("stick") == {("inside", "pot")}

    def test_a_tall_thing_on_a_stand_is_on_it(self):
        stand = boxes(((0, 0, 0), (0.3, 0.3, 0.02)), ((0, 0, 0.02), (0.3, 0.02, 0.3)))
        room = Room(FLOOR).mesh("stand", "DesignedArtifact", stand)
        room.mesh("stick", "DesignedArtifact", boxes(((0.1, 0.1, 0.02), (0.12, 0.12, 0.9))))
        assert room.of("stick") == {("on", "stand")}

    def test_what_lies_on_the_contents_of_a_case_is_in_it(self):
        case = open_box((0, 0, 0), (0.7, 0.45, 0.14))
        room = Room(FLOOR).mesh("case", "DesignedArtifact", case)
        room.box("shirt", "DesignedArtifact", (0.2, 0.1, 0.01), (0.3, 0.25, 0.03))
        room.box("shirt2", "DesignedArtifact", (0.2, 0.1, 0.04), (0.3, 0.25, 0.03))
        assert room.of("shirt2") == {("inside", "case"), ("on", "shirt")}

    def test_a_dome_contains_what_stands_below_it(self):
        dome = turned((0.2, 0), (0.2, 0.3), (0, 0.35), (0, 0.34), (0.19, 0.29), (0.19, 0), at=(0.5, 0.5, 0.7))
        room = Room(FLOOR).mesh("table", "Table", table((0, 0, 0), (1, 1, 0.7)))
        room.mesh("dome", "Lid", dome).box("cake", "DesignedArtifact", (0.4, 0.4, 0.7), (0.2, 0.2, 0.1))
        assert room.of("cake") == {("inside", "dome"), ("on", "table")}

    def test_a_lid_in_the_opening_of_a_pot_is_not_in_it(self):
        pot = turned((0, 0), (0.1, 0), (0.1, 0.14), (0.12, 0.14), (0.12, 0.15), (0.09, 0.15), (0.09, 0.01), (0, 0.01))
        room = Room(FLOOR).mesh("pot", "Pot", pot)
        lid = turned((0, 0.12), (0.085, 0.12), (0.085, 0.15), (0.1, 0.15), (0.1, 0.16), (0.02, 0.17), (0, 0.18))
        room.mesh("lid", "Lid", lid)
        assert room.of("lid") == {("on", "pot")}

    def test_a_wire_rack_contains_what_its_wires_surround(self):
        wires = [((x, y, 0), (x + 0.004, y + 0.004, 0.12)) for x in (0, 0.15, 0.296) for y in (0, 0.15, 0.296)]
        rims = [((0, y, 0.11), (0.3, y + 0.004, 0.12)) for y in (0, 0.296)]
        room = Room(FLOOR).mesh("rack", "Rack", boxes(*wires, *rims))
        room.box("plate", "DesignedArtifact", (0.05, 0.05, 0.0), (0.02, 0.2, 0.11))
        assert room.of("plate") == {("inside", "rack")}

    def test_a_chair_below_a_table_is_neither_in_it_nor_at_it(self):
        room = Room(FLOOR).mesh("table", "Table", table((0, 0, 0), (2, 1.2, 0.75)))
        room.box("stool", "DesignedChair", (0.8, 0.4, 0), (0.4, 0.4, 0.45))
        found = room.relate()
        assert not [key for key in found if key[1] in {"inside", "touching"}]
        # The table top begins 27 cm above the stool.
        assert found["table", "near", "stool"].numbers["distance"] == pytest.approx(0.27)


class TestContacts:
    def test_penetration_is_a_negative_gap(self):
        room = Room(FLOOR).mesh("table", "Table", table((0, 0, 0), (1, 1, 0.7)))
        room.mesh("cup", "Cup", turned((0, 0.69), (0.04, 0.69), (0.04, 0.8), (0, 0.8), at=(0.5, 0.5, 0)))
        assert room.relate()["cup", "on", "table"].numbers["gap"] == pytest.approx(-0.01)

    def test_a_table_below_the_floor_stands_on_it(self):
        room = Room(FLOOR).mesh("table", "Table", table((0, 0, -0.18), (2, 1, 0.8)))
        relation = room.relate()["table", "on", "floor"]
        assert (relation.numbers["gap"], relation.confidence) == (pytest.approx(-0.18), pytest.approx(0.69, abs=0.02))

    def test_chains_of_stacked_meshes(self):
        room = Room(FLOOR).mesh("table", "Table", table((0, 0, 0), (1, 1, 0.7)))
        tray = open_box((0.2, 0.2, 0.7), (0.7, 0.6, 0.74))
        room.mesh("tray", "DesignedArtifact", tray)
        plate = [(0, 0), (0.06, 0), (0.1, 0.02), (0.06, 0.006), (0, 0.006)]
        for number in range(3):
            lifted = [(r, z + 0.71 + 0.007 * number) for r, z in plate]
            room.mesh(f"plate{number}", "DinnerPlate", turned(*lifted, at=(0.45, 0.4, 0)))
        found = {key for key in room.relate(("on",)) if key[1] == "on"}
        assert found == {
            ("table", "on", "floor"),
            ("tray", "on", "table"),
            ("plate0", "on", "tray"),
            ("plate1", "on", "plate0"),
            ("plate2", "on", "plate1"),
        }

    def test_what_stands_in_a_tray_that_is_pressed_into_a_cloth_is_on_the_tray(self):
        room = Room(FLOOR).mesh("table", "Table", table((0, 0, 0), (1, 1, 0.7)))
        # It hangs down on one side, and the tray is a sheet without an underside.
        cloth = boxes(((-0.1, -0.1, 0.7), (1.1, 1.1, 0.705)), ((-0.105, -0.1, 0.5), (-0.1, 1.1, 0.705)))
        room.mesh("cloth", "DesignedArtifact", cloth)
        corners = [(0.2, 0.2, 0.706), (0.7, 0.2, 0.706), (0.7, 0.6, 0.706), (0.2, 0.6, 0.706)]
        room.mesh("tray", "DesignedArtifact", surface_of(corners, [(0, 1, 2), (0, 2, 3)]))
        room.mesh("glass", "Glass", turned((0, 0.708), (0.03, 0.708), (0.03, 0.8), (0, 0.8), at=(0.45, 0.4, 0)))
        assert room.of("glass") == {("on", "tray")}

    def test_a_worktop_is_on_the_cabinets_and_not_on_their_doors(self):
        room = Room(FLOOR)
        for at in range(2):
            room.box(f"base{at}/cabinet", "KitchenCabinet", (0.6 * at, 0, 0), (0.6, 0.56, 0.8))
            room.box(f"base{at}/door", "KitchenCabinet", (0.6 * at, -0.02, 0.1), (0.6, 0.02, 0.7))
        room.box("worktop", "Countertop", (0, -0.02, 0.8), (1.2, 0.58, 0.04))
        assert room.of("base0/door", ("part-of",)) == {("part-of", "base0/cabinet")}
        assert room.of("worktop", ("on", "part-of")) == {("on", "base0/cabinet"), ("on", "base1/cabinet")}

    def test_what_is_heaped_above_a_rim_is_on_the_contents(self):
        room = Room(FLOOR).mesh("bowl", "Bowl", open_box((0, 0, 0), (0.3, 0.3, 0.1)))
        room.box("melon", "DesignedArtifact", (0.05, 0.05, 0.01), (0.2, 0.2, 0.15))
        room.box("book", "DesignedArtifact", (0.05, 0.05, 0.16), (0.2, 0.2, 0.02))
        assert room.of("melon") == {("inside", "bowl")}
        assert room.of("book") == {("on", "melon")}

    def test_contents_that_several_support_a_little_are_on_the_one_that_supports_most(self):
        room = Room(FLOOR).mesh("basket", "Box", open_box((0, 0, 0), (0.5, 0.5, 0.3)))
        for at, (x, width) in enumerate(((0.1, 0.1), (0.25, 0.12))):
            room.box(f"roll{at}", "DesignedArtifact", (x, 0.1, 0.01), (width, 0.2, 0.08))
        # Half of each is below it.
        room.box("roll", "DesignedArtifact", (0.1, 0.2, 0.09), (0.27, 0.2, 0.08))
        assert room.of("roll") == {("inside", "basket"), ("on", "roll1")}

    def test_a_lid_lies_on_the_rim_of_a_pot(self):
        pot = turned((0, 0), (0.15, 0), (0.15, 0.2), (0.14, 0.2), (0.14, 0.01), (0, 0.01))
        room = Room(FLOOR).mesh("pot", "Pot", pot).box("lid", "Lid", (-0.16, -0.16, 0.2), (0.32, 0.32, 0.01))
        assert room.of("lid") == {("on", "pot")}

    def test_a_slab_lies_on_the_rims_of_open_cabinets(self):
        room = Room(FLOOR)
        for name, x in (("left", 0), ("right", 1)):
            room.mesh(name, "KitchenCabinet", open_box((x, 0, 0), (x + 0.9, 0.6, 0.9), 0.02))
        room.box("slab", "Countertop", (-0.1, 0, 0.9), (2.1, 0.62, 0.04))
        assert room.of("slab") == {("on", "left"), ("on", "right")}

    def test_a_ball_rests_on_a_seat_below_the_top_of_the_back(self):
        sofa = boxes(((0, 0, 0), (2, 0.9, 0.4)), ((0, 0.7, 0.4), (2, 0.9, 0.8)))
        profile = [(0.1 * np.cos(a), 0.5 + 0.1 * np.sin(a)) for a in np.linspace(-np.pi / 2, np.pi / 2, 9)]
        room = Room(FLOOR).mesh("sofa", "Sofa", sofa).mesh("ball", "DesignedArtifact", turned(*profile, at=(1, 0.3, 0)))
        assert room.relate()["ball", "on", "sofa"].numbers["gap"] == pytest.approx(0, abs=1e-6)

    def test_a_tablet_lies_on_a_tilted_plate(self):
        slope = np.tan(np.radians(30))
        tilt = np.array([[1, 0, slope], [0, 1, 0], [0, 0, 1]])
        plate, tablet = boxes(((0, 0, 0.5), (0.2, 0.2, 0.51))), boxes(((0, 0, 0.52), (0.2, 0.2, 0.53)))
        room = Room(FLOOR)
        for name, surface in (("stand", plate), ("tablet", tablet)):
            piece = surface.pieces[0]
            moved = type(surface)((piece._replace(points=piece.points @ tilt),))
            room.mesh(name, "DesignedArtifact", moved)
        relation = room.relate()["tablet", "on", "stand"]
        # 1 cm above it, across a slope of 30 degrees.
        assert relation.numbers["gap"] == pytest.approx(0.01 * np.cos(np.radians(30)), abs=1e-4)


def test_a_wall_in_one_mesh_separates_what_is_on_its_two_sides():
    partition = boxes(((0, 2, 0), (3.9, 2.05, 2.5)), ((0, 0, 0), (0.1, 2, 2.5)), ((0, 2, 2), (8, 2.05, 2.5)))
    shell = (Box((0, 2, 0), (3.9, 2.05, 2.5)), Box((0, 0, 0), (0.1, 2, 2.5)), Box((0, 2, 2), (8, 2.05, 2.5)))
    room = Room(FLOOR).mesh("walls", "Wall", partition, shell_boxes=shell)
    room.box("one", "DesignedChair", (1, 1.6, 0), (0.4, 0.35, 0.9))
    room.box("two", "DesignedChair", (1, 2.1, 0), (0.4, 0.4, 0.9))
    assert not [key for key in room.relate() if {key[0], key[2]} == {"one", "two"}]


class TestCovers:
    """Thin things that feet may sink through: a rug of 9 mm whose underside is level with the feet of a table."""

    RUG = boxes(((0, 0, 0.0005), (3, 3, 0.0095)))

    def rug(self) -> Room:
        return Room().box("floor", "Floor", (-1, -1, -0.1), (6, 6, 0.1)).mesh("rug", "DesignedFurniture", self.RUG)

    def test_a_table_drawn_through_a_rug_is_on_the_rug(self):
        room = self.rug().mesh("table", "Table", table((1, 1, 0.0005), (1.8, 1.8, 0.7)))
        assert room.of("table") == {("on", "rug")}
        assert room.relate()["table", "on", "rug"].numbers["gap"] == pytest.approx(-0.009, abs=1e-6)

    def test_a_thin_thing_of_the_same_size_is_no_cover(self):
        """The plates of a stack are not on each other in a circle."""
        plates = [boxes(((1, 1, z), (1.2, 1.2, z + 0.008))) for z in (0.01, 0.016)]
        room = self.rug().mesh("low", "Plate", plates[0]).mesh("high", "Plate", plates[1])
        assert room.of("high") == {("on", "low")}
        assert room.of("low") == {("on", "rug")}
