"""Questions in English are interpreted as ready questions, and answered in both profiles."""

from collections.abc import Mapping

import pytest

from tests.graph.records import build_graph, open_store, thing
from tests.grounding.records import make_object
from usd2kg.assistant import ask_offline, describe_objects, list_objects
from usd2kg.assistant.phrases import list_phrases, match_phrases
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
    "What's on the table?": ("rel-what", {"relation": "on", "thing": "the table"}),
    "whats undr the table": ("rel-what", {"relation": "undr", "thing": "the table"}),
    "Please, can you tell me what else is standing on the kitchen table": (
        "rel-what",
        {"relation": "on", "thing": "the kitchen table"},
    ),
    "what is there in the fridge": ("rel-what", {"relation": "in", "thing": "the fridge"}),
    "anything in the sink?": ("rel-is", {"class": "anything", "relation": "in", "thing": "the sink"}),
    "Where\u2019s the kettle": ("where", {"thing": "the kettle"}),
    "in which room are the chairs?": ("in-room", {"thing": "the chairs"}),
    "how many cups are there?": ("how-many", {"class": "cups"}),
    "How many cups do we have, please?": ("how-many", {"class": "cups"}),
    "how many windows does the house have?": ("how-many", {"class": "windows"}),
    "how many drawers does the cabinet have?": ("parts-of", {"class": "drawers", "thing": "the cabinet"}),
    "how many cups are on the table?": ("rel-count", {"class": "cups", "relation": "on", "thing": "the table"}),
    "is there a knife on the worktop?": ("rel-is", {"class": "a knife", "relation": "on", "thing": "the worktop"}),
    "is the cup in the sink": ("rel-is", {"class": "the cup", "relation": "in", "thing": "the sink"}),
    "what is within 50 cm of the sink?": ("close-to", {"distance": "50 cm", "thing": "the sink"}),
    "what is heavier than 1 kg and within 60 cm of the sink": (
        "heavy-near",
        {"mass": "1 kg", "distance": "60 cm", "thing": "the sink"},
    ),
    "what must be moved to open this drawer?": ("to-open", {"thing": "this drawer"}),
    "what is in the way of the drawer?": ("to-open", {"thing": "the drawer"}),
    "which containers on the table can hold liquid?": ("hold-liquid", {"thing": "the table"}),
    "which things can hold water and stand on the table": ("hold-liquid", {"thing": "the table"}),
    "what else is on the same surface as the cup?": ("same-surface", {"thing": "the cup"}),
    "what is the nearest cup to the sink?": ("nearest", {"class": "cup", "thing": "the sink"}),
    "which chair is nearest to the oven?": ("nearest", {"class": "chair", "thing": "the oven"}),
    "what can I reach from (1, 0.5, 1.2)?": ("reach", {"position": "1, 0.5, 1.2"}),
    "what would move if I move the tray?": ("moves-along", {"thing": "the tray"}),
    "what does the cup stand on": ("stands-on", {"thing": "the cup"}),
    "what carries the cup": ("support-chain", {"thing": "the cup"}),
    "what is under the table": ("rel-what", {"relation": "under", "thing": "the table"}),
    "which appliances are there?": ("all", {"class": "appliances"}),
    "list all the chairs": ("all", {"class": "chairs"}),
    "which objects are you unsure about?": ("unsure", {}),
    "how heavy is the wardrobe?": ("measure", {"adjective": "heavy", "thing": "the wardrobe"}),
    "could you please tell me how tall the fridge is?": ("measure", {"adjective": "tall", "thing": "the fridge"}),
    "couch: how wide?": ("measure", {"adjective": "wide", "thing": "couch"}),
    "weight of the lamp": ("measure", {"adjective": "weight", "thing": "the lamp"}),
    "heaviest thing?": ("superlative", {"adjective": "heaviest", "class": "thing"}),
    "which lamp hangs lowest?": ("superlative", {"adjective": "lowest", "class": "lamp"}),
    "is the cup bigger than the bowl?": ("compare", {"thing": "the cup", "adjective": "bigger", "other": "the bowl"}),
    "where can I put the tray?": ("put", {"thing": "the tray"}),
    "what colour is the cup?": ("color", {"thing": "the cup"}),
    "how sure are you that cup_red is a cup?": ("sure", {"thing": "cup_red", "class": "a cup"}),
    "is there a fridge?": ("is-there", {"class": "a fridge"}),
    "Wo ist der Kühlschrank?": ("where", {"thing": "der Kühlschrank"}),
    "¿Cuántas sillas hay?": ("how-many", {"class": "sillas"}),
    "De quelle couleur est le fauteuil ?": ("color", {"thing": "le fauteuil"}),
}


@pytest.mark.parametrize("text", UNDERSTOOD)
def test_understands_a_question(text: str):
    phrase = next(iter(match_phrases(text)), None)
    assert phrase is not None
    assert (phrase.question, dict(phrase.given)) == UNDERSTOOD[text]


@pytest.mark.parametrize("text", ["", "sing me a song", "delete everything", "?", "on"])
def test_does_not_match_other_texts(text: str):
    assert not match_phrases(text)


def test_patterns_use_the_parameters_of_their_question():
    parameters = {q.id: {p.name for p in q.parameters} for q in list_questions()}
    for question, pattern, _ in list_phrases():
        if question in parameters:
            named = {name for name in pattern.groupindex if not name.startswith("left_")}
            assert named <= parameters[question]


def test_matching_long_texts_is_fast():
    assert match_phrases("what is on the " + "on the in the of the " * 200 + "table on")
    assert not match_phrases("which " * 2000)


@pytest.fixture(scope="module", params=["soma", "plain"])
def graph(home_tbox: TBox, request: pytest.FixtureRequest) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM, profile=request.param))


def objects(graph: GraphStore, text: str) -> list[str | None]:
    answer = ask_offline(graph, text).answer
    return [row[answer.columns.index("object")] for row in answer.rows]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("what is on the dining table?", ["FruitBowl", "plate_1", "tray"]),
        ("which cups are on the dining table?", ["cup_red"]),
        ("cups on the table", ["cup_red"]),
        ("how many cups are there?", ["cup_red"]),
        ("what is in the bowl?", ["Apple"]),
        ("what does the cup stand on?", ["tray"]),
        ("what carries the cup?", ["tray", "dining table", "Floor"]),
        ("cup_red - what does it stand on?", ["tray"]),
        ("heaviest thing?", ["Wardrobe"]),
        ("the tallest object", ["Wardrobe"]),
        ("which plate is nearest to the bowl?", ["plate_1"]),
        ("what can be opened?", ["Wardrobe"]),
        ("Was ist auf dem Tisch?", ["FruitBowl", "plate_1", "tray"]),
        ("¿Qué hay sobre la mesa?", ["FruitBowl", "plate_1", "tray"]),
        ("where is the wardrobbe?", ["Wardrobe"]),
        ("what's under the table?", []),
    ],
)
def test_answers_with_objects(graph: GraphStore, text: str, expected: list[str]):
    assert objects(graph, text) == expected


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("what is on the dining table?", "An artifact, a bowl and a dinner plate are on the table dining table."),
        ("what is on the plate?", "Nothing is on the dinner plate plate_1."),
        ("is there an apple on the plate?", "No: no apple is on the dinner plate plate_1."),
        ("how heavy is the cup?", "cup_red weighs 400 g."),
        ("how tall is the wardrobe?", "Wardrobe is 2 m tall."),
        ("how big is the wardrobe?", "Wardrobe measures 2.00 × 1.00 × 0.60 m."),
        ("is the bowl larger than the cup?", "Yes: 0.009 against 0.001 m³."),
        ("where is the piano?", "There is no piano in this scene."),
        (
            "where is the wardrobbe?",
            "Wardrobe is on the floor, at (3.50, 3.30, 1.00) m (“wardrobbe” was read as “wardrobe”).",
        ),
    ],
)
def test_answers_in_sentences(graph: GraphStore, text: str, sentence: str):
    assert ask_offline(graph, text).sentence == sentence


@pytest.mark.parametrize(
    ("text", "verdict"),
    [
        ("is there a cup on the table?", True),
        ("is there a bowl on the tray?", False),
        ("is the apple in the bowl?", True),
        ("is there a cup in the bowl?", False),
        ("is there a wardrobe?", True),
        ("is there a piano?", False),
        ("is the wardrobe heavier than the cup?", True),
        ("gibt es eine Tasse?", True),
    ],
)
def test_answers_yes_or_no(graph: GraphStore, text: str, verdict: bool):
    asked = ask_offline(graph, text)
    assert asked.verdict is verdict
    assert asked.sentence.startswith("Yes" if verdict else "No")


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("how many cups are there?", 1),
        ("how many plates are on the table?", 1),
        ("how many cups are in the bowl", 0),
        # The noun is known, and nothing is one.
        ("how many dragons are there?", 0),
        ("how many dragons are on the table?", 0),
        ("how heavy is the wardrobe", 60.0),
        ("how wide is the dining table?", 1.6),
        ("distance between the dining table and the wardrobe", 2.6077),
    ],
)
def test_answers_with_a_number(graph: GraphStore, text: str, number: float):
    assert ask_offline(graph, text).number == pytest.approx(number)


def test_a_place_for_a_thing_is_free(graph: GraphStore):
    asked = ask_offline(graph, "where can I put the plate?")
    assert asked.places[0] == "/Room/DiningTable"
    spot = asked.answer.values[0][asked.answer.columns.index("center_m")]
    x, y, z = map(float, str(spot).split())
    assert z == pytest.approx(0.7)
    for _, lower, size in (
        (o.name, o.box.lower, o.box.size) for o, _ in ROOM if o.box and o.name in {"tray", "FruitBowl"}
    ):
        is_apart = (
            abs(x - lower[0] - size[0] / 2) > size[0] / 2 + 0.1 or abs(y - lower[1] - size[1] / 2) > size[1] / 2 + 0.1
        )
        assert is_apart
    assert "No level top has room" in ask_offline(graph, "where can I put a box of 3 by 3 m?").sentence


def test_what_stands_on_the_floor_has_its_place_there(graph: GraphStore):
    assert ask_offline(graph, "where can I put the wardrobe?").places == ("/Room/Floor",)


def test_distances_are_gaps_between_boxes(graph: GraphStore):
    # From the table's corner (1.6, 0.8) to the wardrobe's (3, 3): √(1.4² + 2.2²).
    (row,) = ask_offline(graph, "how far is the dining table from the wardrobe?").answer.values
    assert row[-1] == pytest.approx(2.608, abs=1e-3)


def test_converts_units(graph: GraphStore):
    assert objects(graph, "what is heavier than 50 kilograms and within 4 metres of the table?") == ["Wardrobe"]
    assert objects(graph, "what is heavier than 300 g and within 5 cm of the tray?") == ["cup_red"]
    asked = ask_offline(graph, "what is within 50 centimeters of the tray")
    assert asked.understood == "close-to: What is within 50 cm of the tray?"


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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("where is the flurbl?", "'flurbl' is not a word that this graph or the lexicon knows"),
        ("is there a flurbl on the table?", "'flurbl' is not"),
        ("is there a cup on the flurbl?", "'flurbl' is not"),
        ("what is on the piano?", "there is no piano in this scene"),
        ("who owns the wardrobe?", "is not understood"),
        ("what colour is the cup?", "not known: the graph has no colour for cup"),
        ("how heavy is the plate?", "not known: the graph has no mass for plate"),
        ("how many dragons does the table have?", "not known: the graph states no parts of table"),
        ("what blocks the wardrobe?", "not known: the stage has no joint for wardrobe"),
        ("sing me a song", "expected a question like"),
        ('what is on "} DROP ALL {"?', "is not"),
    ],
)
def test_says_what_is_not_understood_or_not_known(graph: GraphStore, text: str, message: str):
    with pytest.raises(GraphError) as error:
        ask_offline(graph, text)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


def test_an_unread_language_does_not_change_english_words(graph: GraphStore):
    # Italian “piano” is a top.
    assert ask_offline(graph, "is there a piano?").verdict is False
