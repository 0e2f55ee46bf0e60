"""Which word of a name is its head; cases are scored in `regression.csv`, groups `compounds` and `parents`."""

import json
import math

import pytest

from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.reading.head_noun import HeadFeatures, head_likelihood, head_log_odds
from usd2kg.knowledge import read_text

FITTED = json.loads(read_text("head_noun.json"))
WEIGHTS = FITTED["weights"]


def test_there_is_a_weight_for_each_feature():
    assert WEIGHTS.keys() == set(HeadFeatures._fields)
    assert FITTED["accepted_when_left_out"] > 0.9


def test_likelihood_is_the_exponential_of_the_weighted_sum():
    assert head_likelihood(HeadFeatures()) == 1.0
    expected = math.exp(2 * WEIGHTS["behind"] + 0.5 * WEIGHTS["size_log_ratio"])
    assert head_likelihood(HeadFeatures(behind=2.0, size_log_ratio=0.5)) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("name", "sign"), [("score", 1), ("compound", 1), ("size_log_ratio", 1), ("glued", -1), ("corrected", -1)]
)
def test_weights_have_the_expected_sign(name: str, sign: int):
    assert sign * WEIGHTS[name] > 0


def test_last_log_odds_is_the_log_odds_of_ending_a_compound():
    names = [name.lower().split() for found in home_names().values() for name in found]
    ends = sum(1 for words in names if len(words) > 1 and words[-1] == "oil")
    within = sum(words[:-1].count("oil") for words in names)
    assert head_log_odds("oil") == pytest.approx(math.log((ends + 1) / (within + 1)))
    assert head_log_odds("xqzv") == 0.0
