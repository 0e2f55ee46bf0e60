"""Questions with misspelt words."""

import pytest

from usd2kg.assistant import ask_offline
from usd2kg.assistant.misspellings import respelled
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore
from usd2kg.query.lookup import Nouns


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("is the kettel next to the toster?", "is the kettle next to the toaster?"),
        ("wich chairs are benaeth the winndow", "wich chairs are beneath the window"),
        ("which cups belong to barTable or Fridge_01?", None),
        ("where is the qwxyzk?", None),
    ],
)
def test_unknown_words_become_the_nearest(kitchen: GraphStore, written: str, meant: str | None):
    assert respelled(written, Nouns(kitchen.facts)) == meant


def test_the_answer_says_how_it_was_read(kitchen: GraphStore):
    found = ask_offline(kitchen, "what is in the cutlry tray?")
    assert found.answer.rows
    assert "“what is in the cutlery tray?”" in found.sentence


def test_nothing_follows_from_a_correction(kitchen: GraphStore):
    with pytest.raises(GraphError, match="read as “which pianos are on the table"):
        ask_offline(kitchen, "which piannos are on the table")


def test_a_substance_may_have_two_words(kitchen: GraphStore):
    found = ask_offline(kitchen, "which things are made of cast iron?")
    assert "fryingPan_28" in {row[0] for row in found.answer.rows}
