"""What the modes new, overwrite and skip do to prims that have labels."""

from dataclasses import replace

from pxr import Usd, UsdSemantics

from tests.labels.conftest import ENCODINGS, MUG, SOMA, class_label, labels_at, outcomes
from tests.scene.usda import cube, prim, xform
from usd2kg.labels import LabelOptions, write_labels
from usd2kg.scene.label_lint import lint_labels
from usd2kg.scene.label_reader import read_labels

LABELLED = xform(
    "Mug",
    'token[] semantics:labels:class = ["banana"]',
    'token[] semantics:labels:room = ["kitchen"]',
    'string semantic:old:params:semanticType = "class"',
    'string semantic:old:params:semanticData = "banana"',
    cube("g"),
    apis=["SemanticsLabelsAPI:class", "SemanticsLabelsAPI:room", "SemanticsAPI:old"],
    kind="component",
)
OLD_LABELS = {
    ("UsdSemantics", "class", "banana"),
    ("UsdSemantics", "room", "kitchen"),
    ("Isaac", "class", "banana"),
}


def test_new_keeps_labelled_prims(write):
    report, stage = write(LABELLED, {"/Mug": class_label()}, mode="new")
    assert labels_at(stage, "/Mug") == OLD_LABELS
    (entry,) = report.outcomes
    assert (entry.outcome, entry.reason) == ("kept", "has labels already: 'banana', 'kitchen'")


def test_overwrite_replaces_the_class_in_all_encodings(write):
    report, stage = write(LABELLED, {"/Mug": class_label(qcodes=())}, mode="overwrite")
    assert outcomes(report) == {"/Mug": "replaced"}
    assert labels_at(stage, "/Mug") == {
        ("UsdSemantics", "class", "Cup"),
        ("UsdSemantics", "iri", f"{SOMA}Cup"),
        ("UsdSemantics", "room", "kitchen"),
    }
    assert lint_labels(stage) == []
    assert "SemanticsAPI:old" not in stage.GetPrimAtPath("/Mug").GetPrimTypeInfo().GetAppliedAPISchemas()


def test_overwrite_removes_or_replaces_multiverse_tags(write):
    ontology = prim("", "Onto", prim("", "_class_Banana", 'string rdf:conceptName = "Banana"', specifier="class"))
    tagged = xform("Mug", "rel semanticTag:semanticLabels = </Onto/_class_Banana>", cube("g"), apis=["SemanticTagAPI"])
    _, stage = write(ontology + tagged, {"/Mug": class_label(qcodes=())}, mode="overwrite")
    assert {encoding for encoding, _, _ in labels_at(stage, "/Mug")} == {"UsdSemantics"}
    assert lint_labels(stage) == []
    _, stage = write(ontology + tagged, {"/Mug": class_label()}, mode="overwrite", encodings=ENCODINGS, name="all.usda")
    assert ("Multiverse", SOMA, "Cup") in labels_at(stage, "/Mug")
    assert not any(value == "Banana" for _, _, value in labels_at(stage, "/Mug"))


def test_overwrite_blocks_misspelt_class_labels_and_corrects_types(write):
    wrong = xform(
        "Mug",
        'string semantics:labels:class = "banana"',
        'token[] semantics:label:class = ["banana"]',
        'token[] semantics:label:room = ["kitchen"]',
        'string semantics:a:params:semanticType = "class"',
        'string semantics:a:params:semanticData = "banana"',
        'string semantics:b:params:semanticType = "room"',
        "rel semanticTags:semanticLabels = </Mug>",
        cube("g"),
        apis=["SemanticsLabelsAPI:class"],
    )
    report, stage = write(wrong, {"/Mug": class_label(qcodes=())}, mode="overwrite")
    assert outcomes(report) == {"/Mug": "replaced"}
    mug = stage.GetPrimAtPath("/Mug")
    assert labels_at(stage, "/Mug") == {("UsdSemantics", "class", "Cup"), ("UsdSemantics", "iri", f"{SOMA}Cup")}
    query = UsdSemantics.LabelsQuery("class", Usd.TimeCode.Default())
    assert list(query.ComputeUniqueDirectLabels(mug)) == ["Cup"]
    # Labels of other taxonomies stay, even if misspelt.
    assert [note.message.split()[0] for note in lint_labels(stage)] == [
        "semantics:b:params:semanticType",
        "semantics:label:room",
    ]
    assert mug.GetAttribute("semantics:label:class").GetTypeName() == "token[]"


def test_overwrite_replaces_time_samples(write):
    samples = xform("Mug", 'token[] semantics:labels:class.timeSamples = { 1: ["pupa"], 5: ["butterfly"] }', cube("g"))
    _, stage = write(samples, {"/Mug": class_label()}, mode="overwrite")
    labels = read_labels(stage.GetPrimAtPath("/Mug"), Usd.TimeCode(5))
    assert [label.value for label in labels if label.taxonomy == "class"] == ["Cup"]


def test_skip_adds_missing_labels_if_the_class_agrees(write):
    agreeing = LABELLED.replace("banana", "coffee mug")
    encodings = ("UsdSemantics", "Isaac")
    report, stage = write(agreeing, {"/Mug": class_label(names=["mug"])}, mode="skip", encodings=encodings)
    assert outcomes(report) == {"/Mug": "completed"}
    assert labels_at(stage, "/Mug") == {
        ("UsdSemantics", "class", "coffee mug"),
        ("UsdSemantics", "iri", f"{SOMA}Cup"),
        ("UsdSemantics", "room", "kitchen"),
        ("UsdSemantics", "wikidata_qcode", "Q81727"),
        ("Isaac", "class", "coffee mug"),
        ("Isaac", "iri", f"{SOMA}Cup"),
        ("Isaac", "qcode", "Q81727"),
    }


def test_skip_adds_nothing_to_labels_of_another_class(write):
    report, stage = write(LABELLED, {"/Mug": class_label()}, mode="skip")
    assert labels_at(stage, "/Mug") == OLD_LABELS
    assert report.outcomes[0].reason == "its labels name another class: 'banana'"


def test_skip_keeps_complete_labels(write, tmp_path):
    write(MUG, {"/Mug": class_label()}, name="first.usda")
    options = LabelOptions(mode="skip")
    report = write_labels(tmp_path / "first.usda", {"/Mug": class_label()}, tmp_path / "second.usda", options)
    assert outcomes(report) == {"/Mug": "kept"}


def test_keeps_isaac_schema_instances_of_other_taxonomies(write):
    room = xform(
        "Mug",
        'string semantic:Semantics:params:semanticType = "room"',
        'string semantic:Semantics:params:semanticData = "bath"',
        cube("g"),
        apis=["SemanticsAPI:Semantics"],
    )
    _, stage = write(room, {"/Mug": class_label()}, mode="overwrite", encodings=("Isaac",))
    assert {("Isaac", "room", "bath"), ("Isaac", "class", "Cup")} <= labels_at(stage, "/Mug")


def test_the_concept_is_a_label_of_its_own(write):
    label = replace(class_label(qcodes=()), concept="mug")
    _, stage = write(MUG, {"/Mug": label}, encodings=("UsdSemantics", "Isaac"))
    assert UsdSemantics.LabelsAPI(stage.GetPrimAtPath("/Mug"), "concept").GetLabelsAttr().Get() == ["mug"]
    assert ("Isaac", "concept", "mug") in labels_at(stage, "/Mug")
    assert lint_labels(stage) == []


def test_overwrite_replaces_the_concept(write, tmp_path):
    label = replace(class_label(qcodes=()), concept="mug")
    write(MUG, {"/Mug": label}, name="first.usda", encodings=("UsdSemantics", "Isaac"))
    for concept in ("cup", ""):
        options = LabelOptions(("UsdSemantics", "Isaac"), "overwrite")
        target = tmp_path / f"second{concept}.usda"
        write_labels(tmp_path / "first.usda", {"/Mug": replace(label, concept=concept)}, target, options)
        found = labels_at(Usd.Stage.Open(str(target)), "/Mug")
        concepts = {(encoding, value) for encoding, taxonomy, value in found if taxonomy == "concept"}
        assert concepts == ({("UsdSemantics", "cup"), ("Isaac", "cup")} if concept else set())
