"""Which word of a name is its head."""

import json
import math

import pytest

from tests.grounding.records import ground_names, ground_view, local
from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.alignment.lexicon import home_names
from usd2kg.grounding.lexical.reading.head_noun import Features, likelihood, propensity
from usd2kg.knowledge import read_text
from usd2kg.ontology import TBox

FITTED = json.loads(read_text("heads.json"))


def test_there_is_a_weight_for_each_feature():
    assert FITTED["weights"].keys() == set(Features._fields)
    assert FITTED["accepted_when_left_out"] > 0.9


def test_the_likelihood_is_the_exponential_of_the_weighted_sum():
    weights = FITTED["weights"]
    assert likelihood(Features()) == 1.0
    expected = math.exp(2 * weights["behind"] + 0.5 * weights["size"])
    assert likelihood(Features(behind=2.0, size=0.5)) == pytest.approx(expected)


@pytest.mark.parametrize(("name", "sign"), [("score", 1), ("compound", 1), ("size", 1), ("glued", -1), ("guessed", -1)])
def test_what_was_learned_is_what_one_expects(name: str, sign: int):
    assert sign * FITTED["weights"][name] > 0


def test_propensity_counts_where_a_word_stands_in_names_of_several():
    names = [name.lower().split() for found in home_names().values() for name in found]
    ends = sum(1 for words in names if len(words) > 1 and words[-1] == "oil")
    within = sum(words[:-1].count("oil") for words in names)
    assert propensity("oil") == pytest.approx(math.log((ends + 1) / (within + 1)))
    assert propensity("xqzv") == 0.0


@pytest.mark.parametrize(
    ("name", "parent", "expected"),
    [
        # The parent's name says that the sink is what it belongs to.
        ("doorSink_L", "sinkUnit", "Door"),
        # A part of the whole that the parent is.
        ("RockingChair_Spindle", "RockingChair_02", "DesignedComponent"),
        ("RockingChair_Spindle", "Props", "DesignedChair"),
        ("WashingMachine_Gasket", "WashingMachine", "DesignedComponent"),
    ],
)
def test_what_the_parent_is_called_tells_the_head(home_tbox: TBox, name: str, parent: str, expected: str):
    view = ObjectView(name=name, parents=("World", parent))
    assert local(ground_view(view, home_tbox)) == expected


def test_the_special_term_is_taken_for_the_general_one(home_tbox: TBox):
    expected = {"plate_dinner": "DinnerPlate", "Bottle_Water": "WaterBottle", "glass_wine": "WineGlass"}
    assert dict(zip(expected, map(local, ground_names(list(expected), home_tbox)), strict=True)) == expected


def test_heads_in_front_and_at_the_end(home_tbox: TBox):
    expected = {
        "RoomWindow_01": "DesignedComponent",
        "KitchenCabinet_02": "KitchenCabinet",
        "bowl_salad_oak": "SaladBowl",
        "plate_blue_porcelain": "Plate",
        "teapot_lid": "Lid",
        "door_fridge_upper": "Door",
        "hingeleftdoor": "Door",
    }
    found = dict(zip(expected, map(local, ground_names(list(expected), home_tbox)), strict=True))
    assert found == expected
