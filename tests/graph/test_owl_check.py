"""Graphs are OWL 2 DL (OWL API) and consistent with SOMA-HOME, DUL and USD.owl (HermiT)."""

from pathlib import Path

import pytest

import usd2kg
from tests.conftest import shared_file
from tests.graph.test_vocabulary import WRITTEN
from tests.kitchen import kitchen_scene
from tools.check_owl import check_owl, missing_tools
from usd2kg.graph import GraphOptions, read_document, vocabulary_text, write_graph
from usd2kg.relations import ALL_KINDS, RelationOptions, parse_viewpoint

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(missing_tools()), reason=missing_tools()),
]

PROFILES = ["soma", "plain"]
EVERY_RELATION = RelationOptions(kinds=ALL_KINDS, viewpoint=parse_viewpoint("0,0,1.6"))
PART = "\n<https://example.org/franka_kitchen/-stage> <{dul}hasPart> <https://example.org/franka_kitchen/{part}> .\n"
DUL = "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#"
KETTLE = "franka_kitchen.Geometry.kettle"


def franka(folder: Path, profile: str = "soma", options: GraphOptions | None = None, *, merges: bool = False) -> Path:
    """Return the file with the graph of the Franka kitchen over SOMA-HOME."""
    path = folder / f"franka_{profile}.ttl"
    result = usd2kg.build(
        shared_file("scenes/franka_kitchen/franka_kitchen.usdc"),
        shared_file("ontologies/soma/SOMA-HOME.owl"),
        profile=profile,
        graph_options=options,
        relations=EVERY_RELATION,
        merges_imports=merges,
    )
    write_graph(result.graph, path)
    return path


def ontologies() -> Path:
    return shared_file("ontologies/soma/USD.owl").parent


@pytest.mark.parametrize("profile", PROFILES)
def test_demo_kitchen_is_owl_2_dl(tmp_path: Path, profile: str):
    graph = usd2kg.build(kitchen_scene(), profile=profile, relations=EVERY_RELATION).graph
    assert {relation.kind for relation in graph.relations} == set(ALL_KINDS)
    write_graph(graph, tmp_path / "demo.ttl")
    report = check_owl(tmp_path / "demo.ttl")
    assert report.violations == ()
    assert report.axioms > 3000


@pytest.mark.parametrize("profile", PROFILES)
def test_all_statement_kinds_are_owl_2_dl_and_consistent(tmp_path: Path, profile: str):
    write_graph(WRITTEN[profile], tmp_path / "rich.ttl")
    report = check_owl(tmp_path / "rich.ttl", ontologies(), reasons=True)
    assert (report.violations, report.verdict) == ((), "consistent")


def test_u2k_vocabulary_is_owl_2_dl_and_consistent(tmp_path: Path):
    (tmp_path / "u2k.ttl").write_text(vocabulary_text(), encoding="utf-8")
    report = check_owl(tmp_path / "u2k.ttl", reasons=True)
    assert (report.violations, report.missing, report.verdict) == ((), (), "consistent")


@pytest.mark.parametrize("profile", PROFILES)
def test_franka_kitchen_is_consistent_with_its_ontologies(tmp_path: Path, profile: str):
    report = check_owl(franka(tmp_path, profile), ontologies(), reasons=True)
    assert (report.violations, report.missing, report.verdict) == ((), (), "consistent")


def test_check_detects_an_inconsistency(tmp_path: Path):
    # A stage is a collection, thus a social object, whose parts are social objects, too.
    path = franka(tmp_path)
    declared = f"<{DUL}hasPart> a <http://www.w3.org/2002/07/owl#ObjectProperty> ."
    path.write_text(path.read_text("utf-8") + declared + PART.format(dul=DUL, part=KETTLE), encoding="utf-8")
    assert check_owl(path, ontologies(), reasons=True).verdict == "inconsistent"


def test_check_detects_an_undeclared_property(tmp_path: Path):
    path = franka(tmp_path, "plain")
    text = path.read_text("utf-8").replace("u2k:lowerLimit a owl:DatatypeProperty .\n", "")
    path.write_text(text, encoding="utf-8")
    assert any("lowerLimit" in violation for violation in check_owl(path, ontologies()).violations)


def test_knowrob_colours_are_inconsistent(tmp_path: Path):
    path = franka(tmp_path, options=GraphOptions(colors="knowrob"))
    report = check_owl(path, ontologies(), reasons=True)
    assert (report.violations, report.verdict) == ((), "inconsistent")


def test_merged_graph_is_consistent(tmp_path: Path):
    report = check_owl(franka(tmp_path, merges=True), reasons=True)
    assert (report.missing, report.verdict) == ((), "consistent")
    # The violation is DUL's: a cardinality on isLocationOf, whose inverse occurs in a property chain.
    assert all("DUL.owl#isLocationOf" in violation for violation in report.violations)


@pytest.mark.parametrize("profile", PROFILES)
def test_owl_api_reads_the_same_axioms_in_all_owl_formats(tmp_path: Path, profile: str):
    turtle = franka(tmp_path, profile)
    expected = check_owl(turtle)
    assert expected.axioms > 500
    for ending in (".ofn", ".rdf"):
        other = tmp_path / f"franka{ending}"
        write_graph(read_document(turtle), other)
        assert check_owl(other) == expected
