"""The prefixes of the user's ontology in graphs and mappings."""

from pathlib import Path

import pytest

from tests.graph.records import build_graph, thing
from usd2kg.graph import RDF_FORMATS, serialize_graph
from usd2kg.ontology import load_tbox

TURTLE = """
@prefix lab: <https://my.lab/onto#> .
@prefix other: <https://my.lab/onto#> .
@prefix unused: <https://unused.org/> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix prov: <https://my.lab/more/> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
<https://my.lab/onto> a owl:Ontology .
lab:Thing a owl:Class .
lab:Cup a owl:Class ; rdfs:subClassOf lab:Thing .
prov:Table a owl:Class ; rdfs:subClassOf lab:Thing .
"""
XML = """<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:lab="https://my.lab/onto#"
  xmlns:owl="http://www.w3.org/2002/07/owl#" xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#">
<owl:Ontology rdf:about="https://my.lab/onto"/>
<owl:Class rdf:about="https://my.lab/onto#Thing"/>
<owl:Class rdf:about="https://my.lab/onto#Cup"><rdfs:subClassOf rdf:resource="https://my.lab/onto#Thing"/></owl:Class>
</rdf:RDF>"""
FUNCTIONAL = """Prefix(lab:=<https://my.lab/onto#>)
Ontology(<https://my.lab/onto>
Declaration(Class(lab:Thing)) Declaration(Class(lab:Cup)) SubClassOf(lab:Cup lab:Thing))"""


@pytest.mark.parametrize("text", [TURTLE, XML, FUNCTIONAL], ids=["Turtle", "RDF/XML", "functional"])
def test_prefixes_of_the_classes_are_read(tmp_path: Path, text: str):
    (tmp_path / "lab.owl").write_text(text)
    tbox = load_tbox(tmp_path / "lab.owl")
    assert tbox.prefixes["lab"] == "https://my.lab/onto#"
    assert set(tbox.prefixes) <= {"lab", "prov"}


def test_graphs_and_mappings_use_them(tmp_path: Path):
    (tmp_path / "lab.ttl").write_text(TURTLE)
    tbox = load_tbox(tmp_path / "lab.ttl")
    graph = build_graph(tbox, [(thing("/Cup", (0, 0, 0), (1, 1, 1)), "Cup")])
    turtle = serialize_graph(graph, RDF_FORMATS[".ttl"]).decode()
    assert "@prefix lab: <https://my.lab/onto#> ." in turtle
    assert "lab:Cup" in turtle
    # A name of this project keeps its meaning.
    assert "@prefix prov: <http://www.w3.org/ns/prov#> ." in turtle
    assert "unused" not in turtle
