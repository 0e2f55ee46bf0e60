"""Opening stages: unreadable files, missing assets, units."""

import hashlib
import subprocess
import sys
from dataclasses import replace

import pytest
from pxr import Sdf, Usd, UsdGeom, UsdUtils, Vt

from tests.scene.usda import METRES, component, cube, header, move, prim, xform
from usd2kg.errors import SceneError
from usd2kg.scene import Diagnostic, ReadOptions, read_scene

CUBE = xform("World", cube("box"))


def refusal(path):
    """Return the error message about `path` after the path itself, and check that it is one line."""
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert "\n" not in message
    return message.removeprefix(f"{path}: ")


def write_crate(path):
    """Write a binary stage with one mesh and return its bytes."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    mesh = UsdGeom.Mesh.Define(stage, "/World/Mesh")
    mesh.CreatePointsAttr([(float(i), float(i % 7), 0.5) for i in range(200)])
    stage.Save()
    return path.read_bytes()


# --- refused files ---------------------------------------------------------------------------------


def test_missing_file_is_refused(tmp_path):
    assert refusal(tmp_path / "nope.glb").startswith("no such file; expected a scene (.usd, .usda, .usdc, .usdz, .glb,")


def test_folder_is_refused(tmp_path):
    folder = tmp_path / "kitchen.usd"
    folder.mkdir()
    assert refusal(folder) == "is a folder without OBJ files, expected a USD stage; name the root layer inside it"


def test_empty_file_is_refused(tmp_path):
    path = tmp_path / "empty.usda"
    path.touch()
    assert refusal(path) == "the file is empty, expected a USD stage; export it again"


@pytest.mark.parametrize(("name", "ending"), [("scene.txt", "'.txt'"), ("scene.fbx", "'.fbx'"), ("scene", "missing")])
def test_unknown_suffixes_are_refused(tmp_path, name, ending):
    path = tmp_path / name
    path.write_text("#usda 1.0\n" + CUBE)
    message = refusal(path)
    assert message.startswith("not a USD file (ending ")
    assert ending in message
    assert message.endswith("convert the scene to USD first")


@pytest.mark.parametrize("name", ["a.usd", "a.usda", "a.usdc", "a.usdz"])
def test_text_that_is_not_a_layer_is_refused(tmp_path, name, capfd):
    path = tmp_path / name
    path.write_text("A kitchen with a table.\n")
    message = refusal(path)
    assert message.startswith("OpenUSD cannot read this layer (")
    assert message.endswith("; export it again")
    assert capfd.readouterr() == ("", "")


def test_syntax_error_is_located(write_stage):
    # Line 1 is the magic line, line 2 opens the prim, line 3 is the one that is wrong.
    message = refusal(write_stage('def Xform "World" {\n    float[][] wrong = 1\n}\n'))
    assert ":3:" in message
    assert "wrong" in message


def test_latin1_layer_is_refused(tmp_path):
    path = tmp_path / "umlaut.usda"
    path.write_bytes('#usda 1.0\ndef Xform "Küche" {}\n'.encode("latin-1"))
    assert refusal(path).startswith("OpenUSD cannot read this layer")


@pytest.mark.parametrize("keep", [8, 40, 0.5, 0.95, -1])
def test_truncated_crate_is_refused(tmp_path, keep, capfd):
    whole = write_crate(tmp_path / "whole.usdc")
    end = int(keep * len(whole)) if isinstance(keep, float) else keep
    cut = tmp_path / "cut.usdc"
    cut.write_bytes(whole[:end])
    assert "OpenUSD cannot read this layer (" in refusal(cut)
    assert capfd.readouterr() == ("", "")
    assert [obj.name for obj in read_scene(tmp_path / "whole.usdc").objects] == ["World"]  # near miss: uncut it reads


@pytest.mark.parametrize("start", [0, 16])
def test_crate_with_flipped_bytes_is_refused(tmp_path, start):
    # A crate starts with its magic (8 bytes), its version (8) and the place of its table of contents (8).
    data = bytearray(write_crate(tmp_path / "whole.usdc"))
    data[start : start + 8] = bytes(255 - value for value in data[start : start + 8])
    path = tmp_path / "flipped.usdc"
    path.write_bytes(data)
    assert refusal(path).startswith("OpenUSD cannot read this layer (")


def test_stage_without_prims_is_refused_with_what_was_found(write_stage):
    message = refusal(write_stage(METRES))
    assert message.startswith("no object among 0 prims")
    assert "expected prims with geometry" in message


def test_stage_without_geometry_names_the_commonest_reasons(write_stage):
    path = write_stage(METRES + xform("World", prim("Camera", "A"), prim("Camera", "B"), prim("SphereLight", "L")))
    assert "4 prims (2 camera, " in refusal(path)


# --- missing assets ---------------------------------------------------------------------------------


@pytest.mark.parametrize("arc", ["references", "payload"])
def test_unresolved_arc_keeps_its_object_and_is_reported_once(read, write_stage, capfd, arc):
    chair = xform("Chair", move(1, 2, 0), meta=[f"{arc} = @chair.usd@"])
    scene = read(xform("World", chair, cube("box")))
    obj = scene.by_path["/World/Chair"]
    assert (obj.position, obj.box) == ((1, 2, 0), None)
    notes = [note for note in scene.diagnostics if note.code == "composition"]
    assert [note.prim_path for note in notes] == ["/World/Chair"]
    assert notes[0].layer == scene.source
    assert notes[0].message.startswith(f"Could not open asset @chair.usd@ for {arc.removesuffix('s')} introduced by @")
    assert not [note for note in scene.diagnostics if note.code == "openusd"]
    assert capfd.readouterr() == ("", "")


def test_position_of_a_prim_whose_asset_and_type_are_missing_is_kept(read):
    # `def "Chair"` leaves the type to the asset; without one OpenUSD does not look at its transform.
    chair = prim("", "Chair", move(1, 2, 0), meta=["references = @chair.usd@"])
    assert read(xform("World", chair, cube("box"))).by_path["/World/Chair"].position == (1, 2, 0)


def test_unresolved_arc_of_another_layer_names_that_layer(read, write_stage):
    sub = write_stage(xform("World", prim("Xform", "Chair", meta=["references = @chair.usd@"])), "sub.usda")
    scene = read(xform("World", cube("box")), layer="(\n    metersPerUnit = 1\n    subLayers = [@./sub.usda@]\n)\n")
    note = next(note for note in scene.diagnostics if note.code == "composition")
    assert note.prim_path == "/World/Chair"
    assert note.layer == str(sub)


def test_missing_prim_of_an_existing_layer_keeps_its_object(read, write_stage):
    write_stage(xform("Other"), "asset.usda")
    scene = read(xform("World", prim("", "Cup", meta=["references = @asset.usda@</Cup>"]), cube("box")))
    assert "/World/Cup" in scene.by_path
    assert "/World/Cup" in {note.prim_path for note in scene.diagnostics}


def test_missing_sublayer_is_reported_with_the_root_layer(read):
    scene = read(CUBE, layer="(\n    metersPerUnit = 1\n    subLayers = [@gone.usda@]\n)\n")
    assert [obj.prim_path for obj in scene.objects] == ["/World/box"]
    note = next(note for note in scene.diagnostics if "gone.usda" in note.message)
    assert (note.code, note.layer) == ("composition", scene.source)


def test_every_instance_of_an_asset_with_a_missing_payload_stays(read, write_stage):
    asset = '(\n    defaultPrim = "Lamp"\n)\n' + xform("Lamp", xform("geo", meta=["payload = @nope.usd@"]))
    write_stage(asset, "lamp.usda")
    lamps = [prim("", name, meta=["references = @lamp.usda@", "instanceable = true"]) for name in ("L1", "L2", "L3")]
    scene = read(xform("World", *lamps, cube("box")))
    assert [obj.name for obj in scene.objects] == ["L1", "L2", "L3", "box"]


def test_resolved_stage_has_no_diagnostics(read):
    assert read(CUBE).diagnostics == ()


def test_transform_that_openusd_rejects_is_a_diagnostic(read, capfd):
    # USD allows any token in xformOpOrder; asking for the transform then raises inside OpenUSD.
    broken = xform("Broken", 'uniform token[] xformOpOrder = ["xformOp:nope", "bad"]', cube("box"))
    scene = read(xform("World", broken, cube("other")))
    assert [obj.name for obj in scene.objects] == ["Broken", "other"]
    assert "/World/Broken" in {note.prim_path for note in scene.diagnostics}
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    "lines",
    [
        ["int[] protoIndices = [0, 7]", "point3f[] positions = [(0, 0, 0), (1, 0, 0)]"],
        ["int[] protoIndices = [0, 0, 0]", "point3f[] positions = [(0, 0, 0)]"],
        ["point3f[] positions = [(0, 0, 0)]"],
    ],
    ids=["index out of range", "too few positions", "no indices"],
)
def test_broken_point_instancer_is_a_diagnostic_and_prints_nothing(read, capfd, lines):
    instancer = prim("PointInstancer", "Grass", *lines, "rel prototypes = [</World/Grass/Blade>]", cube("Blade"))
    scene = read(xform("World", instancer, cube("box")))
    assert [obj.name for obj in scene.objects] == ["Grass", "box"]
    assert "/World/Grass" in {note.prim_path for note in scene.diagnostics}
    assert capfd.readouterr() == ("", "")


# --- units -----------------------------------------------------------------------------


def frame_of(read, **metadata):
    scene = read(CUBE, layer=header(**metadata) if metadata else "")
    return scene, scene.frame


def test_units_are_read_as_authored(read):
    scene, frame = frame_of(read, metersPerUnit=0.0254, upAxis="Z", kilogramsPerUnit=0.001)
    assert (frame.metres_per_unit, frame.up_axis, frame.kilograms_per_unit, frame.is_authored) == (
        0.0254,
        "Z",
        0.001,
        True,
    )
    assert scene.diagnostics == ()


def test_missing_units_fall_back_and_are_reported(read):
    scene, frame = frame_of(read)
    # OpenUSD's fallbacks: a centimetre, y-up, one kilogram.
    assert (frame.metres_per_unit, frame.up_axis, frame.kilograms_per_unit, frame.is_authored) == (
        0.01,
        "Y",
        1.0,
        False,
    )
    messages = (
        "metersPerUnit is not authored; OpenUSD's fallback of 0.01 m is used; author it, or set --metres-per-unit",
        "upAxis is not authored; OpenUSD's fallback Y is used; author it, or set --up-axis",
    )
    assert scene.diagnostics == tuple(Diagnostic("units", message, None, scene.source) for message in messages)


def test_what_only_a_sublayer_says_of_units_is_reported(write_stage):
    write_stage(METRES + CUBE, "below.usda")
    scene = read_scene(write_stage("(\n    subLayers = [@below.usda@]\n)\n"))
    assert (scene.frame.metres_per_unit, scene.frame.up_axis) == (0.01, "Y")
    assert [note.message for note in scene.diagnostics if note.code == "units"][:2] == [
        "metersPerUnit is not authored (a sublayer says 1.0, which OpenUSD does not read); OpenUSD's fallback of 0.01 "
        "m is used; author it, or set --metres-per-unit",
        "upAxis is not authored (a sublayer says Z, which OpenUSD does not read); OpenUSD's fallback Y is used; author "
        "it, or set --up-axis",
    ]


def test_an_option_replaces_a_missing_up_axis(write_stage):
    path = write_stage("(\n    metersPerUnit = 1\n)\n" + CUBE)
    assert read_scene(path, options=ReadOptions(up_axis="Z")).diagnostics == ()


@pytest.mark.parametrize("value", [-1, 0, "inf", "nan"])
def test_invalid_metres_per_unit_falls_back_and_is_reported(read, value):
    text = f'(\n    metersPerUnit = {value}\n    upAxis = "Z"\n)\n'
    scene = read(CUBE, layer=text)
    assert scene.frame.metres_per_unit == 0.01
    assert not scene.frame.is_authored
    (note,) = scene.diagnostics
    assert note.code == "units"
    assert note.message.startswith(f"metersPerUnit is {float(value)!r}, expected a number from")


def test_metres_per_unit_authored_as_float_means_the_number_typed(tmp_path):
    # 0.01 as a 32-bit float is 0.00999999977…; a cube of 100 units is 1 m all the same.
    layer = Sdf.Layer.CreateNew(str(tmp_path / "float.usdc"))
    layer.pseudoRoot.SetInfo("metersPerUnit", Vt.Float(0.01))
    stage = Usd.Stage.Open(layer)
    UsdGeom.Cube.Define(stage, "/Box").CreateSizeAttr(100.0)
    layer.Save()
    stored = Usd.Stage.Open(str(tmp_path / "float.usdc")).GetMetadata("metersPerUnit")
    assert stored != 0.01  # the trap is there
    scene = read_scene(tmp_path / "float.usdc")
    assert scene.frame.metres_per_unit == 0.01
    assert scene.objects[0].box.size == (1.0, 1.0, 1.0)


def test_invalid_up_axis_is_reported_and_y_is_used(read):
    scene, frame = frame_of(read, metersPerUnit=1, upAxis="X")
    assert frame.up_axis == "Y"
    assert [note.message for note in scene.diagnostics] == ["upAxis is 'X', expected Y or Z; Y is used"]


@pytest.mark.parametrize("value", [-2, 0, "inf"])
def test_invalid_kilograms_per_unit_falls_back_and_is_reported(read, value):
    scene = read(CUBE, layer=f'(\n    metersPerUnit = 1\n    upAxis = "Z"\n    kilogramsPerUnit = {value}\n)\n')
    assert scene.frame.kilograms_per_unit == 1.0
    assert [note.code for note in scene.diagnostics] == ["units"]
    assert "kilogramsPerUnit" in scene.diagnostics[0].message


# --- what identifies it ------------------------------------------------------------------------------


def test_hash_depends_on_every_layer_but_not_on_the_path(write_stage):
    def digest(folder, asset_size=1, other_size=1):
        write_stage(cube("Cup", size=asset_size), f"{folder}/asset.usda")
        cup = prim("", "Cup", meta=["references = @asset.usda@</Cup>"])
        scene = METRES + xform("World", cup, cube("Other", size=other_size))
        return read_scene(write_stage(scene, f"{folder}/scene.usda")).content_hash

    first = digest("one")
    assert first.startswith("sha256:")
    assert len(first) == len("sha256:") + hashlib.sha256().digest_size * 2
    assert digest("two") == first
    assert len({first, digest("three", asset_size=2), digest("four", other_size=2)}) == 3


def test_source_is_kept_as_the_user_named_it(write_stage, monkeypatch):
    path = write_stage(METRES + CUBE)
    monkeypatch.chdir(path.parent)
    assert read_scene("scene.usda").source == "scene.usda"


def test_reading_needs_no_terminal(write_stage):
    path = write_stage(METRES + xform("World", prim("", "Chair", meta=["references = @chair.usd@"]), cube("box")))
    code = "import sys; from usd2kg.scene import read_scene; read_scene(sys.argv[1])"
    done = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")


# --- how it comes: a package, or a stage that is open -------------------------------------------------

ROOM = xform(
    "World",
    component("Chair", cube("seat"), cube("leg", at=(0, 0, -1))),
    component("Table", cube("top", size=2), move(5, 0, 0)),
)


def names(scene):
    return [obj.prim_path for obj in scene.objects]


def opened(text, *arguments):
    """Return a stage that lives in memory."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString("#usda 1.0\n" + METRES + text)
    return Usd.Stage.Open(layer, *arguments)


def test_a_package_is_read_like_its_files(write_stage, tmp_path):
    write_stage(METRES + component("Cup", cube("body", size=3)), "assets/cup.usda")
    cups = [prim("", name, meta=["references = @assets/cup.usda@</Cup>"]) for name in ("Cup1", "Cup2")]
    path = write_stage(METRES + xform("World", *cups, component("Table", cube("top"))))
    package = tmp_path / "room.usdz"
    assert UsdUtils.CreateNewUsdzPackage(str(path), str(package))
    of_files, of_package = read_scene(path), read_scene(package)
    assert names(of_package) == ["/World/Cup1", "/World/Cup2", "/World/Table"]
    assert [obj.geometry_file for obj in of_files.objects] == ["assets/cup.usda", "assets/cup.usda", ""]
    # The packager gives files folders of their own.
    assert {obj.geometry_file for obj in of_package.objects} == {"room.usdz[0/cup.usda]", ""}
    unfiled = [[replace(obj, geometry_file="") for obj in scene.objects] for scene in (of_package, of_files)]
    assert unfiled[0] == unfiled[1]
    assert (of_package.source, of_package.diagnostics) == (str(package), ())


def test_a_package_whose_content_changed_has_another_hash(write_stage, tmp_path):
    hashes = set()
    for size in (1, 2):
        path = write_stage(METRES + xform("World", cube("a", size=size), cube("b")), f"{size}.usda")
        assert UsdUtils.CreateNewUsdzPackage(str(path), str(tmp_path / f"{size}.usdz"))
        hashes.add(read_scene(tmp_path / f"{size}.usdz").content_hash)
    assert len(hashes) == 2


def test_the_session_layer_of_an_open_stage_moves_and_hides():
    stage = opened(ROOM + xform("Other", component("Lamp", cube("bulb"))))
    before = read_scene(stage)
    stage.SetEditTarget(stage.GetSessionLayer())
    UsdGeom.XformCommonAPI(stage.GetPrimAtPath("/World/Chair")).SetTranslate((1, 2, 3))
    UsdGeom.Imageable(stage.GetPrimAtPath("/Other/Lamp")).MakeInvisible()
    scene = read_scene(stage)
    assert (names(before), names(scene)) == (["/World/Chair", "/World/Table", "/Other/Lamp"], names(before)[:2])
    assert scene.by_path["/World/Chair"].position == (1, 2, 3)
    assert scene.by_path["/World/Chair"].box.lower == (0.5, 1.5, 1.5)
    assert scene.left_out["invisible"] == 1
    assert scene.content_hash != before.content_hash


def test_the_session_layer_of_an_open_stage_switches_a_variant():
    one, two = (f'"{name}" {{\n{cube(name)}}}\n' for name in ("plain", "padded"))
    meta = ['kind = "component"', 'variants = {\nstring seat = "plain"\n}', 'prepend variantSets = "seat"']
    chair = prim("Xform", "Chair", f'variantSet "seat" = {{\n{one}{two}}}', meta=meta)
    stage = opened(xform("World", chair, component("Table", cube("top"))))
    actual = [read_scene(stage).objects[0]]
    stage.SetEditTarget(stage.GetSessionLayer())
    stage.GetPrimAtPath("/World/Chair").GetVariantSet("seat").SetVariantSelection("padded")
    actual.append(read_scene(stage).objects[0])
    assert [(chair.variants, chair.parts) for chair in actual] == [
        ((("seat", "plain"),), ("plain",)),
        ((("seat", "padded"),), ("padded",)),
    ]


def test_an_open_stage_is_left_as_it_was():
    stage = opened(ROOM)
    before = stage.GetRootLayer().ExportToString()
    read_scene(stage)
    assert stage.GetRootLayer().ExportToString() == before
    assert stage.GetSessionLayer().empty
    assert stage.GetPrimAtPath("/World/Chair/seat").IsValid()


def test_only_masked_prims_of_a_masked_stage_are_read(write_stage):
    stage = Usd.Stage.OpenMasked(str(write_stage(METRES + ROOM)), Usd.StagePopulationMask(["/World/Table"]))
    scene = read_scene(stage)
    assert names(scene) == ["/World/Table"]
    assert scene.prim_count == 3  # /World, the table and its top
    assert scene.by_path["/World/Table"].box.lower == (4, -1, -1)


def test_a_material_outside_of_the_mask_keeps_its_name(write_stage):
    bound = cube("top", "rel material:binding = </Looks/Oak>", meta=['prepend apiSchemas = ["MaterialBindingAPI"]'])
    path = write_stage(
        METRES + prim("Scope", "Looks", prim("Material", "Oak")) + xform("World", component("Table", bound))
    )
    for stage in (Usd.Stage.Open(str(path)), Usd.Stage.OpenMasked(str(path), Usd.StagePopulationMask(["/World"]))):
        assert read_scene(stage).by_path["/World/Table"].materials == ("Oak",)


def test_payloads_of_an_open_stage_stay_unloaded_and_of_a_file_are_loaded(write_stage):
    write_stage('(\n    defaultPrim = "Chair"\n)\n' + component("Chair", cube("seat"), cube("leg")), "chair.usda")
    chair = prim("Xform", "Chair", move(1, 0, 0), meta=["payload = @chair.usda@"])
    path = write_stage(METRES + xform("World", chair, component("Table", cube("top"))))
    stage = Usd.Stage.Open(str(path), Usd.Stage.LoadNone)
    as_it_stands, of_file = read_scene(stage), read_scene(path)
    assert names(as_it_stands) == ["/World/Table"]
    assert not stage.GetPrimAtPath("/World/Chair").IsLoaded()
    assert names(of_file) == ["/World/Chair", "/World/Table"]
    assert of_file.by_path["/World/Chair"].parts == ("seat", "leg")
    stage.Load("/World/Chair")
    assert read_scene(stage).objects == of_file.objects


@pytest.mark.parametrize(
    "type_name",
    [
        pytest.param(""),
        "Xform",
    ],
)
def test_names_and_texts_of_prims_with_and_without_a_type(read, type_name):
    chairs = [
        prim(type_name, "P1", cube("a"), cube("b"), meta=['displayName = "Blue chair"']),
        prim(type_name, "P2", cube("a"), cube("b"), meta=['doc = "A chair"']),
        prim(type_name, "P3", cube("a"), cube("b"), meta=['customData = {\nstring note = "oak chair"\n}']),
    ]
    scene = read(xform("World", *chairs, cube("box")))
    assert scene.by_path["/World/P1"].display_name == "Blue chair"
    assert scene.by_path["/World/P2"].documentation == "A chair"
    assert scene.by_path["/World/P3"].texts == (("customData:note", "oak chair"),)


def test_importing_scene_does_not_import_openusd():
    code = "import sys, usd2kg.scene; sys.exit('pxr' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
