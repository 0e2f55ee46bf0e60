"""References to the same specs are read once, with the same result as if each was read by itself."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pxr import Sdf, Usd

from tests.scene.usda import METRES, header
from usd2kg.scene import equal_references, read_scene, traversal
from usd2kg.scene.equal_references import content_key, may_share_contents

ASSET = """
def Xform "Chair" (
    kind = "component"
    assetInfo = { string name = "oak chair" }
    variants = { string color = "red" }
    prepend variantSets = "color"
)
{
    variantSet "color" = {
        "red" { over "seat" { color3f[] primvars:displayColor = [(1, 0, 0)] } }
        "blue" {
            over "seat" {
                color3f[] primvars:displayColor = [(0, 0, 1)]
                float3[] extent = [(0, 0, 0), (1, 1, 3)]
            }
        }
    }
    def Scope "Looks" { def Material "Oak" { } }
    def Mesh "seat" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        rel material:binding = </Chair/Looks/Oak>
        float3[] extent = [(0, 0, 0), (1, 1, 0.5)]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0.5), (0, 1, 0.5)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
    }
    def Xform "back"
    {
        double3 xformOp:translate = (0, 1, 0)
        double3 xformOp:translate.timeSamples = { 0: (0, 1, 0), 10: (0, 2, 0) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Cube "bar" { double size = 0.3 }
    }
    def Camera "eye" { }
}
def Xform "Broken" (references = @./no_such_file.usda@)
{
}
class Xform "_Rule" { over "seat" { color3f[] primvars:displayColor = [(0, 1, 0)] } }
"""
OVERRIDES = {
    "none": "",
    "placed": "double3 xformOp:translate = (5, 0, 0)\nuniform token[] xformOpOrder = ['xformOp:translate']",
    "turned": "double xformOp:rotateZ = 30\nuniform token[] xformOpOrder = ['xformOp:rotateZ']",
    "animated": "double xformOp:rotateZ.timeSamples = { 0: 10, 10: 40 }\n"
    "uniform token[] xformOpOrder = ['xformOp:rotateZ']",
    "hidden": 'uniform token purpose = "guide"',
    "invisible": 'token visibility = "invisible"',
    "colored part": "over 'seat' { color3f[] primvars:displayColor = [(0, 0, 0)] }",
    "moved part": "over 'back' { double3 xformOp:translate = (0, 3, 0) }",
    "new part": 'def Cube "leg" { double size = 0.2 }',
    "inactive part": "over 'back' (active = false) { }",
    "reordered": "reorder nameChildren = ['back', 'seat']",
}
METADATA = {
    "none": "",
    "variant": 'variants = { string color = "blue" }',
    "class": "inherits = </_Rule>",
    "kind": 'kind = "subcomponent"',
    "named": 'displayName = "my chair"',
}
OFFSETS = ("", " (offset = 5)", " (scale = 2)")


def placed(name, override="none", metadata="none", offset="", target="@asset.usda@</Chair>"):
    return f'def "{name}" (references = {target}{offset} \n{METADATA[metadata]}) {{ {OVERRIDES[override]} }}\n'


def on_lines(text):
    """Return a text with one statement a line, which the format requires."""
    return text.replace("{ ", "{\n").replace(" }", "\n}").replace("} ", "}\n")


def stage_of(text, layer=METRES, asset=ASSET):
    """Return a stage that refers to the asset."""
    library = Sdf.Layer.CreateAnonymous("asset.usda")
    assert library.ImportFromString("#usda 1.0\n" + on_lines(asset))
    root = Sdf.Layer.CreateAnonymous("root.usda")
    classes = 'class Xform "_Rule" { over "seat" { double3 xformOp:translate = (0, 0, 9) } }\n'
    assert root.ImportFromString(
        "#usda 1.0\n" + layer + on_lines(text.replace("asset.usda", library.identifier) + classes)
    )
    stage = Usd.Stage.Open(root)
    return stage, library


def is_read_alike(stage, monkeypatch):
    """Return whether a stage reads the same with and without sharing."""
    shared = read_scene(stage)
    with monkeypatch.context() as patch:
        patch.setattr(equal_references, "may_share_contents", lambda stage: False)
        plain = read_scene(stage)
    pieces = [
        {path: [(p.points.tolist(), p.triangles.tolist(), p.matrix.tolist()) for p in surface.pieces]
         for path, surface in scene.surfaces.items()}
        for scene in (shared, plain)
    ]  # fmt: skip
    return replace(shared, surfaces={}) == replace(plain, surfaces={}) and pieces[0] == pieces[1]


copies = st.lists(
    st.tuples(st.sampled_from(sorted(OVERRIDES)), st.sampled_from(sorted(METADATA)), st.sampled_from(OFFSETS)),
    min_size=2,
    max_size=6,
)


@settings(max_examples=60, deadline=None)
@given(copies, st.sampled_from(["Z", "Y"]), st.booleans())
def test_any_overrides_are_read_as_without_sharing(copies, up_axis, is_group_turned):
    # Two plain copies come first, so that something is shared.
    entries = [("none", "none", ""), ("placed", "none", ""), *copies]
    text = "".join(placed(f"chair_{at}", *entry) for at, entry in enumerate(entries))
    group = OVERRIDES["turned"] if is_group_turned else ""
    stage, _library = stage_of(f'def Xform "Room" {{ {group}\n{text} }}\n', header(metersPerUnit=1, upAxis=up_axis))
    with pytest.MonkeyPatch.context() as monkeypatch:
        assert is_read_alike(stage, monkeypatch)


def records_of(stage, monkeypatch):
    """Return name → whether the contents of a prim were copied, for the prims of a stage."""
    found = {}
    copy = traversal._Outliner._copy_known_contents

    def watched(self, root):
        found[root.name] = copy(self, root)
        return found[root.name]

    monkeypatch.setattr(traversal._Outliner, "_copy_known_contents", watched)
    read_scene(stage)
    return found


@pytest.mark.parametrize(
    ("override", "metadata", "offset", "expected"),
    [
        ("none", "none", "", True),
        ("turned", "kind", "", True),
        ("animated", "named", "", True),
        ("colored part", "none", "", False),
        ("moved part", "none", "", False),
        ("new part", "none", "", False),
        ("inactive part", "none", "", False),
        ("reordered", "none", "", False),
        ("hidden", "none", "", False),
        ("none", "variant", "", False),
        ("none", "class", "", False),
        ("none", "none", " (offset = 5)", False),
        ("none", "none", " (scale = 2)", False),
    ],
)
def test_contents_are_copied_only_if_nothing_overrides_them(override, metadata, offset, expected, monkeypatch):
    stage, _library = stage_of(placed("first") + placed("second", override, metadata, offset))
    assert records_of(stage, monkeypatch)["second"] is expected


def test_overrides_in_the_session_layer_count(monkeypatch):
    stage, _library = stage_of(placed("first") + placed("second"))
    stage.SetEditTarget(stage.GetSessionLayer())
    stage.GetPrimAtPath("/second/seat").GetAttribute("primvars:displayColor").Set([(0.5, 0.5, 0.5)])
    assert is_read_alike(stage, monkeypatch)
    assert not records_of(stage, monkeypatch)["second"]


def test_overrides_in_a_layer_between_count(monkeypatch):
    inner = 'def Xform "Flat" {\n' + placed("first") + placed("second") + "}\n"
    outer = (
        'def Xform "One" (references = </Flat>) { over "second" { over "seat" { double3 xformOp:translate = (1, 1, 1)\n'
        'uniform token[] xformOpOrder = ["xformOp:translate"] } } }\ndef Xform "Two" (references = </Flat>) { }\n'
    )
    stage, _library = stage_of(inner + outer)
    assert is_read_alike(stage, monkeypatch)


def test_contents_that_inherit_a_class_are_read_by_themselves(monkeypatch):
    asset = ASSET.replace('def Xform "back"', 'def Xform "back" (inherits = </_Rule>)')
    stage, _library = stage_of(placed("first") + placed("second"), asset=asset)
    assert not records_of(stage, monkeypatch)["second"]


@pytest.mark.parametrize("is_above", [False, True])
def test_clips_at_or_above_a_reference_prevent_sharing(is_above, monkeypatch):
    clips = 'clips = { dictionary default = { string primPath = "/x" } }\n'
    second = placed("second") if is_above else placed("second").replace("references", clips + "references")
    room = f'def Xform "Room" ({clips if is_above else ""}) {{ {second} }}\n'
    stage, _library = stage_of(placed("first") + room)
    assert not records_of(stage, monkeypatch)["second"]


def test_masks_and_unloaded_payloads_prevent_sharing():
    stage, _library = stage_of(placed("first"))
    assert may_share_contents(stage)
    masked = Usd.Stage.OpenMasked(stage.GetRootLayer(), Usd.StagePopulationMask(["/first"]))
    assert not may_share_contents(masked)
    assert not may_share_contents(Usd.Stage.Open(stage.GetRootLayer(), Usd.Stage.LoadNone))


def test_expression_variables_prevent_sharing():
    stage, _library = stage_of(placed("first"))
    stage.GetRootLayer().expressionVariables = {"ROOM": "kitchen"}
    assert not may_share_contents(stage)


def test_the_key_holds_what_composes_the_contents():
    stage, library = stage_of(placed("first") + placed("second", offset=" (offset = 5)"))
    first, second = (content_key(stage.GetPrimAtPath(path)) for path in ("/first", "/second"))
    assert [entry[:2] for entry in first][1:] == [
        (library.identifier, "/Chair"),
        (library.identifier, "/Chair{color=red}"),
    ]
    assert [entry[2] for entry in first] == [0, 0, 0]
    assert [entry[2] for entry in second] == [0, 5, 5]
