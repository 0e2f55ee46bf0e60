"""Answers about several things: in order, in total, in a range, what fits in, and what moves along."""

import pytest

from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore


@pytest.mark.parametrize(
    ("text", "is_rising"),
    [
        ("sort the chairs by height", False),
        ("put all chairs in order of height, shortest first", True),
        ("list the chairs, tallest first", False),
        ("rank the chairs by height, tallest first", False),
    ],
)
def test_things_in_order_of_a_measure(kitchen: GraphStore, text: str, is_rising: bool):
    found = ask_offline(kitchen, text).answer
    heights = [float(str(row[found.columns.index("tall_m")])) for row in found.values]
    assert len(heights) == 10
    assert heights == sorted(heights, reverse=not is_rising)


def test_an_average(kitchen: GraphStore):
    heights = ask_offline(kitchen, "how tall are the chairs?").answer
    values = [float(str(row[heights.columns.index("tall_m")])) for row in heights.values]
    found = ask_offline(kitchen, "what is the average height of the chairs?")
    assert found.number == pytest.approx(sum(values) / len(values), abs=1e-3)
    assert found.sentence.startswith("The average height of 10 chairs is ")


@pytest.mark.parametrize("text", ["total weight of the chairs", "how much do the chairs weigh in total?"])
def test_a_sum_needs_every_measure(kitchen: GraphStore, text: str):
    with pytest.raises(GraphError, match="not known: 8 of 10 chairs lack a mass"):
        ask_offline(kitchen, text)


def test_things_in_a_range(kitchen: GraphStore):
    found = ask_offline(kitchen, "list the things that weigh between 5 and 10 kg").answer
    assert sorted(str(row[0]) for row in found.rows) == ["chair_01", "fireExtinguisher", "toolBox"]


def test_a_range_without_a_measure_is_refused(kitchen: GraphStore):
    with pytest.raises(GraphError, match="does not say which measure is meant"):
        ask_offline(kitchen, "list the things between 1 and 2 m")


@pytest.mark.parametrize(
    ("text", "is_so"),
    [
        ("would the kettle fit into the microwave?", True),
        ("is the microwave big enough for the fridge?", False),
        ("is there anything loaded on the bar table?", True),
        ("anything left in the sink?", True),
        ("is one of the drawers empty?", True),
        ("do we have more cups than plates?", False),
        ("is the wall clock mounted higher than 1.5 m?", True),
        ("is the wall clock mounted higher than 2.5 m?", False),
    ],
)
def test_yes_or_no(kitchen: GraphStore, text: str, is_so: bool):
    assert ask_offline(kitchen, text).verdict is is_so


def test_what_moves_along_of_a_kind(kitchen: GraphStore):
    found = ask_offline(kitchen, "if I move the bar table, which apples come along?")
    assert sorted(str(row[0]) for row in found.answer.rows) == ["appleGreen", "apple_1", "apple_2", "apple_3"]
    assert found.sentence == "Four apples move along with bar table."


def test_how_far_a_part_opens(kitchen: GraphStore):
    assert "turns by " in ask_offline(kitchen, "how far can the fridge be opened?").sentence
    with pytest.raises(GraphError, match="no joint for microwave"):
        ask_offline(kitchen, "how far can the microwave be opened?")


def test_a_part_of_one_thing_is_not_that_of_another(kitchen: GraphStore):
    with pytest.raises(GraphError, match="no oven door"):
        ask_offline(kitchen, "how wide is the oven door?")
    with pytest.raises(GraphError, match="not known: no oven door is known"):
        ask_offline(kitchen, "is there an oven door?")


@pytest.mark.parametrize(
    ("text", "label"),
    [("I can't find the kettle", "Wasserkocher"), ("has anyone seen the kettle?", "Wasserkocher")],
)
def test_what_is_looked_for_is_located(kitchen: GraphStore, text: str, label: str):
    assert ask_offline(kitchen, text).sentence.startswith(f"{label} is on the worktop")


def test_a_number_for_each(kitchen: GraphStore):
    found = ask_offline(kitchen, "how many cups are on each table?")
    counts = {str(row[0]): str(row[found.answer.columns.index("count")]) for row in found.answer.rows}
    assert counts["barTable"] == "2"
    assert found.number is None


@pytest.mark.parametrize("end", ["? where?", " anywhere, and if so what is it on?", "? where is it?"])
def test_a_second_question_about_the_place(kitchen: GraphStore, end: str):
    assert ask_offline(kitchen, f"is there a toaster{end}").places
