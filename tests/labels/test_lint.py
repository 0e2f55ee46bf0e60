"""Linting labels: against each other, an ontology and a run. Each rule on a stage made for it, and a good one."""

import pytest

from tests.conftest import shared_file
from tests.scene.usda import METRES, component, cube, prim, xform
from usd2kg.labels import LabelOptions, label_stage, lint_stage, read_prim_classes
from usd2kg.ontology import load_tbox

SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"


@pytest.fixture
def lint(write_stage, home_tbox):
    """A function that writes prims as a stage and lints it: [(severity, rule, path, found, expected)]."""

    def run(*prims, tbox=home_tbox, answers=None):
        found = lint_stage(write_stage(METRES + "".join(prims)), tbox, answers)
        return [(f.severity.value, f.rule, f.prim_path, f.found, f.expected) for f in found.findings]

    return run


def thing(name, *classes, iri=None, inside=(), kind="component"):
    """Return an object with labels of OpenUSD's, and geometry."""
    lines, apis = [], []
    for taxonomy, values in (("class", classes), ("iri", [iri] if iri else [])):
        if values:
            listed = ", ".join(f'"{value}"' for value in values)
            lines.append(f"token[] semantics:labels:{taxonomy} = [{listed}]")
            apis.append(f"SemanticsLabelsAPI:{taxonomy}")
    return xform(name, *lines, cube("g"), *inside, apis=apis, kind=kind)


@pytest.mark.parametrize("label", ["Cup", "cup", "teacup", "Designed Container", "designed_container"])
def test_names_labels_and_synonyms_of_classes_are_good(lint, label):
    assert lint(thing("A", label)) == []


def test_an_unknown_class_with_a_near_match(lint):
    assert lint(thing("A", "Botle"), thing("B", "Botle"), thing("C", "quux")) == [
        ("warning", "class-unknown", "/A", "the label 'Botle' names no class, on 2 prims",
         "the name of a class, such as Bottle"),
        ("warning", "class-unknown", "/C", "the label 'quux' names no class", "the name of a class"),
    ]  # fmt: skip


def test_iris(lint):
    found = lint(thing("A", iri=f"{SOMA}Botle"), thing("B", iri="http://x.example/o#Y"), thing("C", iri=f"{SOMA}Cup"))
    assert [entry[:4] for entry in found] == [
        ("error", "iri-unknown", "/A", f"<{SOMA}Botle> is no class of the ontology"),
        ("note", "iri-foreign", "/B", "<http://x.example/o#Y> is of another ontology"),
    ]


def test_class_and_iri_that_contradict(lint):
    found = lint(thing("A", "Bottle", iri=f"{SOMA}Cup"), thing("B", "Crockery", "Cup", iri=f"{SOMA}Cup"))
    assert [entry[:4] for entry in found] == [
        ("error", "class-iri-contradict", "/A", "class says 'Bottle' (UsdSemantics), but the IRI says soma:Cup")
    ]
    rules = {entry[1] for entry in lint(thing("A", "banana split", iri=f"{SOMA}Cup"))}
    assert rules == {"class-iri-contradict", "class-unknown"}


def test_deprecated_classes(lint, tmp_path):
    path = tmp_path / "lab.ttl"
    path.write_text(
        "@prefix : <http://x.example/lab#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        "@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix dct: <http://purl.org/dc/terms/> .\n"
        ":Beaker a owl:Class ; rdfs:subClassOf :Vessel ; owl:deprecated true ; dct:isReplacedBy :Cup .\n"
        ":Cup a owl:Class ; rdfs:subClassOf :Vessel .\n"
    )
    found = lint(thing("A", "beaker"), thing("B", "Cup"), thing("C", iri="http://x.example/lab#Beaker"),
                 tbox=load_tbox(path))  # fmt: skip
    assert [entry[1:] for entry in found] == [
        ("class-deprecated", "/A", "the label 'beaker' names a deprecated class",
         "<http://x.example/lab#Cup>, which replaces it"),
        ("class-deprecated", "/C", "the class <http://x.example/lab#Beaker> is deprecated",
         "<http://x.example/lab#Cup>, which replaces it"),
    ]  # fmt: skip


def test_spellings_that_vary(lint):
    (found,) = lint(thing("A", "Cup"), thing("B", "Cup"), thing("C", "cup"))
    assert found == ("warning", "spelling-varies", "/C", "class is 'cup' on 1 prim, and 'Cup' on 2, /A the first",
                     "'Cup'")  # fmt: skip


def test_a_label_that_nobody_sees(lint):
    light = prim("SphereLight", "Lamp", 'token[] semantics:labels:class = ["Lamp"]',
                 meta=['prepend apiSchemas = ["SemanticsLabelsAPI:class"]'])  # fmt: skip
    assert ("note", "label-unseen", "/Lamp") in [entry[:3] for entry in lint(light, thing("A", "Cup"))]


def test_labels_of_groups_that_objects_inherit(lint):
    group = thing("Set", "Table", inside=[thing("A", "Cup"), thing("B")], kind="group")
    (found,) = [entry for entry in lint(group) if entry[1] == "label-inherited"]
    assert found[0] == "warning"
    assert found[2] == "/Set"
    assert "inherit 'Table': /Set/" in found[3]
    assert "/Set/B" in found[3]
    assert "/Set/A" not in found[3]


def test_the_same_geometry_labelled_twice(lint):
    mesh = cube("g", 'token[] semantics:labels:class = ["Bottle"]',
                meta=['prepend apiSchemas = ["SemanticsLabelsAPI:class"]'])  # fmt: skip
    cup = xform(
        "A", 'token[] semantics:labels:class = ["Cup"]', mesh, apis=["SemanticsLabelsAPI:class"], kind="component"
    )
    assert [entry[:4] for entry in lint(cup)] == [
        ("warning", "above-contradicts", "/A/g", "it says Bottle, but /A above it, of the same geometry, says Cup")
    ]
    assert lint(cup.replace("Bottle", "Crockery")) == []


@pytest.mark.parametrize(
    ("lines", "apis", "rule", "expected"),
    [
        (['token[] semantics:label:class = ["Cup"]'], [], "property-misspelt", "semantics:labels:class"),
        (['string semantic:Semantics:params:semanticdata = "Cup"'], [], "property-misspelt",
         "semantic:Semantics:params:semanticData"),
        (['rel semanticTag:semanticLabel = </A>'], [], "property-misspelt", "semanticTag:semanticLabels"),
        (['string semantic:Semantics_ab:params:semanticType = "class"',
          'string semantic:Semantics_aB:params:semanticData = "Cup"'],
         ["SemanticsAPI:Semantics_ab", "SemanticsAPI:Semantics_aB"], "isaac-instance", "one instance name for both"),
        (['string semantic:Semantics_ab:params:semanticType = "class"',
          'string semantic:Semantics_ab:params:semanticData = "Cup"'],
         ["SemanticsAPI:Semantics_abc"], "isaac-instance", "SemanticsAPI:Semantics_ab"),
        (['string semantic:a:params:semanticType = "class"'], ["SemanticsAPI:a"], "isaac-half",
         "both semanticType and semanticData under one instance name"),
        (['rel semanticTag:semanticLabels = </SOMA/_class_Cup>'], ["SemanticTagAPI"], "tag-target-missing",
         "a class prim on the stage"),
        (['token[] semantics:labels:class = [""]'], ["SemanticsLabelsAPI:class"], "label-empty", "one"),
    ],
)  # fmt: skip
def test_what_is_wrong_on_one_prim(lint, lines, apis, rule, expected):
    found = lint(xform("A", *lines, cube("g"), apis=apis, kind="component"))
    assert [(entry[1], entry[4]) for entry in found] == [(rule, expected)]


def test_stale_labels(lint, tmp_path, home_tbox):
    path = tmp_path / "run.csv"
    path.write_text("path,class,confidence\n/A,soma:Cup,0.9\n/B,soma:Bottle,\n/C,soma:Crockery,\n/D,,\n/E,soma:Cup,\n")
    run = read_prim_classes(path, home_tbox)
    prims = [
        thing("A", "Bottle"),
        thing("B", "bottle"),
        thing("C", "Cup"),
        thing("D", "Cup"),
        thing("E", iri=f"{SOMA}Cup"),
    ]
    assert lint(*prims, answers=run)[0] == (
        "warning", "label-stale", "/A", "its labels say 'Bottle'", "soma:Cup (0.90), which the run says"
    )  # fmt: skip
    assert [entry[1] for entry in lint(*prims, answers=run)] == ["label-stale", "spelling-varies"]


def test_what_is_written_here_is_clean(write_stage, tmp_path, home_tbox):
    source = write_stage(METRES + component("A", cube("g")) + component("B", cube("g")))
    path = tmp_path / "run.csv"
    path.write_text("path,class,confidence\n/A,soma:Cup,0.9\n/B,soma:Bottle,0.5\n")
    run = read_prim_classes(path, home_tbox)
    encodings = ("UsdSemantics", "Isaac", "Multiverse")
    target = tmp_path / "labels.usda"
    options = LabelOptions(encodings)
    report = label_stage(source, run, home_tbox, target, options=options, has_ancestors=True, min_confidence=0.6)
    assert [(e.prim_path, e.outcome, e.reason) for e in report.outcomes] == [
        ("/A", "written", ""),
        ("/B", "left out", "its class is less sure than 0.6"),
    ]
    assert lint_stage(target, home_tbox, run).findings == ()


def test_the_tagged_kitchen_against_its_own_ontology():
    scene = shared_file("scenes/dlr_kitchen/tagged_flattened.usda")
    module = load_tbox(shared_file("ontologies/other/multiverse_soma_dfl/SOMA_DFL_module.owl"))
    found = lint_stage(scene, module)
    assert [(f.rule, f.prim_path) for f in found.findings] == [("schema-without-label", "/dlr_kitchen/kitchenette")]
    assert found.prims == 21
