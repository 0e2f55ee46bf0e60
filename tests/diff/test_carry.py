"""Decisions about an earlier scene apply to the same objects of the new scene."""

from dataclasses import replace

from tests.diff.records import item, rename
from tests.graph.records import BASE, reread, said_of, select, thing
from tests.grounding.records import make_scene
from usd2kg.diff import ObjectState, carry_decisions, objects_of_graph, objects_of_scene
from usd2kg.graph import GraphOptions, instantiate
from usd2kg.grounding import DecisionOrigin, Status, ground
from usd2kg.ontology import TBox

CUP = item("/Room/Cup_1")
MUG = rename(CUP, "/Room/Mug")
TABLE = item("/Room/Table", (3, 0, 0), (2, 1, 0.7))


def test_decision_follows_a_renamed_object() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Room/Table": "Table"}, [CUP, TABLE], [MUG, TABLE])
    assert found.decisions == {"/Room/Mug": "Cup", "/Room/Table": "Table"}
    assert found.carried == {
        "/Room/Mug": DecisionOrigin("/Room/Cup_1", "renamed: same asset, same size, same class, in place")
    }
    assert found.unplaced == ()


def test_decisions_follow_objects_that_exchange_their_paths() -> None:
    exchanged = [rename(CUP, TABLE.prim_path), rename(TABLE, CUP.prim_path)]
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Room/Table": "Table"}, [CUP, TABLE], exchanged)
    assert found.decisions == {"/Room/Table": "Cup", "/Room/Cup_1": "Table"}


def test_lists_decisions_about_removed_and_unknown_objects() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Elsewhere": "Bowl"}, [CUP, TABLE], [TABLE])
    assert found.decisions == {}
    assert [(each.prim_path, each.class_iri, each.reason) for each in found.unplaced] == [
        ("/Room/Cup_1", "Cup", "removed"),
        ("/Elsewhere", "Bowl", "in neither scene"),
    ]


def test_decision_does_not_apply_to_another_object_at_the_same_path() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup"}, [CUP, TABLE], [rename(TABLE, "/Room/Cup_1")])
    assert found.decisions == {}
    assert found.unplaced[0].reason == "removed; its path now belongs to another object"


def test_decision_about_the_new_path_wins() -> None:
    found = carry_decisions({"/Room/Cup_1": "Cup", "/Room/Mug": "Mug"}, [CUP], [MUG])
    assert (found.decisions, found.carried) == ({"/Room/Mug": "Mug"}, {})
    assert found.unplaced[0].reason == "is now /Room/Mug, which has a decision of its own"


def test_graph_states_the_origin_of_a_carried_decision(home_tbox: TBox) -> None:
    scene = make_scene(thing("/Room/Mug", (0, 0, 0), (0.1, 0.1, 0.1)))
    iri = home_tbox.resolve("Cup")
    carried = {"/Room/Mug": DecisionOrigin("/Room/Cup_1", "renamed")}
    grounding = ground(scene, home_tbox, decisions={"/Room/Mug": iri}, carried=carried)
    (prediction,) = grounding.predictions
    assert (prediction.status, prediction.decided_for) == (Status.REVIEWED, "/Room/Cup_1")
    store = reread(instantiate(scene, home_tbox, grounding, base=BASE))
    annotations = said_of(store, f"<{BASE}Room.Mug> rdf:type <{iri}>")
    assert annotations["https://w3id.org/usd2kg#decidedFor"] == "/Room/Cup_1"
    assert "/Room/Cup_1" in annotations["https://w3id.org/usd2kg#explanation"]
    assert select(store, "SELECT ?k { u2k:decidedFor a ?k }") == [("http://www.w3.org/2002/07/owl#AnnotationProperty",)]


def test_scene_and_its_graph_give_the_same_objects(home_tbox: TBox) -> None:
    cup = thing("/Room/Cup", (1, 2, 3), (0.1, 0.2, 0.3), mass_kg=0.25, asset=("mug", "mug_v2"))
    scene = make_scene(
        replace(cup, position=(1.0, 2.0, 3.0), orientation=(0.0, 0.0, 0.6, 0.8), oriented_size=(0.1, 0.15, 0.3)),
        thing("/Room/Table", (0, 0, 0), (2, 1, 0.7)),
        replace(cup, prim_path="/Room/WithoutBox", box=None, own_box=None),
    )
    grounding = ground(scene, home_tbox, "dictionary", paths=())
    for profile in ("soma", "plain"):
        for annotations in ("owl", "rdf12"):
            options = GraphOptions(annotations=annotations)
            graph = instantiate(scene, home_tbox, grounding, base=BASE, profile=profile, options=options)
            found = objects_of_graph(graph.triples, "room.ttl")
            from_graph = [replace(_rounded(state), iri="", links=frozenset()) for state in found]
            assert from_graph == [_rounded(state) for state in objects_of_scene(scene)]
            assert found[0].iri == f"{BASE}Room.Cup"


def _rounded(state: ObjectState) -> ObjectState:
    size, box_size, center = (
        value and tuple(round(side, 6) for side in value) for value in (state.size, state.box_size, state.center)
    )
    return replace(state, size=size, box_size=box_size, center=center)
