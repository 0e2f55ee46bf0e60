"""Questions about the demo kitchen that are read as answer type, noun phrases and predicates."""

from collections.abc import Sequence

import pytest

from usd2kg.assistant import ask_offline
from usd2kg.assistant.composition.groups import ANY, EACH, NO, Quantity, exactly
from usd2kg.assistant.composition.words import Words
from usd2kg.assistant.interpreted_answer import InterpretedAnswer, contradict
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore
from usd2kg.query.answer import Answer


def labels(graph: GraphStore, question: str) -> Sequence[str | None]:
    return sorted(str(row[0]) for row in ask_offline(graph, question).answer.rows)


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("Which bowls are in the wall cabinets?", ["cerealBowl_1", "cerealBowl_2", "geo_bowlSmall"]),
        ("Which bowls have been put in the wall cabinets?", ["cerealBowl_1", "cerealBowl_2", "geo_bowlSmall"]),
        ("Name everything on the window sill except the plants.", ["vase_empty_02"]),
        ("What stands on the sideboard besides the radio?", ["birdCage", "cakeStand", "vase_tall"]),
        ("Which drawers contain both a knife and a spoon?", ["drwr_R1"]),
        ("What is the most heavy appliance?", ["Fridge_01"]),
        ("Which pot has a lid?", ["SM_StockPot"]),
        ("Which dining chairs do not have a cushion?", ["chair_01", "chair_04", "chair_05", "chair_06"]),
    ],
)
def test_objects(kitchen: GraphStore, question: str, expected: Sequence[str]):
    assert labels(kitchen, question) == expected


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("Name every lamp that is not on the ceiling.", "There is a candle that is not on the ceiling."),
        (
            "Name every chair that is not at the window.",
            "There are five chairs, three barstools and an armchair that are not at the window.",
        ),
    ],
)
def test_a_pattern_for_lists_yields_to_composition(kitchen: GraphStore, question: str, answer: str):
    assert ask_offline(kitchen, question).sentence == answer


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("How many of the dining chairs do not have a cushion?", 4),
        ("How many apples are left?", 4),
        ("How many spice jars does the spice rack hold?", 5),
        ("How many of the cups are in a cupboard?", 3),
    ],
)
def test_numbers(kitchen: GraphStore, question: str, expected: int):
    assert ask_offline(kitchen, question).number == expected


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("Does anything lie on the armchair apart from the cushion?", True),
        ("Are all the forks on the dining table lying on napkins?", True),
        ("are there as many plates as forks on the dining table?", True),
        ("Are the apples in the same bowl as the oranges?", True),
        ("Do we still have some honey?", True),
        ("Has the fridge got more than three doors?", False),
        ("Is there a bottle that is not in the fridge?", True),
    ],
)
def test_verdicts(kitchen: GraphStore, question: str, expected: bool):
    assert ask_offline(kitchen, question).verdict is expected


@pytest.mark.parametrize(
    "question",
    [
        "Is there a glass on every plate?",
        "Which laptops are closed?",
        "Do we have enough chairs for eight people?",
        "Which cups are sort of on the table?",
        "Does the fridge hold the quantity of eggs that we need?",
        "Is the armchair the largest?",
    ],
)
def test_what_a_reading_would_drop_is_no_yes(kitchen: GraphStore, question: str):
    try:
        answered = ask_offline(kitchen, question)
    except GraphError:
        return
    assert answered.verdict is not True


def test_the_scene_has_things(kitchen: GraphStore):
    assert ask_offline(kitchen, "Does the room have a smoke detector?").verdict is True
    assert ask_offline(kitchen, "How many windows does the room have?").number == 2


def test_a_noun_that_no_thing_is_known_to_be_is_refused(kitchen: GraphStore):
    with pytest.raises(GraphError, match="egg"):
        ask_offline(kitchen, "Does the fridge contain any eggs?")


def test_words_keep_names_and_lose_adverbs():
    words = Words("What's really standing on Desk_A1, please?")
    assert words[:] == ["what", "is", "standing", "on", "Desk_A1"]
    assert words.word(9) == ""
    assert [*words.relation(2, 3)] == [("on", 4)]


@pytest.mark.parametrize(
    ("quantity", "counts"), [(ANY, {1, 2, 3}), (NO, {0}), (EACH, {3}), (exactly(2), {2}), (Quantity(2), {2, 3})]
)
def test_quantities(quantity: Quantity, counts: set[int]):
    assert {count for count in range(4) if quantity.holds(count, 3)} == counts


def test_nothing_is_not_each_of_nothing():
    assert not EACH.holds(0, 0)


def test_answers_contradict_each_other():
    table = Answer(("object", "path"), (("Cup", "/Cup"),), (), "")
    empty = Answer(("object", "path"), (), (), "")
    assert contradict(InterpretedAnswer("", table), InterpretedAnswer("", empty))
    assert not contradict(InterpretedAnswer("", table, number=1), InterpretedAnswer("", empty, number=1))
    assert contradict(InterpretedAnswer("", table, verdict=True), InterpretedAnswer("", table, verdict=False))
    assert not contradict(
        InterpretedAnswer("", table, places=("/Table",)), InterpretedAnswer("", empty, places=("/Shelf", "/Table"))
    )


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("list the cups on the bar table", "There are an espresso cup and a mug on the bar table."),
        ("Which pot has a lid?", "There is a stockpot that has a lid."),
    ],
)
def test_a_list_says_what_was_asked_of_the_things(kitchen: GraphStore, question: str, expected: str):
    assert ask_offline(kitchen, question).sentence == expected


def test_the_two_are_no_more_than_two(kitchen: GraphStore):
    with pytest.raises(GraphError, match="not known which 2 chairs"):
        ask_offline(kitchen, "Do the two chairs stand on the floor?")


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("Do the two windows hang on the same wall?", False),
        ("Is a television among the appliances?", False),
        ("Got a toaster here?", True),
    ],
)
def test_short_and_joint_claims(kitchen: GraphStore, question: str, expected: bool):
    assert ask_offline(kitchen, question).verdict is expected


@pytest.mark.parametrize(
    ("question", "plain"),
    [
        ("Kids ask where the kettle is", "where is the kettle?"),
        ("Guard here. Where is the toaster?", "where is the toaster?"),
        ("whereabouts is the toaster?", "where is the toaster?"),
        ("What can be found in the fridge?", "what is in the fridge?"),
        ("What is lying about on the sideboard?", "what is on the sideboard?"),
        ("Which is farther from the fridge, the oven or the toaster?", "the toaster"),
        ("How many drawers has baseUnit_L?", "how many drawers does baseUnit_L have?"),
    ],
)
def test_other_shapes_of_a_question(kitchen: GraphStore, question: str, plain: str):
    assert ask_offline(kitchen, question).paths == ask_offline(kitchen, plain).paths
