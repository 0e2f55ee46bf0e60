"""Which objects a noun counts: by the confidence of what it matched, and copies that no words name."""

from pathlib import Path

import pytest

from usd2kg.query import GraphStore, load_graph
from usd2kg.query.lookup import Nouns

GRAPH = """
@prefix u2k: <https://w3id.org/usd2kg#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix skos: <http://www.w3.org/2004/02/skos/core#> .
@prefix sssom: <https://w3id.org/sssom/> . @prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
<urn:Device> a owl:Class ; rdfs:label "device" .
<urn:mouse> a skos:Concept ; skos:prefLabel "mouse" .
<urn:lamp> a skos:Concept ; skos:prefLabel "lamp" .
"""


def device(name: str, size: tuple[float, float, float], concept: str = "", sure: float = 0.9) -> str:
    width, depth, height = size
    text = (
        f'<urn:{name}> a u2k:Object , <urn:Device> ; u2k:primPath "/R/{name}" ; rdfs:label "{name}" ; '
        f'u2k:boxCenter "0 0 0" ; u2k:width {width} ; u2k:depth {depth} ; u2k:height {height} .\n'
        # The class is doubtful.
        f"[] owl:annotatedSource <urn:{name}> ; owl:annotatedProperty rdf:type ; owl:annotatedTarget <urn:Device> ; "
        f"sssom:confidence 0.2 .\n"
    )
    if concept:
        text += f"<urn:{name}> u2k:concept <urn:{concept}> ; u2k:conceptConfidence {sure} .\n"
    return text


@pytest.fixture
def load(tmp_path: Path):
    def make(*devices: str) -> GraphStore:
        path = tmp_path / "graph.ttl"
        path.write_text(GRAPH + "".join(devices), encoding="utf-8")
        return load_graph(path)

    return make


def mice(graph: GraphStore) -> list[str]:
    return [iri.removeprefix("urn:") for iri in Nouns(graph.facts).find("mouse").iris]


MOUSE, LAMP = (0.038, 0.064, 0.112), (0.2, 0.2, 0.5)


def test_a_concept_counts_by_its_own_confidence(load):
    graph = load(device("a", MOUSE, "mouse"), device("b", LAMP, "mouse", 0.3))
    assert mice(graph) == ["a"]


def test_a_doubtful_concept_counts_if_no_other_does(load):
    assert mice(load(device("b", LAMP, "mouse", 0.3))) == ["b"]


def test_an_object_without_a_concept_is_a_copy_by_class_and_size(load):
    turned = (0.112, 0.064, 0.038)
    graph = load(
        device("a", MOUSE, "mouse"), device("b", turned), device("c", LAMP), device("d", (0.038, 0.064, 0.115))
    )
    assert mice(graph) == ["a", "b"]


def test_a_look_that_another_concept_has_is_no_sign(load):
    graph = load(device("a", MOUSE, "mouse"), device("b", MOUSE), device("c", MOUSE, "lamp"))
    assert mice(graph) == ["a"]
