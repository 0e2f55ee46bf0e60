"""Questions in English are interpreted as ready questions, and answered in both profiles."""

from collections.abc import Mapping

import pytest

from tests.graph.records import build_graph, open_store, thing
from tests.grounding.records import make_object
from usd2kg.assistant import ask_offline, describe_objects, list_objects
from usd2kg.assistant.phrases import list_phrases, match_phrase
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore
from usd2kg.query.questions import list_questions

# On a table: a cup on a tray, a plate, and an apple in a bowl; a wardrobe away from it.
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
def test_understands_a_question(text: str):
    phrase = match_phrase(text)
    assert phrase is not None
    assert (phrase.question, dict(phrase.given)) == UNDERSTOOD[text]


@pytest.mark.parametrize("text", ["", "sing me a song", "delete everything", "?", "on"])
def test_does_not_match_other_texts(text: str):
    assert match_phrase(text) is None


def test_patterns_use_the_parameters_of_their_question():
    parameters = {q.id: {p.name for p in q.parameters} for q in list_questions()}
    for question, pattern in list_phrases():
        if question in parameters:
            assert pattern.groupindex.keys() <= parameters[question]


def test_matching_long_texts_is_fast():
    assert match_phrase("what is on the " + "on the in the of the " * 200 + "table on") is not None
    assert match_phrase("which " * 2000) is None


@pytest.fixture(scope="module", params=["soma", "plain"])
def graph(home_tbox: TBox, request: pytest.FixtureRequest) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM, profile=request.param))


def objects(graph: GraphStore, text: str) -> list[str | None]:
    answer = ask_offline(graph, text).answer
    return [row[answer.columns.index("object")] for row in answer.rows]


def test_answers_with_objects(graph: GraphStore):
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
def test_answers_yes_or_no(graph: GraphStore, text: str, verdict: bool):
    assert ask_offline(graph, text).verdict is verdict


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("how many cups are there?", 1),
        ("how many plates are on the table?", 1),
        ("how many cups are in the bowl", 0),
        # Nothing has this name.
        ("how many dragons are there?", 0),
        ("how many dragons are on the table?", 0),
        ("how many dragons does the table have?", 0),
    ],
)
def test_answers_with_a_number(graph: GraphStore, text: str, number: int):
    asked = ask_offline(graph, text)
    assert (asked.number, asked.summary()) == (number, f"{number}\n")


def test_distances_are_gaps_between_boxes(graph: GraphStore):
    # From the table's corner (1.6, 0.8) to the wardrobe's (3, 3): √(1.4² + 2.2²).
    (row,) = ask_offline(graph, "how far is the dining table from the wardrobe?").answer.values
    assert row[-1] == pytest.approx(2.608, abs=1e-3)


def test_converts_units(graph: GraphStore):
    assert objects(graph, "what is heavier than 50 kilograms and within 4 metres of the table?") == ["Wardrobe"]
    assert objects(graph, "what is heavier than 300 g and within 5 cm of the tray?") == ["cup_red"]
    asked = ask_offline(graph, "what is within 50 centimeters of the tray")
    assert asked.understood.endswith("with distance = 50 cm, thing = the tray")


def test_describes_an_object(graph: GraphStore):
    facts = {(fact, value) for _, fact, value in ask_offline(graph, "tell me about the cup").answer.rows}
    expected = {("class", "cup"), ("size_m", "0.1 × 0.1 × 0.1"), ("mass_kg", "0.4"), ("stands_on", "tray")}
    assert expected <= facts
    (table,) = describe_objects(graph, "dining table")["objects"]
    assert table["center_m"] == pytest.approx((0.8, 0.4, 0.35))
    assert table["on_it"] == ["FruitBowl", "plate_1", "tray"]
    assert table["classes"][0]["class"] == "table"


def test_cuts_long_lists_and_counts_all(graph: GraphStore):
    assert describe_objects(graph, "/Room/tray", limit=0) == {"count": 1, "objects": []}
    page = list_objects(graph, limit=2, start=1)
    assert (page["count"], [row["object"] for row in page["objects"]]) == (9, ["dining table", "Floor"])


def test_reports_unknown_names_and_questions(graph: GraphStore):
    with pytest.raises(GraphError, match="nothing is named 'unicorn'"):
        ask_offline(graph, "where is the unicorn?")
    with pytest.raises(GraphError, match=r"nothing is named 'wardrobbe' \(did you mean 'Wardrobe'\?\)"):
        ask_offline(graph, "where is the wardrobbe?")
    with pytest.raises(GraphError, match=r"is not understood; expected a question like .* with --model"):
        ask_offline(graph, "sing me a song")
