"""Label layers: what is written over a stage, read back by OpenUSD and by our own reader."""

import hashlib
import os
import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pxr import Usd, UsdGeom, UsdSemantics

from tests.conftest import shared_file
from tests.scene.usda import METRES, component, cube, header, prim, xform
from usd2kg.demo import demo_scene
from usd2kg.errors import OutputError
from usd2kg.labels import ClassLabel, LabelOptions, write_labels
from usd2kg.scene import read_scene
from usd2kg.scene.label_lint import lint_labels
from usd2kg.scene.label_reader import read_labels

EARLIEST = Usd.TimeCode.EarliestTime()
SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
ALL = ("UsdSemantics", "Isaac", "Multiverse")


def label(name="Cup", above=(), qcodes=("Q81727",), names=(), namespace=SOMA):
    return ClassLabel(name, namespace + name, name, namespace, above, qcodes, f"A {name}.", frozenset(names))


def told(stage, path):
    return {(found.encoding, found.taxonomy, found.value) for found in read_labels(stage.GetPrimAtPath(path), EARLIEST)}


def outcomes(report):
    return {entry.prim_path: entry.outcome for entry in report.outcomes}


@pytest.fixture
def write(write_stage, tmp_path):
    """A function that writes prims as a stage, labels it, and returns the report and the labelled stage."""

    def run(text, labels, name="labels.usda", layer=METRES, **options):
        source = write_stage(layer + text)
        before = source.read_bytes()
        report = write_labels(source, labels, tmp_path / name, LabelOptions(**options))
        assert source.read_bytes() == before, "the source is never changed"
        return report, Usd.Stage.Open(str(tmp_path / name))

    return run


MUG = component("Mug", cube("g"))


def test_the_layer_of_one_label(write, tmp_path):
    report, _ = write(MUG, {"/Mug": label()})
    assert outcomes(report) == {"/Mug": "written"}
    assert (tmp_path / "labels.usda").read_text() == (
        "#usda 1.0\n"
        "(\n"
        "    customLayerData = {\n"
        "        dictionary usd2kg = {\n"
        '            string content = "labels"\n'
        "        }\n"
        "    }\n"
        '    doc = "Semantic labels over scene.usda, by usd2kg."\n'
        "    metersPerUnit = 1\n"
        "    subLayers = [\n"
        "        @./scene.usda@\n"
        "    ]\n"
        '    upAxis = "Z"\n'
        ")\n\n"
        'over "Mug" (\n'
        '    prepend apiSchemas = ["SemanticsLabelsAPI:class", "SemanticsLabelsAPI:iri", '
        '"SemanticsLabelsAPI:wikidata_qcode"]\n'
        ")\n"
        "{\n"
        '    token[] semantics:labels:class = ["Cup"]\n'
        f'    token[] semantics:labels:iri = ["{SOMA}Cup"]\n'
        '    token[] semantics:labels:wikidata_qcode = ["Q81727"]\n'
        "}\n\n"
    )


def test_openusd_reads_the_labels_and_lets_them_inherit(write):
    _, stage = write(MUG, {"/Mug": label(above=("Crockery",))})
    query = UsdSemantics.LabelsQuery("class", Usd.TimeCode.Default())
    mug, mesh = stage.GetPrimAtPath("/Mug"), stage.GetPrimAtPath("/Mug/g")
    assert mug.HasAPI(UsdSemantics.LabelsAPI, "class")
    assert list(UsdSemantics.LabelsAPI(mug, "class").GetLabelsAttr().Get()) == ["Crockery", "Cup"]
    assert sorted(query.ComputeUniqueInheritedLabels(mesh)) == ["Crockery", "Cup"]
    assert query.HasInheritedLabel(mesh, "Cup")
    assert not query.HasDirectLabel(mesh, "Cup")


@pytest.mark.parametrize("ending", ["usda", "usdc", "usd"])
def test_all_three_encodings_come_back(write, ending):
    _, stage = write(MUG, {"/Mug": label(above=("Crockery",))}, f"labels.{ending}", encodings=ALL)
    assert told(stage, "/Mug") == {
        ("UsdSemantics", "class", "Crockery"),
        ("UsdSemantics", "class", "Cup"),
        ("UsdSemantics", "iri", f"{SOMA}Cup"),
        ("UsdSemantics", "wikidata_qcode", "Q81727"),
        ("Isaac", "class", "Cup"),
        ("Isaac", "hierarchy", "Crockery/Cup"),
        ("Isaac", "iri", f"{SOMA}Cup"),
        ("Isaac", "qcode", "Q81727"),
        ("Multiverse", SOMA, "Cup"),
    }
    assert lint_labels(stage) == []
    tagged = stage.GetPrimAtPath("/SOMA/_class_Cup")
    assert tagged.GetAttribute("rdf:definition").Get() == "A Cup."
    assert [found.GetPath() for found in stage.Traverse()] == ["/Mug", "/Mug/g", "/SOMA"]


# --- the stage that the layer is over ------------------------------------------------------------------


def test_stage_metadata_is_restated(write):
    layer = header(
        metersPerUnit=0.01,
        upAxis="Y",
        kilogramsPerUnit=0.001,
        startTimeCode=1,
        endTimeCode=48,
        timeCodesPerSecond=48,
        framesPerSecond=24,
        defaultPrim="Mug",
        customLayerData=1,
    ).replace("    customLayerData = 1", '    customLayerData = { string note = "kept" }')
    _, stage = write(MUG, {"/Mug": label()}, layer=layer, provenance={"ontology": "http://x"})
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.01
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert stage.GetMetadata("kilogramsPerUnit") == 0.001
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, 48)
    assert (stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()) == (48, 24)
    assert stage.GetDefaultPrim().GetPath() == "/Mug"
    assert stage.GetRootLayer().customLayerData == {
        "note": "kept",
        "usd2kg": {"content": "labels", "ontology": "http://x"},
    }


def test_a_layer_of_labels_is_written_anew(write, tmp_path):
    for name in ("labels.usda", "labels.usdc", "labels.usd"):
        write(MUG, {"/Mug": label()}, name)
        _, stage = write(MUG, {"/Mug": label("Mug")}, name)
        assert ("UsdSemantics", "class", "Mug") in told(stage, "/Mug")
        assert ("UsdSemantics", "class", "Cup") not in told(stage, "/Mug")


SWITCH = """
def Xform "World" (
    variants = { string v = "off" }
    prepend variantSets = "v"
)
{
    variantSet "v" = { "off" { } "on" ( prepend references = @./other.usda@ ) { } }
}
"""


@pytest.mark.parametrize("other", [METRES + MUG, "not USD", 'x = "usd2kg"'])
def test_a_file_that_is_no_layer_of_labels_stays(write_stage, tmp_path, other):
    source = write_stage(METRES + SWITCH)
    path = tmp_path / "other.usda"
    path.write_text(other)
    with pytest.raises(OutputError, match=r"other\.usda: exists and is no layer of labels of usd2kg, so it stays"):
        write_labels(source, {"/World": label()}, path)
    assert path.read_text() == other


def test_a_flattened_labelled_stage_stays(write, tmp_path):
    _, stage = write(MUG, {"/Mug": label()})
    flat = tmp_path / "flat.usda"
    stage.Export(str(flat))
    with pytest.raises(OutputError, match="no layer of labels"):
        write_labels(tmp_path / "scene.usda", {"/Mug": label()}, flat)


def test_a_hard_link_to_the_scene_is_refused(write_stage, tmp_path):
    source = write_stage(METRES + MUG)
    os.link(source, tmp_path / "link.usda")
    with pytest.raises(OutputError, match="the stage is made of this layer"):
        write_labels(source, {"/Mug": label()}, tmp_path / "link.usda")


def test_scene_and_layer_move_together(write, tmp_path):
    write(MUG, {"/Mug": label()})
    moved = tmp_path.parent / f"{tmp_path.name}_moved"
    shutil.copytree(tmp_path, moved)
    shutil.rmtree(tmp_path)
    assert told(Usd.Stage.Open(str(moved / "labels.usda")), "/Mug")


def test_another_folder_and_another_working_directory(write_stage, tmp_path, monkeypatch):
    source = write_stage(METRES + MUG, "in/a b/scene.usda")
    (tmp_path / "out").mkdir()
    monkeypatch.chdir(tmp_path)
    write_labels(Path("in/a b/scene.usda"), {"/Mug": label()}, Path("out/labels.usda"))
    stage = Usd.Stage.Open("out/labels.usda")
    assert list(stage.GetRootLayer().subLayerPaths) == ["../in/a b/scene.usda"]
    assert source.exists()


def test_a_bare_layer_is_nothing_but_labels(write, tmp_path):
    _, _ = write(MUG, {"/Mug": label()}, is_bare=True)
    text = (tmp_path / "labels.usda").read_text()
    head, _, prims = text.partition("\n)\n\n")
    assert 'string content = "labels"' in head
    assert not {"subLayers", "metersPerUnit", "upAxis", "doc"} & set(head.split())
    assert prims.startswith('over "Mug"')
    stage = Usd.Stage.Open(str(tmp_path / "scene.usda"))
    stage.GetSessionLayer().subLayerPaths.append(str(tmp_path / "labels.usda"))
    assert ("UsdSemantics", "class", "Cup") in told(stage, "/Mug")


def test_a_package_can_be_labelled(write_stage, tmp_path):
    from pxr import UsdUtils  # noqa: PLC0415

    UsdUtils.CreateNewUsdzPackage(str(write_stage(METRES + MUG)), str(tmp_path / "scene.usdz"))
    write_labels(tmp_path / "scene.usdz", {"/Mug": label()}, tmp_path / "labels.usda")
    assert told(Usd.Stage.Open(str(tmp_path / "labels.usda")), "/Mug")


def test_no_layer_of_the_stage_is_overwritten(write_stage, tmp_path):
    write_stage(METRES + MUG, "base.usda")
    root = write_stage("(\n    subLayers = [@./base.usda@]\n)\n")
    for name in ("scene.usda", "base.usda"):
        with pytest.raises(OutputError, match="is made of this layer, which is never changed"):
            write_labels(root, {"/Mug": label()}, tmp_path / name)
    (tmp_path / "link.usda").symlink_to(tmp_path / "base.usda")
    with pytest.raises(OutputError, match="never changed"):
        write_labels(root, {"/Mug": label()}, tmp_path / "link.usda")


@pytest.mark.parametrize("name", ["labels.usdz", "labels.txt", "labels"])
def test_other_endings_are_refused(write_stage, tmp_path, name):
    with pytest.raises(OutputError, match=r"ends in one of \.usda"):
        write_labels(write_stage(METRES + MUG), {}, tmp_path / name)


# --- modes ---------------------------------------------------------------------------------------------

API = 'prepend apiSchemas = ["SemanticsLabelsAPI:class", "SemanticsLabelsAPI:room", "SemanticsAPI:old"]'
LABELLED = xform(
    "Mug",
    'token[] semantics:labels:class = ["banana"]',
    'token[] semantics:labels:room = ["kitchen"]',
    'string semantic:old:params:semanticType = "class"',
    'string semantic:old:params:semanticData = "banana"',
    cube("g"),
    meta=[API, 'kind = "component"'],
)
OLD = {
    ("UsdSemantics", "class", "banana"),
    ("UsdSemantics", "room", "kitchen"),
    ("Isaac", "class", "banana"),
}


def test_new_leaves_labelled_prims_alone(write):
    report, stage = write(LABELLED, {"/Mug": label()}, mode="new")
    assert told(stage, "/Mug") == OLD
    (entry,) = report.outcomes
    assert (entry.outcome, entry.reason) == ("kept", "has labels already: 'banana', 'kitchen'")


def test_overwrite_replaces_the_class_in_all_encodings(write):
    report, stage = write(LABELLED, {"/Mug": label(qcodes=())}, mode="overwrite")
    assert outcomes(report) == {"/Mug": "replaced"}
    assert told(stage, "/Mug") == {
        ("UsdSemantics", "class", "Cup"),
        ("UsdSemantics", "iri", f"{SOMA}Cup"),
        ("UsdSemantics", "room", "kitchen"),
    }
    assert lint_labels(stage) == []
    assert "SemanticsAPI:old" not in stage.GetPrimAtPath("/Mug").GetPrimTypeInfo().GetAppliedAPISchemas()


def test_overwrite_leaves_no_tag_of_multiverse(write):
    onto = prim("", "Onto", prim("", "_class_Banana", 'string rdf:conceptName = "Banana"', specifier="class"))
    tagged = xform("Mug", "rel semanticTag:semanticLabels = </Onto/_class_Banana>", cube("g"), apis=["SemanticTagAPI"])
    _, stage = write(onto + tagged, {"/Mug": label(qcodes=())}, mode="overwrite")
    assert {encoding for encoding, _, _ in told(stage, "/Mug")} == {"UsdSemantics"}
    assert lint_labels(stage) == []
    _, stage = write(onto + tagged, {"/Mug": label()}, mode="overwrite", encodings=ALL, name="again.usda")
    assert ("Multiverse", SOMA, "Cup") in told(stage, "/Mug")
    assert not any(value == "Banana" for _, _, value in told(stage, "/Mug"))


def test_overwrite_blocks_misspelt_classes_and_mends_types(write):
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
    report, stage = write(wrong, {"/Mug": label(qcodes=())}, mode="overwrite")
    assert outcomes(report) == {"/Mug": "replaced"}
    assert told(stage, "/Mug") == {("UsdSemantics", "class", "Cup"), ("UsdSemantics", "iri", f"{SOMA}Cup")}
    query = UsdSemantics.LabelsQuery("class", Usd.TimeCode.Default())
    assert list(query.ComputeUniqueDirectLabels(stage.GetPrimAtPath("/Mug"))) == ["Cup"]
    # What says a room stays, in whatever spelling.
    assert [note.message.split()[0] for note in lint_labels(stage)] == [
        "semantics:b:params:semanticType",
        "semantics:label:room",
    ]
    assert stage.GetPrimAtPath("/Mug").GetAttribute("semantics:label:class").GetTypeName() == "token[]"


def test_overwrite_beats_samples_over_time(write):
    moving = xform("Mug", 'token[] semantics:labels:class.timeSamples = { 1: ["pupa"], 5: ["butterfly"] }', cube("g"))
    _, stage = write(moving, {"/Mug": label()}, mode="overwrite")
    mug = stage.GetPrimAtPath("/Mug")
    assert [found.value for found in read_labels(mug, Usd.TimeCode(5)) if found.taxonomy == "class"] == ["Cup"]


def test_skip_adds_what_is_missing_where_the_class_agrees(write):
    agreeing = LABELLED.replace("banana", "coffee mug")
    report, stage = write(agreeing, {"/Mug": label(names=["mug"])}, mode="skip", encodings=("UsdSemantics", "Isaac"))
    assert outcomes(report) == {"/Mug": "completed"}
    assert told(stage, "/Mug") == {
        ("UsdSemantics", "class", "coffee mug"),
        ("UsdSemantics", "iri", f"{SOMA}Cup"),
        ("UsdSemantics", "room", "kitchen"),
        ("UsdSemantics", "wikidata_qcode", "Q81727"),
        ("Isaac", "class", "coffee mug"),
        ("Isaac", "iri", f"{SOMA}Cup"),
        ("Isaac", "qcode", "Q81727"),
    }


def test_skip_adds_nothing_to_labels_of_another_class(write):
    report, stage = write(LABELLED, {"/Mug": label()}, mode="skip")
    assert told(stage, "/Mug") == OLD
    assert report.outcomes[0].reason == "its labels say another class: 'banana'"


def test_skip_finds_all_there(write, tmp_path):
    write(MUG, {"/Mug": label()}, name="first.usda")
    report = write_labels(tmp_path / "first.usda", {"/Mug": label()}, tmp_path / "x.usda", LabelOptions(mode="skip"))
    assert outcomes(report) == {"/Mug": "kept"}


def test_an_instance_of_isaacs_that_is_taken_is_not_used(write):
    room = (
        'string semantic:Semantics:params:semanticType = "room"\nstring semantic:Semantics:params:semanticData = "bath"'
    )
    taken = xform("Mug", room, cube("g"), apis=["SemanticsAPI:Semantics"])
    _, stage = write(taken, {"/Mug": label()}, mode="overwrite", encodings=("Isaac",))
    assert {("Isaac", "room", "bath"), ("Isaac", "class", "Cup")} <= told(stage, "/Mug")


# --- prims that cannot carry labels --------------------------------------------------------------------

CHAIR = xform("Proto", xform("Seat", cube("g"), kind="subcomponent"))
COPIES = "".join(xform(name, meta=["instanceable = true", "references = </Proto>"]) for name in "AB")


def test_an_instance_root_takes_a_label_and_its_parts_are_reported(write):
    report, stage = write(CHAIR + COPIES, {"/A": label("Chair"), "/B/Seat": label("Seat")})
    assert outcomes(report) == {"/A": "written", "/B/Seat": "left out"}
    assert report.outcomes[1].reason == "it is inside the instance /B; --de-instance breaks that up"
    assert stage.GetPrimAtPath("/B").IsInstance()
    assert ("UsdSemantics", "class", "Chair") in told(stage, "/A")


def test_de_instancing_breaks_up_that_instance_only(write):
    report, stage = write(CHAIR + COPIES, {"/B/Seat": label("Seat")}, de_instances=True)
    assert report.de_instanced == ("/B",)
    assert not stage.GetPrimAtPath("/B").IsInstance()
    assert stage.GetPrimAtPath("/A").IsInstance()
    assert ("UsdSemantics", "class", "Seat") in told(stage, "/B/Seat")
    assert told(stage, "/A/Seat") == set()


def test_nested_instances_are_broken_up_all_the_way(write):
    nested = xform("Set", xform("Chair", meta=["instanceable = true", "references = </Proto>"]))
    outer = xform("Room", meta=["instanceable = true", "references = </Set>"])
    report, stage = write(CHAIR + nested + outer, {"/Room/Chair/Seat": label("Seat")}, de_instances=True)
    assert report.de_instanced == ("/Room", "/Room/Chair")
    assert ("UsdSemantics", "class", "Seat") in told(stage, "/Room/Chair/Seat")


@pytest.mark.parametrize(
    ("text", "path", "reason"),
    [
        (MUG, "/Nothing", "there is no such prim on the stage"),
        (MUG, "not a path", "there is no such prim on the stage"),
        (MUG, "/Mug.size", "there is no such prim on the stage"),
        (MUG, "", "there is no such prim on the stage"),
        (MUG, "/Mug[3]", "a copy of a point instancer is no prim"),
        (xform("Mug", cube("g"), meta=["active = false"]), "/Mug", "it is inactive"),
        (prim("Xform", "Mug", specifier="over"), "/Mug", "it is only an over, nothing defines it"),
        (prim("Xform", "Mug", specifier="class"), "/Mug", "it is abstract: what inherits from it would be labelled"),
    ],
)
def test_prims_that_carry_no_label(write, text, path, reason):
    report, _ = write(text, {path: label()})
    assert [(entry.outcome, entry.reason) for entry in report.outcomes] == [("left out", reason)]


def test_prims_of_variants_and_of_other_alphabets(write):
    variant = (
        'def Xform "Mug" (\n    variants = { string kind = "a" }\n    prepend variantSets = "kind"\n)\n{\n'
        '    variantSet "kind" = {\n        "a" {\n def Cube "Küche" {\n}\n}\n        "b" {\n        }\n    }\n}\n'
    )
    _, stage = write(variant, {"/Mug/Küche": label("Kitchen")})
    assert ("UsdSemantics", "class", "Kitchen") in told(stage, "/Mug/Küche")
    stage.GetPrimAtPath("/Mug").GetVariantSet("kind").SetVariantSelection("b")
    assert not stage.GetPrimAtPath("/Mug/Küche").IsDefined()


def test_class_prims_of_one_name_and_of_names_in_use(write):
    other = "http://other.example/SOMA.owl#"
    labels = {"/A": label("Cup"), "/B": label("Cup", namespace=other), "/C": label("Tasse groß", namespace=other)}
    text = "".join(component(name, cube("g")) for name in "ABC") + xform("SOMA", cube("g"))
    _, stage = write(text, labels, encodings=("Multiverse",))
    assert told(stage, "/A") == {("Multiverse", SOMA, "Cup")}
    assert told(stage, "/B") == {("Multiverse", other, "Cup")}
    assert told(stage, "/C") == {("Multiverse", other, "Tasse groß")}
    assert stage.GetPrimAtPath("/SOMA").GetTypeName() == "Xform"
    assert lint_labels(stage) == []


def test_class_prims_that_the_stage_has_are_used(write):
    lines = ['string rdf:conceptName = "Cup"', f'string rdf:namespace = "{SOMA}"']
    onto = prim("", "SOMA", prim("", "_class_Cup", *lines, specifier="class"))
    _, stage = write(onto + MUG, {"/Mug": label()}, encodings=("Multiverse",))
    assert stage.GetRootLayer().GetPrimAtPath("/SOMA") is None
    assert told(stage, "/Mug") == {("Multiverse", SOMA, "Cup")}


# --- real scenes, and the validators of OpenUSD --------------------------------------------------------

SCENES = [
    "aws_robomaker/small_house.usdc",
    "dlr_kitchen/tagged_flattened.usda",
    "awkward/legacy_labels/cube_cylinder.usda",
    "awkward/float_metres_per_unit/suzanne.usdc",
    "awkward/point_instancers/PointInstancer_Grid_70k.usda",
]


def complaints(path):
    """Return what OpenUSD's validators say of a stage, without the places, which name the layers."""
    from pxr import UsdValidation  # noqa: PLC0415

    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    stage = Usd.Stage.Open(str(path))
    return {(error.GetName(), error.GetMessage().replace(str(path), "")) for error in context.Validate(stage)}


@pytest.mark.parametrize("name", ["demo", *SCENES])
def test_real_scenes_open_with_their_labels(name, tmp_path):
    source = demo_scene() if name == "demo" else shared_file(f"scenes/{name}")
    digest = hashlib.sha256(source.read_bytes()).hexdigest()
    scene = read_scene(source)
    labels = {obj.prim_path: label(above=("Crockery",)) for obj in scene.objects}
    target = tmp_path / "labels.usda"
    report = write_labels(source, labels, target, LabelOptions(ALL, "overwrite", de_instances=True))
    assert hashlib.sha256(source.read_bytes()).hexdigest() == digest
    assert "left out" not in report.counts
    again = read_scene(target)
    assert [obj.prim_path for obj in again.objects] == [obj.prim_path for obj in scene.objects]
    assert [obj.box for obj in again.objects] == [obj.box for obj in scene.objects]
    for obj in again.objects:
        assert {found.iri for found in obj.labels.own if found.iri and found.strength == "label"} == {f"{SOMA}Cup"}
    assert not [note for note in again.diagnostics if note.code == "label"]


@pytest.mark.skipif(Usd.GetVersion() < (0, 25, 2), reason="usd-core has validators from 25.02 on")
@pytest.mark.parametrize("name", ["demo", "awkward/legacy_labels/cube_cylinder.usda"])
def test_openusds_validators_find_nothing_new(name, tmp_path):
    source = demo_scene() if name == "demo" else shared_file(f"scenes/{name}")
    labels = {obj.prim_path: label() for obj in read_scene(source).objects}
    target = Path(os.path.realpath(tmp_path)) / "labels.usda"
    write_labels(source, labels, target, LabelOptions(ALL, "overwrite"))
    assert {found for found, _ in complaints(target)} <= {found for found, _ in complaints(source)}


# --- whatever the words --------------------------------------------------------------------------------

WORD = st.text(
    st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Zs", "Zl", "Zp", "Cn", "Co", "Cf"]), min_size=1
)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(token=WORD, above=st.lists(WORD, max_size=3, unique=True), mode=st.sampled_from(["new", "overwrite", "skip"]))
def test_what_is_written_is_what_is_read(write_stage, tmp_path, token, above, mode):
    source = write_stage(METRES + MUG)
    said = ClassLabel(token, SOMA + token, token, SOMA, tuple(above), ("Q1",), "", frozenset())
    target = tmp_path / "labels.usda"
    write_labels(source, {"/Mug": said}, target, LabelOptions(ALL, mode))
    stage = Usd.Stage.Open(str(target))
    stage.Reload()
    found = told(stage, "/Mug")
    assert {value for encoding, taxonomy, value in found if (encoding, taxonomy) == ("UsdSemantics", "class")} == {
        *above,
        token,
    }
    assert ("Isaac", "class", token) in found
    assert ("Multiverse", SOMA, token) in found
