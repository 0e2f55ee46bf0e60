"""The compiled shapes find each violation, and agree with a SHACL processor."""

import warnings

import pytest

from tests.graph.records import BASE, build_graph, reread
from tests.validation.broken import ROOM, SHAPES, Break, found_in, open_room
from usd2kg.graph import GraphOptions
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.ontology import TBox
from usd2kg.query import Dataset, GraphStore
from usd2kg.validation.shacl import compile_shapes, find_violations, read_shapes

CASES = pytest.mark.parametrize("case", SHAPES, ids=[f"{i}-{c.profile}-{c.rule}" for i, c in enumerate(SHAPES)])
PROFILES = pytest.mark.parametrize("profile", ["soma", "plain"])


@PROFILES
def test_finds_nothing_in_a_valid_graph(home_tbox: TBox, profile: str):
    assert found_in(open_room(home_tbox, profile)) == ()


@CASES
def test_finds_exactly_the_violated_rule(home_tbox: TBox, case: Break):
    found = found_in(open_room(home_tbox, case.profile, case.update))
    assert {finding.rule for finding in found} == {case.rule}


@PROFILES
def test_every_shape_has_a_case(profile: str):
    assert {c.rule for c in SHAPES if c.profile == profile} == {rule.id for rule in compile_shapes(profile)}


def test_a_finding_names_the_object_the_value_and_the_advice(home_tbox: TBox):
    case = next(c for c in SHAPES if c.rule == "box-width" and c.profile == "soma")
    (finding,) = found_in(open_room(home_tbox, "soma", case.update))
    assert (finding.severity, finding.label, finding.prim_path) == ("error", "Fork", "/Fork")
    assert finding.iri == "https://my.lab/k/Fork-box"
    assert (finding.found, finding.expected) == ("-0.2", "exactly one extent from 0 to 100000 m")
    assert "metersPerUnit" in finding.advice


def test_a_finding_on_a_joint_names_its_prim(home_tbox: TBox):
    case = next(c for c in SHAPES if c.rule == "joint-limits" and c.profile == "plain")
    (finding,) = found_in(open_room(home_tbox, "plain", case.update))
    assert (finding.label, finding.prim_path, finding.found) == ("hinge", "/Cupboard/hinge", "2")


@CASES
def test_agrees_with_pyshacl_on_invalid_graphs(home_tbox: TBox, case: Break):
    compare_with_pyshacl(open_room(home_tbox, case.profile, case.update), case.profile)


@PROFILES
def test_agrees_with_pyshacl_on_a_valid_graph(home_tbox: TBox, profile: str):
    assert compare_with_pyshacl(open_room(home_tbox, profile), profile) == set()


def compare_with_pyshacl(graph: GraphStore, profile: str) -> set[tuple[str, str]]:
    """Assert that both find the same; return pairs of rule and node IRI, which is empty for blank nodes."""
    import pyoxigraph as ox  # noqa: PLC0415

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import pyshacl  # noqa: PLC0415
        import rdflib  # noqa: PLC0415

        triples = ox.serialize((quad.triple for quad in graph.store), format=ox.RdfFormat.N_TRIPLES)
        data = rdflib.Graph().parse(data=triples, format="nt")
        _, report, _ = pyshacl.validate(
            data, shacl_graph=read_shapes(profile), shacl_graph_format="turtle", inference="none"
        )
    shacl = rdflib.Namespace("http://www.w3.org/ns/shacl#")
    theirs = set()
    for result in report.subjects(rdflib.RDF.type, shacl.ValidationResult):
        focus = report.value(result, shacl.focusNode)
        name = "" if isinstance(focus, rdflib.BNode) else str(focus)
        theirs.add((str(report.value(result, shacl.sourceShape)).rpartition("#")[2], name))
    ours = {
        (rule.id, "" if isinstance(broken.focus, ox.BlankNode) else broken.focus.value)
        for rule in compile_shapes(profile)
        for broken in find_violations(graph.store, rule)
    }
    assert ours == theirs
    return ours


def test_checks_confidences_on_triple_terms(home_tbox: TBox):
    graph = GraphStore(
        Dataset(reread(build_graph(home_tbox, ROOM, options=GraphOptions(annotations="rdf12")))), "room.ttl"
    )
    assert found_in(graph) == ()
    graph.store.update(
        "DELETE { ?x sssom:confidence ?o } INSERT { ?x sssom:confidence 2.0 } "
        "WHERE { ?x sssom:confidence ?o ; rdf:reifies <<( k:Cup rdf:type ?c )>> }",
        prefixes={**PREFIXES, "k": BASE},
    )
    (finding,) = found_in(graph)
    assert (finding.rule, finding.prim_path, finding.found) == ("confidence-range", "/Cup", "2")
