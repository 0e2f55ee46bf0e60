"""Graphs load in SWI-Prolog, answer KnowRob's queries there, and load in other RDF and OWL readers."""

import csv
import shutil
import subprocess
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pyhornedowl
import pyoxigraph as ox
import pytest
import rdflib

import usd2kg
from tests.conftest import shared_file
from tests.graph.records import build_graph, thing
from tests.kitchen import kitchen_scene
from usd2kg.demo import demo_relations
from usd2kg.graph import PropertyGraph, rdf_format, read_document, read_property_graph, write_graph
from usd2kg.graph.export.ros.frame_ids import frame_id_of
from usd2kg.graph.export.ros.rigid_transform import read_pose
from usd2kg.graph.export.ros.transforms import read_transforms
from usd2kg.ontology import TBox
from usd2kg.query import Answer, GraphStore, load_graph
from usd2kg.relations import ALL_KINDS, RelationOptions, parse_viewpoint

needs_prolog = pytest.mark.skipif(
    shutil.which("swipl") is None, reason="needs SWI-Prolog, KnowRob's engine: apt-get install swi-prolog-nox"
)

QUESTIONS = Path(__file__).parents[2] / "integrations/knowrob/questions.pl"
BASE = "https://example.org/kitchen/"
SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
DUL = "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#"
BOWL = "/KitchenDining/breakfastBar/fruitBowl"
SOMA_HOME = "ontologies/soma/SOMA-HOME.owl"

Write = Callable[..., Path]
Rows = list[tuple[str, ...]]


@pytest.fixture(scope="module")
def write(tmp_path_factory: pytest.TempPathFactory) -> Write:
    """A function that writes the demo kitchen's graph, cached by its options."""
    folder = tmp_path_factory.mktemp("kitchen")
    scene = kitchen_scene()
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


@pytest.fixture(scope="module")
def store(write: Write) -> GraphStore:
    return load_graph(write())


@pytest.fixture(scope="module")
def graph(write: Write) -> PropertyGraph:
    return read_property_graph(read_document(write()))


class Prolog:
    """A process of SWI-Prolog that has loaded a graph and answers questions about it."""

    LOOP = (
        "prompt(_, ''), repeat, read_line_to_string(user_input, Line), ( Line == end_of_file -> halt ;"
        " split_string(Line, '\\t', '', Parts), maplist(atom_string, [Name|Words], Parts),"
        " question(Name, Kinds, Goal, Fields), ask(Words, Kinds, Goal, Fields), writeln(end), flush_output, fail )"
    )

    def __init__(self, path: Path) -> None:
        self._errors = path.with_name(f"{path.name}.stderr")
        loaded = f"load('{path}'), {self.LOOP}"
        with self._errors.open("wb") as errors:
            self._process = subprocess.Popen(
                ["swipl", "-l", str(QUESTIONS), "-g", loaded],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
            )

    def ask(self, question: tuple[str, ...]) -> Rows:
        assert self._process.stdin is not None and self._process.stdout is not None
        print(*question, sep="\t", file=self._process.stdin, flush=True)
        lines = []
        while (line := self._process.stdout.readline()) != "end\n":
            assert line, self._errors.read_text("utf-8")
            lines.append(line)
        # The parser recovers from errors with a warning on stderr.
        assert self._errors.read_text("utf-8") == ""
        return [tuple(line.removesuffix("\n").split("\t")) for line in lines]

    def close(self) -> None:
        self._process.communicate(timeout=60)


_RUNNING: dict[Path, Prolog] = {}


@pytest.fixture(scope="module", autouse=True)
def close_prolog() -> Iterator[None]:
    yield
    while _RUNNING:
        _RUNNING.popitem()[1].close()


def ask_prolog(path: Path, *question: str) -> Rows:
    """Return SWI-Prolog's answers to a question: rows of prim paths, names and numbers."""
    if path not in _RUNNING:
        _RUNNING[path] = Prolog(path)
    return _RUNNING[path].ask(question)


def run_prolog(path: Path, *question: str) -> "subprocess.CompletedProcess[str]":
    command = ["swipl", str(QUESTIONS), str(path), *question]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)


def triples_of(path: Path) -> set[ox.Triple]:
    return {quad.triple for quad in ox.parse(path=str(path), format=rdf_format(path))}


def authored(relation: str) -> set[tuple[str, str]]:
    """Return the authored pairs of a relation, as prim paths."""
    rows = csv.DictReader(demo_relations().read_text("utf-8").splitlines())
    return {(row["subject"], row["object"]) for row in rows if row["relation"] == relation}


def pairs(rows: Rows) -> set[tuple[str, str]]:
    return {(row[0], row[1]) for row in rows}


@needs_prolog
class TestAuthoredKitchen:
    """What SWI-Prolog reads from the graph agrees with the scene that was authored."""

    @pytest.mark.parametrize("question", ["size", "where", "mesh", "transform"])
    def test_every_object_has_an_answer(self, write: Write, question: str):
        rows = ask_prolog(write(), question)
        assert len(rows) == len({row[question == "transform"] for row in rows}) == 294

    def test_the_command_line_prints_the_answers(self, write: Write):
        done = run_prolog(write(), "where", BOWL)
        assert (done.returncode, done.stderr) == (0, "")
        assert [tuple(line.split("\t")) for line in done.stdout.splitlines()] == ask_prolog(write(), "where", BOWL)

    def test_depth_lies_along_x_and_width_along_y(self, write: Write, tmp_path: Path, home_tbox: TBox):
        # KnowRob: depth is the extent along x, width along y, height along z.
        path = tmp_path / "box.ttl"
        write_graph(build_graph(home_tbox, [(thing("/Box", (0, 0, 0), (0.5, 0.25, 0.125)), "Box")], base=BASE), path)
        assert ask_prolog(path, "size") == [("/Box", "0.5", "0.25", "0.125")]
        # The table is authored 120 cm along the stage's x, 104 cm tall (its y), and 50 cm deep.
        ((_, *table),) = ask_prolog(write(), "size", "barTable")
        assert table == ["1.2", "0.5", "1.04"]

    def test_poses_and_mesh_files(self, write: Write):
        # Authored 0.1 cm above the table's top at 104 cm; the stage is y-up, so the pose includes 90° about x.
        assert ask_prolog(write(), "where", BOWL) == [(BOWL, "world", "-1.5 0.4 1.041", "0.707107 0.0 0.0 0.707107")]
        assert ask_prolog(write(), "mesh", BOWL) == [(BOWL, "assets/fruit_bowl.usdc")]

    def test_support(self, write: Write):
        on = authored("on")
        assert len(on) > 100
        assert len(on & pairs(ask_prolog(write(), "on"))) / len(on) > 0.98

    def test_merged_soma_entails_the_inverse_of_inside(self, write: Write):
        path = write(merges=True)
        inside = authored("inside")
        assert len(inside) > 50
        assert len(inside & pairs(ask_prolog(path, "inside"))) / len(inside) > 0.95
        mug = {cls for name, cls in ask_prolog(path, "instances") if name.endswith("/mug_dirty")}
        assert {SOMA + "Cup", SOMA + "DesignedContainer", DUL + "PhysicalObject", DUL + "Object"} <= mug

    def test_turtle_and_ntriples_give_the_same_answers(self, write: Write):
        turtle, ntriples = (write(merges=True, ending=ending) for ending in (".ttl", ".nt"))
        for question in ("relation", "transform", "instances"):
            assert ask_prolog(turtle, question) == ask_prolog(ntriples, question)


@needs_prolog
class TestQuestions:
    """Each question has the answer of the Python interface."""

    def test_what_is_on_the_table(self, write: Write, store: GraphStore):
        rows = ask_prolog(write(), "on", "barTable")
        answer = store.on("/KitchenDining/breakfastBar/barTable")
        assert len(rows) == 8
        assert [row[0] for row in rows] == column(answer, "path")
        assert [float(row[2]) for row in rows] == pytest.approx([*map(float, column(answer, "gap_m"))], abs=1e-4)

    def test_what_supports_an_apple(self, write: Write, store: GraphStore):
        found = {row[1].rpartition("/")[2] for row in ask_prolog(write(), "supports", "apple_1")}
        assert found == set(column(store.answer("support-chain", {"thing": "apple_1"}), "object"))
        assert found == {"fruitBowl", "barTable", "floor_tiles"}

    def test_what_is_in_the_bowl(self, write: Write, store: GraphStore):
        found = [row[0] for row in ask_prolog(write(), "inside", "fruitBowl")]
        assert found == column(store.inside(BOWL), "path")
        assert len(found) == 7

    def test_what_may_contain_the_cup(self, write: Write, store: GraphStore):
        cup = "/KitchenDining/breakfastBar/espressoCup_1"
        boxes = store.sparql(
            "SELECT ?path ?x ?y ?z (EXISTS { ?o a/rdfs:subClassOf* soma:DesignedContainer } AS ?contains) {"
            " ?o u2k:primPath ?path ; soma:hasShape/dul:hasRegion ?box ."
            " ?box soma:hasDepth ?x ; soma:hasWidth ?y ; soma:hasHeight ?z }"
        ).rows
        extents = {path: sorted(map(float, sides)) for path, *sides, _ in boxes}
        containers = {row[0] for row in boxes if row[-1] == "true"}
        fits = {p for p in containers if all(a < b for a, b in zip(extents[cup], extents[p], strict=True))}
        found = {row[1] for row in ask_prolog(write(), "may_contain", cup)}
        assert found == fits - {cup}
        assert BOWL in found
        assert not any("spiceJar" in path for path in found)

    def test_all_instances_of_a_class_and_its_subclasses(self, write: Write, store: GraphStore):
        query = "SELECT ?path { ?o a/rdfs:subClassOf* soma:Crockery ; u2k:primPath ?path } ORDER BY ?path"
        crockery = [row[0] for row in store.sparql(query).rows]
        found = [row[0] for row in ask_prolog(write(), "instances", "Crockery")]
        assert found == crockery
        assert {"/KitchenDining/counterRun/mug_dirty", BOWL} <= set(found)
        # By label and by IRI, too.
        assert found == [row[0] for row in ask_prolog(write(), "instances", "crockery")]
        assert found == [row[0] for row in ask_prolog(write(), "instances", SOMA + "Crockery")]

    def test_where_an_object_is(self, write: Write, graph: PropertyGraph):
        poses = {str(node.properties["path"]): read_pose(node.properties) for node in graph.nodes}
        rows = ask_prolog(write(), "where")
        for path, frame, position, orientation in rows:
            pose = poses[path]
            assert pose is not None
            assert frame == "world"
            assert vector(position) == pytest.approx(pose.translation, abs=2e-6)
            assert vector(orientation) == pytest.approx(pose.rotation, abs=2e-6)

    def test_transforms_are_those_of_the_export(self, write: Write, graph: PropertyGraph):
        rows = {row[1]: row for row in ask_prolog(write(), "transform")}
        transforms = read_transforms(graph)["transforms"]
        assert rows.keys() == {each["child_frame_id"] for each in transforms}
        for each in transforms:
            frame, _, position, orientation = rows[each["child_frame_id"]]
            assert frame == each["header"]["frame_id"]
            assert vector(position) == pytest.approx([*each["transform"]["translation"].values()], abs=3e-6)
            assert vector(orientation) == pytest.approx([*each["transform"]["rotation"].values()], abs=3e-6)
        assert {row[0] for row in rows.values()} > {"map", "KitchenDining/counterRun/baseUnit_L/carcass"}

    def test_frame_ids_are_escaped_as_in_the_export(self, tmp_path: Path, home_tbox: TBox):
        paths = ["/Büro/Cup[3]", "/a-b/_u0041_", "/a/_u004", "/🫖/x__u1F375_y", "/a/Cup_1"]
        pose = {"position": (1.0, 2.0, 3.0), "orientation": (0.0, 0.0, 0.0, 1.0)}
        things = [(thing(path, (0, 0, 0), (1, 1, 1), **pose), "Cup") for path in paths]
        write_graph(build_graph(home_tbox, things, base=BASE), tmp_path / "odd.ttl")
        assert {row[1] for row in ask_prolog(tmp_path / "odd.ttl", "transform")} == set(map(frame_id_of, paths))

    def test_the_nearest_of_a_class(self, write: Write, store: GraphStore):
        for thing_name, kind in (("toaster", "Cup"), ("Fridge_01", "chair"), ("tulips", "Spoon")):
            ((_, found, gap),) = ask_prolog(write(), "nearest", kind, thing_name)
            answer = store.answer("nearest", {"thing": thing_name, "class": kind})
            assert [found] == column(answer, "path")
            assert float(gap) == pytest.approx(float(column(answer, "gap_m")[0]), abs=1e-4)

    def test_the_room_of_an_object(self, write: Write, store: GraphStore):
        ((_, room),) = ask_prolog(write(), "room", "toaster")
        assert room == "/KitchenDining"
        assert column(store.where_is("toaster"), "room") == ["KitchenDining"]
        inside = column(store.sparql("SELECT ?path { ?o u2k:inRoom ?r ; u2k:primPath ?path }"), "path")
        assert sorted(row[0] for row in ask_prolog(write(), "room")) == sorted(inside)

    def test_the_parts_of_a_whole(self, write: Write, store: GraphStore):
        for whole in ("/KitchenDining/wallUnits/cab_up_01/carcass", "/KitchenDining/counterRun/baseUnit_L/carcass"):
            found = [row[0] for row in ask_prolog(write(), "parts", whole)]
            assert found == column(store.parts_of(whole), "path")
            assert len(found) > 2

    def test_sizes(self, write: Write, graph: PropertyGraph):
        known = {str(node.properties["path"]): node.properties for node in graph.nodes}
        for path, *extents in ask_prolog(write(), "size"):
            expected = [float(known[path][name]) for name in ("width", "depth", "height")]
            assert [*map(float, extents)] == pytest.approx(expected, abs=1e-6)

    def test_the_relations_between_two_objects(self, write: Write, graph: PropertyGraph):
        paths = {node.id: str(node.properties["path"]) for node in graph.nodes}
        inverse = {"above": "below", "below": "above", "part_of": "has_part"}
        symmetric = {"touching", "next_to", "near"}
        expected = set()
        for edge in graph.edges:
            name, ends = edge.type.lower(), (paths[edge.start], paths[edge.end])
            if name in {"parent", "child", "has_joint", "between"}:
                continue
            if name != "part_of":
                expected.add((ends[0], name, ends[1]))
            if name in inverse or name in symmetric:
                expected.add((ends[1], inverse.get(name, name), ends[0]))
        rows = ask_prolog(write(), "relation")
        assert {row for row in rows if not row[2].endswith("_hinge")} == expected
        assert ask_prolog(write(), "relation", "fruitBowl", "barTable") == [
            (BOWL, "on", "/KitchenDining/breakfastBar/barTable")
        ]

    def test_the_joints_of_an_object(self, write: Write, store: GraphStore):
        answer = store.answer("joints", {"thing": "Fridge_01"})
        rows = ask_prolog(write(), "joints", "Fridge_01")
        assert sorted(row[1].rpartition("/")[2] for row in rows) == sorted(column(answer, "joint"))
        assert {row[2:] for row in rows} == {("-1.745329", "0.0", "-")}

    def test_unknown_names_and_questions_are_errors(self, write: Write):
        for words, said in (
            (["on", "unicorn"], "unicorn: neither an object nor a class in the graph"),
            (["sing"], "expected GRAPH... QUESTION [NAME...]"),
        ):
            done = run_prolog(write(), *words)
            assert (done.returncode, said in done.stderr) == (1, True)


def column(answer: Answer, name: str) -> list[str]:
    """Return a column of an answer, rows in their order."""
    return [str(row[answer.columns.index(name)]) for row in answer.rows]


def vector(text: str) -> list[float]:
    return [float(number) for number in text.split()]


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
