"""Contradictions between a graph and its ontology are found and explained by an axiom."""

import pyoxigraph as ox
import pytest

from tests.conftest import shared_file
from tests.validation.broken import added, found_in, open_room
from usd2kg.ontology import Closure, TBox, load_tbox, read_closure
from usd2kg.validation.axiom_index import AxiomIndex, Disjointness

PREFIXES = """@prefix : <https://lab.example/onto#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix soma: <http://www.ease-crc.org/ont/SOMA.owl#> .
"""
DECLARED = "soma:Floor a owl:Class . soma:Table a owl:Class . soma:Cup a owl:Class . soma:Fork a owl:Class ."
KNOWN = f"{DECLARED} soma:Cupboard a owl:Class . soma:Door a owl:Class . soma:Bowl a owl:Class ."
TOP = ':Thing a owl:Class ; rdfs:label "thing"@en . :Event a owl:Class ; rdfs:label "Ereignis"@de , "event"@en .'
ABOVE = "soma:Cup rdfs:subClassOf :Thing . :Party a owl:Class ; rdfs:subClassOf :Event ."


def closure_of(text: str, missing: tuple[str, ...] = ()) -> Closure:
    quads = ox.parse(PREFIXES + text, format=ox.RdfFormat.TURTLE)
    return Closure(tuple(quad.triple for quad in quads), (), missing)


def axioms_of(text: str) -> AxiomIndex:
    return AxiomIndex(closure_of(text).triples)


LAB = "https://lab.example/onto#"


@pytest.mark.parametrize(
    "stated",
    [
        ":Thing owl:disjointWith :Event .",
        ":Event owl:disjointWith :Thing .",
        "[] a owl:AllDisjointClasses ; owl:members ( :Event :Other :Thing ) .",
        ":All owl:disjointUnionOf ( :Thing :Event ) .",
    ],
)
def test_finds_disjoint_classes_of_an_object(home_tbox: TBox, stated: str):
    graph = open_room(home_tbox, "plain", added("k:Cup a <https://lab.example/onto#Party>"))
    (finding,) = found_in(graph, closure=closure_of(f"{KNOWN} {TOP} {ABOVE} {stated}"))
    assert (finding.severity, finding.rule, finding.prim_path) == ("error", "disjoint-classes", "/Cup")
    assert "“event” (https://lab.example/onto#Event)" in finding.found
    assert "it is soma:Cup, a subclass of “thing” (https://lab.example/onto#Thing)" in finding.found
    assert finding.found.count("owl:disjointWith") == 1


def test_finds_nothing_without_disjointness(home_tbox: TBox):
    graph = open_room(home_tbox, "plain", added("k:Cup a <https://lab.example/onto#Party>"))
    assert found_in(graph, closure=closure_of(f"{KNOWN} {TOP} {ABOVE}")) == ()


@pytest.mark.parametrize(
    ("stated", "rule", "path"),
    [
        ("u2k:on rdfs:domain :Event", "domain-clash", "/Cup"),
        ("u2k:on rdfs:range :Event", "range-clash", "/Cup"),
        ("u2k:on rdfs:subPropertyOf :during . :during rdfs:domain :Event", "domain-clash", "/Cup"),
        (":under owl:inverseOf u2k:on . :under rdfs:range :Event", "domain-clash", "/Cup"),
        ("u2k:on rdfs:domain [ owl:unionOf ( :Event :Party ) ]", "domain-clash", "/Cup"),
        ("u2k:on rdfs:domain [ owl:intersectionOf ( :Event :Late ) ]", "domain-clash", "/Cup"),
    ],
)
def test_finds_violations_of_domain_and_range(home_tbox: TBox, stated: str, rule: str, path: str):
    # In the room, the cup is on the table; the edit adds a fork on the cup, which violates the range.
    text = (
        f"@prefix u2k: <https://w3id.org/usd2kg#> . {KNOWN} {TOP} {ABOVE} :Thing owl:disjointWith :Event . {stated} ."
    )
    graph = open_room(home_tbox, "plain", added("k:Fork u2k:on k:Cup"))
    found = found_in(graph, closure=closure_of(text))
    # The boxes of fork and cup are 22 cm apart.
    assert {(f.rule, f.prim_path) for f in found} == {(rule, path), ("relation-apart", "/Fork")}
    assert "“event”" in found[0].expected


def test_accepts_one_compatible_member_of_a_union(home_tbox: TBox):
    text = (
        f"@prefix u2k: <https://w3id.org/usd2kg#> . {KNOWN} {TOP} {ABOVE} :Thing owl:disjointWith :Event . "
        "u2k:on rdfs:domain [ owl:unionOf ( :Event :Other ) ] ."
    )
    assert found_in(open_room(home_tbox, "plain"), closure=closure_of(text)) == ()


def test_finds_deprecated_and_unknown_classes(home_tbox: TBox):
    text = f"{DECLARED} soma:Cupboard a owl:Class . soma:Bowl a owl:Class . soma:Cup owl:deprecated true ."
    found = found_in(open_room(home_tbox, "soma"), closure=closure_of(text))
    assert [(f.severity, f.rule, f.prim_path) for f in found] == [
        ("error", "class-unknown", "/Cupboard/Door"),
        ("warning", "class-deprecated", "/Cup"),
    ]
    assert found[0].found == "its class soma:Door is not in the ontology"


def test_classes_of_a_missing_import_are_not_unknown(home_tbox: TBox):
    closure = closure_of(DECLARED, ("http://www.ease-crc.org/ont/SOMA.owl",))
    assert found_in(open_room(home_tbox, "soma"), closure=closure) == ()


def test_explains_by_the_most_specific_axiom():
    axioms = axioms_of(":A rdfs:subClassOf :B . :B owl:disjointWith :C . :A owl:disjointWith :C . :C a owl:Class .")
    assert axioms.clash(f"{LAB}A", f"{LAB}C") == Disjointness(f"{LAB}A", f"{LAB}C")


def test_handles_cyclic_classes_properties_and_lists():
    axioms = axioms_of(
        ":A rdfs:subClassOf :B . :B rdfs:subClassOf :A . :p rdfs:subPropertyOf :q ; rdfs:domain :A . "
        ":q rdfs:subPropertyOf :p . [] a owl:AllDisjointClasses ; owl:members _:l . "
        "_:l <http://www.w3.org/1999/02/22-rdf-syntax-ns#rest> _:l ; "
        "<http://www.w3.org/1999/02/22-rdf-syntax-ns#first> :A ."
    )
    assert axioms.closure(f"{LAB}A") == {f"{LAB}A", f"{LAB}B"}
    assert axioms.ends(f"{LAB}q", is_subject=True) == [(f"{LAB}p", (f"{LAB}A",))]


def test_equivalent_classes_and_intersections_are_superclasses():
    axioms = axioms_of(":A owl:equivalentClass [ owl:intersectionOf ( :B :C ) ] . :B owl:equivalentClass :D .")
    assert axioms.closure(f"{LAB}A") == {LAB + name for name in "ABCD"}
    assert axioms.closure(f"{LAB}D") == {LAB + name for name in "BD"}


@pytest.fixture(scope="session")
def soma() -> Closure:
    return read_closure(load_tbox(shared_file("ontologies/soma/SOMA-HOME.owl")))


def test_the_room_is_consistent_with_soma(home_tbox: TBox, soma: Closure):
    assert found_in(open_room(home_tbox, "soma"), closure=soma) == ()


def test_finds_contradictions_with_soma(home_tbox: TBox, soma: Closure):
    graph = open_room(home_tbox, "soma", added("k:Cup a dul:Event . k:Fork soma:isOntopOf k:Cup"))
    found = found_in(graph, closure=soma)
    assert {(finding.rule, finding.prim_path) for finding in found} == {
        ("disjoint-classes", "/Cup"),
        ("domain-clash", "/Cup"),
        ("range-clash", "/Cup"),
        ("relation-apart", "/Fork"),
    }
    text = next(finding.found for finding in found if finding.rule == "disjoint-classes")
    assert "(dul:Event)" in text
    assert "(dul:Object)" in text
