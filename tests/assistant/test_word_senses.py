"""Words that occur in names of other things, name rooms or the whole scene, or count."""

import pytest

from tests.graph.records import BASE, open_store, thing
from tests.grounding.records import make_scene
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.graph import instantiate
from usd2kg.grounding import ground
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

FLAT = [
    thing("/Flat/Floor", (-3, -3, -0.1), (6, 6, 0.1)),
    thing("/Flat/HouseWall", (-3, 3, 0), (6, 0.1, 2.5)),
    thing("/Flat/Picture", (0, 2.97, 1.5), (0.6, 0.03, 0.4)),
    thing("/Flat/KitchenCabinet", (2, 2.4, 0), (0.6, 0.6, 0.9)),
    thing("/Flat/ShoeRack", (-2, 2.5, 0), (0.8, 0.4, 0.5)),
    thing("/Flat/Rug", (-1, -1, 0), (2, 2, 0.01)),
    thing("/Flat/Table", (-0.5, -0.5, 0.01), (1, 1, 0.7)),
    thing("/Flat/Mug_1", (0, 0, 0.71), (0.08, 0.08, 0.1)),
    thing("/Flat/Refrigerator", (2, -2, 0), (0.7, 0.7, 1.8)),
]


@pytest.fixture(scope="module", params=["soma", "plain"])
def flat(home_tbox: TBox, request: pytest.FixtureRequest) -> GraphStore:
    scene = make_scene(*FLAT)
    return open_store(instantiate(scene, home_tbox, ground(scene, home_tbox), base=BASE, profile=request.param))


@pytest.mark.parametrize(
    ("question", "message"),
    [
        ("are there shoes?", "nothing is known to be shoes, which is only in the name of ShoeRack"),
        ("how many shoes are there?", "only in the name of ShoeRack"),
        ("what is in the kitchen?", "there is no kitchen in this scene"),
    ],
)
def test_a_word_in_the_name_of_something_else_is_no_answer(flat: GraphStore, question: str, message: str):
    with pytest.raises(GraphError, match=message):
        ask_offline(flat, question)


def test_the_house_is_the_whole_scene(flat: GraphStore):
    assert ask_offline(flat, "how many tables are in the house?").number == 1
    assert ask_offline(flat, "how many racks does the flat have?").number == 1


@pytest.mark.parametrize(
    ("question", "expected"), [("are there two mugs on the table?", False), ("is there one mug?", True)]
)
def test_numbers_count(flat: GraphStore, question: str, expected: bool):
    assert ask_offline(flat, question).verdict is expected


def test_too_few_are_named(flat: GraphStore):
    answered = ask_offline(flat, "are there two tables?")
    assert (answered.verdict, answered.sentence) == (False, "No: there is a table.")
    assert ask_offline(flat, "is there a piano?").sentence == "No: there is no piano in this scene."


def test_what_hangs_on_a_wall_is_attached_to_it(flat: GraphStore):
    assert [row[0] for row in ask_offline(flat, "what hangs on the wall?").answer.rows] == ["Picture"]


def test_a_rug_is_under_the_table_that_stands_on_it(flat: GraphStore):
    assert ask_offline(flat, "is there a rug under the table?").verdict is True


def test_a_fridge_is_a_refrigerator(flat: GraphStore):
    assert [row[0] for row in ask_offline(flat, "where is the fridge?").answer.rows] == ["Refrigerator"]
