"""Questions about rooms that no prim is, and about what connects them."""

import pyoxigraph as ox
import pytest

from tests.graph.records import BASE, ground_as
from tests.grounding.records import make_scene
from tests.relations.test_derived_rooms import BED, FLAT, SOFA, door
from usd2kg.assistant import ask_offline
from usd2kg.graph import instantiate
from usd2kg.ontology import load_home_tbox
from usd2kg.query import GraphStore
from usd2kg.query.dataset import Dataset


@pytest.fixture(scope="module", params=["soma", "plain"])
def flat(request: pytest.FixtureRequest) -> GraphStore:
    """Room 1 with a sofa, room 2 with a bed, a door between them, and one that leads outside."""
    between = door("door_bedroom", (5.02, 3.1, 0), (0.06, 0.9, 2.1))
    front = door("door_front", (1, -0.08, 0), (0.9, 0.06, 2.1))
    placed = [*FLAT, SOFA, BED, between, front]
    tbox = load_home_tbox()
    scene = make_scene(*(obj for obj, _ in placed))
    grounding = ground_as(tbox, scene, {obj.prim_path: cls for obj, cls in placed if cls})
    store = ox.Store()
    graph = instantiate(scene, tbox, grounding, base=BASE, profile=request.param)
    store.extend(ox.Quad(*triple) for triple in graph.triples)
    return GraphStore(Dataset(store), "flat")


def test_what_a_door_connects(flat: GraphStore):
    found = flat.answer("connects", {"thing": "door_bedroom"})
    assert [row[:2] for row in found.rows] == [("door_bedroom", "room 1"), ("door_bedroom", "room 2")]
    assert [row[1] for row in ask_offline(flat, "Where does door_front lead to?").answer.rows] == ["room 1"]


@pytest.mark.parametrize(
    "question",
    [
        "How do I get from the sofa to the bed?",
        "route from room 1 to room 2",
        "How can the robot drive to the bed from room 1?",
    ],
)
def test_the_route_between_rooms_or_things_in_them(flat: GraphStore, question: str):
    found = ask_offline(flat, question).answer
    assert found.columns == ("step", "object", "path", "room", "length_m")
    assert [(row[1], row[3]) for row in found.rows] == [("door_bedroom", "room 2")]


def test_there_is_no_route_within_a_room_or_through_a_door_to_the_outside(flat: GraphStore):
    assert flat.answer("route", {"thing": "sofa", "other": "room 1"}).rows == ()
    assert flat.answer("route", {"thing": "sofa", "other": "door_front"}).rows == ()


def test_the_doors_of_a_room_and_where_they_lead(flat: GraphStore):
    found = ask_offline(flat, "Which doors lead into room 1?").answer
    assert [(row[0], row[3]) for row in found.rows] == [("door_bedroom", "room 2"), ("door_front", None)]


def test_what_is_in_a_room(flat: GraphStore):
    assert "is in room 2." in ask_offline(flat, "What is in room 2?").sentence
    assert ask_offline(flat, "How many rooms are there?").number == 2
    assert "in room 1" in ask_offline(flat, "Where is the sofa?").sentence
