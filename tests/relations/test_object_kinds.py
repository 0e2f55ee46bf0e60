"""Relations are the same whatever the ontology says, since they know what objects are."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

from benchmarks.names.lists import PUBLIC_ONTOLOGIES
from tests.conftest import shared_file
from tests.graph.records import thing
from tests.grounding.records import LAB, make_class, make_scene, make_tbox
from tests.judged_scenes import judged_stage
from tests.kitchen import kitchen_scene
from usd2kg.grounding import NamingRegime, ground
from usd2kg.ontology import TBox, load_home_tbox, load_tbox
from usd2kg.relations import RelationOptions, find_relations, load_rules
from usd2kg.relations.object_kinds import find_kinds
from usd2kg.scene import Scene, read_scene

SHARED = (
    "soma/SOMA-HOME.owl",
    # SOMA+DFL builds on SOMA and says more: that trays contain what is on them.
    *(f"other/{path}" for name, path in PUBLIC_ONTOLOGIES.items() if name != "SOMA+DFL"),
    "other/saref/saref4bldg.ttl",
)
BENCHMARKS = Path(__file__).parents[2] / "benchmarks/ontologies"
OWN = make_tbox(
    make_class("Item"),
    *(
        make_class(name, "Item")
        for name in "Furniture Seat Table Storage Tableware Tool Appliance Lamp Textile Food Structure".split()
    ),
)
"""Twelve classes of a user."""
LABELS = make_tbox(*(make_class(name) for name in ("wall", "floor", "cabinet", "chair", "otherprop")))
"""A list of labels, such as NYU40's."""
ROOM = make_scene(
    thing("/Room/table_1", (0, 0, 0), (1.6, 0.8, 0.7)),
    thing("/Room/salad_bowl", (0.2, 0.2, 0.7), (0.3, 0.3, 0.1)),
    thing("/Room/apple", (0.3, 0.3, 0.72), (0.08, 0.08, 0.06)),
    thing("/Room/chair_2", (0.3, 0.1, 0), (0.4, 0.4, 0.6)),
)


def slow(*names: str) -> list[ParameterSet]:
    """Return parameters for which a test is slow: the lexicon of each ontology takes a second."""
    return [pytest.param(name, marks=pytest.mark.slow) for name in names]


@cache
def demo() -> Scene:
    return kitchen_scene()


def links(scene: Scene, tbox: TBox, options: RelationOptions | None = None) -> set[tuple[str, str, str]]:
    found = find_relations(scene, tbox, ground(scene, tbox), options)
    return {(link.target, link.kind, link.anchor) for link in found}


@cache
def home_links() -> set[tuple[str, str, str]]:
    return links(demo(), load_home_tbox())


@pytest.mark.parametrize("tbox", [OWN, LABELS], ids=["twelve classes", "labels"])
def test_small_ontologies_give_the_relations_of_the_home_tbox(tbox: TBox):
    assert links(demo(), tbox) == home_links()


@pytest.mark.parametrize("name", ["store", *slow("farm", "street", "works")])
def test_ontologies_of_other_fields_give_the_relations_of_the_home_tbox(name: str):
    assert links(demo(), load_tbox(BENCHMARKS / f"{name}.ttl")) == home_links()


@pytest.mark.parametrize("path", [*SHARED[:2], *slow(*SHARED[2:])])
def test_public_ontologies_give_the_relations_of_the_home_tbox(path: str):
    assert links(demo(), load_tbox(shared_file(f"ontologies/{path}"))) == home_links()


@cache
def house() -> Scene:
    return read_scene(shared_file("scenes/aws_robomaker/small_house.usdc"))


@cache
def house_links() -> set[tuple[str, str, str]]:
    return links(house(), load_home_tbox())


@pytest.mark.parametrize("path", [SHARED[0], *slow(*SHARED[1:])])
def test_a_real_house_has_the_same_relations_and_rooms(path: str):
    found = links(house(), load_tbox(shared_file(f"ontologies/{path}")))
    assert found == house_links()
    assert {anchor for _, kind, anchor in found if kind == "room"} == {"room 1", "room 2", "room 3"}


def test_a_real_house_has_the_same_relations_under_a_small_ontology():
    assert links(house(), OWN) == house_links()


@pytest.mark.slow
def test_a_real_house_has_the_same_relations_under_a_list_of_labels():
    assert links(house(), LABELS) == house_links()


@cache
def garage() -> Scene:
    return read_scene(judged_stage("garage"))


@cache
def garage_links() -> set[tuple[str, str, str]]:
    return links(garage(), load_home_tbox())


@pytest.mark.parametrize("path", [SHARED[1], *slow(SHARED[0], *SHARED[2:])])
def test_a_garage_has_the_same_relations(path: str):
    assert links(garage(), load_tbox(shared_file(f"ontologies/{path}"))) == garage_links()


@pytest.mark.parametrize("tbox", [OWN, pytest.param(LABELS, marks=pytest.mark.slow)], ids=["twelve classes", "labels"])
def test_a_garage_has_the_same_relations_under_small_ontologies(tbox: TBox):
    assert links(garage(), tbox) == garage_links()


def test_not_everything_is_a_container():
    assert links(ROOM, OWN) >= {
        ("/Room/apple", "inside", "/Room/salad_bowl"),
        ("/Room/salad_bowl", "on", "/Room/table_1"),
    }
    # The chair is in the table's box.
    assert not any(kind == "inside" for target, kind, _ in links(ROOM, OWN) if target == "/Room/chair_2")


@pytest.mark.parametrize(
    ("name", "item", "is_inside"), [("containers", "Table", True), ("not_containers", "Tableware", False)]
)
def test_lists_of_the_user_count(tmp_path: Path, name: str, item: str, is_inside: bool):
    path = tmp_path / "rules.toml"
    path.write_text(f'[classes.extend]\n{name} = ["{LAB}{item}"]\n', encoding="utf-8")
    rules = load_rules(path)
    found = links(ROOM, OWN, RelationOptions(rules=rules))
    target, anchor = ("chair_2", "table_1") if is_inside else ("apple", "salad_bowl")
    assert ((f"/Room/{target}", "inside", f"/Room/{anchor}") in found) is is_inside


def test_a_decision_against_the_name_counts():
    # A person says that the bowl is a lamp, which contains nothing.
    grounding = ground(ROOM, OWN, decisions={"/Room/salad_bowl": f"{LAB}Lamp"})
    found = {(link.target, link.kind) for link in find_relations(ROOM, OWN, grounding)}
    assert ("/Room/apple", "inside") not in found


def test_masked_names_are_not_used():
    grounding = ground(ROOM, OWN, regime=NamingRegime.OPAQUE)
    kinds = find_kinds(ROOM, OWN, grounding)
    renamed = replace(ROOM, objects=tuple(replace(obj, name="thing") for obj in ROOM.objects))
    assert find_kinds(renamed, OWN, grounding) == kinds
