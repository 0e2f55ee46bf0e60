"""Vectors of words."""

import numpy as np
import pytest

from tools.fit_word_vectors import count_words, split_words
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.concepts.word_vectors import WordVectors, load_word_vectors

VECTORS = WordVectors(
    {"tap": 0, "tower": 1}, np.array([[100, 0], [0, 50]], np.int8), np.array([3.0 / 100, 4.0 / 50], np.float32)
)


def test_words_are_weighted_by_their_scale():
    # 3 · (1, 0) + 4 · (0, 1), over its length 5.
    assert VECTORS.embed({"tap": 1.0, "tower": 1.0}).tolist() == pytest.approx([0.6, 0.8])


def test_a_weight_multiplies_the_vector_of_a_word():
    assert VECTORS.embed({"tap": 2.0, "tower": 1.5}).tolist() == pytest.approx([0.5**0.5, 0.5**0.5])


@pytest.mark.parametrize("weights", [{}, {"flurbl": 1.0}])
def test_unknown_words_have_the_zero_vector(weights: dict[str, float]):
    assert VECTORS.embed(weights).tolist() == [0.0, 0.0]


@pytest.mark.parametrize(
    ("word", "near", "far"),
    [("trolley", "cart", "tower"), ("signage", "sign", "spoon"), ("shelf", "shelving", "engine")],
)
def test_words_for_the_same_thing_are_near(word: str, near: str, far: str):
    vectors = load_word_vectors()
    own, other, unlike = (vectors.embed({each: 1.0}) for each in (word, near, far))
    assert np.linalg.norm(own) == pytest.approx(1.0, abs=1e-6)
    assert own @ other > 0.6 > own @ unlike + 0.3


def test_a_sense_has_the_words_of_its_hypernyms_and_of_their_categories():
    taxonomy = load_taxonomy()
    bowl = taxonomy.senses("bowl")[0].synset
    vessel = taxonomy.above(bowl)[0]
    words = count_words(bowl, taxonomy, {bowl: ("mixing bowl",), vessel: ("serving vessel",)})
    # A label weighs 3, the label of a hypernym 2, a category 0.5, all times 0.7 a step.
    assert words["bowl"] == pytest.approx(3.0 + 0.5)
    assert words["mixing"] == pytest.approx(0.5)
    assert words["vessel"] == pytest.approx(0.7 * 2.0 + 0.7 * 0.5)
    assert words["serving"] == pytest.approx(0.7 * 0.5)


def test_a_compound_without_spaces_has_no_words():
    taxonomy = load_taxonomy()
    assert split_words("hvac ducts", taxonomy) == {"hvac", "duct"}
    assert split_words("hvacduct", taxonomy) == set()
