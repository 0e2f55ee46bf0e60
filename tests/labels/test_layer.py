"""Label layers: their text, stage metadata, and the files that may be written."""

import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pxr import Usd, UsdGeom, UsdSemantics, UsdUtils

from tests.labels.conftest import ENCODINGS, MUG, SOMA, class_label, labels_at, outcomes
from tests.scene.usda import METRES, header
from usd2kg.errors import OutputError
from usd2kg.labels import LABEL_MODES, ClassLabel, LabelOptions, write_labels
from usd2kg.scene.label_lint import lint_labels


def test_writes_a_root_layer_over_the_scene(write, tmp_path):
    report, _ = write(MUG, {"/Mug": class_label()})
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


def test_openusd_reads_direct_and_inherited_labels(write):
    _, stage = write(MUG, {"/Mug": class_label(ancestors=("Crockery",))})
    query = UsdSemantics.LabelsQuery("class", Usd.TimeCode.Default())
    mug, mesh = stage.GetPrimAtPath("/Mug"), stage.GetPrimAtPath("/Mug/g")
    assert mug.HasAPI(UsdSemantics.LabelsAPI, "class")
    assert list(UsdSemantics.LabelsAPI(mug, "class").GetLabelsAttr().Get()) == ["Crockery", "Cup"]
    assert sorted(query.ComputeUniqueInheritedLabels(mesh)) == ["Crockery", "Cup"]
    assert not query.HasDirectLabel(mesh, "Cup")


@pytest.mark.parametrize("ending", ["usda", "usdc", "usd"])
def test_writes_all_encodings_in_all_formats(write, ending):
    _, stage = write(MUG, {"/Mug": class_label(ancestors=("Crockery",))}, f"labels.{ending}", encodings=ENCODINGS)
    assert labels_at(stage, "/Mug") == {
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
    assert stage.GetPrimAtPath("/SOMA/_class_Cup").GetAttribute("rdf:definition").Get() == "A Cup."
    assert [found.GetPath() for found in stage.Traverse()] == ["/Mug", "/Mug/g", "/SOMA"]


WORD = st.text(
    st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Zs", "Zl", "Zp", "Cn", "Co", "Cf"]), min_size=1
)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(token=WORD, ancestors=st.lists(WORD, max_size=3, unique=True), mode=st.sampled_from(LABEL_MODES))
def test_reads_back_any_class_name(write_stage, tmp_path, token, ancestors, mode):
    source = write_stage(METRES + MUG)
    label = ClassLabel(token, SOMA + token, token, SOMA, tuple(ancestors), ("Q1",))
    target = tmp_path / "labels.usda"
    write_labels(source, {"/Mug": label}, target, LabelOptions(ENCODINGS, mode))
    stage = Usd.Stage.Open(str(target))
    stage.Reload()
    found = labels_at(stage, "/Mug")
    classes = {value for encoding, taxonomy, value in found if (encoding, taxonomy) == ("UsdSemantics", "class")}
    assert classes == {*ancestors, token}
    assert {("Isaac", "class", token), ("Multiverse", SOMA, token)} <= found


def test_copies_stage_metadata(write):
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
    _, stage = write(MUG, {"/Mug": class_label()}, layer=layer, provenance={"ontology": "http://x"})
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


def test_a_bare_layer_contains_only_labels(write, tmp_path):
    write(MUG, {"/Mug": class_label()}, is_bare=True)
    text = (tmp_path / "labels.usda").read_text()
    head, _, prims = text.partition("\n)\n\n")
    assert 'string content = "labels"' in head
    assert not {"subLayers", "metersPerUnit", "upAxis", "doc"} & set(head.split())
    assert prims.startswith('over "Mug"')
    stage = Usd.Stage.Open(str(tmp_path / "scene.usda"))
    stage.GetSessionLayer().subLayerPaths.append(str(tmp_path / "labels.usda"))
    assert ("UsdSemantics", "class", "Cup") in labels_at(stage, "/Mug")


def test_refers_to_the_scene_relative_to_the_output_folder(write_stage, tmp_path, monkeypatch):
    write_stage(METRES + MUG, "in/a b/scene.usda")
    (tmp_path / "out").mkdir()
    monkeypatch.chdir(tmp_path)
    write_labels(Path("in/a b/scene.usda"), {"/Mug": class_label()}, Path("out/labels.usda"))
    stage = Usd.Stage.Open("out/labels.usda")
    assert list(stage.GetRootLayer().subLayerPaths) == ["../in/a b/scene.usda"]


def test_labels_a_usdz_package(write_stage, tmp_path):
    UsdUtils.CreateNewUsdzPackage(str(write_stage(METRES + MUG)), str(tmp_path / "scene.usdz"))
    write_labels(tmp_path / "scene.usdz", {"/Mug": class_label()}, tmp_path / "labels.usda")
    assert labels_at(Usd.Stage.Open(str(tmp_path / "labels.usda")), "/Mug")


@pytest.mark.parametrize("name", ["labels.usda", "labels.usdc"])
def test_replaces_a_label_layer(write, name):
    write(MUG, {"/Mug": class_label()}, name)
    _, stage = write(MUG, {"/Mug": class_label("Mug")}, name)
    values = {value for _, taxonomy, value in labels_at(stage, "/Mug") if taxonomy == "class"}
    assert values == {"Mug"}


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
def test_does_not_replace_other_files(write_stage, tmp_path, other):
    source = write_stage(METRES + SWITCH)
    path = tmp_path / "other.usda"
    path.write_text(other)
    with pytest.raises(OutputError, match=r"other\.usda: exists and is not a label layer of usd2kg"):
        write_labels(source, {"/World": class_label()}, path)
    assert path.read_text() == other


def test_does_not_replace_a_flattened_labelled_stage(write, tmp_path):
    _, stage = write(MUG, {"/Mug": class_label()})
    flat = tmp_path / "flat.usda"
    stage.Export(str(flat))
    with pytest.raises(OutputError, match="not a label layer"):
        write_labels(tmp_path / "scene.usda", {"/Mug": class_label()}, flat)


def test_does_not_replace_a_layer_of_the_stage(write_stage, tmp_path):
    base = write_stage(METRES + MUG, "base.usda")
    root = write_stage("(\n    subLayers = [@./base.usda@]\n)\n")
    (tmp_path / "symbolic.usda").symlink_to(base)
    os.link(base, tmp_path / "hard.usda")
    for name in ("scene.usda", "base.usda", "symbolic.usda", "hard.usda"):
        with pytest.raises(OutputError, match="is a layer of the stage, which is never modified"):
            write_labels(root, {"/Mug": class_label()}, tmp_path / name)


@pytest.mark.parametrize("name", ["labels.usdz", "labels.txt", "labels"])
def test_rejects_other_file_name_endings(write_stage, tmp_path, name):
    with pytest.raises(OutputError, match=r"name ending in one of \.usda"):
        write_labels(write_stage(METRES + MUG), {}, tmp_path / name)
