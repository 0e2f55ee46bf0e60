"""Drawers, doors and handles by what their names mean and by their form."""

import math

from tests.graph.records import thing
from tests.grounding.records import make_scene
from tests.relations.room_builder import FLOOR, Placed, relate
from usd2kg.grounding import ground
from usd2kg.ontology import load_home_tbox
from usd2kg.relations import find_relations
from usd2kg.scene import SceneObject

FLOOR_OBJECT = thing("/Room/Floor", (-3, -3, -0.1), (6, 6, 0.1))


def named(*objects: SceneObject) -> set[tuple[str, str, str]]:
    """Return (target, kind, anchor) by the last names, with the classes that the names mean."""
    scene, tbox = make_scene(FLOOR_OBJECT, *objects), load_home_tbox()
    found = find_relations(scene, tbox, ground(scene, tbox))
    return {(r.target.rpartition("/")[2], r.kind, r.anchor.rpartition("/")[2]) for r in found}


def fitted(*placed: Placed) -> set[tuple[str, str]]:
    return {(r.target, r.anchor) for r in relate(*placed, kinds=("part-of",))}


class TestNames:
    def test_a_drawer_cabinet_is_the_whole_of_its_drawers(self):
        cabinet = thing("/Room/Parts/Drawer_cabinet", (0, 0, 0), (0.6, 0.2, 0.4))
        # One is pulled out by more than half.
        drawers = [
            thing(f"/Room/Parts/Small_parts_drawer_{n}", (0.02 + 0.2 * n, y, 0.1), (0.16, 0.18, 0.1))
            for n, y in enumerate((0.0, -0.1))
        ]
        found = named(cabinet, *drawers)
        for n in range(2):
            assert (f"Small_parts_drawer_{n}", "part-of", "Drawer_cabinet") in found

    def test_a_pedestal_drawer_is_a_part_of_its_cabinet(self):
        cabinet = thing("/Room/Pedestal/Cabinet", (0, 0, 0), (0.4, 0.56, 0.6))
        drawer = thing("/Room/Pedestal/Drawer_1", (0.02, -0.14, 0.4), (0.36, 0.52, 0.15))
        assert ("Drawer_1", "part-of", "Cabinet") in named(cabinet, drawer)

    def test_a_crank_puller_on_a_cabinet_is_no_handle(self):
        cabinet = thing("/Room/Cabinet", (0, 0, 0), (0.5, 0.7, 0.95))
        puller = thing("/Room/Crank_puller", (0.2, 0.3, 0.951), (0.03, 0.09, 0.06))
        found = named(cabinet, puller)
        assert ("Crank_puller", "on", "Cabinet") in found
        assert ("Crank_puller", "part-of", "Cabinet") not in found


class TestForms:
    BOX = (thing("/breaker", (0, 0, 1.4), (0.3, 0.09, 0.44)), "DesignedComponent")

    def test_a_component_that_covers_a_face_is_a_door(self):
        cover = (thing("/cover", (0.005, -0.011, 1.405), (0.29, 0.01, 0.43)), "DesignedComponent")
        assert fitted(self.BOX, cover) == {("/cover", "/breaker")}

    def test_a_component_beside_or_smaller_than_a_face_is_none(self):
        apart = (thing("/apart", (0.005, -0.05, 1.405), (0.29, 0.01, 0.43)), "DesignedComponent")
        label = (thing("/label", (0.1, -0.011, 1.5), (0.1, 0.01, 0.05)), "DesignedComponent")
        assert fitted(self.BOX, apart, label) == set()

    def test_an_open_door_belongs_to_a_flat_cabinet(self):
        # Its axis-aligned box is larger than that of the cabinet.
        cabinet = (thing("/cabinet", (0, 0, 1.6), (0.32, 0.06, 0.3)), "Cupboard")
        width, thickness, angle = 0.32, 0.01, math.radians(70)
        size = (
            width * math.cos(angle) + thickness * math.sin(angle),
            width * math.sin(angle) + thickness * math.cos(angle),
            0.3,
        )
        turned = {
            "oriented_size": (width, thickness, 0.3),
            "orientation": (0.0, 0.0, -math.sin(angle / 2), math.cos(angle / 2)),
        }
        door = (thing("/door", (0.001, -size[1] - 0.001, 1.6), size, **turned), "Door")
        assert fitted(cabinet, door) == {("/door", "/cabinet")}


def test_a_floor_too_small_for_a_room_lies_on_the_floor():
    cardboard = (thing("/cardboard", (1, 1, -0.001), (0.75, 0.7, 0.005)), "Floor")
    assert {(r.target, r.kind, r.anchor) for r in relate(FLOOR, cardboard)} == {("/cardboard", "on", "/floor")}


def test_a_cup_on_a_small_floor_is_on_it():
    cardboard = (thing("/cardboard", (1, 1, -0.001), (0.75, 0.7, 0.005)), "Floor")
    cup = (thing("/cup", (1.2, 1.2, 0.004), (0.1, 0.1, 0.1)), "Cup")
    assert ("/cup", "on", "/cardboard") in {(r.target, r.kind, r.anchor) for r in relate(FLOOR, cardboard, cup)}
