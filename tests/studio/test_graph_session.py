"""A studio on a graph without its stage."""

import shutil
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import numpy as np
import pyoxigraph as ox
import pytest

from tests.graph.records import ground_as
from tests.grounding.records import make_scene
from tests.kitchen import kitchen_scene
from tests.relations.test_derived_rooms import BED, FLAT, SOFA, door
from tests.studio.conftest import running_studio
from usd2kg.errors import GroundingError
from usd2kg.graph import GraphOptions, instantiate, write_graph
from usd2kg.graph.rdf_document import read_statements
from usd2kg.graph.vocabulary import RDF, RDFS
from usd2kg.grounding import apply_decisions, read_decisions
from usd2kg.ontology import load_home_tbox
from usd2kg.pipeline import build
from usd2kg.query import load_graph
from usd2kg.studio import ProjectSources, open_project
from usd2kg.studio.open_session import open_session
from usd2kg.studio.session import StudioSession
from usd2kg.studio.verdicts import Verdict, VerdictKind

CUP_1, CUP_2, FLOOR, TABLE, THING = range(5)
"""In the order of their prim paths."""
pytestmark = pytest.mark.studio


@contextmanager
def opened(source: Path, folder: Path) -> Iterator[StudioSession]:
    with open_project(folder, ProjectSources(source)) as project, closing(open_session(project)) as session:
        yield session


@pytest.fixture(scope="module")
def graph(stage: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("graph") / "kitchen.ttl"
    write_graph(build(stage).graph, path)
    return path


@pytest.mark.parametrize("profile", ["soma", "plain"])
@pytest.mark.parametrize("annotations", ["owl", "rdf12"])
def test_a_graph_is_read_back_as_the_stage_was(profile: str, annotations: str, tmp_path: Path):
    built = build(kitchen_scene(), profile=profile, graph_options=GraphOptions(annotations=annotations))
    path = tmp_path / "kitchen.nq"
    write_graph(built.graph, path)
    with opened(path, tmp_path / "p") as session:
        by_path = session.scene.by_path
        assert by_path.keys() == built.scene.by_path.keys()
        assert [obj.parent_path for obj in built.scene.objects] == [
            by_path[obj.prim_path].parent_path for obj in built.scene.objects
        ]
        for obj in built.scene.objects:
            read = by_path[obj.prim_path]
            assert (read.box is None) == (obj.box is None)
            if obj.box is not None and read.box is not None:
                assert read.box.lower == pytest.approx(obj.box.lower, abs=1e-5)
                assert read.box.upper == pytest.approx(obj.box.upper, abs=1e-5)
            assert (read.name, read.display_name or read.name) == (obj.name, obj.display_name or obj.name)
            assert (read.asset, read.materials) == (obj.asset, obj.materials)
            if obj.position is not None:
                assert read.position == pytest.approx(obj.position, abs=1e-5)
                assert read.orientation == pytest.approx(obj.orientation, abs=1e-5)
        for prediction in built.grounding.predictions:
            found = session.predictions[prediction.prim_path]
            assert (found.class_iri, found.status) == (prediction.class_iri, prediction.status)
            assert found.confidence == pytest.approx(prediction.confidence, abs=1e-6)
            assert (found.explanation, found.evidence) == (prediction.explanation, prediction.evidence)
            assert found.concept == prediction.concept
        concepts = {iri: (concept.label, {*concept.broader}) for iri, concept in built.grounding.concepts.items()}
        assert {
            iri: (concept.label, {*concept.broader}) for iri, concept in session.suggestions.concepts.items()
        } == concepts
        read_relations = {(r.kind, r.target, r.anchor): r for r in session.relations}
        assert len(read_relations) == len(session.relations)
        assert read_relations.keys() == {(r.kind, r.target, r.anchor) for r in built.graph.relations}
        for relation in built.graph.relations:
            again = read_relations[relation.kind, relation.target, relation.anchor]
            assert again.rule == relation.rule
            assert again.numbers == pytest.approx(dict(relation.numbers), rel=1e-5, abs=1e-6)
        # Without a decision, the graph is that of the file.
        assert frozenset(session.graph().triples) == frozenset(read_statements(path))


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_rooms_without_a_prim_are_read_back(profile: str, tmp_path: Path):
    placed = [*FLAT, SOFA, BED, door("door_bedroom", (5.02, 3.1, 0), (0.06, 0.9, 2.1))]
    tbox = load_home_tbox()
    scene = make_scene(*(obj for obj, _ in placed))
    grounding = ground_as(tbox, scene, {obj.prim_path: cls for obj, cls in placed if cls})
    graph = instantiate(scene, tbox, grounding, profile=profile)
    expected = {(r.kind, r.target, r.anchor): r.room for r in graph.relations if r.room is not None}
    assert {(kind, anchor) for kind, _, anchor in expected} >= {("room", "room 1"), ("connects", "room 2")}
    write_graph(graph, tmp_path / "flat.ttl")
    with (
        running_studio(tmp_path / "flat.ttl", tmp_path / "p") as client,
        opened(tmp_path / "flat.ttl", tmp_path / "q") as session,
    ):
        found = {(r.kind, r.target, r.anchor): r.room for r in session.relations if r.room is not None}
        assert found.keys() == expected.keys()
        for key, room in expected.items():
            read = found[key]
            assert room is not None and read is not None
            assert (read.name, read.rule) == (room.name, room.rule)
            assert np.concatenate(read.outline) == pytest.approx(np.concatenate(room.outline), abs=1e-3)
            measured = [(each.area, each.height, each.confidence) for each in (read, room)]
            assert measured[0] == pytest.approx(measured[1], abs=1e-5)
        objects = client.ask("api/scene").json()
        room_of = dict(zip(objects["objects"]["path"], objects["objects"]["room"], strict=True))
        assert objects["objects"]["rooms"][room_of["/bed"]] == "room 2"


@pytest.mark.parametrize("annotations", ["owl", "rdf12"])
def test_decisions_change_the_graph_as_a_build_with_them_does(stage: Path, annotations: str, tmp_path: Path):
    options = GraphOptions(annotations=annotations)
    built = build(stage, graph_options=options)
    path = tmp_path / "kitchen.ttl"
    write_graph(built.graph, path)
    with opened(path, tmp_path / "p") as session:
        cupboard = session.tbox.resolve("Cupboard")
        session.decide({"/Kitchen/Zxqv": Verdict(VerdictKind.CLASS, cupboard, comment="boards")}, "Ann", 0)
        session.decide({"/Kitchen/Cup_1": Verdict(VerdictKind.NO_CLASS)}, "https://orcid.org/0000-0002-1825-0097", 1)
        cup = session.predictions["/Kitchen/Cup_2"].class_iri
        session.decide({"/Kitchen/Cup_2": Verdict(VerdictKind.CLASS, cup)}, "Ann", 2)
        found = frozenset(session.graph().triples)
        grounding = apply_decisions(built.grounding, session.review.decisions(), built.scene, built.tbox)
        for _ in range(2):
            session.undo("Ann")
        session.undo("https://orcid.org/0000-0002-1825-0097")
        assert frozenset(session.graph().triples) == frozenset(read_statements(path))
    expected = instantiate(
        built.scene, built.tbox, grounding, options=options, relations=built.graph.relations, profile="soma"
    )
    assert frozenset(expected.triples) - found == set()
    # What is left over are classes that no object has any more, and the terms of statements that are gone.
    assert {t.predicate for t in found - frozenset(expected.triples)} <= {RDF.type, RDFS.label, RDFS.subClassOf}
    assert all(t.subject != ox.NamedNode(f"{session.base}Kitchen.Cup_1") for t in found - frozenset(expected.triples))


def test_files_follow_the_decisions_on_a_graph(graph: Path, tmp_path: Path):
    folder = tmp_path / "project"
    with running_studio(graph, folder) as client:
        scene = client.ask("api/scene").json()
        assert scene["is_graph"]
        assert scene["limits"].keys() == {"meshes", "labels", "reground"}
        assert "kitchen.usda is not beside the graph" in scene["limits"]["meshes"]
        cupboard = next(index for index, cls in enumerate(scene["classes"]) if cls["name"] == "Cupboard")
        body = {"objects": [THING], "action": "choose", "class": cupboard, "reviewer": "Ann"}
        assert client.ask("api/decisions", body).json()["states"][0]["state"] == "corrected"
        assert client.ask("api/geometry").json() == {"chunks": [], "triangles": 0, "source_triangles": 0}
        assert client.ask(f"api/thumbnail/{TABLE}.png").status == 422
        assert client.ask("api/export/labels.usda").status == 422
        refused = client.ask("api/reground", {"reviewer": "Ann", "page": ""})
        assert (refused.status, refused.json()["error"]) == (422, scene["limits"]["reground"])
        answer = client.ask("api/ask", {"question": "what is on the table?"}).json()
        assert set(answer["objects"]) == {CUP_1, CUP_2}
        query = "SELECT ?o { ?o a soma:Cupboard }"
        assert client.ask("api/sparql", {"query": query}).json()["objects"] == [THING]
        page = client.ask(f"api/object/{CUP_2}").json()
        assert [candidate["share"] for candidate in page["candidates"]] == [None] * len(page["candidates"])
        assert all(candidate["evidence"] == [] for candidate in page["candidates"])
        assert "/Kitchen/Table" in {relation["anchor_path"] for relation in page["relations"]}
        assert 'u2k:primPath "/Kitchen/Cup_2"' in page["turtle"]
    tbox = load_home_tbox()
    kept = load_graph(folder / "graph.ttl").sparql(
        'SELECT ?c { ?o u2k:primPath "/Kitchen/Zxqv" ; a ?c . ?c a owl:Class }'
    )
    assert (tbox.resolve("Cupboard"),) in kept.rows
    assert (folder / "mapping.sssom.tsv").is_file()
    assert not (folder / "labels.usda").exists()
    decisions = read_decisions(folder / "decisions.sssom.tsv", tbox)
    assert decisions["/Kitchen/Zxqv"].class_iri == tbox.resolve("Cupboard")


def test_a_stage_beside_the_graph_gives_meshes_and_labels(stage: Path, graph: Path, tmp_path: Path):
    for file in (stage, graph):
        shutil.copy(file, tmp_path / file.name)
    with running_studio(tmp_path / graph.name, tmp_path / "project") as client:
        scene = client.ask("api/scene").json()
        assert scene["limits"].keys() == {"reground"}
        assert {
            "label": "Meshes",
            "value": f"Meshes come from the stage {tmp_path / stage.name}, from which the graph was built.",
        } in scene["figures"]
        assert client.ask("api/geometry").json()["triangles"] > 0
        assert client.ask("api/export/labels.usda").status == 200
    # Another version of the stage shows other things than the graph is about.
    with (tmp_path / stage.name).open("a") as file:
        file.write('def Xform "New" (kind = "component") {}\n')
    with opened(tmp_path / graph.name, tmp_path / "project") as session:
        assert session.stage is None
        assert "has changed since the graph was built" in session.limits["meshes"]


def test_a_graph_that_names_a_file_elsewhere_opens_nothing(stage: Path, graph: Path, tmp_path: Path):
    outside = tmp_path / "kitchen.usda"
    shutil.copy(stage, outside)
    inside = tmp_path / "a" / "hostile.ttl"
    inside.parent.mkdir()
    inside.write_text(graph.read_text().replace('"kitchen.usda"', '"../kitchen.usda"'))
    with opened(inside, tmp_path / "p") as session:
        assert session.stage is None


@pytest.mark.parametrize("name", ["mapping", "alignment", "base"])
def test_options_of_stages_are_refused(graph: Path, name: str, tmp_path: Path):
    value = "https://x.org/" if name == "base" else tmp_path / "file"
    sources = ProjectSources(graph, **{name: value})
    with (
        open_project(tmp_path / "p", sources) as project,
        pytest.raises(GroundingError, match=f"--{name}: .* is a graph"),
    ):
        open_session(project)


def test_classes_of_another_ontology_are_named(graph: Path, tmp_path: Path):
    path = tmp_path / "other.ttl"
    path.write_text(graph.read_text().replace("SOMA.owl#> .", "OTHER.owl#> ."))
    with (
        open_project(tmp_path / "p", ProjectSources(path)) as project,
        pytest.raises(GroundingError, match="--ontology"),
    ):
        open_session(project)
