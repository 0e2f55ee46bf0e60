"""The built-in TBoxes: which one a scene gets, and what that of places holds."""

import gzip
from collections import Counter
from pathlib import Path

import pytest

from benchmarks.bare import bare_object, bare_scene
from tests.conftest import shared_file
from tests.kitchen import kitchen_scene
from usd2kg import build
from usd2kg.diff.versions import VersionOptions, read_versions
from usd2kg.graph import write_graph
from usd2kg.grounding import ObjectView, make_grounder
from usd2kg.grounding.built_in_choice import choose_built_in_tbox, count_place_votes, stated_places
from usd2kg.ontology import PLACES_IRI, load_home_tbox, load_places_tbox, load_tbox, read_closure
from usd2kg.pipeline import open_tbox
from usd2kg.scene import ReadOptions, Scene, read_scene

PLACES = load_places_tbox()
WORKPLACE = ["Forklift_01", "pallet_rack_3", "SM_EuroPallet", "shelf_a", "cardboard_box", "fire_extinguisher"]
HOME = ["sofa", "coffee_table", "book_3", "lamp", "potted_plant", "tv", "bed_01", "kitchen_cabinet", "wheelchair"]


def test_one_odd_thing_in_a_home_decides_nothing():
    votes = count_place_votes(HOME)
    assert (votes.workplaces, votes.is_workplace) == (("wheelchair",), False)


def test_a_fifth_of_the_names_decides():
    votes = count_place_votes([*WORKPLACE, *HOME])
    # The shelf and the box may be in a home.
    assert votes.workplaces == ("euro pallet", "fire extinguisher", "forklift", "pallet rack", "wheelchair")
    assert votes.homes == 10
    assert votes.is_workplace


def test_copies_of_a_name_count_once():
    assert count_place_votes([f"Pallet_{number}" for number in range(50)]).workplaces == ("pallet",)


def test_the_demo_kitchen_is_a_home():
    assert choose_built_in_tbox(kitchen_scene()) is load_home_tbox()


@pytest.mark.parametrize(
    ("scene", "is_workplace"),
    [("aws_robomaker/small_warehouse.usdc", True), ("aws_robomaker/small_house.usdc", False)],
)
def test_real_scenes(scene: str, is_workplace: bool):
    tbox = choose_built_in_tbox(read_scene(shared_file(f"scenes/{scene}")))
    assert (tbox.source == PLACES.source) == is_workplace
    assert all("--ontology home" in note.message for note in tbox.notes)


def test_a_graph_keeps_the_ontology_that_it_states():
    assert open_tbox(None, stated=["https://w3id.org/usd2kg/places"]) is PLACES
    assert open_tbox(None, stated=["https://w3id.org/usd2kg/places#Forklift"]) is PLACES
    assert open_tbox(None, stated=["http://www.ease-crc.org/ont/SOMA-HOME.owl"]) is load_home_tbox()


def scene_of(names: list[str]) -> Scene:
    return bare_scene("names", [bare_object(f"/World/{name}") for name in names])


def test_what_a_graph_states_precedes_what_suits_the_scene():
    workplace = scene_of(WORKPLACE)
    assert open_tbox(None, workplace).source == PLACES.source
    assert open_tbox(None, workplace, stated=[load_home_tbox().resolve("Cup")]) is load_home_tbox()


def test_one_workplace_among_the_scenes_decides():
    home, workplace = scene_of(HOME), scene_of(WORKPLACE)
    for scenes in ((home, workplace), (workplace, home)):
        assert open_tbox(None, *scenes).source == PLACES.source


@pytest.mark.parametrize("name", ["decisions.csv", "graph.ttl.gz"])
def test_a_file_states_places_by_its_text(tmp_path: Path, name: str):
    opener = gzip.open if name.endswith(".gz") else open
    with opener(tmp_path / name, "wb") as file:
        # The IRI lies on the border of two blocks.
        file.write(b" " * ((1 << 20) - 9) + b"https://w3id.org/usd2kg/places#Forklift")
    assert stated_places(None, tmp_path / name) == (PLACES_IRI,)
    (tmp_path / "other").write_bytes(b"https://w3id.org/usd2kg/home")
    assert stated_places(None, tmp_path / "other", tmp_path / "missing") == ()


def test_decisions_with_classes_of_places_are_kept_in_a_home():
    forklift = PLACES.resolve("Forklift")
    path = f"/World/{HOME[0]}"
    built = build(scene_of(HOME), decisions={path: forklift})
    assert built.tbox is PLACES
    assert built.grounding.by_path[path].class_iri == forklift


def test_a_stage_has_no_changes_from_its_own_graph_of_homes(tmp_path: Path):
    stage = shared_file("scenes/aws_robomaker/small_warehouse.usdc")
    write_graph(build(stage, "home").graph, tmp_path / "home.ttl")
    options = VersionOptions(ReadOptions())
    before, after = read_versions(
        tmp_path / "home.ttl", stage, lambda scenes, stated: open_tbox(None, *scenes, stated=stated), options
    )
    assert [one.classes for one in before.objects] == [one.classes for one in after.objects]


def test_the_tbox_of_places_extends_that_of_homes():
    home = load_home_tbox()
    for cls in home.classes:
        assert PLACES.by_iri[cls.iri].parents == cls.parents
        assert PLACES.by_iri[cls.iri].label == cls.label


def test_local_names_and_labels_are_unique():
    for names in ([cls.local_name for cls in PLACES.classes], [cls.label for cls in PLACES.classes]):
        assert [name for name, count in Counter(names).items() if count > 1] == []


def test_each_class_of_places_is_described():
    assert all(cls.comment.endswith(".") for cls in PLACES.classes)


def test_labels_and_synonyms_mean_their_class():
    views = [
        (f"/{cls.local_name}/{number}", ObjectView(name=name.replace(" ", "_")))
        for cls in PLACES.classes
        if "usd2kg/places#" in cls.iri
        for number, name in enumerate((cls.label, *cls.alt_labels))
    ]
    found = {p.prim_path: p.class_iri for p in make_grounder("lexical").ground_views(views, PLACES)}
    wrong = [view.name for path, view in views if PLACES.by_iri[found[path]].local_name != path.split("/")[1]]
    assert len(wrong) <= 0.02 * len(views), wrong


def test_the_name_of_a_built_in_tbox_is_an_ontology(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert load_tbox("places") is PLACES
    assert load_tbox("home", roots=["soma:Cup"]).classes[0].label == "cup"
    # A folder of that name does not hide it.
    (tmp_path / "places").mkdir()
    assert load_tbox("places") is PLACES


def test_a_self_contained_graph_has_the_classes_of_places():
    subjects = {str(triple.subject) for triple in read_closure(PLACES).triples}
    assert "<https://w3id.org/usd2kg/places#Forklift>" in subjects


def test_build_uses_the_named_tbox():
    assert build(scene_of(HOME), "places").tbox is PLACES
