"""What noun phrases with relations, negations and names of kinds mean in the demo kitchen."""

from collections.abc import Sequence

import pytest

from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore


def labels(graph: GraphStore, question: str) -> Sequence[str | None]:
    return sorted(str(row[0]) for row in ask_offline(graph, question).answer.rows)


@pytest.mark.parametrize(
    "negated", ["which cups are not", "which cups aren't", "which cups arent", "cups that are not"]
)
def test_a_negated_relation_excludes(kitchen: GraphStore, negated: str):
    all_cups, on_table = (set(labels(kitchen, text)) for text in ("cups?", "which cups are on the bar table?"))
    assert set(labels(kitchen, f"{negated} on the bar table?")) == all_cups - on_table


def test_a_negated_kind_excludes(kitchen: GraphStore):
    on_table = set(labels(kitchen, "list everything on the bar table"))
    apples = {"apple_1", "apple_2", "apple_3", "appleGreen"}
    assert set(labels(kitchen, "list everything on the bar table that is not an apple")) == on_table - apples


def test_a_negation_that_may_belong_to_another_noun_is_refused(kitchen: GraphStore):
    with pytest.raises(GraphError, match="no piano"):
        ask_offline(kitchen, "what is on the bar table that is not a piano?")


def test_on_directly_excludes_what_is_on_another_thing(kitchen: GraphStore):
    assert labels(kitchen, "which apples are on the bar table?")
    found = ask_offline(kitchen, "which apples are directly on the bar table?")
    assert not found.answer.rows
    assert found.sentence == "There are no apples that are directly on the bar table in this scene."


def test_what_is_on_a_table_is_not_on_the_floor(kitchen: GraphStore):
    assert labels(kitchen, "list the cups that stand on the floor") == []


def test_from_is_on_or_in(kitchen: GraphStore):
    assert labels(kitchen, "bring me a cup from the bar table") == ["espressoCup_1", "mug_large_04"]
    assert labels(kitchen, "take the milk from the fridge") == ["milkBottle", "milkCarton_1", "milkCarton_2"]


def test_on_top_of_is_no_part(kitchen: GraphStore):
    assert labels(kitchen, "mugs on top of the bar table") == ["mug_large_04"]


def test_a_coloured_cup_may_be_a_coffee_cup(kitchen: GraphStore):
    with pytest.raises(GraphError, match="no coffee cup is known, but"):
        ask_offline(kitchen, "is there a coffee cup?")


def test_nothing_follows_from_a_guess(kitchen: GraphStore):
    assert "was read as" in ask_offline(kitchen, "is there a bottle in the breakfast fridge?").sentence
    with pytest.raises(GraphError, match="“breakfast fridge” was read as “fridge”, and nothing was found"):
        ask_offline(kitchen, "is there a stapler in the breakfast fridge?")


def test_a_topic_beside_the_question_is_not_left_out(kitchen: GraphStore):
    with pytest.raises(GraphError, match="'The cups on the bar table' beside the question"):
        ask_offline(kitchen, "The cups on the bar table - how many plates is that?")


def test_whats_colour_is_contracted(kitchen: GraphStore):
    assert "white" in ask_offline(kitchen, "what colour's the fridge?").sentence


@pytest.mark.parametrize("text", ["is there music?", "where is the time?"])
def test_a_scene_does_not_lack_an_abstraction(kitchen: GraphStore, text: str):
    with pytest.raises(GraphError, match=r"is not (a word|understood)"):
        ask_offline(kitchen, text)


@pytest.mark.parametrize("text", ["fridge contents please", "list the contents of the fridge"])
def test_contents(kitchen: GraphStore, text: str):
    assert labels(kitchen, text) == labels(kitchen, "what is in the fridge?")


@pytest.mark.parametrize(
    ("text", "is_so"),
    [
        ("is the kettle within 50 cm of the toaster?", False),
        ("is the kettle within 3 m of the toaster?", True),
        ("would a 30 x 40 cm box fit on the bar table?", True),
        ("are there at least three chairs?", True),
        ("are the cups on the bar table?", False),
        ("do all apples have the same height?", True),
        ("do all chairs have the same height?", False),
    ],
)
def test_a_verdict(kitchen: GraphStore, text: str, is_so: bool):
    assert ask_offline(kitchen, text).verdict is is_so


def test_things_with_others_are_counted(kitchen: GraphStore):
    assert ask_offline(kitchen, "how many tables have a cup on them?").number == 1
