"""Usual sizes: of a class by its IRI, else by its label."""

import pytest

from usd2kg.grounding.lexical.concepts.sizes import typical_extents
from usd2kg.validation.class_extents import typical_class_extent


def test_by_class_then_by_label():
    # class_sizes.csv: soma:Bottle is 0.29 m high; things.csv: an accordion is 0.46 m long.
    assert typical_class_extent("http://www.ease-crc.org/ont/SOMA.owl#Bottle", "accordion") == 0.29
    assert typical_class_extent("https://lab.example/onto#A", "accordion") == pytest.approx(0.46)
    assert typical_class_extent("https://lab.example/onto#A", "gadget of ours") is None


def test_all_extents_of_a_thing_longest_first():
    assert typical_extents("acousticguitar") == pytest.approx((1.02, 0.4, 0.12))
    assert typical_extents("nosuchthing") is None
