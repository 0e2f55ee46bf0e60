"""Ontologies of which no class is true of things of all kinds."""

from dataclasses import replace

import pytest

from tests.grounding.records import LAB, ground_names, make_class, make_tbox, scene_of
from usd2kg.grounding import ObjectView, Status, ground
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import load_home_tbox

FLAT = make_tbox(*(make_class(name) for name in ("Chair", "Table", "Mug", "Plate", "Knife", "Refrigerator", "Door")))
KNOWN = {"chair_06": "Chair", "side_plate": "Plate", "Fridge_01": "Refrigerator", "coffeeTable": "Table"}
PART = ("Cup", "Bowl", "Sofa")
NONE = ["kitchen_scale", "table_fork", "Wall_N", "teddy", "DoorMat", "qwrtzx", "pCube3", ""]


def default_of(*classes: tuple[str, ...]) -> str | None:
    tbox = make_tbox(*(make_class(*names) for names in classes))
    iri = build_lexicon(tbox, load_taxonomy(), {}).default
    return iri and iri.removeprefix(LAB)


@pytest.mark.parametrize(
    ("classes", "default"),
    [
        ([("Chair",), ("Table",)], None),
        ([("Furniture",), ("Chair", "Furniture"), ("Table", "Furniture"), ("Tool",)], None),
        # Of a single tree the root is true of all that is in the scope.
        ([("Furniture",), ("Chair", "Furniture"), ("Table", "Furniture")], "Furniture"),
        ([("Artifact",), ("Chair", "Artifact"), ("Person",)], "Artifact"),
        ([("StockItem",), ("Chair", "StockItem"), ("Person",)], "StockItem"),
        # What is no known word may be anything.
        ([("Zorkable",), ("Chair", "Zorkable"), ("Person",)], "Zorkable"),
    ],
)
def test_a_root_of_one_kind_is_not_true_of_most_things(classes: list[tuple[str, ...]], default: str | None):
    assert default_of(*classes) == default


def test_what_the_ontology_has_is_found():
    found = ground_names([*KNOWN], FLAT)
    assert {name: one.class_iri for name, one in zip(KNOWN, found, strict=True)} == {
        name: LAB + cls for name, cls in KNOWN.items()
    }
    assert all((one.confidence or 0.0) > 0.5 for one in found)


@pytest.mark.parametrize("abstains", [False, True])
def test_what_it_lacks_gets_no_class(abstains: bool):
    views = [(f"/x{at}", ObjectView(name)) for at, name in enumerate(NONE)]
    found = LexicalGrounder(abstains=abstains).ground_views(views, FLAT)
    assert [one.class_iri for one in found] == [None] * len(NONE)
    assert {one.status for one in found} == {Status.REFUSED}
    assert {one.confidence for one in found} == {None}


def test_the_explanation_says_why():
    scale, unknown = ground_names(["kitchen_scale", "qwrtzx"], FLAT)
    assert scale.explanation.startswith("“kitchen scale” is a kind of ")
    assert scale.explanation.endswith("“artifact”, which is no class of the ontology")
    assert unknown.explanation.endswith("; no class of the ontology is true of most things")


def test_no_answer_and_no_candidate_is_another_class_than_the_ontology_has():
    scene = scene_of(*(f"/World/{name}" for name in [*KNOWN, *filter(None, NONE)]))
    for prediction in ground(scene, FLAT).predictions:
        assert {candidate.class_iri for candidate in prediction.candidates} <= FLAT.by_iri.keys()
        assert prediction.class_iri is None or prediction.class_iri in FLAT.by_iri


def test_a_part_of_the_home_tbox_may_have_no_general_class():
    home = load_home_tbox()
    part = replace(home, classes=tuple(replace(home.by_iri[home.resolve(name)], parents=()) for name in PART))
    cup, teddy = ground_names(["coffee_mug", "teddy"], part)
    assert cup.class_iri == home.resolve("Cup")
    assert teddy.class_iri is None


def test_names_of_the_home_vocabulary_are_no_kinds_that_people_count_things_among():
    # Cold storage is a name of a room, and a refrigerator is cold storage.
    home = load_home_tbox()
    room = home.resolve("Room")
    tbox = make_tbox(make_class("Room", base=room.removesuffix("Room")), make_class("Chair"))
    assert [found.class_iri for found in ground_names(["Fridge", "guest_room"], tbox)] == [None, room]
