"""The unit that a question asks for is that of the answer, or it is refused."""

import pytest

from usd2kg.assistant import ask_offline
from usd2kg.assistant.units import Units
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore


@pytest.mark.parametrize(
    ("text", "question"),
    [
        ("how high is the table in inches?", "how high is the table?"),
        ("how tall is it, in feet please", "how tall is it please"),
        ("how many feet tall is the ladder?", "how tall is the ladder?"),
        ("how many pounds does the crate weigh?", "how much does the crate weigh?"),
        ("floor area in square feet", "floor area"),
        ("what is in the box?", "what is in the box?"),
        ("which chair is in good shape?", "which chair is in good shape?"),
    ],
)
def test_the_unit_is_read_from_the_question(text: str, question: str):
    assert Units(text).question == question


@pytest.mark.parametrize(
    ("text", "value", "unit", "said"),
    [
        ("how high is it in inches?", 0.75, "m", "29.5 in"),
        ("how high is it in cm?", 1.852, "m", "185 cm"),
        ("its area in sq ft", 378.64, "m²", "4,076 ft²"),
        ("its area in m2", 5.0, "m²", "5 m²"),
        ("its weight in tonnes", 3900.0, "kg", "3.9 t"),
        ("its weight in tonnes", 0.75, "m", "75 cm"),
    ],
)
def test_a_quantity_is_converted_if_it_has_that_dimension(text: str, value: float, unit: str, said: str):
    assert Units(text).text(value, unit) == said


def test_sides_are_converted():
    assert Units("size of the box in cm").sides((0.4, 0.305, 0.2)) == "40.00 × 30.50 × 20.00 cm"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("how tall is the fridge in inches?", " in tall"),
        ("how many feet is the toaster from the kettle", " ft from"),
        ("floor area of the kitchen in square feet", " ft²"),
        ("what size is the floor, in m2?", " m²"),
    ],
)
def test_the_answer_is_in_the_unit(kitchen: GraphStore, text: str, said: str):
    assert said in ask_offline(kitchen, text).sentence


def test_a_unit_of_something_else_is_refused(kitchen: GraphStore):
    with pytest.raises(GraphError, match="'in feet' is not understood: the answer has no quantity in ft"):
        ask_offline(kitchen, "weight of the armchair in feet")
