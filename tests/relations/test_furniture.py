"""Relations to furniture with levels, drawers or nested parts.

Lengths are metres; the cases are those that were found wrong by eye in real scenes.
"""

import pytest

from tests.graph.records import box_at, related, thing
from tests.relations.room_builder import FLOOR, HAIR, RULES, artifact, relate
from tests.relations.test_part_of import joint
from usd2kg.scene import Box


def level(x: float, y: float, z: float, width: float, depth: float) -> Box:
    return box_at((x, y, z), (width, depth, 0))


class TestTapOverWorktop:
    """A kitchen unit in one mesh, 1.2 m high: worktop at 0.9 m, with a protruding tap."""

    UNIT = (thing("/unit", (0, 0, 0), (2, 0.6, 1.2), support_levels=(level(0, 0, 0.9, 2, 0.6),)), "KitchenCabinet")

    def test_an_object_at_the_height_of_the_tap_is_not_on_the_worktop(self):
        ladle = artifact("ladle", (1, 0.55, 1.2), (0.1, 0.02, 0.3))
        assert relate(self.UNIT, ladle) == ()

    def test_an_object_at_the_height_of_the_tap_does_not_touch_the_worktop(self):
        ladle = artifact("ladle", (1, 0.55, 1.2), (0.1, 0.02, 0.3))
        assert relate(self.UNIT, ladle, kinds=("touching",)) == ()

    def test_an_object_on_the_worktop_is_on_it(self):
        jar = artifact("jar", (1, 0.3, 0.9), (0.1, 0.1, 0.2))
        assert related(relate(self.UNIT, jar)) == {("jar", "on", "unit")}

    @pytest.mark.parametrize(
        "levels", [(level(0, 0, 0.1, 0.3, 0.3),), (level(0, 0, 0.25, 0.1, 0.1),)], ids=["bottom", "narrow shelf"]
    )
    def test_lid_is_on_the_rim_of_a_pot(self, levels: tuple[Box, ...]):
        # The only level is the bottom of the pot, or high but too narrow to be its top.
        pot = (thing("/pot", (0, 0, 0), (0.3, 0.3, 0.3), support_levels=levels), "Pot")
        lid = (thing("/lid", (0, 0, 0.3), (0.3, 0.3, 0.02)), "Lid")
        assert related(relate(pot, lid)) == {("lid", "on", "pot")}


class TestLedgeOfSideboard:
    """A sideboard whose lower board, at 0.2 m, sticks out by 0.4 m beside the body under the top at 0.5 m."""

    LEVELS = (level(0, 0, 0.2, 2, 0.5), level(0.4, 0, 0.5, 1.6, 0.5))
    SIDEBOARD = (thing("/sideboard", (0, 0, 0), (2, 0.5, 0.5), support_levels=LEVELS), "Cupboard")

    def test_object_on_the_ledge_is_on_and_not_inside(self):
        frame = artifact("frame", (0.1, 0.2, 0.2), (0.15, 0.05, 0.15))
        assert related(relate(self.SIDEBOARD, frame)) == {("frame", "on", "sideboard")}

    def test_an_object_below_the_top_is_inside(self):
        book = artifact("book", (1, 0.2, 0.2), (0.15, 0.05, 0.15))
        assert related(relate(self.SIDEBOARD, book)) == {("book", "inside", "sideboard")}

    def test_an_object_in_the_basin_of_a_sink_is_inside(self):
        # The drainer at 0.19 m is beside the basin, not over it; a sink has no top.
        levels = (level(0, 0, 0.02, 0.4, 0.4), level(0.4, 0, 0.19, 0.4, 0.4))
        sink = (thing("/sink", (0, 0, 0), (0.8, 0.4, 0.2), support_levels=levels), "Sink")
        plate = (thing("/plate", (0.1, 0.1, 0.02), (0.2, 0.2, 0.02)), "Plate")
        assert related(relate(sink, plate)) == {("plate", "inside", "sink")}


class TestDrawers:
    CABINET = (thing("/cab", (0, 0, 0.1), (0.6, 0.6, 0.8)), "KitchenCabinet")
    TABLE = (thing("/low_table", (0, 0, 0), (1, 0.6, 0.4)), "CoffeeTable")
    DRAWER = (thing("/drawer", (0.3, 0, 0.1), (0.4, 0.5, 0.25)), "Drawer")

    def test_closed_drawer_is_inside_its_whole(self):
        runs = [joint("/low_table", "/drawer", "prismatic")]
        assert related(relate(self.TABLE, self.DRAWER, joints=runs)) == {("drawer", "inside", "low_table")}

    def test_drawer_of_another_whole_is_not_inside(self):
        other = (thing("/store/drawer", (0.3, 0, 0.1), (0.4, 0.5, 0.25)), "Drawer")
        assert relate(self.TABLE, other) == ()

    def test_open_drawer_is_not_inside(self):
        out = (thing("/drawer", (0.3, -0.45, 0.1), (0.4, 0.5, 0.25)), "Drawer")
        assert relate(self.TABLE, out, joints=[joint("/low_table", "/drawer", "prismatic")]) == ()

    def test_drawer_behind_a_tall_front_is_inside_the_cabinet(self):
        # The front is as high as the cabinet, so the box of the lower drawer encloses the upper one.
        lower = (thing("/lower", (0, -0.02, 0.1), (0.6, 0.5, 0.79)), "Drawer")
        upper = (thing("/upper", (0.05, 0.05, 0.6), (0.5, 0.4, 0.1)), "Drawer")
        runs = [joint("/cab", "/lower", "prismatic"), joint("/cab", "/upper", "prismatic")]
        found = related(relate(self.CABINET, lower, upper, joints=runs))
        assert found == {("lower", "inside", "cab"), ("upper", "inside", "cab")}

    def test_cabinet_is_not_inside_its_own_drawer(self):
        low = (thing("/low", (0, -0.02, 0.1), (0.6, 0.58, 0.4)), "Drawer")
        found = relate(self.CABINET, low, joints=[joint("/cab", "/low", "prismatic")])
        assert related(found) == {("low", "inside", "cab")}

    def test_slabs_do_not_rest_on_drawers(self):
        # Both end at 0.9 m; drawers do not support slabs.
        other = (thing("/other", (0.6, 0, 0.1), (0.6, 0.6, 0.8)), "KitchenCabinet")
        front = (thing("/front", (0, -0.02, 0.1), (0.6, 0.5, 0.8)), "Drawer")
        slab = (thing("/slab", (0, -0.02, 0.9), (1.2, 0.64, 0.04)), "Countertop")
        found = related(relate(self.CABINET, other, front, slab, kinds=("on",)))
        assert found == {("slab", "on", "cab"), ("slab", "on", "other")}


class TestWallsInOneMesh:
    """The box around all walls of a house contains everything in it."""

    HOUSE = (thing("/walls", (-5, -5, 0), (10, 10, 2.5)), "Wall")

    def test_a_hovering_object_within_house_walls_is_on_the_object_below(self):
        chair = (thing("/chair", (0, 0, 0.05), (0.5, 0.5, 0.9)), "DesignedChair")
        (relation,) = relate(FLOOR, self.HOUSE, chair)
        assert (relation.target, relation.anchor, relation.rule) == ("/chair", "/floor", RULES.hovering.rule)

    @pytest.mark.parametrize(("step", "kind"), [(-HAIR, "attached-to"), (HAIR, "on")])
    def test_thicker_boxes_are_not_walls(self, step: float, kind: str):
        thick = RULES.attached.max_wall_thickness + step
        wall = (thing("/wall", (-5, 1, 0), (10, thick, 2.5)), "Wall")
        radiator = (thing("/radiator", (0, 0.9, 0.05), (0.5, 0.1, 0.9)), "Appliance")
        (relation,) = relate(FLOOR, wall, radiator, kinds=("on", "attached-to"))
        assert relation.kind == kind
