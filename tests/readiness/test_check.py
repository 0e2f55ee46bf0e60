"""Findings of the readiness check."""

from pathlib import Path

import pytest

from tests.conftest import shared_file
from usd2kg.ontology import TBox, load_tbox
from usd2kg.readiness import OntologyReport, check_ontology
from usd2kg.validation import Severity

HEAD = """
@prefix : <https://lab.example/onto#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
<https://lab.example/onto> a owl:Ontology .
:Artifact a owl:Class ; rdfs:label "artifact" ; rdfs:comment "A made thing." .
:Cup a owl:Class ; rdfs:subClassOf :Artifact ; rdfs:label "cup" ; skos:altLabel "mug" ; rdfs:comment "To drink of." .
"""


def check(folder: Path, text: str) -> OntologyReport:
    path = folder / "lab.ttl"
    path.write_text(HEAD + text, encoding="utf-8")
    return check_ontology(load_tbox(path))


def found(report: OntologyReport) -> set[tuple[str, str]]:
    return {(finding.rule, finding.iri.rpartition("#")[2]) for finding in report.findings}


def test_built_in_tbox_has_no_findings(home_tbox: TBox):
    report = check_ontology(home_tbox)
    assert report.findings == ()
    assert report.classes == report.labelled == report.meant == report.found_by_name == 102


def test_counts_labels_definitions_and_synonyms(tmp_path: Path):
    report = check(tmp_path, ":Box a owl:Class ; rdfs:subClassOf :Artifact .")
    assert (report.classes, report.labelled, report.described, report.with_synonyms) == (3, 2, 2, 1)
    assert (report.roots, report.depth, report.several_parents, report.documents) == (1, 1, 0, 1)
    assert report.default == "https://lab.example/onto#Artifact"
    assert report.counts()["meant"] == 3


CASES = {
    "a name that says nothing": (":B_0042 a owl:Class ; rdfs:subClassOf :Cup .", ("no-name", "B_0042")),
    "no label": (":SaltMill a owl:Class ; rdfs:subClassOf :Artifact .", ("no-label", "SaltMill")),
    "no comment": (":Fork a owl:Class ; rdfs:subClassOf :Artifact .", ("no-definition", "Fork")),
    "a name of two classes": (
        ":Goblet a owl:Class ; rdfs:subClassOf :Artifact ; rdfs:label 'goblet', 'Mug' .",
        ("shared-name", "Cup"),
    ),
    "disjoint superclasses": (
        ":Food a owl:Class ; owl:disjointWith :Artifact . :Pie a owl:Class ; rdfs:subClassOf :Food, :Cup .",
        ("unsatisfiable", "Pie"),
    ),
    "below nothing": (":Ghost a owl:Class ; rdfs:subClassOf :Cup, owl:Nothing .", ("unsatisfiable", "Ghost")),
    "a cycle": (":Cup rdfs:subClassOf :Bowl . :Bowl a owl:Class ; rdfs:subClassOf :Cup .", ("cycle", "")),
    "an import that is not there": (
        "<https://lab.example/onto> owl:imports <https://x.example/y> .",
        ("missing-import", ""),
    ),
    "no noun": (
        ":Zorbaquix a owl:Class ; rdfs:subClassOf :Artifact ; rdfs:label 'zorbaquix' .",
        ("no-sense", "Zorbaquix"),
    ),
    "no things": (
        ":MakeEvent a owl:Class ; rdfs:subClassOf :Artifact ; rdfs:label 'make event' .",
        ("no-things", "MakeEvent"),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_finds_each_fault(tmp_path: Path, name: str):
    text, expected = CASES[name]
    report = check(tmp_path, text)
    assert expected in found(report)
    assert expected not in found(check(tmp_path, ""))
    finding = next(f for f in report.findings if f.rule == expected[0])
    assert finding.found and finding.expected and finding.advice


def test_finds_a_flat_list(tmp_path: Path):
    names = "Fork Spoon Plate Bowl Knife Table Chair Lamp".split()
    path = tmp_path / "flat.ttl"
    path.write_text(
        HEAD.split(":Artifact a", maxsplit=1)[0] + "".join(f":{name} a owl:Class .\n" for name in names), "utf-8"
    )
    report = check_ontology(load_tbox(path))
    assert {f.rule for f in report.findings if f.severity is not Severity.NOTE} == {"flat"}
    assert report.default is None


def test_finds_isolated_classes(tmp_path: Path):
    alone = "".join(f":Alone{i:02} a owl:Class .\n" for i in range(22))
    report = check(tmp_path, f"{alone} :Old a owl:Class ; owl:deprecated true . owl:Thing a owl:Class .")
    (finding,) = [finding for finding in report.findings if finding.rule == "stands-alone"]
    assert finding.severity is Severity.NOTE
    assert finding.found.startswith("22 classes without subclass axioms: Alone00, Alone01, ")
    assert finding.found.endswith("Alone19 and 2 more")
    assert not any(rule == "stands-alone" for rule, _ in found(check(tmp_path, "")))


def test_explicit_scopes_have_no_isolated_classes(tmp_path: Path):
    path = tmp_path / "lab.ttl"
    path.write_text(HEAD + ":Alone a owl:Class .", encoding="utf-8")
    assert load_tbox(path).isolated == ("https://lab.example/onto#Alone",)
    assert load_tbox(path, roots=["https://lab.example/onto#Artifact"]).isolated == ()


def test_finds_a_missing_residual_class(tmp_path: Path):
    path = tmp_path / "kinds.ttl"
    pairs = [("Table", "Desk"), ("Chair", "Armchair")]
    classes = "".join(
        f":{general} a owl:Class .\n:{special} a owl:Class ; rdfs:subClassOf :{general} .\n"
        for general, special in pairs
    )
    path.write_text(HEAD.split(":Artifact a", maxsplit=1)[0] + classes, "utf-8")
    report = check_ontology(load_tbox(path))
    (finding,) = [finding for finding in report.findings if finding.rule == "no-general-class"]
    expected = "an object that fits no class gets no class: none of the 2 roots fits objects of all kinds"
    assert finding.found == expected
    assert report.default is None


def test_finds_a_narrow_residual_class(tmp_path: Path):
    others = "".join(
        f":R{i} a owl:Class ; rdfs:label 'cabinet kind {i}' .\n:S{i} a owl:Class ; rdfs:subClassOf :R{i} .\n"
        for i in range(4)
    )
    assert "no-general-class" in {finding.rule for finding in check(tmp_path, others).findings}


def test_suggests_a_common_noun(tmp_path: Path):
    report = check(tmp_path, ":QuuxGripper a owl:Class ; rdfs:subClassOf :Artifact ; rdfs:label 'quux gripper' .")
    advice = next(f.advice for f in report.findings if f.rule == "no-sense" and f.iri.endswith("QuuxGripper"))
    assert advice.startswith("Add a skos:altLabel")


def test_finds_a_label_claimed_by_another_class(tmp_path: Path):
    report = check(tmp_path, ":Cup2 a owl:Class ; rdfs:subClassOf :Artifact ; rdfs:label 'cup' .")
    (lost,) = [finding for finding in report.findings if finding.rule == "lost-name"]
    assert "an object called Cup is grounded to" in lost.found


def test_reads_wordnet_sense_keys():
    tbox = load_tbox(shared_file("ontologies/other/multiverse_soma_dfl/SOMA_DFL_module.owl"))
    report = check_ontology(tbox)
    assert report.found_by_name / report.classes > 0.9
    assert not any("N.wn" in finding.found for finding in report.findings)
