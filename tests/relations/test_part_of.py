"""part-of."""

from typing import Any

import pytest

from tests.graph.records import related, thing
from tests.grounding.records import make_object, make_scene
from tests.relations.room_builder import RULES, Placed, relate
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
