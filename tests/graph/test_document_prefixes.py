"""The prefixes of the user's ontology in graphs and mappings."""

from pathlib import Path

import pyoxigraph as ox
import pytest

from tests.graph.records import build_graph, thing
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.graph import RDF_FORMATS, serialize_graph, write_graph
from usd2kg.grounding.lexical.alignment.alignment_rows import AlignmentRow, RowKind, format_rows, parse_rows
from usd2kg.ontology import load_tbox
from usd2kg.query import Dataset, GraphStore
from usd2kg.query.graph_file import load_graph

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


@pytest.mark.parametrize("ending", [".ttl", ".nt", ".rdf"])
def test_queries_may_use_them(tmp_path: Path, ending: str):
    (tmp_path / "lab.ttl").write_text(TURTLE)
    tbox = load_tbox(tmp_path / "lab.ttl")
    write_graph(build_graph(tbox, [(thing("/Cup", (0, 0, 0), (1, 1, 1)), "Cup")]), tmp_path / f"graph{ending}")
    store = load_graph(tmp_path / f"graph{ending}")
    assert store.sparql("SELECT ?p { ?o a lab:Cup ; u2k:primPath ?p }").rows == (("/Cup",),)
    assert [row[0] for row in store.answer("which-where", {"class": "lab:Cup"}).rows] == ["Cup"]
    assert ask_offline(store, "how many lab:Cup are there?").number == 1
    assert store.sparql("ASK { ?entity a prov:Entity }").rows == (("true",),)
    assert store.hints("SELECT * { ?o a lab:Cupp }") == ["lab:Cupp is not in the graph; did you mean lab:Cup?"]
    with pytest.raises(GraphError, match=r"the prefix unused: is not declared.* lab:,"):
        store.sparql("ASK { ?o a unused:Cup }")


def test_a_scene_of_a_store_has_its_own_prefixes():
    store = ox.Store()
    for name in ("one", "two"):
        declared = (
            f'[] sh:prefix "lab" ; sh:namespace "https://{name}/"^^xsd:anyURI . <urn:{name}> a <https://{name}/Cup> .'
        )
        head = "@prefix sh: <http://www.w3.org/ns/shacl#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .\n"
        store.load((head + declared).encode(), format=ox.RdfFormat.TURTLE, to_graph=ox.NamedNode(f"urn:graph:{name}"))
    for name in ("one", "two"):
        view = GraphStore(Dataset(store, (ox.NamedNode(f"urn:graph:{name}"),)), name)
        assert view.sparql("SELECT ?o { ?o a lab:Cup }").rows == ((f"urn:{name}",),)
    # Which of two namespaces it means would be arbitrary.
    with pytest.raises(GraphError, match="the prefix lab: is not declared"):
        GraphStore(Dataset(store), "both").sparql("SELECT ?o { ?o a lab:Cup }")


def test_declarations_that_are_no_prefixes_are_left_out():
    declared = [
        ("a b", "https://my.lab/"),
        ("bad", "no iri"),
        ("u2k", "https://my.lab/"),
        ("x", "https://z/"),
        ("x", "https://y/"),
    ]
    text = "".join(f'[] sh:prefix "{prefix}" ; sh:namespace "{iri}"^^xsd:anyURI .\n' for prefix, iri in declared)
    head = "@prefix sh: <http://www.w3.org/ns/shacl#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .\n"
    triples = [quad.triple for quad in ox.parse(head + text, format=ox.RdfFormat.TURTLE)]
    prefixes = GraphStore.from_triples(triples, "test").dataset.prefixes
    # Which of two namespaces x means would be arbitrary.
    assert prefixes.keys() & {"a b", "bad", "u2k", "x"} == {"u2k"}
    assert prefixes["u2k"] == "https://w3id.org/usd2kg#"


def test_alignments_use_them(tmp_path: Path):
    (tmp_path / "lab.ttl").write_text(TURTLE)
    tbox = load_tbox(tmp_path / "lab.ttl")
    row = AlignmentRow(
        RowKind.CONCEPT, "http://wordnet-rdf.princeton.edu/id/03151500-n", "https://my.lab/onto#Cup", 1.0, label="cup"
    )
    text = format_rows([row], tbox)
    assert '#  lab: "https://my.lab/onto#"' in text
    assert "\tlab:Cup\t" in text
    # A person adds a row for a class whose prefix the header does not declare.
    text = "\n".join(line for line in text.splitlines() if not line.startswith("#  lab:")) + "\n"
    assert [read.class_iri for read in parse_rows(tmp_path / "edits.tsv", text, tbox)[2]] == ["https://my.lab/onto#Cup"]
