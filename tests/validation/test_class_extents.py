"""Typical sizes of classes by IRI, else by label."""

import pytest

from usd2kg.validation.class_extents import typical_class_extent


def test_prefers_the_class_to_the_label():
    # class_sizes.csv: soma:Bottle is 0.29 m high; everyday_objects.csv: an accordion is 0.46 m long.
    assert typical_class_extent("http://www.ease-crc.org/ont/SOMA.owl#Bottle", "accordion") == 0.29
    assert typical_class_extent("https://lab.example/onto#A", "accordion") == pytest.approx(0.46)
    assert typical_class_extent("https://lab.example/onto#A", "gadget of ours") is None
