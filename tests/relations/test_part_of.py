"""part-of."""

from dataclasses import replace
from typing import Any

import pytest

from tests.graph.records import ground_as, related, thing
from tests.grounding.records import make_object, make_scene
from tests.relations.room_builder import FLOOR, RULES, Placed, relate
from tests.shapes.solids import open_box
from usd2kg.grounding import ground
from usd2kg.ontology import load_home_tbox
from usd2kg.relations import RelationOptions, find_relations
from usd2kg.scene import Joint

PART = RULES.part_of


def joint(body0: str | None, body1: str | None, kind: Any = "revolute") -> Joint:
    return Joint(
        prim_path="/joint",
        type=kind,
        body0=body0,
        body1=body1,
        axis="Z",
        axis_vector=(0, 0, 1),
        origin=None,
        direction="vertical",
        lower=0,
        upper=1,
        value=None,
        is_enabled=True,
        is_excluded_from_articulation=False,
    )


def parts(*placed: Placed, joints: Any = ()) -> dict[tuple[str, str], str]:
    """Return (part, whole) → rule."""
    return {(r.target, r.anchor): r.rule for r in relate(*placed, kinds=("part-of",), joints=joints)}


class TestStated:
    CABINET = (thing("/cab", (0, 0, 0), (0.6, 0.6, 0.8)), "KitchenCabinet")
    DRAWER = (thing("/drawer", (0, -0.02, 0.5), (0.6, 0.5, 0.2)), "Drawer")

    def test_movable_joints_state_parthood(self):
        (relation,) = relate(
            self.CABINET, self.DRAWER, kinds=("part-of",), joints=[joint("/cab", "/drawer", "prismatic")]
        )
        assert (relation.target, relation.anchor, relation.rule) == ("/drawer", "/cab", PART.stated_rule)
        assert (relation.numbers, relation.confidence) == ({}, None)

    @pytest.mark.parametrize("kind", ["fixed", "distance", "other"])
    def test_fixed_joints_do_not_state_parthood(self, kind: str):
        chair = (thing("/chair", (2, 0, 0), (0.5, 0.5, 0.9)), "DesignedChair")
        assert parts(self.CABINET, chair, joints=[joint("/cab", "/chair", kind)]) == {}

    def test_resolves_bodies_to_objects(self):
        inner = [joint("/cab/frame/mesh", "/drawer/body"), joint(None, "/cab"), joint("/cab/a", "/cab/b")]
        assert parts(self.CABINET, self.DRAWER, joints=inner) == {("/drawer", "/cab"): PART.stated_rule}

    def test_swapped_bodies(self):
        assert list(parts(self.CABINET, self.DRAWER, joints=[joint("/drawer", "/cab")])) == [("/drawer", "/cab")]
        nested = make_object("/cab/flap", parent_path="/cab"), "DesignedArtifact"
        assert list(parts(self.CABINET, nested, joints=[joint("/cab/flap", "/cab")])) == [("/cab/flap", "/cab")]

    @pytest.mark.parametrize("ends", [("/bracket", "/screen"), ("/screen", "/bracket")])
    @pytest.mark.parametrize("fixed", [(None, "/bracket"), ("/bracket", None)])
    def test_what_is_fixed_to_the_world_is_the_whole(self, ends: tuple[str, str], fixed: Any):
        bracket = (thing("/bracket", (0, 0, 0), (0.1, 0.1, 0.1)), "DesignedComponent")
        screen = (thing("/screen", (0, 0, 0.1), (0.6, 0.1, 0.4)), "Appliance")
        joints = [joint(*ends), joint(*fixed, kind="fixed")]
        assert list(parts(bracket, screen, joints=joints)) == [("/screen", "/bracket")]
        assert list(parts(bracket, screen, joints=joints[:1])) == [("/bracket", "/screen")]

    def test_floor_is_never_a_whole(self):
        floor = (thing("/floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor")
        robot = (thing("/robot", (2, 0, 0), (0.5, 0.5, 0.9)), "DesignedArtifact")
        assert parts(floor, robot, joints=[joint("/floor", "/robot")]) == {}

    def test_subcomponents_are_parts(self):
        motor = make_object("/fan/motor", parent_path="/fan", kind="subcomponent"), "Appliance"
        fan = (thing("/fan", (0, 0, 0), (0.5, 0.5, 0.5)), "Appliance")
        assert parts(fan, motor) == {("/fan/motor", "/fan"): PART.stated_rule}

    def test_jointed_parts_do_not_rest_on_objects(self):
        # Drawers never rest on objects, so use another class.
        flap = (thing("/flap", (0, 0, 0.8), (0.6, 0.6, 0.02)), "DesignedArtifact")
        assert related(relate(self.CABINET, flap)) == {("flap", "on", "cab")}
        assert relate(self.CABINET, flap, joints=[joint("/cab", "/flap")]) == ()


class TestNested:
    def test_nested_components_are_parts(self):
        cabinet = (thing("/cab", (0, 0, 0), (0.6, 0.6, 0.8)), "KitchenCabinet")
        door = make_object("/cab/group/door", parent_path="/cab"), "Door"
        handle = make_object("/cab/group/door/handle", parent_path="/cab/group/door"), "DesignedHandle"
        assert parts(cabinet, door, handle) == {
            ("/cab/group/door", "/cab"): PART.tree_rule,
            ("/cab/group/door/handle", "/cab/group/door"): PART.tree_rule,
        }

    def test_grouping_is_not_parthood(self):
        table = (thing("/table", (0, 0, 0), (1, 1, 0.7)), "Table")
        nested = (thing("/table/cup", (0.4, 0.4, 0.7), (0.1, 0.1, 0.1), parent_path="/table"), "Cup")
        assert parts(table, nested) == {}

    @pytest.mark.parametrize("cls", ["Kitchen", "Room", "Building"])
    def test_rooms_have_no_parts(self, cls: str):
        room = (thing("/room", (0, 0, 0), (4, 4, 2.5)), cls)
        sink = make_object("/room/sink", parent_path="/room"), "Sink"
        assert parts(room, sink) == {}

    def test_a_part_is_not_on_its_own_whole(self):
        cabinet = (thing("/cab", (0, 0, 0), (0.6, 0.6, 0.8)), "KitchenCabinet")
        top = (thing("/cab/top", (0, 0, 0.8), (0.6, 0.6, 0.03), parent_path="/cab"), "Countertop")
        beside = (thing("/top", (0, 0, 0.8), (0.6, 0.6, 0.03)), "Countertop")
        assert relate(cabinet, top) == ()
        assert related(relate(cabinet, beside)) == {("top", "on", "cab")}


class TestFitted:
    """A kitchen unit as a group of carcass, doors and knobs."""

    CARCASS = (thing("/K/unit/carcass", (0, 0, 0), (0.8, 0.5, 0.7)), "KitchenCabinet")
    LEFT = (thing("/K/unit/left", (0, -0.02, 0), (0.399, 0.02, 0.7)), "Door")
    RIGHT = (thing("/K/unit/right", (0.401, -0.02, 0), (0.399, 0.02, 0.7)), "Door")
    KNOB = (thing("/K/unit/knob", (0.37, -0.045, 0.1), (0.025, 0.025, 0.025)), "DesignedHandle")

    def test_doors_and_knobs_are_fitted(self):
        assert parts(self.CARCASS, self.LEFT, self.RIGHT, self.KNOB) == {
            ("/K/unit/left", "/K/unit/carcass"): PART.fitted_rule,
            ("/K/unit/right", "/K/unit/carcass"): PART.fitted_rule,
            ("/K/unit/knob", "/K/unit/left"): PART.fitted_rule,
        }

    def test_its_number(self):
        off = (thing("/K/unit/left", (0, -0.025, 0), (0.399, 0.02, 0.7)), "Door")
        (relation,) = relate(self.CARCASS, off, kinds=("part-of",))
        assert relation.numbers == pytest.approx({"gap": 0.005})
        assert relation.confidence == pytest.approx(0.5)

    def test_knob_without_a_door_is_fitted_to_the_body(self):
        low = (thing("/K/unit/knob", (0.37, -0.025, 0.1), (0.025, 0.025, 0.025)), "DesignedHandle")
        assert list(parts(self.CARCASS, low)) == [("/K/unit/knob", "/K/unit/carcass")]

    def test_fitting_requires_siblings_in_contact(self):
        elsewhere = (thing("/K/other/door", (0, -0.02, 0), (0.399, 0.02, 0.7)), "Door")
        afar = (thing("/K/unit/door", (0, -0.2, 0), (0.399, 0.02, 0.7)), "Door")
        assert parts(self.CARCASS, elsewhere, afar) == {}

    def test_finds_stated_parts_without_boxes(self):
        cabinet, door = make_object("/cab"), make_object("/cab/door", parent_path="/cab")
        assert list(parts((cabinet, "KitchenCabinet"), (door, "Door"))) == [("/cab/door", "/cab")]


def test_a_door_is_a_part_of_its_frame_and_still_connects_rooms():
    scene = make_scene(
        thing("/House/bedroom", (0, -4, 0), (4, 4, 2.5)),
        thing("/House/kitchen", (0, 0.2, 0), (4, 4, 2.5)),
        thing("/House/wall", (0, 0, 0), (4, 0.2, 2.5)),
        thing("/House/door_frame", (1, 0, 0), (1, 0.2, 2.1)),
        thing("/House/door", (1.05, 0.05, 0), (0.9, 0.04, 2.05)),
        thing("/House/door_handle", (1.1, -0.05, 1), (0.12, 0.1, 0.03)),
    )
    tbox = load_home_tbox()
    found = find_relations(scene, tbox, ground(scene, tbox), RelationOptions(kinds=("part-of", "connects")))
    assert {(r.target, r.kind, r.anchor) for r in found} == {
        ("/House/door", "part-of", "/House/door_frame"),
        ("/House/door_handle", "part-of", "/House/door"),
        ("/House/door", "connects", "/House/bedroom"),
        ("/House/door", "connects", "/House/kitchen"),
    }


class TestGroups:
    """The whole may be in the group of the part, or in the group above it."""

    BODY = (thing("/R/fridge/body", (0, 0, 0), (0.6, 0.6, 1.8)), "Refrigerator")

    def test_a_door_in_a_group_of_its_own_is_a_part_of_the_body_above(self):
        door = (thing("/R/fridge/leaf/door", (0, -0.05, 0), (0.6, 0.05, 1.8)), "Door")
        handle = (thing("/R/fridge/leaf/handle", (0.5, -0.1, 1), (0.02, 0.05, 0.3)), "DesignedHandle")
        assert set(parts(self.BODY, door, handle)) == {
            ("/R/fridge/leaf/door", "/R/fridge/body"),
            ("/R/fridge/leaf/handle", "/R/fridge/leaf/door"),
        }

    def test_two_groups_above_is_too_far(self):
        door = (thing("/R/fridge/a/b/door", (0, -0.05, 0), (0.6, 0.05, 1.8)), "Door")
        assert parts(self.BODY, door) == {}

    def test_the_group_of_the_part_comes_first(self):
        own = (thing("/R/fridge/crate/body", (0, -0.6, 0), (0.5, 0.59, 1.8)), "Refrigerator")
        door = (thing("/R/fridge/crate/door", (0, -0.01, 0), (0.6, 0.01, 1.8)), "Door")
        assert list(parts(self.BODY, own, door)) == [("/R/fridge/crate/door", "/R/fridge/crate/body")]

    def test_the_stage_is_no_group(self):
        body = (thing("/body", (0, 0, 0), (0.6, 0.6, 1.8)), "Refrigerator")
        door = (thing("/leaf/door", (0, -0.05, 0), (0.6, 0.05, 1.8)), "Door")
        assert parts(body, door) == {}


class TestNames:
    """The last noun of a name says what it is where the class follows another word."""

    UNIT = (thing("/K/u/unit", (0, 0, 0), (0.8, 0.5, 0.7)), "KitchenCabinet")
    DRAWER = (thing("/K/u/drawer", (0, -0.02, 0.4), (0.8, 0.5, 0.2)), "Drawer")

    def test_a_door_of_the_class_of_sinks(self):
        door = (thing("/K/u/sink_door_left", (0, -0.02, 0), (0.8, 0.02, 0.7)), "Sink")
        knob = (thing("/K/u/knob", (0.7, -0.04, 0.3), (0.02, 0.02, 0.02)), "DesignedHandle")
        assert set(parts(self.UNIT, door, knob)) == {
            ("/K/u/sink_door_left", "/K/u/unit"),
            ("/K/u/knob", "/K/u/sink_door_left"),
        }

    def test_a_fork_in_a_drawer_is_no_drawer(self):
        fork = (thing("/K/u/drawer_fork", (0.1, 0.1, 0.45), (0.02, 0.2, 0.01)), "Drawer")
        assert list(parts(self.UNIT, self.DRAWER, fork)) == [("/K/u/drawer", "/K/u/unit")]

    def test_a_bar_is_the_handle_of_the_front_that_it_is_on(self):
        bar = (thing("/K/u/drawer_bar", (0.3, -0.05, 0.5), (0.2, 0.03, 0.01)), "Drawer")
        assert ("/K/u/drawer_bar", "/K/u/drawer") in parts(self.UNIT, self.DRAWER, bar)

    @pytest.mark.parametrize("lower", [(0.3, -0.05, 0.1), (0.3, -0.1, 0.5)], ids=["below", "off"])
    def test_bars_elsewhere_are_not_parts(self, lower: Any):
        bar = (thing("/K/u/bar", lower, (0.2, 0.03, 0.01)), "DesignedArtifact")
        assert list(parts(self.UNIT, self.DRAWER, bar)) == [("/K/u/drawer", "/K/u/unit")]

    def test_the_panel_of_a_group_named_after_a_door_is_the_door(self):
        panel = (thing("/K/u/door_left/panel", (0, -0.02, 0), (0.4, 0.02, 0.7)), "DesignedArtifact")
        bar = (thing("/K/u/door_left/bar", (0.35, -0.05, 0.3), (0.01, 0.03, 0.2)), "DesignedArtifact")
        assert set(parts(self.UNIT, panel, bar)) == {
            ("/K/u/door_left/panel", "/K/u/unit"),
            ("/K/u/door_left/bar", "/K/u/door_left/panel"),
        }

    def test_a_panel_of_another_group_is_no_door(self):
        panel = (thing("/K/u/left/panel", (0, -0.02, 0.2), (0.2, 0.02, 0.2)), "DesignedArtifact")
        assert parts(self.UNIT, panel) == {}

    def test_boards_are_parts_of_the_uprights_in_their_group(self):
        uprights = (thing("/K/rack/uprights", (0, 0, 0), (1.0, 0.4, 1.8)), "DesignedComponent")
        board = (thing("/K/rack/board_1", (0.02, 0.02, 0.5), (0.96, 0.36, 0.02)), "DesignedComponent")
        chain = (thing("/K/rack/chain", (0.4, 0.1, 0.6), (0.1, 0.1, 0.3)), "DesignedComponent")
        assert list(parts(uprights, board, chain)) == [("/K/rack/board_1", "/K/rack/uprights")]

    def test_boards_on_a_rack_are_not_its_parts(self):
        rack = (thing("/K/rack/rack", (0, 0, 0), (1.0, 0.4, 1.8)), "Rack")
        board = (thing("/K/rack/board_1", (0.02, 0.02, 0.5), (0.96, 0.36, 0.02)), "DesignedComponent")
        assert parts(rack, board) == {}

    def test_a_dresser_with_drawers_is_a_dresser(self):
        dresser = (thing("/K/d/dresser_with_drawers", (0, 0, 0), (0.8, 0.5, 0.7)), "DesignedFurniture")
        drawer = (thing("/K/d/drawer", (0, -0.02, 0.4), (0.8, 0.5, 0.2)), "Drawer")
        assert list(parts(dresser, drawer)) == [("/K/d/drawer", "/K/d/dresser_with_drawers")]

    def relate_knob(self, **known: Any) -> int:
        """Return the number of relations of a knob of the class of artifacts."""
        knob = thing("/K/u/knob", (0.7, -0.02, 0.3), (0.02, 0.02, 0.02))
        scene, tbox = make_scene(self.UNIT[0], knob), load_home_tbox()
        grounding = ground_as(tbox, scene, {"/K/u/unit": "KitchenCabinet", "/K/u/knob": "DesignedArtifact"})
        if known.pop("is_reviewed", False):
            decided = (p.reviewed(p.class_iri, "ada") for p in grounding.predictions)
            grounding = replace(grounding, predictions=tuple(decided))
        return len(find_relations(scene, tbox, replace(grounding, **known), RelationOptions(kinds=("part-of",))))

    def test_the_class_counts_where_a_person_chose_it(self):
        assert (self.relate_knob(), self.relate_knob(is_reviewed=True)) == (1, 0)

    @pytest.mark.parametrize("settings", [{"regime": "opaque"}, {"evidence": "geometry,position"}])
    def test_names_that_the_grounding_did_not_see_do_not_count(self, settings: dict[str, str]):
        assert self.relate_knob(settings=settings) == 0


class TestDoorsOfCases:
    SAFE = (thing("/R/safe/case", (0, 0, 0), (0.4, 0.4, 0.3)), "DesignedContainer")

    def test_a_door_as_large_as_the_face_of_a_case(self):
        door = (thing("/R/safe/door", (0.01, -0.005, 0.01), (0.38, 0.02, 0.28)), "Door")
        keypad = (thing("/R/safe/keypad", (0.15, -0.015, 0.1), (0.1, 0.01, 0.06)), "Appliance")
        assert set(parts(self.SAFE, door, keypad)) == {
            ("/R/safe/door", "/R/safe/case"),
            ("/R/safe/keypad", "/R/safe/door"),
        }

    def test_a_small_door_before_a_case_is_another_ones(self):
        door = (thing("/R/safe/door", (0.01, -0.02, 0.01), (0.2, 0.02, 0.28)), "Door")
        assert parts(self.SAFE, door) == {}


class TestShelves:
    CASE = (thing("/R/w/case", (0, 0, 0), (0.8, 0.4, 1.8)), "Cupboard")

    def in_case(self, name: str, lower: Any, size: Any) -> set[tuple[str, str]]:
        surfaces = {"/R/w/case": open_box((0, 0, 0), (0.8, 0.4, 1.8), 0.02)}
        shelf = thing(f"/R/w/{name}", lower, size)
        found = relate(self.CASE, (shelf, "DesignedArtifact"), kinds=("part-of",), surfaces=surfaces)
        return {(r.target, r.anchor) for r in found}

    @pytest.mark.parametrize("name", ["shelf_01", "wire_shelf", "rack", "rail"])
    def test_shelves_whose_ends_meet_the_sides_are_parts(self, name: str):
        assert self.in_case(name, (0.03, 0.05, 0.9), (0.74, 0.3, 0.02)) == {(f"/R/w/{name}", "/R/w/case")}

    def test_loose_shelves_are_not(self):
        assert self.in_case("shelf", (0.1, 0.08, 0.9), (0.6, 0.24, 0.02)) == set()

    def test_nor_are_loose_boards_and_other_contents(self):
        assert self.in_case("plank", (0.03, 0.05, 0.9), (0.74, 0.3, 0.02)) == set()
        assert self.in_case("box", (0.03, 0.05, 0.9), (0.74, 0.3, 0.2)) == set()

    def test_a_rack_that_is_pulled_out_by_a_half_is_a_part(self):
        assert self.in_case("rack", (0.03, -0.16, 0.9), (0.74, 0.3, 0.02)) == {("/R/w/rack", "/R/w/case")}

    def test_a_shelf_that_sticks_out_is_not(self):
        assert self.in_case("shelf", (0.03, -0.25, 0.9), (0.74, 0.3, 0.02)) == set()

    def test_a_rack_on_a_door_is_a_part_of_the_door(self):
        door = (thing("/R/w/door", (0, -0.05, 0), (0.8, 0.05, 1.8)), "Door")
        rack = (thing("/R/w/rack", (0.1, 0.0, 0.5), (0.6, 0.1, 0.1)), "Rack")
        assert ("/R/w/rack", "/R/w/door") in parts(door, rack)


class TestCasters:
    TROLLEY = (thing("/R/t/frame", (0, 0, 0.1), (1, 0.5, 0.9)), "DesignedComponent")
    CASTERS = tuple(
        (thing(f"/R/t/caster_{n}", (x, y, 0), (0.05, 0.05, 0.1)), "DesignedComponent")
        for n, (x, y) in enumerate([(0, 0), (0.95, 0), (0, 0.45), (0.95, 0.45)])
    )

    def test_casters_are_parts_of_what_is_on_them(self):
        assert set(parts(self.TROLLEY, *self.CASTERS)) == {(f"/R/t/caster_{n}", "/R/t/frame") for n in range(4)}

    def test_the_trolley_is_on_what_its_casters_are_on(self):
        found = [r for r in relate(FLOOR, self.TROLLEY, *self.CASTERS) if r.target == "/R/t/frame"]
        assert [(r.kind, r.anchor) for r in found] == [("on", "/floor")]

    def test_a_wheel_beside_a_trolley_is_not_its_part(self):
        wheel = (thing("/R/t/wheel", (1.0, 0, 0), (0.05, 0.3, 0.3)), "DesignedComponent")
        assert parts(self.TROLLEY, wheel) == {}

    def test_a_turntable_is_not_a_part_of_the_vase_on_it(self):
        wheel = (thing("/R/t/wheel", (0, 0, 0), (0.24, 0.24, 0.1)), "DesignedComponent")
        vase = (thing("/R/t/vase", (0.02, 0.02, 0.1), (0.2, 0.2, 0.4)), "DesignedContainer")
        assert parts(wheel, vase) == {}


class TestWheelsOnJoints:
    BODY = (thing("/R/c/body", (0, 0, 0.15), (1, 0.6, 0.5)), "DesignedArtifact")
    WHEELS = tuple(
        (thing(f"/R/c/wheel_{n}", (x, y, 0), (0.2, 0.05, 0.2)), "DesignedComponent")
        for n, (x, y) in enumerate([(0, 0), (0.8, 0), (0, 0.55), (0.8, 0.55)])
    )
    JOINTS = tuple(joint("/R/c/body", f"/R/c/wheel_{n}") for n in range(4))

    def test_a_cart_is_on_what_its_wheels_are_on(self):
        found = relate(FLOOR, self.BODY, *self.WHEELS, joints=self.JOINTS)
        on_floor = {r.target for r in found if (r.kind, r.anchor) == ("on", "/floor")}
        assert on_floor == {"/R/c/body", *(f"/R/c/wheel_{n}" for n in range(4))}
        assert sum(r.target == "/R/c/body" for r in found) == 1

    def test_a_door_that_reaches_no_lower_than_its_case_is_not_on_the_floor(self):
        case = (thing("/R/case", (0, 0, 0), (0.6, 0.6, 0.8)), "KitchenCabinet")
        door = (thing("/R/door", (0, -0.02, 0), (0.6, 0.02, 0.8)), "DesignedComponent")
        found = relate(FLOOR, case, door, joints=[joint("/R/case", "/R/door")])
        assert [r.target for r in found if r.anchor == "/floor"] == ["/R/case"]


class TestLids:
    CASE = (thing("/R/s/base", (0, 0, 0), (0.6, 0.4, 0.15)), "DesignedComponent")

    @pytest.mark.parametrize(
        "lower, size, is_part",
        [
            ((0, 0.39, 0.14), (0.6, 0.2, 0.4), True),
            ((0, 0.39, 0.14), (0.3, 0.2, 0.4), False),
            ((0, 0.45, 0.14), (0.6, 0.2, 0.4), False),
            ((0, 0.39, 0.0), (0.6, 0.2, 0.4), False),
            ((0, 0, 0.15), (0.6, 0.4, 0.02), False),
        ],
        ids=["open", "narrow", "apart", "beside", "loose"],
    )
    def test_a_lid_that_stands_open_along_a_side_is_hinged(self, lower: Any, size: Any, is_part: bool):
        assert bool(parts(self.CASE, (thing("/R/s/lid", lower, size), "Lid"))) is is_part


class TestFittings:
    def test_panes_and_valves_are_parts_of_what_they_touch(self):
        frame = (thing("/R/w/window_frame", (0, 0, 1), (1, 0.06, 1)), "DesignedComponent")
        pane = (thing("/R/w/pane", (0.05, 0.02, 1.05), (0.9, 0.01, 0.9)), "DesignedComponent")
        radiator = (thing("/R/w/radiator", (0, 0, 0.1), (1, 0.06, 0.6)), "Appliance")
        valve = (thing("/R/w/radiator_valve", (1.002, 0, 0.6), (0.08, 0.05, 0.05)), "DesignedComponent")
        assert set(parts(frame, pane, radiator, valve)) == {
            ("/R/w/pane", "/R/w/window_frame"),
            ("/R/w/radiator_valve", "/R/w/radiator"),
        }

    def test_shade_and_bulb_are_parts_of_the_lamp(self):
        foot = (thing("/R/l/desk_lamp", (0, 0, 0), (0.1, 0.1, 0.3)), "DesignedArtifact")
        shade = (thing("/R/l/lampshade", (-0.1, -0.1, 0.28), (0.3, 0.3, 0.2)), "DesignedComponent")
        bulb = (thing("/R/l/bulb", (0.03, 0.03, 0.3), (0.04, 0.04, 0.1)), "DesignedComponent")
        concepts = ground(make_scene(foot[0], shade[0], bulb[0]), load_home_tbox())
        found = find_relations(
            make_scene(foot[0], shade[0], bulb[0]), load_home_tbox(), concepts, RelationOptions(kinds=("part-of",))
        )
        assert {(r.target, r.anchor) for r in found} == {
            ("/R/l/lampshade", "/R/l/desk_lamp"),
            ("/R/l/bulb", "/R/l/desk_lamp"),
        }

    def test_a_handle_of_a_case_of_any_class(self):
        case = (thing("/R/s/case", (0, 0, 0), (0.6, 0.4, 0.15)), "DesignedArtifact")
        handle = (thing("/R/s/handle", (0.2, -0.03, 0.07), (0.2, 0.03, 0.02)), "DesignedHandle")
        assert list(parts(case, handle)) == [("/R/s/handle", "/R/s/case")]
