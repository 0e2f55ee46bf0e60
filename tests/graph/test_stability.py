"""A change in the scene changes only the statements about the changed object."""

from dataclasses import replace

import pyoxigraph as ox

from tests.graph.records import build_graph, thing
from tests.graph.test_joint_patterns import make_joint
from usd2kg.graph import KnowledgeGraph, serialize_graph
from usd2kg.ontology import TBox
from usd2kg.scene import Label, ObjectLabels, SceneObject

TABLE = thing("/Room/Table", (0, 0, 0), (2, 1, 0.7), mass_kg=20.0)
NAMES = ("Cup_1", "Cup_2", "Cup_3")


def cup(name: str, place: int) -> SceneObject:
    path = f"/Room/{name}"
    return thing(path, (0.3 * place, 0.3, 0.7), (0.1, 0.1, 0.1), mass_kg=0.2, display_color=(1.0, 0.0, 0.0))


def lines_of(graph: KnowledgeGraph) -> set[str]:
    return set(serialize_graph(graph, ox.RdfFormat.N_TRIPLES).decode().splitlines())


def room(home_tbox: TBox, *cups: SceneObject) -> set[str]:
    hinge = make_joint(prim_path="/Room/Table/hinge", body0=None, body1="/Room/Table")
    return lines_of(build_graph(home_tbox, [(TABLE, "Table"), *((one, "Cup") for one in cups)], joints=[hinge]))


def test_renaming_one_prim_changes_its_own_statements_only(home_tbox: TBox):
    cups = [cup(name, place) for place, name in enumerate(NAMES)]
    before = room(home_tbox, *cups)
    after = room(home_tbox, cups[0], cup("Mug", 1), cups[2])
    renamed = {line.replace("Cup_2", "Mug") for line in before - after}
    # Blank nodes of its axioms change, since their labels hash the statements.
    named = {line for line in after - before if not line.startswith("_:axiom")}
    assert named == {line for line in renamed if not line.startswith("_:axiom")}
    assert len(before) == len(after)
    for line in before - after:
        assert "Cup_2" in line or line.startswith("_:axiom")
    # Axioms of its type and of its support.
    axioms = {line.split()[0] for line in before - after if line.startswith("_:axiom")}
    assert len(axioms) == 2


def test_a_new_object_adds_statements_and_changes_none(home_tbox: TBox):
    cups = [cup(name, place) for place, name in enumerate(NAMES)]
    assert room(home_tbox, *cups) > room(home_tbox, *cups[:2])
    assert room(home_tbox, *cups) > room(home_tbox, *cups[1:])


def test_the_order_of_objects_changes_the_order_of_statements_only(home_tbox: TBox):
    cups = [cup(name, place) for place, name in enumerate(NAMES)]
    assert room(home_tbox, *cups) == room(home_tbox, *reversed(cups))


def test_statements_of_one_object_are_contiguous(home_tbox: TBox):
    labelled = replace(
        cup("Cup_2", 1), labels=ObjectLabels((Label("/Room/Cup_2", "UsdSemantics", "class", "mug"),), (), ())
    )
    placed = [(TABLE, "Table"), (cup("Cup_1", 0), "Cup"), (labelled, "Cup"), (cup("Cup_3", 2), "Cup")]
    turtle = serialize_graph(build_graph(home_tbox, placed), ox.RdfFormat.TURTLE).decode()
    for name in NAMES:
        assert turtle.count(f"\n:Room.{name} a ") == 1, "its statements are one block"
    start, end = turtle.index("\n:Room.Cup_2 a "), turtle.index("\n:Room.Cup_3 a ")
    block = turtle[start:end]
    (members,) = [line for line in turtle.splitlines() if line.startswith("\tdul:hasMember")]
    assert turtle.count("Room.Cup_2") == block.count("Room.Cup_2") + members.count("Room.Cup_2")
    assert "Cup_1" not in block
