"""Nouns that are near to what the graph states: other names of a class, compounds, acronyms; things between others."""

import pytest

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

# Seen from above: a bed that reaches into the room, with a nightstand at each side of its head.
ROOM = [
    (thing("/R/Bed", (0, -2, 0), (1.8, 2, 0.5)), "DesignedFurniture"),
    (thing("/R/Stand_L", (-0.6, -0.4, 0), (0.5, 0.4, 0.6)), "BedsideTable"),
    (thing("/R/Stand_R", (1.9, -0.4, 0), (0.5, 0.4, 0.6)), "BedsideTable"),
    (thing("/R/Rug", (-2, -3, 0), (6, 4, 0.02)), "DesignedArtifact"),
    (thing("/R/TV_1", (0, 3, 1), (1.2, 0.1, 0.7)), "DesignedArtifact"),
    (thing("/R/TV_2", (3, 3, 1), (1.2, 0.1, 0.7)), "DesignedArtifact"),
    (thing("/R/Trash_1", (4, 0, 0), (0.3, 0.3, 0.3)), "TrashContainer"),
]


@pytest.fixture(scope="module")
def room(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM))


def labels(graph: GraphStore, question: str) -> list[str | None]:
    return [row[0] for row in ask_offline(graph, question).answer.rows]


@pytest.mark.parametrize("noun", ["trash can", "bin", "waste container"])
def test_a_class_may_have_other_names(room: GraphStore, noun: str):
    assert labels(room, f"which {noun} is closest to the bed?") == ["Trash_1"]


def test_acronyms_have_plurals(room: GraphStore):
    assert ask_offline(room, "How far apart are the two TVs?").number == pytest.approx(1.8)


@pytest.mark.parametrize("pair", ["the two bedside tables", "the bedside tables", "Stand_L and Stand_R"])
def test_what_fills_the_way_between_two_things_is_between_them(room: GraphStore, pair: str):
    assert labels(room, f"what is between {pair}?") == ["Bed"]


def test_a_compound_is_not_read_as_one_thing_of_several_kinds(kitchen: GraphStore):
    with pytest.raises(GraphError, match="no pool table"):
        ask_offline(kitchen, "What is lying on the pool table?")


def test_people_say_electrical_appliance_for_an_appliance(kitchen: GraphStore):
    assert {"coffeeMachine", "toaster"} <= set(labels(kitchen, "which electrical appliances stand on the worktop?"))


def test_a_listed_compound_may_contain_an_ordinal(kitchen: GraphStore):
    assert ask_offline(kitchen, "is there a first aid kit in the fridge?").verdict is False


def test_drinks_and_food_are_in_their_packaging(kitchen: GraphStore):
    drinks = labels(kitchen, "what drinks are there?")
    assert {"milkCarton_1", "orangeJuice", "water_btl_02", "WnBttl_1"} <= set(drinks)
    assert {"flourBag", "can_tomato_1"} <= set(labels(kitchen, "What food is on the pantry shelf?"))


@pytest.mark.parametrize(
    "question", ["what is on the ledge of the sideboard?", "what is lying on the sideboard's ledge?"]
)
def test_a_part_that_is_no_object_is_its_whole(kitchen: GraphStore, question: str):
    found = ask_offline(kitchen, question)
    assert {"birdCage", "cakeStand"} <= {row[0] for row in found.answer.rows}
    assert "was read as “sideboard”" in found.sentence


@pytest.mark.parametrize(
    "question", ["By how many degrees can the fridge door swing open?", "how far does the fridge open?"]
)
def test_doors_turn_by_degrees(kitchen: GraphStore, question: str):
    assert ask_offline(kitchen, question).number == 100


def test_what_has_no_joint_opens_by_its_kind(kitchen: GraphStore):
    assert ask_offline(kitchen, "can I open the dishwasher?").verdict is True
    assert {"dishWasher", "drwr_L1", "Fridge_01"} <= set(labels(kitchen, "what can I open here?"))


def test_empty_is_said_of_the_thing_that_is_meant(kitchen: GraphStore):
    assert ask_offline(kitchen, "Is the oven empty?").verdict is False


def test_what_is_put_somewhere_may_be_absent(kitchen: GraphStore):
    assert ask_offline(kitchen, "where could I put a vase of flowers down?").places
    assert "of usual size" in ask_offline(kitchen, "where can I put a laptop?").sentence
    with pytest.raises(GraphError):
        ask_offline(kitchen, "where can I put the laptop?")


@pytest.mark.parametrize("question", ["With what could I sweep the floor?", "anything I can sweep the floor with?"])
def test_tools_for_a_purpose(kitchen: GraphStore, question: str):
    assert labels(kitchen, question) == ["broom"]


def test_a_name_in_parentheses_is_that_of_the_noun(kitchen: GraphStore):
    assert labels(kitchen, "what is in the fridge (Fridge_01)?") == labels(kitchen, "what is in the fridge?")
