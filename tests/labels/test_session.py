"""Labels in the session layer of an open stage: what changes, what stays, and that they go without a trace."""

import pytest
from pxr import Sdf, Tf, Usd, UsdSemantics

from tests.labels.conftest import MUG, SOMA, labels_at, outcomes
from tests.scene.usda import METRES, component, cube
from usd2kg.errors import OutputError
from usd2kg.labels import LabelOptions, PrimClass, PrimClasses, label_session, parse_encodings, remove_session_labels

TABLE = component("Table", cube("Top"))


@pytest.fixture
def stage(write_stage) -> Usd.Stage:
    return Usd.Stage.Open(str(write_stage(METRES + MUG + TABLE)))


def classes(**names) -> PrimClasses:
    """Return SOMA classes of root prims, with confidence 0.5."""
    entries = (
        PrimClass(f"/{prim}", SOMA + name if name else None, 0.5, "grounded", False) for prim, name in names.items()
    )
    return PrimClasses("test", tuple(entries))


def test_labels_are_in_the_session_only(stage, home_tbox):
    root = stage.GetRootLayer()
    before, edit_target = root.ExportToString(), stage.GetEditTarget().GetLayer()
    report = label_session(stage, classes(Mug="Cup", Table=None), home_tbox)
    assert outcomes(report) == {"/Mug": "written", "/Table": "left out"}
    assert list(UsdSemantics.LabelsAPI(stage.GetPrimAtPath("/Mug"), "class").GetLabelsAttr().Get()) == ["Cup"]
    assert (root.ExportToString(), root.dirty, stage.GetEditTarget().GetLayer()) == (before, False, edit_target)


def test_removing_leaves_no_trace(stage, home_tbox):
    session = stage.GetSessionLayer()
    Sdf.CreatePrimInLayer(session, "/Table").active = False
    before, composed = session.ExportToString(), stage.Flatten().ExportToString()
    label_session(stage, classes(Mug="Cup"), home_tbox)
    assert remove_session_labels(stage)
    assert (session.ExportToString(), stage.Flatten().ExportToString()) == (before, composed)
    assert not remove_session_labels(stage)


def test_labelling_again_replaces_labels(stage, home_tbox):
    label_session(stage, classes(Mug="Cup", Table="Table"), home_tbox)
    label_session(stage, classes(Mug="Bowl"), home_tbox)
    assert {value for _, taxonomy, value in labels_at(stage, "/Mug") if taxonomy == "class"} == {"Bowl"}
    assert labels_at(stage, "/Table") == set()
    assert len(stage.GetSessionLayer().subLayerPaths) == 1


def test_existing_labels_stay_unless_overwritten(stage, home_tbox):
    UsdSemantics.LabelsAPI.Apply(stage.GetPrimAtPath("/Mug"), "class").CreateLabelsAttr(["beaker"])
    assert outcomes(label_session(stage, classes(Mug="Cup"), home_tbox)) == {"/Mug": "kept"}
    options = LabelOptions(("UsdSemantics", "Isaac"), "overwrite")
    assert outcomes(label_session(stage, classes(Mug="Cup"), home_tbox, options=options)) == {"/Mug": "replaced"}
    assert {("UsdSemantics", "class", "Cup"), ("Isaac", "class", "Cup")} <= labels_at(stage, "/Mug")
    remove_session_labels(stage)
    assert labels_at(stage, "/Mug") == {("UsdSemantics", "class", "beaker")}


def test_only_labelled_prims_are_composed_again(stage, home_tbox):
    resynced = []
    listener = Tf.Notice.Register(
        Usd.Notice.ObjectsChanged, lambda notice, _: resynced.extend(map(str, notice.GetResyncedPaths())), stage
    )
    label_session(stage, classes(Mug="Cup"), home_tbox)
    remove_session_labels(stage)
    listener.Revoke()
    assert set(resynced) == {"/Mug"}


def test_a_stage_without_session_layer_is_refused(write_stage, home_tbox):
    stage = Usd.Stage.Open(Sdf.Layer.FindOrOpen(str(write_stage(METRES + MUG))), sessionLayer=None)
    with pytest.raises(OutputError, match="opened without a session layer"):
        label_session(stage, classes(Mug="Cup"), home_tbox)


def test_names_of_encodings():
    assert parse_encodings("isaac,semantics, isaac", "x") == ("Isaac", "UsdSemantics")
    with pytest.raises(OutputError, match=r"/exts/x rdf: expected a comma-separated list of semantics, isaac, multiv"):
        parse_encodings("rdf", "/exts/x")
