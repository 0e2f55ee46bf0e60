"""What is between an object and the wall holds it; walls do not hold what something else carries."""

import pytest

from tests.graph.records import thing
from tests.relations.room_builder import FLOOR, Placed, artifact, relate
from tests.relations.test_surfaces import Room, flat
from tests.shapes.solids import boxes

WALL: Placed = (thing("/wall", (-3, 3, 0), (6, 0.2, 2.5)), "Wall")


def held(*placed: Placed) -> set[tuple[str, str, str]]:
    found = relate(FLOOR, WALL, *placed, kinds=("on", "attached-to"))
    return {(r.target[1:], r.kind, r.anchor[1:]) for r in found}


class TestOutlets:
    OUTLET = artifact("outlet", (0, 2.988, 0.3), (0.08, 0.012, 0.08))

    @pytest.mark.parametrize("back", [2.994, 3.0, 3.006])
    def test_a_plug_is_in_its_outlet_however_deep_it_goes(self, back):
        plug = artifact("plug", (0.02, 2.95, 0.32), (0.04, back - 2.95, 0.04))
        assert held(self.OUTLET, plug) == {("outlet", "attached-to", "wall"), ("plug", "attached-to", "outlet")}

    def test_a_box_on_the_wall_that_touches_the_outlet_at_its_edge_is_at_the_wall(self):
        box = artifact("box", (0.06, 2.95, 0.28), (0.2, 0.05, 0.12))
        assert ("box", "attached-to", "wall") in held(self.OUTLET, box)

    def test_the_wall_may_be_one_mesh_with_others(self):
        room = flat().box("outlet", "DesignedArtifact", (3, 4.788, 0.3), (0.08, 0.012, 0.08))
        room.box("plug", "DesignedArtifact", (3.02, 4.75, 0.32), (0.04, 0.045, 0.04))
        assert room.of("plug") == {("attached-to", "outlet")}


def test_a_knife_is_at_the_strip_at_its_middle():
    strip = artifact("strip", (-0.3, 2.983, 1.28), (0.6, 0.014, 0.05))
    knife = artifact("knife", (0, 2.966, 1.15), (0.05, 0.017, 0.33))
    assert ("knife", "attached-to", "strip") in held(strip, knife)
    assert ("strip", "attached-to", "wall") in held(strip, knife)


class TestTelevisions:
    ARM = artifact("arm", (-0.1, 2.8, 1.25), (0.2, 0.2, 0.2))
    SCREEN = artifact("screen", (-0.5, 2.72, 1.08), (1.0, 0.076, 0.55))
    """20 cm off the wall, 4 mm off the arm."""

    def test_it_is_at_its_arm_though_that_is_smaller(self):
        assert held(self.ARM, self.SCREEN) == {("arm", "attached-to", "wall"), ("screen", "attached-to", "arm")}

    def test_it_does_not_stand_on_the_soundbar_below(self):
        soundbar = artifact("soundbar", (-0.4, 2.73, 1.028), (0.8, 0.06, 0.05))
        assert held(self.ARM, self.SCREEN, soundbar) == {
            ("arm", "attached-to", "wall"),
            ("screen", "attached-to", "arm"),
            ("soundbar", "attached-to", "screen"),
        }

    def test_what_stands_on_a_wall_shelf_is_on_it(self):
        shelf = artifact("shelf", (-0.5, 2.8, 1.2), (1.0, 0.2, 0.02))
        assert ("jar", "on", "shelf") in held(shelf, artifact("jar", (0, 2.85, 1.22), (0.1, 0.1, 0.15)))


def test_a_shelf_rests_on_its_posts_and_not_on_a_hook_below_it():
    posts = [artifact(f"post{x}", (x, 1.7, 0), (0.1, 0.2, 1.5)) for x in (-1, 1)]
    shelf = artifact("shelf", (-1, 1.7, 1.5), (2.1, 0.2, 0.02))
    found = held(*posts, shelf, artifact("hook", (0, 1.84, 1.44), (0.006, 0.034, 0.06)))
    assert {row for row in found if row[0] == "shelf"} == {("shelf", "on", "post-1"), ("shelf", "on", "post1")}
    assert ("hook", "attached-to", "shelf") in found


def test_a_hook_does_not_rest_on_the_cup_that_hangs_from_it():
    room = Room(FLOOR, WALL, artifact("shelf", (-0.6, 2.738, 1.5), (1.2, 0.26, 0.024)))
    sides = [((x, 2.759, 1.35), (x + 0.03, 2.999, 1.5)) for x in (-0.5, 0.47)]
    room.mesh("brackets", "DesignedComponent", boxes(*sides))
    # A bow on a stem that is screwed into the shelf; the handle of the mug lies in it.
    bow = boxes(
        ((0, 2.857, 1.476), (0.006, 2.863, 1.502)),
        ((0, 2.857, 1.47), (0.006, 2.873, 1.476)),
        ((0, 2.867, 1.444), (0.006, 2.873, 1.476)),
        ((0, 2.843, 1.444), (0.006, 2.873, 1.45)),
        ((0, 2.843, 1.444), (0.006, 2.849, 1.464)),
    )
    room.mesh("hook", "DesignedComponent", bow)
    mug = boxes(((-0.04, 2.82, 1.3465), (0.05, 2.9, 1.4255)), ((-0.02, 2.854, 1.45), (0.03, 2.862, 1.4589)))
    room.mesh("mug", "Cup", mug)
    assert room.of("hook") == {("attached-to", "shelf")}
    assert room.of("mug") == {("attached-to", "hook")}


def test_the_arms_of_a_lamp_hang_from_the_plate_at_the_ceiling():
    ceiling = (thing("/ceiling", (-3, 0, 2.5), (6, 3, 0.1)), "Ceiling")
    plate = artifact("plate", (0, 1, 2.3), (0.2, 0.2, 0.199))
    arm = artifact("arm", (0, 1, 2.2), (0.5, 0.2, 0.099))
    lamp = artifact("lamp", (0, 1, 2.0), (0.5, 0.2, 0.199))
    assert held(ceiling, plate, arm, lamp) >= {
        ("plate", "attached-to", "ceiling"),
        ("arm", "attached-to", "plate"),
        ("lamp", "attached-to", "arm"),
    }


def test_a_building_narrower_than_a_room_is_a_thing():
    bank = boxes(
        ((0, 0, 0), (0.05, 0.7, 1)), ((1.75, 0, 0), (1.8, 0.7, 1)), ((0, 0.65, 0), (1.8, 0.7, 1)),
        ((0, 0, 0), (1.8, 0.7, 0.05)), ((0, 0, 0.95), (1.8, 0.7, 1)),
    )  # fmt: skip
    room = Room(FLOOR).mesh("bank", "Building", bank)
    room.box("dog", "DesignedArtifact", (0.6, 0.2, 0.05), (0.5, 0.3, 0.3)).box(
        "bag", "Box", (0.6, 0.2, 1), (0.3, 0.3, 0.2)
    )
    assert room.of("bank") == {("on", "floor")}
    assert room.of("dog") == {("inside", "bank")}
    assert room.of("bag") == {("on", "bank")}


class TestNails:
    NAIL = artifact("nail", (0, 2.95, 1.95), (0.009, 0.042, 0.009))

    def test_a_board_for_tiles_is_no_floor_and_holds_nails_and_tiles(self):
        board = (thing("/board", (-0.3, 2.986, 1.6), (0.7, 0.015, 0.44)), "Floor")
        tile = (thing("/tile", (-0.03, 2.971, 1.83), (0.06, 0.006, 0.135)), "Floor")
        assert held(board, self.NAIL, tile) == {
            ("board", "attached-to", "wall"),
            ("nail", "attached-to", "board"),
            ("tile", "attached-to", "nail"),
        }

    def test_a_floor_does_not_hang(self):
        slab = (thing("/slab", (-1.2, 2.0, 1.0), (2.4, 1.0, 0.1)), "Floor")
        assert not {row for row in held(slab) if row[0] == "slab"}


class TestRadiators:
    RADIATOR = artifact("radiator", (0, 2.91, 0.14), (1.28, 0.064, 0.48))
    """2.6 cm off the wall."""
    SENSOR = artifact("sensor", (1.282, 2.913, 0.56), (0.1, 0.058, 0.052))
    """2.9 cm off the wall, 2 mm off the radiator, at its upper end."""

    def test_a_radiator_does_not_hang_from_its_sensor(self):
        assert held(self.RADIATOR, self.SENSOR) == {
            ("radiator", "attached-to", "wall"),
            ("sensor", "attached-to", "radiator"),
        }

    def test_a_box_of_the_same_size_is_at_the_wall(self):
        box = artifact("box", (1.282, 2.913, 0.3), (1.0, 0.058, 0.3))
        assert ("box", "attached-to", "wall") in held(self.RADIATOR, box)


class TestThingsBelow:
    def test_a_screw_hook_in_the_edge_of_a_table_is_not_on_it(self):
        table = boxes(((0, 0, 0.6), (1, 1, 0.76)), ((0.4, 0.4, 0), (0.6, 0.6, 0.6)))
        hook = boxes(((0.977, 0.5, 0.737), (1.028, 0.505, 0.756)))
        room = Room(FLOOR).mesh("table", "Table", table).mesh("hook", "DesignedArtifact", hook)
        assert room.of("hook") == {("attached-to", "table")}

    def test_a_plant_in_its_soil_is_not_at_the_wall(self):
        soil = artifact("soil", (0.1, 2.5, 0), (0.3, 0.3, 0.3))
        plant = boxes(((0.24, 2.64, 0.28), (0.26, 2.66, 0.9)), ((0, 2.4, 0.9), (0.5, 2.98, 1.2)))
        room = Room(FLOOR, WALL, soil).mesh("plant", "DesignedArtifact", plant)
        assert ("attached-to", "wall") not in room.of("plant")

    def test_a_door_is_not_hung_from_the_worktop(self):
        cabinet = (thing("/cabinet", (0, 2.42, 0), (0.8, 0.58, 0.814)), "DesignedFurniture")
        door = artifact("door", (0, 2.399, 0.08), (0.39, 0.018, 0.73))
        top = artifact("top", (-0.1, 2.38, 0.8165), (1, 0.62, 0.04))
        assert ("door", "attached-to", "top") not in held(cabinet, door, top)
