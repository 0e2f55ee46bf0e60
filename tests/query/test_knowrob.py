"""Graphs load in SWI-Prolog, answer KnowRob's queries there, and load in other RDF and OWL readers."""

import csv
import shutil
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pyhornedowl
import pyoxigraph as ox
import pytest
import rdflib

import usd2kg
from tests.conftest import shared_file
from tests.graph.records import build_graph, thing
from usd2kg.demo import demo_relations, demo_scene
from usd2kg.graph import rdf_format, write_graph
from usd2kg.ontology import TBox
from usd2kg.relations import ALL_KINDS, RelationOptions, parse_viewpoint

needs_prolog = pytest.mark.skipif(
    shutil.which("swipl") is None, reason="needs SWI-Prolog, KnowRob's engine: apt-get install swi-prolog-nox"
)

QUESTIONS = Path(__file__).parents[2] / "tools/knowrob/questions.pl"
BASE = "https://example.org/kitchen/"
SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
DUL = "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#"
SOMA_HOME = "ontologies/soma/SOMA-HOME.owl"

Write = Callable[..., Path]
Answers = dict[str, set[tuple[str, ...]]]


@pytest.fixture(scope="module")
def write(tmp_path_factory: pytest.TempPathFactory) -> Write:
    """A function that writes the demo kitchen's graph, cached by its options."""
    folder = tmp_path_factory.mktemp("kitchen")
    scene = usd2kg.read_scene(demo_scene())
    relations = RelationOptions(kinds=ALL_KINDS, viewpoint=parse_viewpoint("0,0,1.6"))

    @cache
    def build(profile: str, *, merges: bool) -> usd2kg.KnowledgeGraph:
        ontology = shared_file(SOMA_HOME) if merges else None
        return usd2kg.build(
            scene, ontology, profile=profile, relations=relations, base=BASE, merges_imports=merges
        ).graph

    def write_as(profile: str = "soma", ending: str = ".ttl", *, merges: bool = False) -> Path:
        path = folder / f"{profile}{'_merged' if merges else ''}{ending}"
        if not path.exists():
            write_graph(build(profile, merges=merges), path)
        return path

    return write_as


def ask_knowrob(path: Path) -> Answers:
    """Return SWI-Prolog's answers: kind of question → rows, with local names of individuals."""
    done = subprocess.run(["swipl", str(QUESTIONS), str(path)], capture_output=True, text=True, check=True, timeout=120)
    # The parser recovers from errors with a warning on stderr.
    assert done.stderr == ""
    found: Answers = {}
    for line in done.stdout.splitlines():
        kind, *row = line.split("\t")
        found.setdefault(kind, set()).add(tuple(field.removeprefix(BASE) for field in row))
    return found


def triples_of(path: Path) -> set[ox.Triple]:
    return {quad.triple for quad in ox.parse(path=str(path), format=rdf_format(path))}


def authored(relation: str) -> set[tuple[str, str]]:
    """Return the authored pairs of a relation, as local names."""
    rows = csv.DictReader(demo_relations().read_text("utf-8").splitlines())
    pairs = [(row["subject"], row["object"]) for row in rows if row["relation"] == relation]
    return {(one[1:].replace("/", "."), other[1:].replace("/", ".")) for one, other in pairs}


@needs_prolog
class TestKnowRob:
    def test_every_object_has_dimensions_a_pose_and_a_mesh(self, write: Write):
        path = write()
        found = ask_knowrob(path)
        assert found["loaded"] == {(str(path), str(len(triples_of(path))))}
        for kind in ("dimensions", "pose", "mesh"):
            assert (kind, len(found[kind]), len({row[0] for row in found[kind]})) == (kind, 294, 294)

    def test_depth_lies_along_x_and_width_along_y(self, write: Write, tmp_path: Path, home_tbox: TBox):
        # KnowRob: depth is the extent along x, width along y, height along z.
        path = tmp_path / "box.ttl"
        write_graph(build_graph(home_tbox, [(thing("/Box", (0, 0, 0), (0.5, 0.25, 0.125)), "Box")], base=BASE), path)
        assert ask_knowrob(path)["dimensions"] == {("Box", "0.5", "0.25", "0.125")}
        # The table is authored 120 cm along the stage's x, 104 cm tall (its y), and 50 cm deep.
        table = {row[1:] for row in ask_knowrob(write())["dimensions"] if row[0].endswith(".barTable")}
        assert table == {("1.2", "0.5", "1.04")}

    def test_answers_poses_and_mesh_files(self, write: Write):
        found = ask_knowrob(write())
        name = "KitchenDining.breakfastBar.fruitBowl"
        # Authored 0.1 cm above the table's top at 104 cm; the stage is y-up, so the pose includes 90° about x.
        assert (name, "world", "-1.5 0.4 1.041 0.7071068 0 0 0.7071068") in found["pose"]
        assert (name, "assets/fruit_bowl.usdc") in found["mesh"]

    def test_support_matches_the_authored_layout(self, write: Write):
        found = ask_knowrob(write())
        assert found["supported"] == found["ontop"]
        on = authored("on")
        assert len(on) > 100
        assert len(on & found["supported"]) / len(on) > 0.98

    def test_types_include_superclasses(self, write: Write):
        types = ask_knowrob(write())["type"]
        mug = {cls.rpartition("#")[2] for name, cls in types if name.endswith(".mug_dirty")}
        assert {"Cup", "Crockery", "DesignedContainer", "DesignedArtifact", "Prim"} <= mug
        assert "Furniture" not in mug

    def test_merged_soma_entails_the_inverse_of_inside(self, write: Write):
        found = ask_knowrob(write(merges=True))
        holds = {(inner, outer) for outer, inner in found["contains"]}
        inside = authored("inside")
        assert len(inside) > 50
        assert len(inside & holds) / len(inside) > 0.95
        mug = {cls for name, cls in found["type"] if name.endswith(".mug_dirty")}
        assert {SOMA + "Cup", SOMA + "DesignedContainer", DUL + "PhysicalObject", DUL + "Object"} <= mug

    def test_turtle_and_ntriples_give_the_same_answers(self, write: Write):
        first, second = (ask_knowrob(write(merges=True, ending=ending)) for ending in (".ttl", ".nt"))
        assert {row[1] for row in first.pop("loaded")} == {row[1] for row in second.pop("loaded")}
        assert first == second


@pytest.mark.slow
@pytest.mark.parametrize("ending", [".ttl", ".nt", ".rdf"])
@pytest.mark.parametrize("merges", [False, True], ids=["alone", "merged"])
@pytest.mark.parametrize("profile", ["soma", "plain"])
class TestReaders:
    def test_rdflib_reads_every_triple(self, write: Write, profile: str, merges: bool, ending: str):
        path = write(profile, ending, merges=merges)
        assert len(rdflib.Graph().parse(path)) == len(triples_of(path))

    def test_an_owl_parser_reads_every_class_assertion(self, write: Write, profile: str, merges: bool, ending: str):
        # horned-owl reads no other RDF syntax.
        triples = triples_of(write(profile, ending, merges=merges))
        data = ox.serialize(triples, format=ox.RdfFormat.RDF_XML)
        ontology = pyhornedowl.open_ontology_from_string(data.decode(), serialization="rdf")
        axioms = [axiom.component for axiom in ontology.get_components()]
        named = {str(axiom.i) for axiom in axioms if type(axiom).__name__ == "ClassAssertion"}
        objects = {t.subject.value for t in triples if t.predicate.value == "https://w3id.org/usd2kg#primPath"}
        assert len(objects) >= 294
        assert objects <= named
        assert sum(type(axiom).__name__ == "DataPropertyAssertion" for axiom in axioms) >= 3 * 294
