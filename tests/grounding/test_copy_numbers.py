"""Names without the numbers that tell copies apart."""

import pytest

from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.reading.copy_numbers import without_copy_numbers
from usd2kg.grounding.lexical.reading.evidence_texts import is_generated_name
from usd2kg.knowledge import word_set
from usd2kg.ontology import load_home_tbox

NAMES = (
    "oak_chair_17",
    "OakChair17",
    "Box003",
    "Box_3",
    "cabinet10_drawer",
    "cabinet10_drawer2",
    "cab10_drawer_3",
    "cab5",
    "shelf_4tier_2",
    "Room1Door",
    "toy_bin_w_lid_3",
    "towel_on_rack_12",
    "chair_3_on_table_4",
    "Flat_12_table_12",
    "tn__knob1_f5",
    "кресло_7",
    "12",
    "000",
    "",
)
PARENTS = (
    (),
    ("World", "Flat_12"),
    ("cabinet10",),
    ("cabinet7", "Room0"),
    ("Room1", "Table_00"),
    ("Hall_3", "box_000"),
)


def test_copies_get_equal_names():
    equal = {without_copy_numbers(f"oak_chair_{n}", ("World", f"Flat_{n + 100}", "Kitchen")) for n in range(1, 100)}
    assert equal == {("oak_chair_0", ("World", "Flat_00", "Kitchen"))}


@pytest.mark.parametrize("parents", PARENTS)
@pytest.mark.parametrize("name", NAMES)
def test_the_equalized_names_read_the_same(name, parents):
    reader = LexicalGrounder().object_grounder(load_home_tbox()).reader
    plain, equalized = reader._read(name, parents), reader._read(*without_copy_numbers(name, parents))
    assert (plain, plain.glued, plain.is_head_last) == (equalized, equalized.glued, equalized.is_head_last)
    assert is_generated_name(without_copy_numbers(name, parents)[0]) == is_generated_name(name)


@pytest.mark.parametrize(
    ("name", "parents"),
    [("cabinet5", ("cabinet5",)), ("door_0", ("cab0",)), ("cab00_door_5", ("cabinet7",)), ("cab_7", ("x0",))],
)
def test_numbers_that_may_refer_to_a_prim_above_stay(name, parents):
    assert without_copy_numbers(name, parents) == (name, parents)


def test_no_compound_of_the_taxonomy_ends_with_a_preposition_and_a_number():
    # Else the last number of a name could decide whether it is cut before the preposition.
    words = word_set("lexical", "prepositions")
    nouns = load_taxonomy()
    assert not [word + str(number) for word in words for number in range(100) if f"chair{word}{number}" in nouns]
