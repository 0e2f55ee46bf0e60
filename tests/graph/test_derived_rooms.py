"""Rooms without a prim, as individuals of the graph."""

import pyoxigraph as ox
import pytest

from tests.graph.records import BASE, ground_as
from tests.grounding.records import make_class, make_scene, make_tbox
from tests.relations.test_derived_rooms import BED, FLAT, SOFA
from usd2kg.graph import KnowledgeGraph, instantiate
from usd2kg.graph.vocabulary import PROV, RDF, RDFS, SSSOM, U2K
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.query import GraphStore
from usd2kg.validation import validate_graph

ROOM = ox.NamedNode(f"{BASE}-room-2")


def graph_of(tbox: TBox, profile: str = "auto") -> KnowledgeGraph:
    placed = [*FLAT, SOFA, BED]
    scene = make_scene(*(obj for obj, _ in placed))
    classes = {obj.prim_path: cls for obj, cls in placed}
    known = {path: cls for path, cls in classes.items() if any(c.iri.endswith(f"#{cls}") for c in tbox.classes)}
    return instantiate(scene, tbox, ground_as(tbox, scene, known), base=BASE, profile=profile)


def values(graph: KnowledgeGraph, subject: ox.NamedNode, predicate: ox.NamedNode) -> list[str]:
    return [t.object.value for t in graph.triples if t.subject == subject and t.predicate == predicate]


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_a_room_is_an_individual_with_its_origin(profile: str):
    graph = graph_of(load_home_tbox(), profile)
    assert set(values(graph, ROOM, RDF.type)) >= {U2K.DerivedRoom.value, "http://www.ease-crc.org/ont/SOMA.owl#Room"}
    assert values(graph, ROOM, RDFS.label) == ["room 2"]
    assert values(graph, ROOM, PROV.wasDerivedFrom) == [f"{BASE}-stage"]
    assert values(graph, ROOM, PROV.wasGeneratedBy) == [f"{BASE}-run"]
    assert float(values(graph, ROOM, U2K.floorArea)[0]) == pytest.approx(11.6, rel=0.05)
    assert 0.9 < float(values(graph, ROOM, SSSOM.confidence)[0]) < 1
    assert values(graph, ox.NamedNode(f"{BASE}bed"), U2K.inRoom) == [ROOM.value]


def test_its_outline_is_well_known_text():
    (outline,) = values(graph_of(load_home_tbox()), ROOM, U2K.floorOutline)
    assert outline.startswith("POLYGON ((") and outline.endswith("))")
    corners = [tuple(map(float, corner.split())) for corner in outline[len("POLYGON ((") : -2].split(", ")]
    assert corners[0] == corners[-1]
    assert len(corners) == 5


def test_without_a_class_of_rooms_only_the_vocabulary_types_it():
    graph = graph_of(make_tbox(make_class("Thing"), make_class("Structure", "Thing")))
    assert set(values(graph, ROOM, RDF.type)) == {
        "http://www.w3.org/2002/07/owl#NamedIndividual",
        U2K.DerivedRoom.value,
    }


def test_the_class_of_rooms_of_a_users_ontology():
    tbox = make_tbox(make_class("Space"), make_class("Room", "Space"))
    graph = graph_of(tbox)
    (room,) = (cls.iri for cls in tbox.classes if cls.iri.endswith("Room"))
    assert room in values(graph, ROOM, RDF.type)
    # Queries for spaces need no ontology.
    assert any(t.subject.value == room and t.predicate == RDFS.subClassOf for t in graph.triples)


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_validation_accepts_it(profile: str):
    graph = graph_of(load_home_tbox(), profile)
    report = validate_graph(GraphStore.from_triples(graph.triples, "flat"))
    assert not [finding for finding in report.findings if finding.severity == "error"]
