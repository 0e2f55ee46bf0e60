"""Questions that compare things: superlatives, two things, numbers, limits, and whether something fits."""

import pytest

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore
from usd2kg.query.lookup.amounts import read_amount, read_sides

ROOM = [
    (thing("/R/Floor", (-3, -3, -0.1), (6, 6, 0.1)), "Floor"),
    (thing("/R/Table", (0, 0, 0), (1.2, 0.8, 0.7), mass_kg=20.0), "Table"),
    (thing("/R/Cup_1", (0.1, 0.1, 0.7), (0.08, 0.08, 0.1), mass_kg=0.3), "Cup"),
    (thing("/R/Cup_2", (0.3, 0.1, 0.7), (0.08, 0.08, 0.12), mass_kg=0.4), "Cup"),
    (thing("/R/Wardrobe", (2, 2, 0), (1, 0.6, 2), mass_kg=60.0), "Wardrobe"),
    (thing("/R/Chair", (-1, 0, 0), (0.5, 0.5, 0.9), mass_kg=5.0), "DesignedChair"),
]


@pytest.fixture(scope="module", params=["soma", "plain"])
def room(home_tbox: TBox, request: pytest.FixtureRequest) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM, profile=request.param))


def labels(graph: GraphStore, question: str) -> list[str | None]:
    return [row[0] for row in ask_offline(graph, question).answer.rows]


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("give me the two tallest things", ["Wardrobe", "Chair"]),
        ("what are the 3 heaviest objects?", ["Wardrobe", "Table", "Chair"]),
        ("which is taller, the wardrobe or the chair?", ["Wardrobe"]),
        ("what's heavier, a cup or a chair?", ["Chair"]),
        ("is the table or the chair lighter?", ["Chair"]),
        ("what weighs more than 4 kg?", ["Chair", "Table", "Wardrobe"]),
        ("which cups are taller than 11 cm", ["Cup_2"]),
        ("list everything that is lighter than 350 g", ["Cup_1"]),
        ("which things are wider than 3 feet", ["Floor", "Table", "Wardrobe"]),
        ("what stands closest to the chair?", ["Table"]),
        ("the cup that is closest to the chair", ["Cup_1"]),
        ("show me everything that is on the table", ["Cup_1", "Cup_2"]),
        ("fetch me the chair", ["Chair"]),
        ("where would I find a cup?", ["Cup_1", "Cup_2"]),
    ],
)
def test_objects(room: GraphStore, question: str, expected: list[str]):
    assert labels(room, question) == expected


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("how tall is the tallest cup?", 0.12),
        ("how far apart are the two cups?", 0.12),
        ("how many things are heavier than 1 kg?", 3),
        ("what is the total number of cups?", 2),
        ("how many cups are there in total?", 2),
        ("how many objects are there altogether?", 6),
    ],
)
def test_numbers(room: GraphStore, question: str, expected: float):
    assert ask_offline(room, question).number == pytest.approx(expected)


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("are there more cups than chairs?", True),
        ("are there fewer cups than chairs?", False),
        ("could a box of 40 by 30 by 20 cm be put on the table?", True),
        ("is there enough room on the table for a box of 130 x 90 x 20 cm?", False),
        ("would the chair fit on the table?", True),
        ("do any cups stand on the table?", True),
        ("have we got any chairs?", True),
        ("can you see a piano anywhere?", False),
    ],
)
def test_yes_or_no(room: GraphStore, question: str, expected: bool):
    answered = ask_offline(room, question)
    assert answered.verdict is expected
    assert answered.sentence.startswith("Yes" if expected else "No")


@pytest.mark.parametrize(
    ("question", "sentence"),
    [
        ("is the wardrobe heavier than the table?", "Yes: 60 kg against 20 kg."),
        ("is the chair taller than the cups?", "Yes: 90 cm against 10 cm to 12 cm."),
        ("are the cups bigger than the chair?", "No: 0.000641 to 0.000769 against 0.225 m³."),
        ("is Cup_2 heavier than Cup_1?", "Yes: 400 g against 300 g."),
    ],
)
def test_all_things_of_a_kind_are_compared(room: GraphStore, question: str, sentence: str):
    assert ask_offline(room, question).sentence == sentence


@pytest.mark.parametrize(
    ("question", "message"),
    [
        ("is Cup_2 taller than the cups?", "some Cup_2 are taller than some cups, .* there are Cup_1 and Cup_2"),
        ("is the piano bigger than the chair?", "there is no piano in this scene"),
        ("are the pianos bigger than the chair?", "there are no pianos in this scene"),
        ("what is heavier than 4 metres?", "expected a number with kg"),
        ("which things are larger than 2 m?", "does not measure what is larger"),
        ("what is heavier, the floor or the chair?", "no mass for floor"),
        ("does a box of 40 by 30 by 20 kg fit on the table?", "expected two or three lengths"),
        ("does the cup fit on the wardrobe?", "nothing stands on wardrobe"),
        ("how far apart are the chairs?", "there are 1 chairs; expected two"),
        ("are the cups on a table or on a chair?", "is not understood"),
        ("how many drawers does the sofa have?", "there is no sofa"),
        ("does the chair have drawers?", "not known: the graph states no parts of chair"),
    ],
)
def test_what_cannot_be_answered_is_said(room: GraphStore, question: str, message: str):
    with pytest.raises(GraphError, match=message):
        ask_offline(room, question)


def test_a_question_with_a_connective_is_not_answered_by_absence(room: GraphStore):
    with pytest.raises(GraphError):
        ask_offline(room, "is there a cup with a crack of some size?")


def test_amounts_and_sides():
    assert read_amount("12 inches") == (pytest.approx(0.3048), "m")
    assert read_amount("2 lbs") == (pytest.approx(0.90718474), "kg")
    assert read_sides("1 m x 30 cm x 20 cm") == (1.0, pytest.approx(0.3), pytest.approx(0.2))
