"""Graphs merged with their import closure."""

from pathlib import Path

import pyoxigraph as ox
import pytest

from tests.conftest import shared_file
from tests.graph.records import BASE, ask, ground_as, reread, select, thing
from tests.graph.test_instantiate import parse_as_owl
from tests.grounding.records import make_scene
from usd2kg.graph import KnowledgeGraph, instantiate, merge_imports, serialize_graph
from usd2kg.ontology import TBox, load_tbox, read_closure

CUP = thing("/Cup", (1, 0.4, 0.7), (0.09, 0.12, 0.1))
LAB = """@prefix : <https://lab.example/lab#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
<https://lab.example/lab> a owl:Ontology ; owl:imports <https://lab.example/absent> .
:Thing a owl:Class .
:Cup a owl:Class ; rdfs:subClassOf :Thing ; rdfs:comment "To drink from." .
"""


def merged(tbox: TBox, profile: str = "auto") -> KnowledgeGraph:
    scene = make_scene(CUP)
    graph = instantiate(scene, tbox, ground_as(tbox, scene, {"/Cup": "Cup"}), base=BASE, profile=profile)
    return merge_imports(graph, read_closure(tbox, graph.imports))


@pytest.fixture
def lab(tmp_path: Path) -> TBox:
    path = tmp_path / "lab.ttl"
    path.write_text(LAB, encoding="utf-8")
    return load_tbox(path)


def test_merges_ontology_and_vocabulary_without_imports(lab: TBox):
    graph = merged(lab)
    store = reread(graph)
    assert not ask(store, "?o owl:imports ?i")
    assert ask(store, '<https://lab.example/lab#Cup> rdfs:comment "To drink from."')
    assert ask(store, "k:Cup a <https://lab.example/lab#Cup> . u2k:width rdfs:range xsd:double ; rdfs:comment ?meaning")
    assert graph.missing_imports == ("https://lab.example/absent",)
    assert (graph.imports, graph.individuals) == ((), 1)


def test_the_header_lists_merged_documents(lab: TBox):
    store = reread(merged(lab))
    assert select(store, "SELECT ?o ?s { ?o a owl:Ontology ; dcterms:source ?s }") == [
        ("https://my.lab/k", "https://lab.example/lab"),
        ("https://my.lab/k", "https://w3id.org/usd2kg"),
    ]


def test_merged_graph_has_no_duplicates_and_parses(lab: TBox):
    graph = merged(lab)
    assert len(graph.triples) == len(set(graph.triples)) == len(reread(graph))
    kinds = {type(item.component).__name__ for item in parse_as_owl(graph)}
    assert {"ClassAssertion", "DisjointClasses", "SymmetricObjectProperty"} <= kinds


def test_built_in_tbox_is_listed_as_a_source(home_tbox: TBox):
    graph = merged(home_tbox)
    assert graph.missing_imports == ("http://www.ease-crc.org/ont/SOMA-HOME.owl", "https://ease-crc.org/ont/USD.owl")
    assert ask(reread(graph), "soma:Refrigerator a owl:Class")


def test_output_is_deterministic(lab: TBox):
    first, second = (serialize_graph(merged(lab), ox.RdfFormat.TURTLE) for _ in range(2))
    assert first == second


def test_merges_all_documents_of_soma_home():
    tbox = load_tbox(shared_file("ontologies/soma/SOMA-HOME.owl"))
    graph = merged(tbox)
    assert graph.missing_imports == ()
    assert ask(
        reread(graph),
        "soma:Joint rdfs:subClassOf [ owl:onProperty soma:hasChildLink ; owl:onClass dul:PhysicalObject ] ."
        " usd:hasColor rdfs:range usd:Color",
    )
