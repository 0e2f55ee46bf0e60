"""Decisions go with the things that they are about, and none is lost."""

from dataclasses import replace

from tests.diff.records import item
from tests.graph.records import BASE, reread, said_of, select, thing
from tests.grounding.records import make_scene
from usd2kg.diff import ObjectState, carry_decisions, objects_of_graph, objects_of_scene
from usd2kg.graph import GraphOptions, instantiate
from usd2kg.grounding import Carried, Status, ground
from usd2kg.ontology import TBox

CUP = item("/Room/Cup_1")
TABLE = item("/Room/Table", (3, 0, 0), (2, 1, 0.7))


def test_a_decision_goes_with_what_was_renamed() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Room/Table": "Table"}, [CUP, TABLE], [renamed(), TABLE])
    assert found.decisions == {"/Room/Mug": "Cup", "/Room/Table": "Table"}
    assert found.carried == {
        "/Room/Mug": Carried("/Room/Cup_1", "renamed: same asset, same size, same class, in place")
    }
    assert found.unplaced == ()


def renamed():
    return replace(CUP, prim_path="/Room/Mug")


def test_what_is_gone_is_listed() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Elsewhere": "Bowl"}, [CUP, TABLE], [TABLE])
    assert found.decisions == {}
    told = [(each.prim_path, each.class_iri, each.reason) for each in found.unplaced]
    assert told == [("/Room/Cup_1", "Cup", "gone"), ("/Elsewhere", "Bowl", "in neither scene")]


def test_a_path_that_another_thing_has_now_does_not_get_the_decision() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup"}, [CUP, TABLE], [replace(TABLE, prim_path="/Room/Cup_1")])
    assert found.decisions == {}
    assert found.unplaced[0].reason == "gone, and its path is another thing's now"


def test_a_decision_about_the_new_path_goes_first() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Room/Mug": "Mug"}, [CUP], [renamed()])
    assert found.decisions == {"/Room/Mug": "Mug"}
    assert found.carried == {}
    assert found.unplaced[0].reason == "is /Room/Mug now, which has a decision of its own"


def test_two_things_that_take_each_others_names() -> None:
    """Cup and table swap their paths: asset and size tell."""
    swapped = [replace(CUP, prim_path=TABLE.prim_path), replace(TABLE, prim_path=CUP.prim_path)]
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Room/Table": "Table"}, [CUP, TABLE], swapped)
    assert found.decisions == {"/Room/Table": "Cup", "/Room/Cup_1": "Table"}


def test_the_graph_tells_where_a_decision_comes_from(home_tbox: TBox) -> None:
    scene = make_scene(thing("/Room/Mug", (0, 0, 0), (0.1, 0.1, 0.1)))
    iri = home_tbox.resolve("Cup")
    grounding = ground(
        scene, home_tbox, decisions={"/Room/Mug": iri}, carried={"/Room/Mug": Carried("/Room/Cup_1", "renamed")}
    )
    (prediction,) = grounding.predictions
    assert (prediction.status, prediction.decided_for) == (Status.REVIEWED, "/Room/Cup_1")
    store = reread(instantiate(scene, home_tbox, grounding, base=BASE))
    said = said_of(store, f"<{BASE}Room.Mug> rdf:type <{iri}>")
    assert said["https://w3id.org/usd2kg#decidedFor"] == "/Room/Cup_1"
    assert said["https://w3id.org/usd2kg#explanation"] == (
        "a person decided so about /Room/Cup_1, the same thing (renamed)"
    )
    assert select(store, "SELECT ?k { u2k:decidedFor a ?k }") == [("http://www.w3.org/2002/07/owl#AnnotationProperty",)]


def test_a_scene_and_its_graph_give_the_same_things(home_tbox: TBox) -> None:
    turned = thing("/Room/Cup", (1, 2, 3), (0.1, 0.2, 0.3), mass_kg=0.25, asset=("mug", "mug_v2"))
    scene = make_scene(
        replace(turned, position=(1.0, 2.0, 3.0), orientation=(0.0, 0.0, 0.6, 0.8), oriented_size=(0.1, 0.15, 0.3)),
        thing("/Room/Table", (0, 0, 0), (2, 1, 0.7)),
        replace(turned, prim_path="/Room/Ghost", box=None, own_box=None),
    )
    grounding = ground(scene, home_tbox, "dictionary", paths=())
    for profile in ("soma", "plain"):
        for annotations in ("owl", "rdf12"):
            options = GraphOptions(annotations=annotations)
            graph = instantiate(scene, home_tbox, grounding, base=BASE, profile=profile, options=options)
            found = objects_of_graph(graph.triples, "room.ttl")
            known = [replace(_rounded(each), iri="", links=frozenset()) for each in found]
            assert known == [_rounded(each) for each in objects_of_scene(scene)]
            assert found[0].iri == f"{BASE}Room.Cup"


def _rounded(one: ObjectState) -> ObjectState:
    size, center = (value and tuple(round(side, 6) for side in value) for value in (one.size, one.center))
    return replace(one, size=size, center=center)
