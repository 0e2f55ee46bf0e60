"""The example queries of the page fit the graph that is served."""

import pytest

import usd2kg
from tests.graph.records import build_graph, thing
from usd2kg.demo import demo_scene
from usd2kg.endpoint.example_queries import make_examples
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore
from usd2kg.query.questions import list_questions

TABLE = (thing("/Table", (0, 0, 0), (1, 1, 1)), "Table")
FAR = (thing("/Cup", (5, 5, 0), (0.1, 0.1, 0.1), name="lonely cup"), "Cup")
MUG = (thing("/Mug", (0.4, 0.4, 1), (0.1, 0.1, 0.1), name="mug"), "Cup")


def store_of(home_tbox: TBox, *placed) -> GraphStore:
    graph = build_graph(home_tbox, placed)
    return GraphStore.from_triples(graph.triples, "g")


def examples(store: GraphStore) -> dict[str, list[str | None]]:
    """Return title of each example → the first column of its answer."""
    return {one.title: [row[0] for row in store.sparql(one.query).rows] for one in make_examples(store.store)}


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_all_examples_of_the_demo_have_an_answer(profile: str):
    graph = usd2kg.build(demo_scene(), profile=profile).graph
    found = examples(GraphStore.from_triples(graph.triples, "g"))
    # Masses and shared assets are not authored, and a route has two ends.
    assert len(found) == len(list_questions()) - 4
    assert [title for title, rows in found.items() if not rows] == []


def test_without_relations_no_question_is_about_one(home_tbox):
    titles = examples(store_of(home_tbox, TABLE, FAR)).keys()
    assert not any(word in title for title in titles for word in (" on ", "inside", "supports", "connect", "joint"))
    assert "How many objects of each class are there?" in titles
    assert any(title.startswith("Which objects of kind") for title in titles)


def test_the_objects_of_a_relation_are_asked_about(home_tbox):
    found = examples(store_of(home_tbox, TABLE, MUG, FAR))
    assert found["Which containers on Table can hold liquid?"] == ["mug"]
    assert found["What supports mug, down to the floor?"] == ["Table"]
    assert found["What moves along if Table is moved?"] == ["mug"]
    assert not any(title.startswith(("Which joints", "Which rooms", "What is on the same")) for title in found)


def test_what_carries_something_heavy_is_asked_about_for_heavy_things(home_tbox):
    heavy = thing("/Table/Cup", (0.4, 0.4, 1), (0.3, 0.3, 0.3), name="heavy cup", mass_kg=8.0), "Cup"
    light = thing("/Table/Cup", (0.4, 0.4, 1), (0.3, 0.3, 0.3), name="light cup", mass_kg=4.0), "Cup"
    found = examples(store_of(home_tbox, TABLE, heavy, FAR))
    assert found["What is heavier than 5 kg and within 1 m of Table?"] == ["heavy cup"]
    assert not any(title.startswith("What is heavier") for title in examples(store_of(home_tbox, TABLE, light, FAR)))


def test_a_graph_without_objects_has_few_examples():
    assert [one.title for one in make_examples(GraphStore.from_triples((), "g").store)] == [
        "How many objects of each class are there?"
    ]
