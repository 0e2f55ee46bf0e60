"""Options of reading, explanations of the selection, and sanity checks."""

import math

import pytest
from pxr import Usd, UsdGeom

from tests.scene.usda import component, cube, header, move, ops, prim, xform
from usd2kg.errors import SceneError
from usd2kg.scene import ReadOptions, SelectionOverrides, explain_choice, read_scene
from usd2kg.scene.object_selection import path_pattern

ROOM = (
    component("Chair_1", cube("seat"), cube("leg", at=(0, 0, 1)))
    + component("Chair_2", cube("seat"))
    + xform("Wall", cube("geo"))
)


def _paths(scene):
    return [obj.prim_path.removeprefix("/World/") for obj in scene.objects]


def _read(read, *, layer=None, **selection):
    options = ReadOptions(selection=SelectionOverrides(**selection))
    arguments = {"options": options} if layer is None else {"options": options, "layer": layer}
    return read(xform("World", ROOM), **arguments)


def test_empty_overrides_change_nothing(read):
    assert _paths(_read(read)) == ["Chair_1", "Chair_2", "Wall"]


def test_a_pattern_includes_parts(read):
    scene = _read(read, include=("/World/**/leg",))
    assert _paths(scene) == ["Chair_1", "Chair_1/leg", "Chair_2", "Wall"]
    assert scene.by_path["/World/Chair_1/leg"].selected_by == "included by a pattern of the user"
    assert scene.by_path["/World/Chair_1/leg"].parent_path == "/World/Chair_1"


def test_a_pattern_excludes_with_all_below(read):
    assert _paths(_read(read, exclude=("/World/Chair_*",))) == ["Wall"]
    assert _paths(_read(read, include=("/World/**/leg",), exclude=("/World/Chair_1",))) == ["Chair_2", "Wall"]


def test_a_list_of_paths_replaces_the_rules(read):
    assert _paths(_read(read, only=("/World/Chair_1/seat", "/World/Wall", "/World/None"))) == ["Chair_1/seat", "Wall"]


def test_other_kinds_can_be_objects(read):
    scene = read(
        xform("World", xform("Set", component("Cup", cube("a")), component("Saucer", cube("a")), kind="group")),
        options=ReadOptions(selection=SelectionOverrides(kinds=("group",))),
    )
    assert _paths(scene) == ["Set"]
    assert scene.objects[0].selected_by == "authored kind: group"


def test_every_prim_with_geometry(read):
    scene = read(
        xform("World", component("Chair", cube("seat"), prim("Xform", "empty"))),
        options=ReadOptions(selection=SelectionOverrides(is_every_prim=True)),
    )
    assert [obj.prim_path for obj in scene.objects] == ["/World", "/World/Chair", "/World/Chair/seat"]


@pytest.mark.parametrize(
    ("pattern", "path", "fits"),
    [
        ("/World/*", "/World/Cup", True),
        ("/World/*", "/World/Cup/mesh", False),
        ("/World/**", "/World/Cup/mesh", True),
        ("/**/mesh", "/World/Cup/mesh", True),
        ("/**/mesh", "/mesh", True),
        ("/World/Cup_?", "/World/Cup_1", True),
        ("/World/Cup_?", "/World/Cup_12", False),
        ("/World/Cup.", "/World/CupX", False),
        ("/World/Cup", "/World/Cup2", False),
    ],
)
def test_patterns(pattern, path, fits):
    assert bool(path_pattern(pattern).fullmatch(path)) is fits


def test_options_override_units_and_axis(read):
    layer = header(metersPerUnit=0.01, upAxis="Y")
    tall = cube("box", ops(("double3", "scale", (1, 2, 3))), size=1)
    assert read(xform("World", tall, cube("b")), layer=layer).by_path["/World/box"].box.size == pytest.approx(
        (0.01, 0.03, 0.02)
    )
    scene = read(
        xform("World", tall, cube("b")),
        layer=layer,
        options=ReadOptions(metres_per_unit=1.0, up_axis="Z"),
        name="b.usda",
    )
    assert scene.by_path["/World/box"].box.size == pytest.approx((1, 2, 3))
    assert (scene.frame.metres_per_unit, scene.frame.up_axis) == (1.0, "Z")


@pytest.mark.parametrize("value", [0, -1, float("inf"), float("nan")])
def test_impossible_units_are_refused(value):
    with pytest.raises(SceneError, match="expected a positive number"):
        ReadOptions(metres_per_unit=value)


def test_impossible_axis_is_refused():
    with pytest.raises(SceneError, match="up axis is 'X'; expected Y or Z"):
        ReadOptions(up_axis="X")


def test_reads_the_given_time(read):
    moving = prim(
        "Cube",
        "Ball",
        "double3 xformOp:translate.timeSamples = { 1: (1, 0, 0), 3: (5, 0, 0) }",
        'uniform token[] xformOpOrder = ["xformOp:translate"]',
    )
    earliest = read(xform("World", moving, cube("b")))
    assert earliest.by_path["/World/Ball"].position == (1, 0, 0)
    # Halfway between the samples: linear interpolation.
    halfway = read(xform("World", moving, cube("b")), options=ReadOptions(time=2.0), name="b.usda")
    assert halfway.by_path["/World/Ball"].position == (3, 0, 0)
    assert (earliest.time, halfway.time) == (None, 2.0)


def test_explains_why_a_prim_is_an_object(write_stage):
    source = write_stage(
        xform(
            "World",
            ROOM,
            prim("Camera", "view"),
            xform("Hidden", cube("a"), meta=["active = false"]),
            xform("Locator"),
        )
    )
    why = {
        path: explain_choice(source, f"/World/{path}")
        for path in ("Chair_1", "Chair_1/seat", "view", "Hidden", "Locator")
    }
    assert why["Chair_1"] == "/World/Chair_1 is an object: authored kind: component"
    assert why["Chair_1/seat"].endswith(
        "is not an object: part of an object, /World/Chair_1 (authored kind: component)"
    )
    assert why["view"].endswith("is not an object: it is left out (camera)")
    assert why["Hidden"].endswith("is not an object: it is left out (inactive)")
    assert why["Locator"].endswith("is not an object: no geometry")
    assert explain_choice(source, "/World").startswith(
        "/World is not an object: grouping of objects; the objects are /World/Chair_1, /World/Chair_2, /World/Wall"
    )
    with pytest.raises(SceneError, match="there is no prim /World/Nope"):
        explain_choice(source, "/World/Nope")


def test_an_open_stage_is_read_with_its_current_state(write_stage):
    source = write_stage(xform("World", component("Cup", cube("a"), meta=['variants = { string size = "small" }'])))
    stage = Usd.Stage.Open(str(source))
    before = read_scene(stage)
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        UsdGeom.XformCommonAPI(stage.GetPrimAtPath("/World/Cup")).SetTranslate((7, 0, 0))
    after = read_scene(stage)
    assert before.by_path["/World/Cup"].position == (0, 0, 0)
    # The stage has no unit: OpenUSD's fallback is the centimetre.
    assert after.by_path["/World/Cup"].position == pytest.approx((0.07, 0, 0))
    assert after.content_hash != before.content_hash, "what the session changed is another scene"
    assert read_scene(source).content_hash == before.content_hash
    assert stage.GetPrimAtPath("/World/Cup"), "the stage is still the caller's"


def test_a_stage_in_memory_has_a_hash():
    stage = Usd.Stage.CreateInMemory("room.usda")
    UsdGeom.Cube.Define(stage, "/Room")
    first = read_scene(stage)
    UsdGeom.Cube.Define(stage, "/Other")
    assert read_scene(stage).content_hash != first.content_hash


# --- boxes -----------------------------------------------------------------------------------------


def _disc(name, degrees, count=64):
    """A flat round mesh of radius 1, turned about z, with the extent a modeller exports."""
    points = ", ".join(f"({math.cos(a):.6f}, {math.sin(a):.6f}, 0)" for a in _angles(count))
    indices = ", ".join(map(str, range(count)))
    return prim(
        "Mesh",
        name,
        f"point3f[] points = [{points}]",
        f"int[] faceVertexCounts = [{count}]",
        f"int[] faceVertexIndices = [{indices}]",
        "float3[] extent = [(-1, -1, 0), (1, 1, 0)]",
        ops(("double", "rotateZ", degrees)),
    )


def _angles(count):
    return [2 * math.pi * i / count for i in range(count)]


@pytest.mark.parametrize("degrees", [0, 30, 45, 90, 123])
def test_rotation_keeps_the_width_of_a_round_table(read, degrees):
    scene = read(xform("World", _disc("table", degrees), cube("b")))
    # Turning the extent by 45 degrees would make it 2 * sqrt(2) = 2.83 wide.
    assert scene.by_path["/World/table"].box.size == pytest.approx((2, 2, 0), abs=0.01)


def test_rotated_meshes_are_measured_by_their_points(read):
    scene = read(xform("World", component("Table", _disc("a", 45), _disc("b", 45)), cube("b")))
    assert scene.by_path["/World/Table"].box.size == pytest.approx((2, 2, 0), abs=0.01)


def test_a_mesh_with_an_inverted_extent_is_measured_by_its_points(read):
    inverted = prim(
        "Mesh",
        "plate",
        "point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 3, 0)]",
        "int[] faceVertexCounts = [3]",
        "int[] faceVertexIndices = [0, 1, 2]",
        "float3[] extent = [(2, 3, 0), (0, 0, 0)]",
    )
    assert read(xform("World", inverted, cube("b"))).by_path["/World/plate"].box.size == (2, 3, 0)


def test_oriented_size_of_a_rotated_object(read):
    board = component("Board", cube("a", ops(("double3", "scale", (4, 1, 2)))), meta=())
    turned = xform(
        "Turned", cube("a", ops(("double3", "scale", (4, 1, 2)))), ops(("double", "rotateZ", 30)), kind="component"
    )
    scene = read(xform("World", board, turned))
    assert scene.by_path["/World/Board"].oriented_size is None
    assert scene.by_path["/World/Turned"].oriented_size == pytest.approx((4, 1, 2))
    # Its world box: 4 cos 30 + 1 sin 30 wide, 4 sin 30 + 1 cos 30 deep.
    assert scene.by_path["/World/Turned"].box.size == pytest.approx((3.964, 2.866, 2), abs=1e-3)


# --- instancers --------------------------------------------------------------------------------------

GRASS = prim(
    "PointInstancer",
    "Grass",
    prim("Xform", "Prototypes", component("Blade", cube("geo", size=2))),
    "rel prototypes = </World/Grass/Prototypes/Blade>",
    "int[] protoIndices = [0, 0, 0]",
    "point3f[] positions = [(0, 0, 0), (10, 0, 0), (0, 10, 5)]",
    "int64[] ids = [7, 8, 9]",
    "int64[] invisibleIds = [8]",
    move(100, 0, 0),
)


def test_copies_become_objects_on_request(read):
    scene = read(xform("World", GRASS, cube("b")), options=ReadOptions(expand_instancers=True))
    copies = [obj for obj in scene.objects if obj.selected_by == "copy of a point instancer"]
    assert [(obj.prim_path, obj.name) for obj in copies] == [
        ("/World/Grass[7]", "Blade_7"),
        ("/World/Grass[9]", "Blade_9"),
    ]
    assert copies[1].position == (100, 10, 5)
    assert (copies[1].box.lower, copies[1].box.upper) == ((99, 9, 4), (101, 11, 6))
    assert copies[0].instance_of == "/World/Grass/Prototypes/Blade"
    assert "/World/Grass" not in scene.by_path


def test_copies_are_one_object_otherwise(read):
    grass = read(xform("World", GRASS, cube("b"))).by_path["/World/Grass"]
    assert (grass.instances.count, grass.instances.prototypes) == (2, ("Blade",))
    assert (grass.box.lower, grass.box.upper) == ((99, -1, -1), (101, 11, 6))


# --- plausibility -------------------------------------------------------------------------------------


def _row(count, step=1.0, size=1.0):
    return [cube(f"c{i}", size=size, at=(i * step, 0, 0)) for i in range(count)]


def test_an_implausibly_small_room_is_reported(read):
    # The file is in metres without saying so: the fallback makes the room 1/100 of its size.
    scene = read(xform("World", *_row(36)), layer=header(upAxis="Z"))
    notes = [note.message for note in scene.diagnostics if note.code == "units"]
    assert any(
        note.startswith("the extent of the scene is 0.36 m with a stage unit of 0.01 m (OpenUSD's fallback")
        for note in notes
    )
    assert any("--metres-per-unit" in note for note in notes)


def test_a_room_of_plausible_size_is_not_reported(read):
    assert not [note for note in read(xform("World", *_row(5))).diagnostics if note.code == "units"]


def test_an_outlier_is_kept_and_reported(read):
    scene = read(xform("World", *_row(8), cube("book", at=(0, 0, 343_000))))
    (note,) = [note for note in scene.diagnostics if note.code == "outlier"]
    assert note.prim_path == "/World/book"
    assert note.message.startswith("its distance from the centre of the scene is 343,000 m")
    assert "/World/book" in scene.by_path
    assert scene.extent_without({"/World/book"}).size == pytest.approx((8, 1, 1))


def test_a_sky_dome_is_reported(read):
    scene = read(xform("World", *_row(8), cube("sky", size=5000)))
    (note,) = [note for note in scene.diagnostics if note.code == "outlier"]
    assert (note.prim_path, "sky dome" in note.message) == ("/World/sky", True)


def test_a_long_hall_has_no_outliers(read):
    scene = read(xform("World", *_row(40, step=5)))
    assert not [note for note in scene.diagnostics if note.code == "outlier"]
