"""Ontologies and lists of labels with a class for what has no other, as NYU40's (Gupta et al., CVPR 2013)."""

import pytest

from tests.grounding.records import LAB, ground_names, make_class, make_tbox
from usd2kg.grounding.lexical.alignment.residual_class import default_class, residue_of
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import load_home_tbox

LABELS = "wall floor cabinet bed chair sofa table door window bookshelf counter desk shelves curtain television towel"
LIST = make_tbox(*map(make_class, [*LABELS.split(), "box", "lamp", "otherstructure", "otherfurniture", "otherprop"]))
SHOP = make_tbox(
    make_class("ShopThing"),
    make_class("Furniture", "ShopThing"),
    make_class("Table", "Furniture"),
    make_class("MiscItem", "ShopThing"),
    make_class("Process"),
)


@pytest.mark.parametrize(
    ("label", "residue"),
    [
        ("otherfurniture", "furniture"),
        ("other structures", "structure"),
        ("Miscellaneous kitchen tools", "kitchen tool"),
        ("otherprop", ""),
        ("sundry item", ""),
        ("Sundries", ""),
        ("Misc", ""),
        ("miscellaneous objects", ""),
        ("furniture", None),
        ("mother", None),
        ("prop", None),
        ("another chair", None),
        ("", None),
    ],
)
def test_what_a_label_leaves_over(label: str, residue: str | None):
    assert residue_of(label, load_taxonomy()) == residue


@pytest.mark.parametrize(
    ("name", "label"),
    [
        ("armchair_03", "chair"),
        ("bench_oak", "otherfurniture"),
        ("stool_2", "otherfurniture"),
        ("Wardrobe_A", "cabinet"),
        ("spiceRack", "shelves"),
        ("kettle", "otherprop"),
        ("fridge_main", "otherprop"),
        ("apple_green", "otherprop"),
        ("doorLever", "otherprop"),
        ("kitchen_scissors", "otherprop"),
        ("tv", "television"),
    ],
)
def test_things_go_to_their_label_or_to_the_rest(name: str, label: str):
    assert ground_names([name], LIST)[0].class_iri == LAB + label


def test_what_nobody_can_read_is_of_the_rest():
    assert ground_names(["qwrtzx"], LIST)[0].class_iri == LAB + "otherprop"


def test_rooms_are_no_sundries():
    corridor, umbrella, stool = ground_names(["corridor_2F", "umbrella_wet", "stool"], SHOP)
    assert corridor.class_iri == LAB + "ShopThing"
    assert umbrella.class_iri == LAB + "MiscItem"
    assert stool.class_iri == LAB + "Furniture"


def test_the_rest_says_little_of_a_thing():
    assert LexicalGrounder().general_classes(SHOP) == {LAB + name for name in ("ShopThing", "MiscItem", "Process")}
    assert LAB + "chair" not in LexicalGrounder().general_classes(LIST)
    home = load_home_tbox()
    assert LexicalGrounder().general_classes(home) == frozenset(home.roots)


def test_other_activities_are_no_things():
    tbox = make_tbox(
        make_class("Object"),
        make_class("Table", "Object"),
        make_class("Activity"),
        make_class("Other", "Activity"),
    )
    assert default_class(tbox, load_taxonomy()) == LAB + "Object"
    assert ground_names(["kettle"], tbox)[0].class_iri == LAB + "Object"


def test_a_class_for_the_rest_of_one_kind_is_not_for_all():
    tbox = make_tbox(*map(make_class, ["chair", "table", "otherfurniture"]))
    assert default_class(tbox, load_taxonomy()) is None
    bench, kettle = ground_names(["bench", "kettle"], tbox)
    assert bench.class_iri == LAB + "otherfurniture"
    assert kettle.class_iri is None
