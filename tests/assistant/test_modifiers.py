"""Noun phrases with superlatives, comparisons, distances and purposes, and questions about distances."""

import pytest

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

# A wardrobe, 3 m from a table with two cups; gaps in metres follow from the boxes.
ROOM = [
    (thing("/R/Floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor"),
    (thing("/R/Table", (0, 0, 0), (1.2, 0.8, 0.7)), "Table"),
    (thing("/R/Cup_1", (0.1, 0.1, 0.7), (0.08, 0.08, 0.1)), "Cup"),
    (thing("/R/Cup_02", (1.0, 0.1, 0.7), (0.08, 0.08, 0.12)), "Cup"),
    (thing("/R/Wardrobe", (-4.2, 0, 0), (1.2, 0.8, 2.0)), "Wardrobe"),
    (thing("/R/Chair_A", (-2.0, 0, 0), (0.5, 0.5, 0.9)), "DesignedChair"),
    (thing("/R/Chair_B", (-0.8, 0, 0), (0.5, 0.5, 0.8)), "DesignedChair"),
    (thing("/R/Bottle", (4.0, 0, 1.5), (0.1, 0.1, 0.3)), "Bottle"),
]


@pytest.fixture(scope="module")
def room(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM))


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("where is the tallest chair", ["Chair_A"]),
        ("which objects are taller than the table?", ["Chair_A", "Chair_B", "Wardrobe"]),
        ("show me chairs lower than a metre", ["Chair_A", "Chair_B"]),
        ("where is the chair nearest to the table", ["Chair_B"]),
        ("which chair is furthest from the table?", ["Chair_A"]),
        ("list the chairs within two metres of the table", ["Chair_A", "Chair_B"]),
        ("list the chairs more than 0.5 m from the table", ["Chair_A"]),
        ("which tables are empty", []),
        ("show me the wardrobes without cups", ["Wardrobe"]),
        ("which wardrobes have nothing on them?", ["Wardrobe"]),
        ("list the cups and the wardrobe", ["Cup_02", "Cup_1", "Wardrobe"]),
        ("where is cup 2", ["Cup_02"]),
        ("where is chair a?", ["Chair_A"]),
        ("is chair b nearer to the table or to the wardrobe?", ["Table"]),
        ("what is near the table?", ["Chair_B"]),
    ],
)
def test_objects(room: GraphStore, question: str, expected: list[str]):
    assert [row[0] for row in ask_offline(room, question).answer.rows] == expected


@pytest.mark.parametrize(
    ("question", "number"),
    [
        ("how wide is the gap between chair a and chair b?", 0.7),
        ("what's the distance from the table to the closest chair", 0.3),
        ("how high above the floor is the bottle?", 1.5),
        ("how far above the table does the bottle hang?", 0.8),
        ("how long is the room", 10.0),
        ("Wie groß ist der Abstand zwischen Tisch und Kleiderschrank?", 3.0),
        ("quanto è alto il tavolo?", 0.7),
    ],
)
def test_numbers(room: GraphStore, question: str, number: float):
    assert ask_offline(room, question).number == pytest.approx(number, abs=1e-3)


@pytest.mark.parametrize(
    ("question", "verdict"),
    [
        ("could a robot that is 60 cm wide drive between chair a and chair b?", True),
        ("can a cart 1.2 m wide pass between chair a and chair b", False),
        ("is chair b closer to the table than chair a?", True),
        ("are there any chairs within 10 cm of the table?", False),
    ],
)
def test_verdicts(room: GraphStore, question: str, verdict: bool):
    assert ask_offline(room, question).verdict is verdict


@pytest.mark.parametrize(
    ("question", "said"),
    [
        ("where is the biggest piano", "no"),
        ("what is the monthly rent?", "not a thing"),
        ("chairs heavier than 2 m", "does not measure what is heavier"),
        ("list the chairs within 2 kg of the table", "is not a distance"),
        ("where is the chair nearest to the piano?", "no piano"),
        ("where can I juggle", "juggle"),
    ],
)
def test_what_cannot_be_answered_is_said(room: GraphStore, question: str, said: str):
    with pytest.raises(GraphError, match=said):
        asked = ask_offline(room, question)
        raise GraphError(asked.sentence)


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("which chairs have nothing on them?", ["Chair_A", "Chair_B"]),
        ("which tables have no cups on them?", []),
        ("what is the tallest?", ["Wardrobe"]),
        ("what is taller than chair a?", ["Wardrobe"]),
        ("what are the Two tallest things?", ["Wardrobe", "Chair_A"]),
        ("which chairs are within 1 m of a chair?", ["Chair_A", "Chair_B"]),
    ],
)
def test_what_is_denied_or_compared_is_kept(room: GraphStore, question: str, expected: list[str]):
    assert [row[0] for row in ask_offline(room, question).answer.rows] == expected


@pytest.mark.parametrize(
    ("question", "verdict"),
    [
        ("are all cups on the table?", True),
        ("is every chair near the table?", False),
        ("are there exactly two cups?", True),
        ("are there exactly one cups?", False),
        ("is chair b nearer to the table than to the wardrobe?", True),
        ("is chair b nearer to the wardrobe than to the table?", False),
    ],
)
def test_quantifiers(room: GraphStore, question: str, verdict: bool):
    assert ask_offline(room, question).verdict is verdict


@pytest.mark.parametrize("question", ["is there no cup?", "is nothing on the table?", "what is opposite the table?"])
def test_what_would_be_inverted_or_dropped_is_refused(room: GraphStore, question: str):
    with pytest.raises(GraphError):
        ask_offline(room, question)
