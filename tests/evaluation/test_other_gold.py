"""Gold labels in `benchmarks/gold` for ontologies other than the built-in TBox."""

from pathlib import Path
from typing import NamedTuple

import pytest

from tests.conftest import shared_file
from usd2kg.evaluation.gold import GoldLabel, read_gold
from usd2kg.ontology import TBox, load_tbox
from usd2kg.scene import ReadOptions, SelectionOverrides, read_scene

GOLD = Path(__file__).parents[2] / "benchmarks" / "gold"
ONTOLOGIES = {
    "multiverse": "ontologies/other/multiverse_soma_dfl/SOMA_DFL_module.owl",
}
SCENES = {
    "small_house": "scenes/aws_robomaker/small_house.usdc",
    "franka_kitchen": "scenes/franka_kitchen/franka_kitchen.usdc",
}
COUNTS = {
    "small_house.multiverse": (87, 35),
    "franka_kitchen.multiverse": (28, 17),
}
"""Numbers of rows and distinct classes, as in the README of each file."""
DFL = "http://www.ease-crc.org/ont/SOMA_DFL.owl#"


class _Labelled(NamedTuple):
    name: str
    scene: Path
    tbox: TBox
    labels: tuple[GoldLabel, ...]


@pytest.fixture(scope="module", params=sorted(COUNTS))
def labelled(request: pytest.FixtureRequest) -> _Labelled:
    name: str = request.param
    scene, ontology = name.split(".")
    tbox = load_tbox(shared_file(ONTOLOGIES[ontology]))
    return _Labelled(name, shared_file(SCENES[scene]), tbox, read_gold(GOLD / f"{name}.csv", tbox))


def test_classes_are_in_scope_and_counts_match_the_readme(labelled: _Labelled) -> None:
    used = {label.target for label in labelled.labels}
    assert (len(labelled.labels), len(used)) == COUNTS[labelled.name]
    assert used | {other for label in labelled.labels for other in label.also} <= set(labelled.tbox.by_iri)


def test_paths_are_objects_of_the_scene(labelled: _Labelled) -> None:
    paths = {label.prim_path for label in labelled.labels}
    found = {obj.prim_path for obj in read_scene(labelled.scene).objects}
    assert paths <= found
    options = ReadOptions(selection=SelectionOverrides(only=tuple(sorted(paths))))
    assert {obj.prim_path for obj in read_scene(labelled.scene, options=options).objects} == paths


def test_classes_out_of_scope_match_the_readme() -> None:
    tbox = load_tbox(shared_file(ONTOLOGIES["multiverse"]))
    for name in ("sink", "lid", "kitchen"):
        assert not any(iri.startswith(f"{DFL}{name}.n.wn.artifact") for iri in tbox.by_iri)
    for name in ("handle", "knob", "room", "faucet", "countertop", "door", "cooktop", "kitchen_unit"):
        assert any(iri.startswith(f"{DFL}{name}.n.wn.artifact") for iri in tbox.by_iri)
