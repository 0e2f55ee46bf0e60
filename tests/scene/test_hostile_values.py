"""Invalid values are ignored or reported, and the rest of the stage is read."""

import math
import struct

import pytest
from pxr import Usd

from tests.scene.fuzz.corpus import as_crate
from tests.scene.usda import METRES, component, cube, header, prim, rigid, xform
from usd2kg.errors import SceneError
from usd2kg.pipeline import build
from usd2kg.render import Renderer, render_scene
from usd2kg.scene import ReadOptions, explain_choice, read_scene
from usd2kg.scene.stage import error_text, translated_errors

SOUND = component("Sound", cube("g"))
COPIES = ReadOptions(expand_instancers=True)


def only(scene, path="/World/Odd"):
    return scene.by_path[path]


def messages(scene, code):
    return [note.message for note in scene.diagnostics if note.code == code]


def odd(*lines, meta=()):
    return xform("World", cube("Odd", *lines, meta=meta), SOUND)


# --- attributes of other types --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "line",
    [
        "float[] primvars:displayColor = [1, 0, 0]",
        'string[] primvars:displayColor = ["red"]',
        "color4f[] primvars:displayColor = [(1, 0, 0, 1)]",
        "float2[] primvars:displayColor = [(1, 0)]",
        "float primvars:displayColor = 1",
        "color3f[] primvars:displayColor = [(nan, 0, 0)]",
        "color3f[] primvars:displayColor = [(0, inf, 0)]",
        "color3f[] primvars:displayColor = []",
        "rel primvars:displayColor = </World>",
    ],
)
def test_ignores_values_that_are_no_colour(read, line):
    scene = read(odd(line))
    assert only(scene).display_color is None
    assert only(scene).box.size == (1, 1, 1)


@pytest.mark.parametrize("type_name", ["color3f", "color3d", "half3"])
def test_colours_of_each_precision_are_read(read, type_name):
    assert only(read(odd(f"{type_name}[] primvars:displayColor = [(1, 0.5, 0)]"))).display_color == (1, 0.5, 0)


def test_the_next_sound_colour_is_taken(read):
    bad, good = (f"color3f[] primvars:displayColor = [({red}, 0, 0)]" for red in ("nan", "1"))
    assert only(read(component("Odd", cube("a", bad), cube("b", good))), "/Odd").display_color == (1, 0, 0)


@pytest.mark.parametrize(
    ("line", "unit", "mass"),
    [
        ("float physics:mass = 2.5", 1, 2.5),
        ('string physics:mass = "heavy"', 1, None),
        ("float3 physics:mass = (1, 2, 3)", 1, None),
        ("float physics:mass = nan", 1, None),
        ("float physics:mass = -1", 1, None),
        ("double physics:mass = 1e300", 1e20, None),
        ("double physics:mass = 1e-320", 1e-10, None),
        # No unit has this many kilograms: 1 is used.
        ("float physics:mass = 2.5", 1e300, 2.5),
    ],
)
def test_ignores_values_that_are_no_mass(read, line, unit, mass):
    layer = header(metersPerUnit=1, upAxis="Z", kilogramsPerUnit=unit)
    scene = read(odd(line, meta=['prepend apiSchemas = ["PhysicsMassAPI"]']), layer=layer)
    assert only(scene).mass_kg == mass


# --- attributes where relationships belong --------------------------------------------------------------


def test_a_joint_with_attributes_for_bodies_has_no_bodies(read):
    lines = ["int physics:body0 = 1", 'string physics:body1 = "Lid"', "float physics:upperLimit = 90"]
    scene = read(prim("PhysicsRevoluteJoint", "Hinge", *lines), rigid("Lid", cube("g")))
    (joint,) = scene.joints
    assert (joint.body0, joint.body1) == (None, None)
    assert joint.upper == pytest.approx(math.pi / 2)
    assert messages(scene, "joint") == [
        "it connects no body on the stage; expected targets of physics:body0 and physics:body1"
    ]


def test_a_binding_that_is_an_attribute_costs_its_prim_alone_the_material(read):
    apis = ['prepend apiSchemas = ["MaterialBindingAPI"]']
    body = cube("a", "int material:binding = 1", meta=apis)
    lid = cube("b", "rel material:binding = </Oak>", meta=apis)
    scene = read(component("Chair", body, lid), prim("Material", "Oak"))
    assert only(scene, "/Chair").materials == ("Oak",)
    assert only(read(component("Chair", body)), "/Chair").materials == ()


# --- point instancers -----------------------------------------------------------------------------------


def instancer(*lines, name="Trees", prototypes="rel prototypes = </World/Trees/Oak>"):
    body = ["int[] protoIndices = [0, 0]", "point3f[] positions = [(0, 0, 0), (5, 0, 0)]", prototypes, *lines]
    return prim("PointInstancer", name, *body, cube("Oak"))


@pytest.mark.parametrize("option", [ReadOptions(), COPIES])
@pytest.mark.parametrize(
    "line", ["int protoIndices = 0", 'string[] protoIndices = ["a"]', "rel protoIndices = </World>"]
)
def test_indices_of_another_type_draw_no_copy(read, line, option):
    trees = prim("PointInstancer", "Trees", line, "rel prototypes = </World/Trees/Oak>", cube("Oak"))
    scene = read(xform("World", trees, SOUND), options=option)
    assert {obj.prim_path for obj in scene.objects} - {"/World/Trees"} == {"/World/Sound"}
    if not option.expand_instancers:
        assert only(scene, "/World/Trees").instances.count == 0


def test_prototypes_that_are_an_attribute_draw_no_copy(read):
    scene = read(xform("World", instancer(prototypes="int prototypes = 1"), SOUND), options=COPIES)
    assert [obj.prim_path for obj in scene.objects] == ["/World/Sound"]


@pytest.mark.parametrize(
    "ids",
    ["int64[] ids = [7]", "int64[] ids = [7, 8, 9]", "int64[] ids = [7, 7]", "int ids = 7", "float[] ids = [nan, 1]"],
)
def test_copies_without_ids_of_their_own_are_numbered_by_place(read, ids):
    scene = read(xform("World", instancer(ids), SOUND), options=COPIES)
    assert [obj.prim_path for obj in scene.objects] == ["/World/Trees[0]", "/World/Trees[1]", "/World/Sound"]
    (note,) = (note for note in scene.diagnostics if note.code == "instancer")
    assert note.prim_path == "/World/Trees"
    assert note.message == "its ids are not 2 different numbers, one for each copy; the copies are numbered by position"


def test_ids_of_their_own_are_kept(read):
    scene = read(xform("World", instancer("int64[] ids = [7, -1]"), SOUND), options=COPIES)
    assert [obj.prim_path for obj in scene.objects] == ["/World/Trees[7]", "/World/Trees[-1]", "/World/Sound"]
    assert messages(scene, "instancer") == []


@pytest.mark.parametrize("option", [ReadOptions(), COPIES])
@pytest.mark.parametrize("targets", ["</World/Trees>", "</World>", "</World/Others>", "</World/Lamp>"])
def test_instancers_that_are_their_own_prototypes_are_left_out(read, targets, option):
    """OpenUSD would die of the question for the box of any prim that holds one."""
    trees = instancer(prototypes=f"rel prototypes = {targets}")
    others = instancer(name="Others", prototypes="rel prototypes = </World/Trees>")
    lamp = prim("SphereLight", "Lamp", instancer(name="Inner", prototypes="rel prototypes = </World/Trees>"))
    hint = "float3[] extentsHint = [(0, 0, 0), (1, 2, 3)]"
    turned = 'float xformOp:rotateZ = 30\nuniform token[] xformOpOrder = ["xformOp:rotateZ"]'
    scene = read(xform("World", turned, hint, trees, others, lamp, SOUND, kind="component"), options=option)
    assert scene.left_out["point instancer among its own prototypes"] == 3
    found = {note.prim_path: note.message for note in scene.diagnostics if note.code == "geometry"}
    assert found["/World/Trees"] == "a point instancer contains itself through its prototypes; it is left out"
    assert only(scene, "/World").box is not None


def test_instancers_within_prototypes_are_not_endless(read):
    inner = instancer(name="Inner", prototypes="rel prototypes = </World/Trees/Inner/Oak>")
    scene = read(xform("World", instancer(inner, prototypes="rel prototypes = </World/Trees/Inner>"), SOUND))
    # Two copies 5 m apart, of two cubes 5 m apart.
    assert only(scene, "/World/Trees").box.size == (11, 1, 1)


# --- numbers beyond all measure -------------------------------------------------------------------------


@pytest.mark.parametrize("unit", [1e300, 1e21, 1e-16, 1e-320])
def test_units_that_none_can_be_are_not_used(read, unit):
    scene = read(odd(), layer=header(metersPerUnit=unit, upAxis="Z"))
    assert scene.frame.metres_per_unit == 0.01
    assert messages(scene, "units") == [
        f"metersPerUnit is {unit!r}, expected a number from 1e-15 to 1e+20; 0.01 is used"
    ]


@pytest.mark.parametrize("unit", [1e-9, 9.4607304725808e15])
def test_nanometres_and_light_years_are_units(read, unit):
    scene = read(odd(), layer=header(metersPerUnit=unit, upAxis="Z"))
    assert only(scene).box.size == pytest.approx((unit, unit, unit))


@pytest.mark.parametrize("place", ["(1e308, 0, 0)", "(0, nan, 0)", "(0, 0, -inf)"])
def test_a_non_finite_transform_has_neither_position_nor_box(read, place):
    move = f'double3 xformOp:translate = {place}\nuniform token[] xformOpOrder = ["xformOp:translate"]'
    for layer in (METRES, header(metersPerUnit=1e20, upAxis="Y")):
        thing = only(read(odd(move), layer=layer))
        assert (thing.position, thing.box) == (None, None)


def test_copies_with_non_finite_positions_have_no_position(read):
    far = instancer().replace("(5, 0, 0)", "(3e38, 0, 0)")
    scene = read(xform("World", far, SOUND), options=COPIES)
    assert only(scene, "/World/Trees[0]").position == (0, 0, 0)
    assert only(scene, "/World/Trees[1]").position is None


def test_non_finite_points_of_a_rotated_mesh_raise_no_warnings(read):
    points = "point3f[] points = [(inf, 0, 0), (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1)]"
    turned = 'float xformOp:rotateX = 30\nuniform token[] xformOpOrder = ["xformOp:rotateX"]'
    assert only(read(prim("Mesh", "Odd", points, turned), SOUND), "/Odd").box.size[0] == pytest.approx(1)


def test_limits_stay_finite(read):
    slide = prim("PhysicsPrismaticJoint", "Slide", "double physics:lowerLimit = -1e300",
                 "double physics:upperLimit = 1e29", "rel physics:body1 = </Sound>")  # fmt: skip
    (joint,) = read(slide, SOUND, layer=header(metersPerUnit=1e20, upAxis="Z")).joints
    assert (joint.lower, joint.upper) == (None, pytest.approx(1e49))


@pytest.mark.parametrize("start", ["inf", "nan"])
def test_a_mistyped_start_time_is_none(read, start):
    assert read(SOUND, layer=header(metersPerUnit=1, startTimeCode=start, endTimeCode=9).replace('"', "")).time is None


# --- diagnostics ----------------------------------------------------------------------------------------


def test_diagnostics_are_short_lines_that_print(read):
    api = 'apiSchemas = ["""SemanticTagAPI\n\a"""]'
    long = f'custom token[] semantics:labels:{"x" * 900} = [""]'
    matrix = "matrix4d state:angular:physics:position = ( (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 0, 0) )"
    scene = read(odd(meta=[api]), cube("Long", long), prim("PhysicsRevoluteJoint", "Hinge", matrix))
    assert {"label", "joint"} <= {note.code for note in scene.diagnostics}
    for note in scene.diagnostics:
        assert note.message.isprintable()
        assert 0 < len(note.message) <= 500
    assert any(message.startswith("SemanticTagAPI is applied") for message in messages(scene, "label"))
    assert any(message.endswith("…") for message in messages(scene, "label"))


def test_only_the_first_of_many_messages_is_quoted():
    # OpenUSD repeats its message for each of a million parts of a corrupt file.
    complaint = "\n\tError in 'f' at line 7 in file crate.cpp : 'a spec is bad'"
    assert error_text(RuntimeError(complaint * 100_000)) == "a spec is bad"


# --- corrupt crates -------------------------------------------------------------------------------------


def write_crate(tmp_path, text, before, after):
    """Write a crate in which some bytes, which it holds once, are replaced."""
    crate = as_crate({"scene.usda": f"#usda 1.0\n{METRES}{text}".encode()}, tmp_path)["scene.usdc"]
    assert crate.count(before) == 1
    path = tmp_path / "corrupt.usdc"
    path.write_bytes(crate.replace(before, after))
    return path


def test_a_prim_that_cannot_be_read_is_left_out(tmp_path):
    text = xform("World", component("Odd", cube("g"), meta=['displayName = "xyzzyplugh"']), SOUND)
    path = write_crate(tmp_path, text, b"xyzzyplugh", b"xyzzy\xff\xfeugh")
    scene = read_scene(path)
    assert [obj.prim_path for obj in scene.objects] == ["/World/Sound"]
    assert scene.left_out["unreadable"] == 1
    (note,) = (note for note in scene.diagnostics if note.code == "geometry")
    assert (note.prim_path, note.message) == (
        "/World/Odd",
        "OpenUSD cannot read it; it is left out with all prims below it",
    )
    assert explain_choice(path, "/World/Odd") == "/World/Odd is not an object: it is left out (unreadable)"


def test_an_object_with_unreadable_evidence_keeps_name_and_box(tmp_path):
    variants = 'variantSet "shape" = {\n"xyzzyplugh" {\n}\n}'
    meta = ['variants = { string shape = "xyzzyplugh" }', 'prepend variantSets = "shape"']
    text = xform("World", component("Odd", cube("g"), variants, meta=meta), SOUND)
    scene = read_scene(write_crate(tmp_path, text, b"xyzzyplugh", b"xyzzy\xff\xfeugh"))
    assert only(scene).box.size == (1, 1, 1)
    assert only(scene).variants == ()
    (message,) = messages(scene, "unreadable")
    assert message.startswith("its evidence cannot be read (it holds text that is not UTF-8)")


def test_errors_of_openusd_are_translated_with_their_cause():
    with pytest.raises(SceneError) as refused, translated_errors("a.usdc"):
        b"\xff".decode()
    assert str(refused.value) == (
        "a.usdc: OpenUSD cannot read this layer (it holds text that is not UTF-8); export it again"
    )
    assert isinstance(refused.value.__cause__, UnicodeDecodeError)


def test_errors_of_our_own_pass_through():
    with pytest.raises(KeyError), translated_errors("a.usdc"):
        {}["a"]


ROUND = ("Sphere", "Cylinder", "Cone", "Capsule", "Cylinder_1", "Capsule_1")


@pytest.mark.parametrize("radius", ["0", "-0", "-1", "1e300"])
def test_round_solids_of_any_radius_are_read_and_drawn(write_stage, home_tbox, radius):
    def solid(kind):
        names = ("radiusTop", "radiusBottom") if kind.endswith("_1") else ("radius",)
        return component(f"Round_{kind}", prim(kind, "g", *(f"double {name} = {radius}" for name in names)))

    line = (
        "point3f[] points = [(0, 0, 0), (1, 1, 1)]",
        "int[] faceVertexCounts = [2]",
        "int[] faceVertexIndices = [0, 1]",
    )
    others = component("Line", prim("Mesh", "g", *line)), component("Box", cube("g"))
    stage = write_stage(METRES + xform("World", *map(solid, ROUND), *others))
    assert build(stage, home_tbox).graph.triples
    assert render_scene(stage, size=(32, 32)).startswith(b"\x89PNG")


def test_a_transform_beyond_all_numbers_is_left_out_of_pictures_without_a_warning(write_stage):
    far = "matrix4d xformOp:transform = ((1e200, 0, 0, 0), (0, 1e200, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))"
    order = 'uniform token[] xformOpOrder = ["xformOp:transform"]'
    stage = write_stage(METRES + xform("World", component("Far", far, order, cube("g")), SOUND))
    picture = Renderer(stage)
    assert picture.render_scene(size=(32, 32)).startswith(b"\x89PNG")
    assert "its transform is not finite; not in pictures" in {note.message for note in picture.diagnostics}


def test_a_corrupt_crate_writes_nothing_to_the_terminal(tmp_path, capfd):
    stage = Usd.Stage.CreateNew(str(tmp_path / "a.usdc"))
    stage.DefinePrim("/a", "Xform")
    stage.GetRootLayer().Save()
    data = bytearray((tmp_path / "a.usdc").read_bytes())
    (contents,) = struct.unpack_from("<q", data, 16)
    # The first section starts far beyond the end of the file (name of 16 bytes, start, size).
    struct.pack_into("<q", data, contents + 8 + 16, 1 << 40)
    (tmp_path / "odd.usdc").write_bytes(data)
    with pytest.raises(SceneError, match="OpenUSD cannot read this layer"):
        read_scene(tmp_path / "odd.usdc")
    assert capfd.readouterr() == ("", "")
