"""Prims that can and cannot be labelled, and the class prims of Multiverse."""

import pytest

from tests.labels.conftest import MUG, SOMA, class_label, labels_at, outcomes
from tests.scene.usda import component, cube, prim, xform
from usd2kg.scene.label_lint import lint_labels

CHAIR = xform("Proto", xform("Seat", cube("g"), kind="subcomponent"))
COPIES = "".join(xform(name, meta=["instanceable = true", "references = </Proto>"]) for name in "AB")


def test_labels_instance_roots_but_not_instance_proxies(write):
    report, stage = write(CHAIR + COPIES, {"/A": class_label("Chair"), "/B/Seat": class_label("Seat")})
    assert outcomes(report) == {"/A": "written", "/B/Seat": "left out"}
    assert report.outcomes[1].reason == "inside an instance, which --de-instance makes editable: /B"
    assert stage.GetPrimAtPath("/B").IsInstance()
    assert ("UsdSemantics", "class", "Chair") in labels_at(stage, "/A")


def test_de_instances_only_where_a_proxy_is_labelled(write):
    report, stage = write(CHAIR + COPIES, {"/B/Seat": class_label("Seat")}, de_instances=True)
    assert report.de_instanced == ("/B",)
    assert not stage.GetPrimAtPath("/B").IsInstance()
    assert stage.GetPrimAtPath("/A").IsInstance()
    assert ("UsdSemantics", "class", "Seat") in labels_at(stage, "/B/Seat")
    assert labels_at(stage, "/A/Seat") == set()


def test_de_instances_nested_instances(write):
    nested = xform("Set", xform("Chair", meta=["instanceable = true", "references = </Proto>"]))
    outer = xform("Room", meta=["instanceable = true", "references = </Set>"])
    labels = {"/Room/Chair/Seat": class_label("Seat")}
    report, stage = write(CHAIR + nested + outer, labels, de_instances=True)
    assert report.de_instanced == ("/Room", "/Room/Chair")
    assert ("UsdSemantics", "class", "Seat") in labels_at(stage, "/Room/Chair/Seat")


@pytest.mark.parametrize(
    ("text", "path", "reason"),
    [
        (MUG, "/Nothing", "no such prim on the stage"),
        (MUG, "not a path", "no such prim on the stage"),
        (MUG, "/Mug.size", "no such prim on the stage"),
        (MUG, "", "no such prim on the stage"),
        (MUG, "/Mug[3]", "an instance of a point instancer is not a prim"),
        (xform("Mug", cube("g"), meta=["active = false"]), "/Mug", "inactive"),
        (prim("Xform", "Mug", specifier="over"), "/Mug", "only an over without a definition"),
        (prim("Xform", "Mug", specifier="class"), "/Mug", "abstract; prims that inherit from it would be labelled"),
    ],
)
def test_says_why_a_prim_cannot_be_labelled(write, text, path, reason):
    report, _ = write(text, {path: class_label()})
    assert [(entry.outcome, entry.reason) for entry in report.outcomes] == [("left out", reason)]


def test_labels_prims_of_variants_and_with_non_ascii_names(write):
    variant = (
        'def Xform "Mug" (\n    variants = { string kind = "a" }\n    prepend variantSets = "kind"\n)\n{\n'
        '    variantSet "kind" = {\n        "a" {\n def Cube "Küche" {\n}\n}\n        "b" {\n        }\n    }\n}\n'
    )
    _, stage = write(variant, {"/Mug/Küche": class_label("Kitchen")})
    assert ("UsdSemantics", "class", "Kitchen") in labels_at(stage, "/Mug/Küche")
    stage.GetPrimAtPath("/Mug").GetVariantSet("kind").SetVariantSelection("b")
    assert not stage.GetPrimAtPath("/Mug/Küche").IsDefined()


def test_class_prims_of_different_ontologies_have_different_paths(write):
    other = "http://other.example/SOMA.owl#"
    labels = {
        "/A": class_label("Cup"),
        "/B": class_label("Cup", namespace=other),
        "/C": class_label("Tasse groß", namespace=other),
    }
    text = "".join(component(name, cube("g")) for name in "ABC") + xform("SOMA", cube("g"))
    _, stage = write(text, labels, encodings=("Multiverse",))
    assert labels_at(stage, "/A") == {("Multiverse", SOMA, "Cup")}
    assert labels_at(stage, "/B") == {("Multiverse", other, "Cup")}
    assert labels_at(stage, "/C") == {("Multiverse", other, "Tasse groß")}
    assert stage.GetPrimAtPath("/SOMA").GetTypeName() == "Xform"
    assert lint_labels(stage) == []


def test_reuses_class_prims_of_the_stage(write):
    lines = ['string rdf:conceptName = "Cup"', f'string rdf:namespace = "{SOMA}"']
    ontology = prim("", "SOMA", prim("", "_class_Cup", *lines, specifier="class"))
    _, stage = write(ontology + MUG, {"/Mug": class_label()}, encodings=("Multiverse",))
    assert stage.GetRootLayer().GetPrimAtPath("/SOMA") is None
    assert labels_at(stage, "/Mug") == {("Multiverse", SOMA, "Cup")}
