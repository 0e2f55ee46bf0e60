"""What hangs by its nature, known by the concept of its name."""

from dataclasses import replace

from tests.graph.records import thing
from tests.grounding.records import make_scene
from usd2kg.grounding import ground
from usd2kg.ontology import load_home_tbox
from usd2kg.relations import find_relations

ROOM = make_scene(
    thing("/Room/floor", (-3, -3, -0.1), (6, 6, 0.1)),
    thing("/Room/wall", (-3, 3, 0), (6, 0.2, 2.5)),
    thing("/Room/curtain", (0, 2.85, 0), (1, 0.05, 2.4)),
    thing("/Room/panel", (2, 2.85, 0), (1, 0.05, 2.4)),
)


def held(scene) -> set[tuple[str, str, str]]:
    tbox = load_home_tbox()
    found = find_relations(scene, tbox, ground(scene, tbox))
    return {(r.target[6:], r.kind, r.anchor[6:]) for r in found if r.kind in {"on", "attached-to"}}


def test_a_curtain_that_reaches_the_floor_hangs_and_a_panel_stands():
    # Both are 10 cm off the wall.
    assert held(ROOM) == {("curtain", "attached-to", "wall"), ("panel", "on", "floor")}


def test_a_curtain_without_a_wall_is_on_nothing():
    bare = replace(ROOM, objects=tuple(obj for obj in ROOM.objects if obj.name != "wall"))
    assert held(bare) == {("panel", "on", "floor")}
