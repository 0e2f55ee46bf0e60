"""The imports closure of an ontology as triples without headers."""

from pathlib import Path

import pyoxigraph as ox
import pytest

from tests.conftest import shared_file
from usd2kg.errors import OntologyError
from usd2kg.ontology import load_home_tbox, load_tbox, read_closure

HEADER = """@prefix : <https://lab.example/{name}#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
<https://lab.example/{name}> a owl:Ontology ; rdfs:label "{name}" {imports} .
"""
BENCH = """:Bench a owl:Class ;
    rdfs:subClassOf :Thing, [ a owl:Restriction ; owl:onProperty :on ; owl:someValuesFrom :Floor ] .
:Thing a owl:Class . :Floor a owl:Class . :on a owl:ObjectProperty .
"""
ABOUT = "https://lab.example/lab#"


def write(folder: Path, name: str, body: str, *imported: str) -> Path:
    imports = "".join(f"; owl:imports <https://lab.example/{other}>" for other in imported)
    path = folder / f"{name}.ttl"
    path.write_text(HEADER.format(name=name, imports=imports) + body, encoding="utf-8")
    return path


def subjects(triples: tuple[ox.Triple, ...]) -> set[str]:
    return {triple.subject.value for triple in triples if isinstance(triple.subject, ox.NamedNode)}


def test_includes_imports_without_headers(tmp_path: Path):
    write(tmp_path, "tools", ":Hammer a owl:Class .")
    lab = write(tmp_path, "lab", BENCH, "tools")
    closure = read_closure(load_tbox(lab))
    assert closure.documents == ("https://lab.example/lab", "https://lab.example/tools")
    assert closure.missing == ()
    names = ("lab#Bench", "lab#Floor", "lab#Thing", "lab#on", "tools#Hammer")
    assert subjects(closure.triples) == {f"https://lab.example/{name}" for name in names}


def test_blank_nodes_of_documents_are_renamed_apart(tmp_path: Path):
    write(tmp_path, "tools", BENCH)
    lab = write(tmp_path, "lab", BENCH, "tools")
    first, second = read_closure(load_tbox(lab)), read_closure(load_tbox(lab))
    blank = {triple.subject for triple in first.triples if isinstance(triple.subject, ox.BlankNode)}
    assert len(blank) == 2
    assert first == second


def test_lists_missing_imports(tmp_path: Path):
    lab = write(tmp_path, "lab", BENCH, "absent")
    also = ["https://lab.example/lab", "https://lab.example/far", "https://lab.example/near"]
    write(tmp_path, "near", ":Oven a owl:Class .")
    closure = read_closure(load_tbox(lab), also)
    assert closure.missing == ("https://lab.example/absent", "https://lab.example/far")
    assert closure.documents == ("https://lab.example/lab", "https://lab.example/near")


def test_includes_the_classes_of_the_built_in_tbox():
    closure = read_closure(load_home_tbox(), ["http://www.ease-crc.org/ont/SOMA-HOME.owl"])
    assert "http://www.ease-crc.org/ont/SOMA.owl#Cup" in subjects(closure.triples)
    assert closure.documents == ("https://w3id.org/usd2kg/home",)
    assert closure.missing == ("http://www.ease-crc.org/ont/SOMA-HOME.owl",)


def test_rejects_a_deleted_document(tmp_path: Path):
    lab = write(tmp_path, "lab", BENCH)
    tbox = load_tbox(lab)
    lab.unlink()
    with pytest.raises(OntologyError, match=r"lab\.ttl: no such file"):
        read_closure(tbox)


FUNCTIONAL = """Prefix(:=<https://lab.example/lab#>)
Prefix(rdfs:=<http://www.w3.org/2000/01/rdf-schema#>)
Ontology(<https://lab.example/lab>
Declaration(Class(:Bench))
Declaration(Class(:Floor))
Declaration(ObjectProperty(:on))
SubClassOf(:Bench ObjectSomeValuesFrom(:on :Floor))
AnnotationAssertion(rdfs:label :Bench "Werkbank"@de)
)
"""


def test_converts_functional_syntax_to_rdf(tmp_path: Path):
    path = tmp_path / "lab.owl"
    path.write_text(FUNCTIONAL, encoding="utf-8")
    store = ox.Store()
    for triple in read_closure(load_tbox(path)).triples:
        store.add(ox.Quad(*triple))
    prefixes = {"": ABOUT, "owl": "http://www.w3.org/2002/07/owl#", "rdfs": "http://www.w3.org/2000/01/rdf-schema#"}
    assert store.query(
        'ASK { :Bench a owl:Class ; rdfs:label "Werkbank"@de ; rdfs:subClassOf [ a owl:Restriction ;'
        " owl:onProperty :on ; owl:someValuesFrom :Floor ] . :on a owl:ObjectProperty }",
        prefixes=prefixes,
    )


def test_soma_home_with_its_imports_and_usd():
    tbox = load_tbox(shared_file("ontologies/soma/SOMA-HOME.owl"))
    closure = read_closure(tbox, [tbox.ontology_iri, "https://ease-crc.org/ont/USD.owl"])
    assert closure.missing == ()
    assert len(closure.documents) == 14
    soma = "http://www.ease-crc.org/ont/SOMA.owl#"
    assert {f"{soma}Cup", f"{soma}Joint", "https://ease-crc.org/ont/USD.owl#Prim"} <= subjects(closure.triples)
    ends = {end for triple in closure.triples for end in (triple.subject, triple.object)}
    assert not [end for end in ends if isinstance(end, ox.NamedNode) and end.value.endswith("owl#imports")]
