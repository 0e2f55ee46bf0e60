"""Questions in English are understood as the ready questions, and answered from either profile."""

from collections.abc import Mapping

import pytest

from tests.graph.records import build_graph, open_store, thing
from tests.grounding.records import make_object
from usd2kg.assistant import ask_offline, describe, list_objects
from usd2kg.assistant.phrases import list_phrases, match_phrase
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore
from usd2kg.query.questions import list_questions

# On a table: a tray with a cup on it, a plate, and a bowl with an apple in it; a wardrobe apart.
ROOM = [
    (thing("/Room/Floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor"),
    (thing("/Room/DiningTable", (0, 0, 0), (1.6, 0.8, 0.7), display_name="dining table"), "Table"),
    (thing("/Room/tray", (0.9, 0.3, 0.7), (0.4, 0.3, 0.02)), "DesignedArtifact"),
    (thing("/Room/cup_red", (1, 0.4, 0.72), (0.1, 0.1, 0.1), mass_kg=0.4), "Cup"),
    (thing("/Room/plate_1", (0.6, 0.4, 0.7), (0.2, 0.2, 0.02)), "DinnerPlate"),
    (thing("/Room/FruitBowl", (0.1, 0.2, 0.7), (0.3, 0.3, 0.1)), "Bowl"),
    (thing("/Room/Apple", (0.2, 0.3, 0.72), (0.08, 0.08, 0.08)), "DesignedArtifact"),
    (thing("/Room/Wardrobe", (3, 3, 0), (1, 0.6, 2), mass_kg=60), "Wardrobe"),
    (make_object("/Room/Ghost"), None),
]

UNDERSTOOD: Mapping[str, tuple[str, dict[str, str]]] = {
    "What's on the table?": ("on", {"thing": "the table"}),
    "Please, can you tell me what else is standing on the kitchen table": ("on", {"thing": "the kitchen table"}),
    "what is there in the fridge": ("inside", {"thing": "the fridge"}),
    "Where\u2019s the kettle": ("where", {"thing": "the kettle"}),
    "in which room are the chairs?": ("where", {"thing": "the chairs"}),
    "how many cups are there?": ("how-many", {"class": "cups"}),
    "how many cups do we have": ("how-many", {"class": "cups"}),
    "how many cups are on the table?": ("count-on", {"class": "cups", "thing": "the table"}),
    "is there a knife on the worktop?": ("is-on", {"class": "knife", "thing": "the worktop"}),
    "is the cup in the sink": ("is-in", {"class": "cup", "thing": "the sink"}),
    "which plates are in the rack": ("some-in", {"class": "plates", "thing": "the rack"}),
    "what is within 50 cm of the sink?": ("close-to", {"distance": "50 cm", "thing": "the sink"}),
    "what is heavier than 1 kg and within 60 cm of the sink": (
        "heavy-near",
        {"mass": "1 kg", "distance": "60 cm", "thing": "the sink"},
    ),
    "what must be moved to open this drawer?": ("to-open", {"thing": "this drawer"}),
    "which containers on the table can hold liquid?": ("hold-liquid", {"thing": "the table"}),
    "which things can hold water and stand on the table": ("hold-liquid", {"thing": "the table"}),
    "what else is on the same surface as the cup?": ("same-surface", {"thing": "the cup"}),
    "what is the nearest cup to the sink?": ("nearest", {"class": "cup", "thing": "the sink"}),
    "what can I reach from (1, 0.5, 1.2)?": ("reach", {"position": "1, 0.5, 1.2"}),
    "what would move if I move the tray?": ("moves-along", {"thing": "the tray"}),
    "what does the cup stand on": ("support-chain", {"thing": "the cup"}),
    "what is under the table": ("below", {"thing": "the table"}),
    "what is above the table": ("above-of", {"thing": "the table"}),
    "which appliances are there?": ("which-where", {"class": "appliances"}),
    "list all the chairs": ("all", {"class": "chairs"}),
    "which objects are you unsure about?": ("unsure", {}),
    "how heavy is the wardrobe?": ("about", {"thing": "the wardrobe"}),
    "is there a fridge?": ("is-there", {"class": "fridge"}),
    "are there any apples here": ("is-there", {"class": "apples"}),
    "which drawer contains the spoons?": ("where", {"thing": "the spoons"}),
    "how many drawers does the cabinet have?": ("parts-of", {"class": "drawers", "thing": "the cabinet"}),
    "how far is the cup from the sink?": ("distance", {"thing": "the cup", "other": "the sink"}),
    "what is the thing": ("about", {"thing": "the thing"}),
}


@pytest.mark.parametrize("text", UNDERSTOOD)
def test_a_question_is_understood(text: str):
    phrase = match_phrase(text)
    assert phrase is not None
    assert (phrase.question, dict(phrase.given)) == UNDERSTOOD[text]


@pytest.mark.parametrize("text", ["", "sing me a song", "delete everything", "?", "on"])
def test_other_texts_are_not(text: str):
    assert match_phrase(text) is None


def test_each_phrase_leads_to_a_question_with_its_parameters():
    parameters = {q.id: {p.name for p in q.parameters} for q in list_questions()}
    for question, pattern in list_phrases():
        if question in parameters:
            assert pattern.groupindex.keys() <= parameters[question]


def test_long_nonsense_takes_no_time():
    assert match_phrase("what is on the " + "on the in the of the " * 200 + "table on") is not None
    assert match_phrase("which " * 2000) is None


@pytest.fixture(scope="module", params=["soma", "plain"])
def graph(home_tbox: TBox, request: pytest.FixtureRequest) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM, profile=request.param))


def objects(graph: GraphStore, text: str) -> list[str | None]:
    answer = ask_offline(graph, text).answer
    return [row[answer.columns.index("object")] for row in answer.rows]


def test_things_on_things(graph: GraphStore):
    assert objects(graph, "what is on the dining table?") == ["FruitBowl", "plate_1", "tray"]
    assert objects(graph, "which cups are on the dining table?") == ["cup_red"]
    assert objects(graph, "how many cups are there?") == ["cup_red"]
    assert objects(graph, "what is in the bowl?") == ["Apple"]
    assert objects(graph, "what does the cup stand on?") == ["tray", "dining table", "Floor"]


@pytest.mark.parametrize(
    ("text", "verdict"),
    [
        ("is there a cup on the table?", True),
        ("is there a bowl on the tray?", False),
        ("is the apple in the bowl?", True),
        ("is there a cup in the bowl?", False),
        ("is there a wardrobe?", True),
        ("is there a unicorn?", False),
    ],
)
def test_yes_and_no(graph: GraphStore, text: str, verdict: bool):
    assert ask_offline(graph, text).verdict is verdict


@pytest.mark.parametrize(
    ("text", "number"),
    [("how many cups are there?", 1), ("how many plates are on the table?", 1), ("how many cups are in the bowl", 0)],
)
def test_numbers(graph: GraphStore, text: str, number: int):
    asked = ask_offline(graph, text)
    assert (asked.number, asked.summary()) == (number, f"{number}\n")


def test_distances_are_gaps_between_boxes(graph: GraphStore):
    # The table ends at x = 1.6, y = 0.8; the wardrobe begins at (3, 3): √(1.4² + 2.2²).
    (row,) = ask_offline(graph, "how far is the dining table from the wardrobe?").answer.values
    assert row[-1] == pytest.approx(2.608, abs=1e-3)


def test_units_are_read(graph: GraphStore):
    assert objects(graph, "what is heavier than 50 kilograms and within 4 metres of the table?") == ["Wardrobe"]
    assert objects(graph, "what is heavier than 300 g and within 5 cm of the tray?") == ["cup_red"]
    asked = ask_offline(graph, "what is within 50 centimeters of the tray")
    assert asked.understood.endswith("with distance = 50 cm, thing = the tray")


def test_all_about_a_thing(graph: GraphStore):
    facts = {(fact, value) for _, fact, value in ask_offline(graph, "tell me about the cup").answer.rows}
    expected = {("class", "cup"), ("size_m", "0.1 × 0.1 × 0.1"), ("mass_kg", "0.4"), ("stands_on", "tray")}
    assert expected <= facts
    (table,) = describe(graph, "dining table")["objects"]
    assert table["center_m"] == pytest.approx((0.8, 0.4, 0.35))
    assert table["on_it"] == ["FruitBowl", "plate_1", "tray"]
    assert table["classes"][0]["class"] == "table"


def test_a_long_list_is_cut_and_counted(graph: GraphStore):
    assert describe(graph, "/Room/tray", most=0) == {"count": 1, "objects": []}
    page = list_objects(graph, most=2, start=1)
    assert (page["count"], [row["object"] for row in page["objects"]]) == (9, ["dining table", "Floor"])


def test_what_is_not_there_is_told(graph: GraphStore):
    with pytest.raises(GraphError, match="nothing is called 'unicorn'"):
        ask_offline(graph, "where is the unicorn?")
    with pytest.raises(GraphError, match=r"nothing is called 'wardrobbe' \(is 'Wardrobe' meant\?\)"):
        ask_offline(graph, "where is the wardrobbe?")
    with pytest.raises(GraphError, match=r"is not understood; ask like .* or let a model write the query with --model"):
        ask_offline(graph, "sing me a song")
