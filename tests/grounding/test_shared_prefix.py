"""Prefixes that the names of a stage share say nothing about single objects."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import pytest

from benchmarks.bare import bare_object, bare_scene
from tests.kitchen import kitchen_scene
from usd2kg.grounding import NamingRegime, Prediction, ground
from usd2kg.grounding.lexical.reading.shared_prefix import shared_prefix, without_prefix
from usd2kg.ontology import load_home_tbox

THINGS = ("Bucket", "Chair", "Lamp", "Shelf", "Table", "TrashCan", "Cup", "Bottle")


def names_thing(name: str) -> bool:
    return any(thing in name for thing in THINGS)


def test_eight_of_eight_names_share_a_prefix_and_seven_of_seven_do_not():
    # 8 / (8 + 2) = 0.8; 7 / (7 + 2) = 0.78.
    names = [f"acme_{thing}_01" for thing in THINGS]
    assert shared_prefix(names, names_thing) == ("acme",)
    assert shared_prefix(names[:7], names_thing) == ()


def test_copies_count_once():
    names = [f"acme_{thing}_{number:02d}" for thing in THINGS[:4] for number in range(10)]
    assert shared_prefix(names, names_thing) == ()


def test_the_prefix_is_the_longest_that_most_names_share():
    names = [f"acme_Depot_{thing}" for thing in THINGS] + ["acme_Sign"]
    # “acme”: 9 / 11 = 0.82; “acme depot”: 8 / 11 = 0.73.
    assert shared_prefix(names, names_thing) == ("acme",)
    assert shared_prefix(names[:-1], names_thing) == ("acme", "depot")


def test_names_that_begin_with_the_head_noun_have_no_prefix():
    colours = ("Red", "Blue", "Green", "Oak", "Pine", "White", "Black", "Grey", "Brown")
    assert shared_prefix([f"Chair_{colour}" for colour in colours], names_thing) == ()


@pytest.mark.parametrize(
    ("name", "prefix", "expected"),
    [
        ("acme_depot_Bucket_01", ("acme", "depot"), "Bucket_01"),
        ("AcmeBucket2", ("acme",), "Bucket2"),
        ("acme_01", ("acme",), "acme_01"),
        ("Bucket_acme", ("acme",), "Bucket_acme"),
        ("acme", ("acme", "depot"), "acme"),
        ("Bucket", (), "Bucket"),
    ],
)
def test_a_prefix_is_left_out_only_at_the_beginning_and_before_a_word(
    name: str, prefix: tuple[str, ...], expected: str
):
    assert without_prefix(name, prefix) == expected


def test_a_vendor_is_not_read_as_a_similar_noun():
    names = ("Bucket", "Lamp", "WallB", "ShelfF", "TrashCanC", "GroundB", "PalletJackB", "RoofB", "Chair")
    scene = bare_scene(
        "depot", [bare_object(f"/World/aws_robomaker_warehouse_{name}_01", (0.5, 0.5, 0.5)) for name in names]
    )
    found = ground(scene, load_home_tbox()).predictions
    assert [load_home_tbox().by_iri[str(one.class_iri)].local_name for one in found[:4]] == [
        "DesignedContainer",
        "Appliance",
        "Wall",
        "DesignedFurniture",
    ]
    assert "most names of the stage begin with “aws robomaker warehouse”" in found[0].explanation


def test_a_distant_spelling_is_not_read_before_a_word_that_names_an_object():
    scene = bare_scene("one", [bare_object("/World/robomaker_bucket", (0.5, 0.5, 0.5))])
    (prediction,) = ground(scene, load_home_tbox()).predictions
    assert str(prediction.class_iri).endswith("DesignedContainer")
    assert "robomower" not in prediction.explanation


@cache
def kitchen_predictions() -> Sequence[Prediction]:
    return ground(kitchen_scene(), load_home_tbox()).predictions


@pytest.mark.parametrize("prefix", ["acme_", "ACME_HQ_Level02_", "robomaker_warehouse_", "Zorg"])
def test_a_common_prefix_changes_hardly_any_class_of_the_demo_scene(prefix: str):
    scene = kitchen_scene()
    renamed = replace(
        scene, objects=tuple(replace(one, name=prefix + one.name[:1].upper() + one.name[1:]) for one in scene.objects)
    )
    before, after = kitchen_predictions(), ground(renamed, load_home_tbox()).predictions
    changed = [one.prim_path for one, other in zip(before, after, strict=True) if one.class_iri != other.class_iri]
    assert len(changed) <= 0.02 * len(before), changed


def test_masked_regimes_ignore_the_prefix():
    scene = bare_scene("depot", [bare_object(f"/World/acme_{name}", (0.5, 0.5, 0.5)) for name in (*THINGS, "Broom")])
    found = ground(scene, load_home_tbox(), regime=NamingRegime.OPAQUE).predictions
    assert not any("begin with" in one.explanation for one in found)
