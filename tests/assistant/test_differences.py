"""Differences of measures, limits, superlatives as yes/no questions, and what things have in common."""

import pytest

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

# A wardrobe of 2 m, a table of 0.7 m with two cups, a bottle that hangs 1.5 m above the floor, and the ceiling.
ROOM = [
    (thing("/R/Floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor"),
    (thing("/R/Ceiling", (-5, -5, 2.5), (10, 10, 0.2)), "Ceiling"),
    (thing("/R/Table", (0, 0, 0), (1.2, 0.8, 0.7), mass_kg=20), "Table"),
    (thing("/R/Cup_1", (0.1, 0.1, 0.7), (0.08, 0.08, 0.1)), "Cup"),
    (thing("/R/Cup_2", (1.0, 0.1, 0.7), (0.08, 0.08, 0.12)), "Cup"),
    (thing("/R/Wardrobe", (-4.2, 0, 0), (1.2, 0.8, 2.0), mass_kg=60), "Wardrobe"),
    (thing("/R/Bottle", (4.0, 0, 1.5), (0.1, 0.1, 0.3)), "Bottle"),
]


@pytest.fixture(scope="module")
def room(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM))


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("how much taller is the wardrobe than the table?", 1.3),
        ("by how much is the table shorter than the wardrobe?", 1.3),
        # Less than nothing: the table is not taller.
        ("how much taller is the table than the wardrobe?", -1.3),
        ("what is the difference in weight between the table and the wardrobe?", 40),
        ("how high is the ceiling?", 2.5),
    ],
)
def test_numbers(room: GraphStore, text: str, number: float):
    assert ask_offline(room, text).number == pytest.approx(number)


@pytest.mark.parametrize(
    ("text", "verdict"),
    [
        ("is the wardrobe taller than a metre and a half?", True),
        ("is the wardrobe taller than three metres?", False),
        ("is the wardrobe lighter than 70 kg?", True),
        ("is the wardrobe the tallest thing?", True),
        ("is the table the heaviest?", False),
        ("is the table longer than the wardrobe is wide?", False),
        ("is the table longer than the bottle is tall?", True),
        # The bottle is not as tall as the table, but hangs over it.
        ("is the bottle higher than the table?", True),
        ("is the bottle taller than the table?", False),
        ("is the wardrobe a table?", False),
        ("is the wardrobe a wardrobe?", True),
        ("do all cups have the same height?", False),
        ("do all cups have the same width?", True),
    ],
)
def test_verdicts(room: GraphStore, text: str, verdict: bool):
    asked = ask_offline(room, text)
    assert asked.verdict is verdict
    assert asked.sentence.startswith("Yes: " if verdict else "No: ")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("which table has a cup on it?", ["Table"]),
        ("on which table is Cup_1?", ["Table"]),
        ("which cups are on the same table as Cup_1?", ["Cup_2"]),
        ("which objects have the same width as Cup_1?", ["Cup_2"]),
        ("list the tables without cups on them", []),
        ("which things are between the table and the wardrobe?", []),
    ],
)
def test_objects(room: GraphStore, text: str, expected: list[str]):
    assert [row[0] for row in ask_offline(room, text).answer.rows] == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("how much bigger is the table than the wardrobe?", "no single measure"),
        ("how much taller are the cups than the table?", "several"),
        ("is the wardrobe taller than 3 kg?", "expected a number with m"),
        ("is the table wooden?", "does not state whether table is wooden"),
        ("is the table nice?", "not understood as a property"),
        ("how many cups are there and how many tables?", "not understood"),
    ],
)
def test_refusals(room: GraphStore, text: str, message: str):
    with pytest.raises(GraphError, match=message):
        ask_offline(room, text)


def test_the_sentence_gives_both_measures(room: GraphStore):
    sentence = ask_offline(room, "how much taller is the wardrobe than the table?").sentence
    assert sentence == "Wardrobe and table differ by 1.3 m in how tall they are: 2 m against 70 cm."
