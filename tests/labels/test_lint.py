"""Linting the labels of a stage: one small stage for each rule."""

import pytest

from tests.conftest import shared_file
from tests.labels.conftest import ENCODINGS, SOMA
from tests.scene.usda import METRES, component, cube, prim, xform
from usd2kg.grounding import ground, view_objects
from usd2kg.labels import LabelOptions, label_stage, lint_stage, read_prim_classes
from usd2kg.ontology import load_tbox
from usd2kg.scene import read_scene


@pytest.fixture
def lint(write_stage, home_tbox):
    """A function that writes prims as a stage and lints it: [(severity, rule, path, found, expected)]."""

    def run(*prims, tbox=home_tbox, grounded=None):
        lint = lint_stage(write_stage(METRES + "".join(prims)), tbox, grounded)
        return [(f.severity.value, f.rule, f.prim_path, f.found, f.expected) for f in lint.findings]

    return run


def labelled(name, *classes, iri=None, inside=(), kind="component"):
    """Return an object with geometry and labels in OpenUSD's encoding."""
    lines, apis = [], []
    for taxonomy, values in (("class", classes), ("iri", [iri] if iri else [])):
        if values:
            listed = ", ".join(f'"{value}"' for value in values)
            lines.append(f"token[] semantics:labels:{taxonomy} = [{listed}]")
            apis.append(f"SemanticsLabelsAPI:{taxonomy}")
    return xform(name, *lines, cube("g"), *inside, apis=apis, kind=kind)


@pytest.mark.parametrize("label", ["Cup", "cup", "teacup", "Designed Container", "designed_container"])
def test_accepts_names_labels_and_synonyms_of_classes(lint, label):
    assert lint(labelled("A", label)) == []


def test_suggests_a_class_for_an_unknown_label(lint):
    assert lint(labelled("A", "Botle"), labelled("B", "Botle"), labelled("C", "quux")) == [
        ("warning", "class-unknown", "/A", "the label 'Botle' names no class, on 2 prims",
         "the name of a class, such as Bottle"),
        ("warning", "class-unknown", "/C", "the label 'quux' names no class", "the name of a class"),
    ]  # fmt: skip


def test_reports_unknown_and_foreign_iris(lint):
    unknown, foreign = labelled("A", iri=f"{SOMA}Botle"), labelled("B", iri="http://x.example/o#Y")
    assert lint(unknown, foreign, labelled("C", iri=f"{SOMA}Cup")) == [
        ("error", "iri-unknown", "/A", f"<{SOMA}Botle> is not a class of the ontology",
         "a class of the ontology, such as Bottle"),
        ("note", "iri-foreign", "/B", "<http://x.example/o#Y> belongs to another ontology", "a class of the ontology"),
    ]  # fmt: skip


def test_reports_a_class_that_contradicts_the_iri(lint):
    found = lint(labelled("A", "Bottle", iri=f"{SOMA}Cup"), labelled("B", "Crockery", "Cup", iri=f"{SOMA}Cup"))
    assert [entry[:4] for entry in found] == [
        ("error", "class-iri-contradict", "/A", "class is 'Bottle' (UsdSemantics), but iri is soma:Cup")
    ]
    rules = {entry[1] for entry in lint(labelled("A", "banana split", iri=f"{SOMA}Cup"))}
    assert rules == {"class-iri-contradict", "class-unknown"}


def test_reports_deprecated_classes_with_their_replacement(lint, tmp_path):
    path = tmp_path / "lab.ttl"
    path.write_text(
        "@prefix : <http://x.example/lab#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        "@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix dct: <http://purl.org/dc/terms/> .\n"
        ":Beaker a owl:Class ; rdfs:subClassOf :Vessel ; owl:deprecated true ; dct:isReplacedBy :Cup .\n"
        ":Cup a owl:Class ; rdfs:subClassOf :Vessel .\n"
    )
    prims = labelled("A", "beaker"), labelled("B", "Cup"), labelled("C", iri="http://x.example/lab#Beaker")
    assert [entry[1:] for entry in lint(*prims, tbox=load_tbox(path))] == [
        ("class-deprecated", "/A", "the label 'beaker' names a deprecated class",
         "<http://x.example/lab#Cup>, which replaces it"),
        ("class-deprecated", "/C", "the class <http://x.example/lab#Beaker> is deprecated",
         "<http://x.example/lab#Cup>, which replaces it"),
    ]  # fmt: skip


def test_reports_the_less_frequent_spelling(lint):
    assert lint(labelled("A", "Cup"), labelled("B", "Cup"), labelled("C", "cup")) == [
        ("warning", "spelling-varies", "/C", "class is 'cup' on 1 prim, but 'Cup' on 2, such as /A", "'Cup'")
    ]


def test_reports_labels_without_geometry(lint):
    light = prim("SphereLight", "Lamp", 'token[] semantics:labels:class = ["Lamp"]',
                 meta=['prepend apiSchemas = ["SemanticsLabelsAPI:class"]'])  # fmt: skip
    found = [entry for entry in lint(light, labelled("A", "Cup")) if entry[1] == "label-unseen"]
    assert [entry[:4] for entry in found] == [
        ("note", "label-unseen", "/Lamp", "labelled 'Lamp', but neither the prim nor its descendants have geometry")
    ]


def test_reports_group_labels_that_objects_inherit(lint):
    group = labelled("Set", "Table", inside=[labelled("A", "Cup"), labelled("B")], kind="group")
    (found,) = [entry for entry in lint(group) if entry[1] == "label-inherited"]
    assert found[:3] == ("warning", "label-inherited", "/Set")
    assert found[3] == "'Table' is inherited by 2 objects without a class label: /Set/g, /Set/B"


def test_reports_two_classes_for_the_same_geometry(lint):
    mesh = cube("g", 'token[] semantics:labels:class = ["Bottle"]',
                meta=['prepend apiSchemas = ["SemanticsLabelsAPI:class"]'])  # fmt: skip
    cup = xform(
        "A", 'token[] semantics:labels:class = ["Cup"]', mesh, apis=["SemanticsLabelsAPI:class"], kind="component"
    )
    assert [entry[:4] for entry in lint(cup)] == [
        (
            "warning",
            "above-contradicts",
            "/A/g",
            "labelled Bottle, but /A, which has the same geometry, is labelled Cup",
        )
    ]
    assert lint(cup.replace("Bottle", "Crockery")) == [], "a superclass does not contradict"


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
    ],
)  # fmt: skip
def test_reports_problems_of_single_prims(lint, lines, apis, rule, expected):
    found = lint(xform("A", *lines, cube("g"), apis=apis, kind="component"))
    assert [(entry[1], entry[4]) for entry in found] == [(rule, expected)]


def test_reports_labels_that_differ_from_the_grounded_class(lint, tmp_path, home_tbox):
    path = tmp_path / "run.csv"
    path.write_text("path,class,confidence\n/A,soma:Cup,0.9\n/B,soma:Bottle,\n/C,soma:Crockery,\n/D,,\n/E,soma:Cup,\n")
    grounded = read_prim_classes(path, home_tbox)
    prims = [labelled("A", "Bottle"), labelled("B", "bottle"), labelled("C", "Cup"), labelled("D", "Cup")]
    found = lint(*prims, labelled("E", iri=f"{SOMA}Cup"), grounded=grounded)
    assert found[0] == ("warning", "label-stale", "/A", "labelled 'Bottle'", "the class of the run, soma:Cup (0.90)")
    assert [entry[1] for entry in found] == ["label-stale", "spelling-varies"]


@pytest.mark.parametrize("encodings", [("UsdSemantics",), ("Isaac",)])
def test_a_doubtful_prediction_is_no_evidence_when_it_is_read_again(write_stage, tmp_path, home_tbox, encodings):
    tree = "".join(component(name, cube("g")) for name in ("x_1", "x_2", "x_3", "x_4"))
    path, target = tmp_path / "run.csv", tmp_path / "labels.usda"
    rows = "/x_1,soma:Cup,0.3,grounded\n/x_2,soma:Cup,0.9,grounded\n/x_3,soma:Cup,,grounded\n/x_4,soma:Cup,1,reviewed\n"
    path.write_text(f"path,class,confidence,status\n{rows}")
    classes = read_prim_classes(path, home_tbox)
    label_stage(write_stage(METRES + tree), classes, home_tbox, target, options=LabelOptions(encodings))
    scene = read_scene(target)
    stated = [next(label.confidence for label in obj.labels.own) for obj in scene.objects]
    assert stated == [0.3, 0.9, None, None]
    views = [view.labels for _, view in view_objects(scene)]
    assert [bool(labels) for labels in views] == [False, True, True, True]


def test_a_prediction_that_is_read_again_is_no_more_certain(write_stage, tmp_path, home_tbox):
    source = write_stage(METRES + component("Bottle", cube("g", size=0.1)) + component("x_2", cube("g", at=(5, 0, 0))))
    path, target = tmp_path / "run.csv", tmp_path / "labels.usda"
    path.write_text("path,class,confidence\n/Bottle,soma:Bottle,0.81\n/x_2,soma:Cup,0.9\n")
    label_stage(source, read_prim_classes(path, home_tbox), home_tbox, target)
    bottle, cup = ground(read_scene(target), home_tbox).predictions
    assert (bottle.class_iri, bottle.confidence) == (SOMA + "Bottle", 0.81)
    # Only the label says so; it counts as that of a person would.
    assert cup.class_iri == SOMA + "Cup"
    assert 0.8 < cup.confidence <= 0.9
    # The name alone is more certain.
    assert ground(read_scene(source), home_tbox).predictions[0].confidence > 0.9
    assert ground(read_scene(target), home_tbox, evidence=frozenset({"name"})).predictions[0].confidence > 0.9


def test_the_confidence_that_is_written_is_no_text_of_the_object(write_stage, tmp_path, home_tbox):
    source = write_stage(METRES + component("Bottle", cube("g"), meta=['customData = { string note = "for milk" }']))
    path, target = tmp_path / "run.csv", tmp_path / "labels.usda"
    path.write_text("path,class,confidence\n/Bottle,soma:DesignedContainer,0.81\n")
    label_stage(source, read_prim_classes(path, home_tbox), home_tbox, target)
    assert read_scene(target).objects[0].texts == (("customData:note", "for milk"),)


def test_a_person_who_changes_a_predicted_label_decides(write_stage, tmp_path, home_tbox):
    path, target = tmp_path / "run.csv", tmp_path / "labels.usda"
    path.write_text("path,class,confidence\n/x_1,soma:Cup,0.3\n")
    source = write_stage(METRES + component("x_1", cube("g")))
    label_stage(source, read_prim_classes(path, home_tbox), home_tbox, target)
    text = target.read_text("utf-8")
    assert 'semantics:labels:class = ["Cup"]' in text
    target.write_text(text.replace('semantics:labels:class = ["Cup"]', 'semantics:labels:class = ["Bottle"]'), "utf-8")
    (obj,) = read_scene(target).objects
    assert {label.confidence for label in obj.labels.own} == {None}


def test_a_person_who_confirms_a_predicted_label_makes_it_evidence(write_stage, tmp_path, home_tbox):
    run, predicted, confirmed = tmp_path / "run.csv", tmp_path / "predicted.usda", tmp_path / "confirmed.usda"
    run.write_text("path,class,confidence\n/x_1,soma:Cup,0.3\n")
    source = write_stage(METRES + component("x_1", cube("g")))
    label_stage(source, read_prim_classes(run, home_tbox), home_tbox, predicted)
    run.write_text("path,decision\n/x_1,soma:Cup\n")
    options = LabelOptions(mode="overwrite")
    label_stage(predicted, read_prim_classes(run, home_tbox), home_tbox, confirmed, options=options)
    (obj,) = read_scene(confirmed).objects
    assert [(label.value, label.confidence) for label in obj.labels.own if label.taxonomy == "class"] == [("Cup", None)]


def test_finds_nothing_in_labels_written_by_label_stage(write_stage, tmp_path, home_tbox):
    source = write_stage(METRES + component("A", cube("g")) + component("B", cube("g")))
    path, target = tmp_path / "run.csv", tmp_path / "labels.usda"
    path.write_text("path,class,confidence\n/A,soma:Cup,0.9\n/B,soma:Bottle,0.5\n")
    classes = read_prim_classes(path, home_tbox)
    options = LabelOptions(ENCODINGS)
    report = label_stage(source, classes, home_tbox, target, options=options, has_ancestors=True, min_confidence=0.6)
    assert [(entry.prim_path, entry.outcome, entry.reason) for entry in report.outcomes] == [
        ("/A", "written", ""),
        ("/B", "left out", "confidence below 0.6"),
    ]
    assert lint_stage(target, home_tbox, classes).findings == ()


def test_lints_the_tagged_kitchen_against_its_own_ontology():
    scene = shared_file("scenes/dlr_kitchen/tagged_flattened.usda")
    module = load_tbox(shared_file("ontologies/other/multiverse_soma_dfl/SOMA_DFL_module.owl"))
    lint = lint_stage(scene, module)
    assert [(f.rule, f.prim_path) for f in lint.findings] == [("schema-without-label", "/dlr_kitchen/kitchenette")]
    assert lint.prims == 21
