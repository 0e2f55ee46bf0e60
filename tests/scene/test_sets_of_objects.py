"""Groups and references of several named things are sets of objects; parts of one thing stay one object."""

import pytest

from tests.scene.usda import cube, prim, xform


def paths(scene, above="/World/"):
    return [obj.prim_path.removeprefix(above) for obj in scene.objects]


def labelled(name, label, **options):
    lines = [f'token[] semantics:labels:class = ["{label}"]'] if label else []
    return cube(name, *lines, meta=['prepend apiSchemas = ["SemanticsLabelsAPI:class"]'], **options)


def slab(name, lower, upper):
    """Return a box between two corners, in metres."""
    middle = tuple((a + b) / 2 for a, b in zip(lower, upper, strict=True))
    sides = tuple(b - a for a, b in zip(lower, upper, strict=True))
    order = 'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]'
    lines = (f"double3 xformOp:translate = {middle}", f"double3 xformOp:scale = {sides}", order)
    return prim("Cube", name, "double size = 1", *lines)


OTHER = cube("box", at=(0, 90, 0))


@pytest.mark.parametrize(
    "distance, expected",
    [
        # Cubes of 1 m: a gap of 1.5 m, of more than a tenth, of less, and none.
        (2.5, ["Seating/Stool_0", "Seating/Stool_1", "Seating/Stool_2"]),
        (1.11, ["Seating/Stool_0", "Seating/Stool_1", "Seating/Stool_2"]),
        (1.09, ["Seating"]),
        (1, ["Seating"]),
    ],
)
def test_meshes_that_are_apart_are_objects(read, distance, expected):
    stools = [cube(f"Stool_{i}", at=(i * distance, 0, 0)) for i in range(3)]
    assert paths(read(xform("World", xform("Seating", *stools), OTHER))) == [*expected, "box"]


def test_one_part_that_is_apart_splits_nothing(read):
    parts = [cube("Shade", at=(0, 0, 2)), cube("Rod"), cube("Foot"), cube("Cable")]
    assert paths(read(xform("World", xform("Lamp", *parts), OTHER))) == ["Lamp", "box"]


def test_unnamed_pieces_that_are_apart_stay_one_object(read):
    pieces = [cube("Seat"), cube("mesh_7", at=(3, 0, 0)), cube("mesh_8", at=(6, 0, 0))]
    assert paths(read(xform("World", xform("Chair", *pieces), OTHER))) == ["Chair", "box"]


@pytest.mark.parametrize("name", ["Walls", "walls_01"])
def test_a_plural_holds_those_that_it_names(read, name):
    walls = [cube("SM_WallA_N"), cube("SM_WallA_W")]
    assert paths(read(xform("World", xform(name, *walls), OTHER))) == [*(f"{name}/SM_WallA_{i}" for i in "NW"), "box"]
    assert paths(read(xform("World", xform("Glasses", cube("Frame"), cube("Lens")), OTHER))) == ["Glasses", "box"]


def test_rooms_hold_their_named_meshes(read):
    room = xform("Server_room", cube("Rack"), cube("Desk"))
    assert paths(read(xform("World", room, OTHER))) == ["Server_room/Rack", "Server_room/Desk", "box"]


@pytest.mark.parametrize(
    "labels, is_set",
    [
        (("mug", "laptop", ""), True),
        (("cart", "cart", "cart"), False),
        (("mug", "", ""), False),
    ],
)
def test_different_labels_make_a_set(read, labels, is_set):
    pieces = [labelled(name, label) for name, label in zip(("Alpha", "Beta", "Gamma"), labels, strict=True)]
    scene = read(xform("World", xform("Stuffing", *pieces), OTHER))
    expected = [f"Stuffing/{name}" for name in ("Alpha", "Beta", "Gamma")] if is_set else ["Stuffing"]
    assert paths(scene) == [*expected, "box"]


def test_labels_of_parts_of_a_labelled_whole_make_no_set(read):
    lines = 'token[] semantics:labels:class = ["car"]'
    whole = xform(
        "Stuffing", lines, labelled("Alpha", "door"), labelled("Beta", "wheel"), apis=["SemanticsLabelsAPI:class"]
    )
    assert paths(read(xform("World", whole, OTHER))) == ["Stuffing", "box"]


ROOM = (slab("Floor", (0, 0, -0.1), (6, 5, 0)), slab("Wall_N", (0, 5, 0), (6, 5.1, 3)))
TABLE = slab("Table", (1, 1, 0), (2, 2, 0.7))


@pytest.mark.parametrize("arc", ["references", "payload"])
def test_a_referenced_furnished_room_is_what_is_in_it(read, write_stage, arc):
    content = (*ROOM, xform("Chair_1", slab("seat", (3, 1, 0), (3.5, 1.5, 0.5))), TABLE)
    text = '(\n    defaultPrim = "Place"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n' + xform("Place", *content)
    asset = write_stage(text, "place.usda").name
    scene = read(xform("World", prim("", "site", meta=[f"{arc} = @{asset}@"]), OTHER))
    assert paths(scene) == ["site/Floor", "site/Wall_N", "site/Chair_1", "site/Table", "box"]


@pytest.mark.parametrize("content", [ROOM, (slab("Wall_left", (0, 0, 0), (6, 0.1, 2)), TABLE), (TABLE, cube("leg"))])
def test_other_referenced_prims_are_one_object(read, write_stage, content):
    text = '(\n    defaultPrim = "Place"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n' + xform("Place", *content)
    asset = write_stage(text, "place.usda").name
    assert paths(read(xform("World", prim("", "site", meta=[f"references = @{asset}@"]), OTHER))) == ["site", "box"]


def test_a_reference_to_several_models_is_a_set(read, write_stage):
    models = [xform(name, cube("mesh"), kind="component") for name in ("Sofa", "Lamp")]
    text = '(\n    defaultPrim = "Place"\n)\n' + xform("Place", *models, cube("carpet"))
    asset = write_stage(text, "place.usda").name
    scene = read(xform("World", prim("", "flat", meta=[f"references = @{asset}@"]), OTHER))
    assert paths(scene) == ["flat/Sofa", "flat/Lamp", "flat/carpet", "box"]


def test_a_model_of_a_furnished_room_is_a_set(read):
    things = [xform(name, part, kind="component") for name, part in (("Walls", ROOM[1]), ("Table", TABLE))]
    house = xform("House", *things, ROOM[0], kind="component")
    assert paths(read(xform("World", house, OTHER))) == ["House/Walls", "House/Table", "House/Floor", "box"]
    cabinet = xform("House", *things[1:], xform("Drawer", TABLE, kind="component"), ROOM[0], kind="component")
    assert paths(read(xform("World", cabinet, OTHER))) == ["House", "House/Table", "House/Drawer", "box"]


@pytest.mark.parametrize("root, thing", [("World", "/World/mug"), ("Scene", "/Scene/mug"), ("Mug_asset", "/Mug_asset")])
def test_the_only_object_of_a_stage_keeps_its_name(read, root, thing):
    assert paths(read(xform(root, xform("mug", cube("mesh")))), above="") == [thing]
