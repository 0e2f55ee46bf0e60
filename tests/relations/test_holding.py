"""What carries is held by the building without what it carries."""

import numpy as np

from tests.graph.records import thing
from tests.relations.room_builder import FLOOR, Placed, artifact, relate
from tests.shapes.solids import boxes
from usd2kg.relations.holding_paths import find_holding_paths

WALL: Placed = (thing("/wall", (-3, 3, 0), (6, 0.2, 2.5)), "Wall")
BOARD = artifact("board", (-0.5, 2.974, 1.2), (1.0, 0.02, 1.0))
"""6 mm off the wall."""


def held(*placed: Placed) -> set[tuple[str, str, str]]:
    found = relate(FLOOR, *placed, kinds=("on", "attached-to"))
    return {(r.target[1:], r.kind, r.anchor[1:]) for r in found}


class TestPegboards:
    HOOK = artifact("hook", (0, 2.91, 2.0), (0.006, 0.068, 0.02))
    """Sunk 4 mm into the board, above its middle."""

    def test_a_board_carries_the_hook_that_is_stuck_in_it(self):
        assert held(WALL, BOARD, self.HOOK) == {("board", "attached-to", "wall"), ("hook", "attached-to", "board")}

    def test_a_hook_does_not_rest_on_what_hangs_from_it(self):
        spanner = artifact("spanner", (-0.01, 2.93, 1.8), (0.026, 0.006, 0.205))
        assert held(WALL, BOARD, self.HOOK, spanner) == {
            ("board", "attached-to", "wall"),
            ("hook", "attached-to", "board"),
            ("spanner", "attached-to", "hook"),
        }

    def test_a_rack_carries_the_tool_that_goes_through_it(self):
        rack = artifact("rack", (-0.2, 2.92, 1.5), (0.4, 0.056, 0.02))
        tool = artifact("tool", (0, 2.93, 1.42), (0.03, 0.03, 0.19))
        found = held(WALL, BOARD, rack, tool)
        assert ("rack", "attached-to", "board") in found
        assert {row for row in found if row[0] == "tool"} <= {("tool", "attached-to", "rack"), ("tool", "on", "rack")}


class TestContactsAndWalls:
    def test_a_valve_at_a_radiator_is_not_at_the_wall_behind(self):
        radiator = artifact("radiator", (0, 2.9, 0.2), (1.0, 0.075, 0.6))
        # A name that does not make it a part.
        valve = artifact("meter", (1.005, 2.9, 0.5), (0.06, 0.047, 0.06))
        assert ("meter", "attached-to", "radiator") in held(WALL, radiator, valve)

    def test_a_wall_cupboard_beside_a_fridge_hangs_at_the_wall(self):
        fridge = (thing("/fridge", (0, 2.4, 0), (0.6, 0.6, 2.0)), "Refrigerator")
        cupboard = artifact("cupboard", (0.602, 2.6, 1.4), (0.6, 0.37, 0.6))
        assert ("cupboard", "attached-to", "wall") in held(WALL, fridge, cupboard)

    def test_of_two_cupboards_off_the_wall_neither_holds_the_other(self):
        left = artifact("left", (0, 2.6, 1.4), (0.6, 0.37, 0.6))
        right = artifact("right", (0.6, 2.6, 1.4), (0.6, 0.37, 0.6))
        assert held(WALL, left, right) == {("left", "attached-to", "wall"), ("right", "attached-to", "wall")}


def test_a_clamped_frame_carries_its_bell():
    stand = (thing("/stand", (0, 0, 0), (0.7, 0.7, 1.54)), "DesignedArtifact")
    frame = artifact("frame", (0.2, 0.6, 0.78), (0.9, 0.3, 0.82))
    bell = artifact("bell", (1.08, 0.7, 1.5), (0.04, 0.04, 0.06))
    assert held(stand, frame, bell) == {
        ("stand", "on", "floor"),
        ("frame", "attached-to", "stand"),
        ("bell", "attached-to", "frame"),
    }


class TestPaths:
    def test_the_shortest_way_leads_outwards(self):
        # 0 is the wall, 1 the board, 2 a hook, 3 a tool on the hook.
        target, anchor = np.array([1, 1, 2, 2, 3]), np.array([0, 2, 0, 1, 2])
        gap = np.array([0.006, -0.004, 0.022, -0.004, 0.0])
        paths = find_holding_paths(target, anchor, gap, np.array([False, True, True, True]))
        assert paths.through.tolist() == [-1, 0, 1, 2]
        assert np.allclose(paths.length, [0, 0.006, 0.006, 0.006], atol=1e-3)
        assert paths.lead_through(np.array([3, 2, 1]), np.array([1, 3, 2])).tolist() == [True, False, False]

    def test_what_hangs_from_each_other_only_is_held_by_nothing(self):
        paths = find_holding_paths(np.array([0, 1]), np.array([1, 0]), np.zeros(2), np.array([True, True]))
        assert np.isinf(paths.length).all()
        assert paths.through.tolist() == [-1, -1]


CEILING: Placed = (thing("/ceiling", (-3, -3, 2.5), (6, 6, 0.2)), "Ceiling")


class TestHangingUnderEachOther:
    def test_a_lamp_hangs_on_a_chain_that_does_not_stand_on_it(self):
        beam = artifact("beam", (-2, -0.1, 2.3), (4, 0.2, 0.2))
        chain = artifact("chain", (-0.5, -0.005, 1.9), (0.01, 0.01, 0.402))
        lamp = artifact("lamp", (-0.6, -0.08, 1.84), (1.2, 0.16, 0.062))
        assert held(CEILING, beam, lamp, chain) == {
            ("beam", "attached-to", "ceiling"),
            ("chain", "attached-to", "beam"),
            ("lamp", "attached-to", "chain"),
        }

    def test_a_hook_under_a_shelf_does_not_hover_over_the_mug_on_it(self):
        shelf = artifact("shelf", (-0.7, 2.79, 1.42), (1.4, 0.21, 0.02))
        hook = artifact("hook", (0, 2.85, 1.386), (0.005, 0.035, 0.036))
        mug = artifact("mug", (-0.04, 2.83, 1.275), (0.11, 0.084, 0.125))
        assert held(WALL, shelf, hook, mug) == {
            ("shelf", "attached-to", "wall"),
            ("hook", "attached-to", "shelf"),
            ("mug", "attached-to", "hook"),
        }


def test_what_would_tip_off_its_support_hangs_at_the_wall_that_it_touches():
    bench = (thing("/bench", (-1, 2.4, 0), (2, 0.58, 0.45)), "DesignedChair")
    # 7 mm of its 24 mm are over the bench.
    back = artifact("back", (-1, 2.973, 0.455), (2, 0.024, 0.36))
    assert ("back", "attached-to", "wall") in held(WALL, bench, back)
    forward = artifact("back", (-1, 2.94, 0.455), (2, 0.024, 0.36))
    assert ("back", "on", "bench") in held(WALL, bench, forward)


class TestDraped:
    TABLE = (thing("/table", (0, 0, 0), (1, 1, 0.7)), "Table")

    def test_a_cloth_that_hangs_over_the_edges_of_a_table_is_on_it(self):
        hems = [
            ((-0.02, -0.02, 0.55), (1.02, -0.01, 0.705)),
            ((-0.02, 1.01, 0.55), (1.02, 1.02, 0.705)),
            ((-0.02, -0.02, 0.55), (-0.01, 1.02, 0.705)),
            ((1.01, -0.02, 0.55), (1.02, 1.02, 0.705)),
        ]
        cloth = boxes(((-0.02, -0.02, 0.701), (1.02, 1.02, 0.705)), *hems)
        placed = artifact("cloth", (-0.02, -0.02, 0.55), (1.04, 1.04, 0.155))
        table = boxes(((0, 0, 0.66), (1, 1, 0.7)), ((0.45, 0.45, 0), (0.55, 0.55, 0.66)))
        surfaces = {"/cloth": cloth, "/table": table}
        found = relate(FLOOR, self.TABLE, placed, kinds=("on", "attached-to"), surfaces=surfaces)
        assert ("/cloth", "on", "/table") in {(r.target, r.kind, r.anchor) for r in found}

    def test_a_towel_over_a_rail_is_attached_to_it(self):
        rail = artifact("rail", (0, 2.9, 1.2), (0.6, 0.1, 0.02))
        bar = boxes(((0, 2.9, 1.2), (0.6, 2.93, 1.22)), ((0, 2.9, 1.2), (0.02, 3.0, 1.22)))
        towel = boxes(
            ((0.1, 2.88, 1.221), (0.5, 2.95, 1.225)),
            ((0.1, 2.88, 0.6), (0.5, 2.89, 1.225)),
            ((0.1, 2.94, 0.6), (0.5, 2.95, 1.195)),
        )
        placed = artifact("towel", (0.1, 2.88, 0.6), (0.4, 0.07, 0.625))
        found = relate(FLOOR, WALL, rail, placed, kinds=("on", "attached-to"), surfaces={"/towel": towel, "/rail": bar})
        assert ("/towel", "on", "/rail") not in {(r.target, r.kind, r.anchor) for r in found}
