"""Scenes and ontologies of the benchmark. None of the scenes is a test scene."""

from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox
from pxr import Usd

import usd2kg
from benchmarks.labelled_scenes import ROOT, SHARED
from usd2kg.demo import demo_scene
from usd2kg.graph import write_graph
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox
from usd2kg.query import Dataset, GraphStore, load_graph
from usd2kg.scene import ReadOptions
from usd2kg.validation import Finding, validate_graph

__all__ = ["ONTOLOGIES", "SCENES", "Key", "build_store", "find", "key_of", "open_ontology", "present"]

HERE = Path(__file__).parent
SCENES = {
    "demo kitchen": demo_scene(),
    "office": ROOT / "benchmarks/scenes/office/office.usda",
    "warehouse": ROOT / "benchmarks/scenes/warehouse/warehouse.usda",
    "apartment": SHARED / "scenes/iai_apartment/apartment.usdc",
    "small house": SHARED / "scenes/aws_robomaker/small_house.usdc",
    "small warehouse": SHARED / "scenes/aws_robomaker/small_warehouse.usdc",
    "bookstore": SHARED / "scenes/aws_robomaker/bookstore.usdc",
    "Franka kitchen": SHARED / "scenes/franka_kitchen/franka_kitchen.usdc",
    "DLR kitchen": SHARED / "scenes/dlr_kitchen/source/dlr_kitchen.usda",
}
ONTOLOGIES: dict[str, Path | None] = {
    "built-in": None,
    "DogOnt": SHARED / "ontologies/other/dogont/dogont.owl",
    "CCO": SHARED / "ontologies/other/cco/ArtifactOntology.ttl",
    "SAREF": SHARED / "ontologies/other/saref/saref4bldg.ttl",
    "RealEstateCore": SHARED / "ontologies/other/rec/rec.ttl",
    "twelve classes": HERE / "twelve.ttl",
}


class Key(NamedTuple):
    """What a finding is about, without its figures."""

    rule: str
    prim_path: str
    """Empty for a finding about the whole graph."""


def present(paths: dict[str, Path | None]) -> list[str]:
    """Return the names whose file exists, or needs none."""
    return [name for name, path in paths.items() if path is None or path.exists()]


def open_ontology(name: str) -> TBox:
    """Return one of `ONTOLOGIES`."""
    return open_tbox(ONTOLOGIES[name])


def build_store(scene: Path | Usd.Stage, tbox: TBox, folder: Path, options: ReadOptions | None = None) -> GraphStore:
    """Return the graph of a stage, written to a file and read back."""
    path = folder / "scene.nt"
    write_graph(usd2kg.build(scene, tbox, options=options).graph, path)
    return load_graph(path)


def find(store: GraphStore | ox.Store) -> dict[Key, list[Finding]]:
    """Return the plausibility findings by what they are about; those of shapes are not the subject here."""
    graph = store if isinstance(store, GraphStore) else GraphStore(Dataset(store), "corrupted")
    found: dict[Key, list[Finding]] = {}
    for finding in validate_graph(graph).findings:
        if finding.rule != "box-missing":
            found.setdefault(key_of(finding), []).append(finding)
    return found


def key_of(finding: Finding) -> Key:
    """Return what a finding is about."""
    return Key(finding.rule, finding.prim_path)
