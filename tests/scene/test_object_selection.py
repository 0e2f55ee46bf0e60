"""Object selection: one small stage per rule."""

import json
import os
import subprocess
import sys

import pytest

from tests.scene.usda import METRES, component, cube, prim, rigid, xform

KIND = "authored kind: component"
BODY = "rigid body"
ASSET = "asset boundary (reference, payload or instance)"
OWNER = "geometry without a model above it"
ROBOT = "robot: a chain of revolute joints"


def chosen(scene):
    """Return prim path → why it is an object, in order."""
    return {obj.prim_path: obj.selected_by for obj in scene.objects}


def parents(scene):
    """Return name → name of the object above."""
    return {obj.name: obj.parent_path and obj.parent_path.rpartition("/")[2] for obj in scene.objects}


def group(name, *body, meta=()):
    return xform(name, *body, meta=meta, kind="group")


def reference(name, asset, *body, meta=()):
    return prim("", name, *body, meta=[f"references = @{asset}@", *meta])


@pytest.fixture
def write_asset(write_stage):
    """A function that writes an asset whose default prim is `name`."""

    def write(name, *body, kind=None):
        text = f'(\n    defaultPrim = "{name}"\n)\n' + xform(name, *body, kind=kind)
        return write_stage(text, f"{name.lower()}.usda").name

    return write


# --- the authored model hierarchy --------------------------------------------------------------------


def test_components_are_objects_and_groups_are_structure(read):
    scene = read(
        group(
            "World", group("Furniture", component("Chair", cube("leg"), cube("seat")), component("Table", cube("top")))
        )
    )
    assert chosen(scene) == {"/World/Furniture/Chair": KIND, "/World/Furniture/Table": KIND}
    assert scene.left_out == {"grouping of objects": 2, "part of an object": 3}


def test_assemblies_are_structure(read):
    scene = read(xform("Set", component("Chair", cube("a")), component("Table", cube("b")), kind="assembly"))
    assert list(chosen(scene)) == ["/Set/Chair", "/Set/Table"]


def test_nested_components_are_objects_in_objects(read):
    scene = read(xform("World", component("Desk", cube("top"), component("Drawer", cube("front"))), cube("box")))
    assert parents(scene) == {"Desk": None, "Drawer": "Desk", "box": None}


def test_subcomponents_are_parts(read):
    drawer = xform("Drawer", cube("front"), kind="subcomponent")
    scene = read(xform("World", component("Desk", cube("top"), drawer), component("Lamp", cube("bulb"))))
    assert chosen(scene) == {"/World/Desk": KIND, "/World/Lamp": KIND}
    assert scene.by_path["/World/Desk"].parts == ("top", "Drawer", "front")


def test_subcomponents_that_are_bodies_are_parts_all_the_same(read):
    wheel = xform("Wheel", cube("tyre"), kind="subcomponent", apis=["PhysicsRigidBodyAPI"])
    scene = read(xform("World", component("Cart", cube("deck"), wheel), rigid("Wheel", cube("spare"))))
    assert chosen(scene) == {"/World/Cart": KIND, "/World/Wheel": BODY}


def test_kinds_derived_from_component_are_components(tmp_path, write_stage):
    # Kinds are registered at the start of a process, so this test starts one.
    kinds = {"prop": {"baseKind": "component"}, "setpiece": {"baseKind": "group"}}
    plugin = {"Name": "kinds", "Type": "resource", "Root": ".", "ResourcePath": ".", "Info": {"Kinds": kinds}}
    (tmp_path / "plugInfo.json").write_text(json.dumps({"Plugins": [plugin]}))
    tree = xform("World", xform("Set", xform("Cup", cube("a"), kind="prop"), cube("b"), kind="setpiece"), kind="group")
    code = (
        "import json, sys; from usd2kg.scene import read_scene\n"
        "print(json.dumps({o.prim_path: o.selected_by for o in read_scene(sys.argv[1]).objects}))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(write_stage(METRES + tree))],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PXR_PLUGINPATH_NAME": str(tmp_path)},
    )
    assert json.loads(done.stdout) == {"/World/Set/Cup": KIND, "/World/Set/b": OWNER}


def test_a_name_is_kept_below_wrappers_without_one(read):
    panel = xform("Xform_1", xform("Xform_2", xform("ControlPanel", xform("group_7", cube("mesh_1")))))
    scene = read(xform("World", xform("Cells", panel, xform("Robot", cube("arm"), cube("base")))))
    assert chosen(scene) == {"/World/Cells/Xform_1/Xform_2/ControlPanel": OWNER, "/World/Cells/Robot": OWNER}


@pytest.mark.parametrize("room", ["Office", "meeting_room_2", "SM_Kitchen_01"])
def test_the_only_object_of_a_room_is_kept(read, room):
    hall = xform("Hallway", xform("Bench", cube("mesh")), xform("Lamp", cube("mesh")))
    scene = read(xform("World", xform(room, xform("Desk", cube("mesh"))), hall))
    assert [*chosen(scene)] == [f"/World/{room}/Desk", "/World/Hallway/Bench", "/World/Hallway/Lamp"]


def test_a_wrapper_of_one_part_beside_groups_is_the_object(read):
    chairs = xform(
        "Chairs", xform("Chair_1", xform("Seat", cube("mesh"))), xform("Chair_2", xform("Seat", cube("mesh")))
    )
    scene = read(
        xform("World", chairs, xform("Table", xform("Top", cube("mesh"))), xform("Lamp", xform("Shade", cube("x"))))
    )
    paths = [path.removeprefix("/World/") for path in chosen(scene)]
    assert paths == ["Chairs/Chair_1", "Chairs/Chair_2", "Table", "Lamp"]


def test_unknown_kind_counts_as_none(read):
    scene = read(xform("World", xform("Cup", cube("a"), kind="crockery"), cube("b")))
    assert chosen(scene) == {"/World/Cup": OWNER, "/World/b": OWNER}


def test_component_around_the_whole_scene_is_not_an_object(read):
    scene = read(component("Room", rigid("Chair", cube("a")), rigid("Table", cube("b"))))
    assert chosen(scene) == {"/Room/Chair": BODY, "/Room/Table": BODY}


def test_component_that_is_the_whole_file_is_the_object(read):
    assert chosen(read(component("Chair", cube("leg"), cube("seat")))) == {"/Chair": KIND}


def test_root_cabinet_with_drawers_stays_an_object(read):
    # It has its own carcass and another object beside it, so it is not a room.
    cabinet = component("Cabinet", cube("carcass"), rigid("Upper", cube("a")), rigid("Lower", cube("b")))
    scene = read(cabinet + component("Table", cube("top")))
    assert chosen(scene) == {"/Cabinet": KIND, "/Cabinet/Upper": BODY, "/Cabinet/Lower": BODY, "/Table": KIND}


# --- rigid bodies ------------------------------------------------------------------------------------


def test_nested_bodies_are_objects_in_objects(read):
    handle = rigid("Handle", cube("bar"))
    cabinet = rigid("Cabinet", cube("carcass"), rigid("Drawer", cube("front"), handle))
    scene = read(xform("World", cabinet, rigid("Chair", cube("seat"))))
    assert set(chosen(scene).values()) == {BODY}
    assert parents(scene) == {"Cabinet": None, "Drawer": "Cabinet", "Handle": "Drawer", "Chair": None}


def test_prim_with_a_mass_is_a_body_and_a_mesh_with_one_is_a_part(read):
    massive = xform("Pot", cube("a"), cube("b"), apis=["PhysicsMassAPI"])
    part = cube("c", meta=['prepend apiSchemas = ["PhysicsMassAPI"]'])
    scene = read(xform("World", massive, xform("Pan", part, cube("d"))))
    assert chosen(scene) == {"/World/Pot": BODY, "/World/Pan": OWNER}


def test_body_that_wraps_one_body_is_that_object(read):
    wrapper = rigid("Door_out", rigid("Door", cube("panel")))
    scene = read(xform("World", wrapper, cube("box")))
    assert chosen(scene) == {"/World/Door_out": BODY, "/World/box": OWNER}


def test_body_that_wraps_several_bodies_groups_them(read):
    wrapper = rigid("Counter", rigid("Left", cube("a")), rigid("Right", cube("b")))
    scene = read(xform("World", wrapper, cube("box")))
    assert list(chosen(scene)) == ["/World/Counter/Left", "/World/Counter/Right", "/World/box"]


def test_component_that_wraps_several_bodies_stays(read):
    kitchen = component("Cabinet", rigid("Left", cube("a")), rigid("Right", cube("b")))
    scene = read(xform("World", kitchen, cube("box")))
    assert parents(scene) == {"Cabinet": None, "Left": "Cabinet", "Right": "Cabinet", "box": None}


def test_body_with_some_own_geometry_is_not_a_wrapper(read):
    scene = read(xform("World", rigid("Door_out", cube("hinge"), rigid("Door", cube("panel"))), cube("box")))
    assert parents(scene) == {"Door_out": None, "Door": "Door_out", "box": None}


def test_body_of_guide_geometry_alone_is_left_out(read):
    scene = read(xform("World", rigid("Collider", cube("hull", purpose="guide")), cube("box"), cube("mat")))
    assert list(chosen(scene)) == ["/World/box", "/World/mat"]
    assert scene.left_out == {"grouping of objects": 1, "guide or proxy geometry": 2}


def test_body_whose_mesh_is_missing_is_kept(read):
    # An importer that could not find the mesh leaves an empty frame in its place.
    shelf = rigid("Shelf", xform("visual"), cube("hull", purpose="guide"))
    scene = read(xform("World", shelf, rigid("Joint"), cube("box")))
    assert chosen(scene) == {"/World/Shelf": BODY, "/World/box": OWNER}
    assert scene.by_path["/World/Shelf"].box is None
    assert [(note.code, note.prim_path) for note in scene.diagnostics] == [("empty-box", "/World/Shelf")]


def arm(links, joint="PhysicsRevoluteJoint"):
    """Return nested bodies link0…, each moved by a joint, and the joints."""
    tree, path, joints = "", "/World/link0", []
    for index in range(1, links + 1):
        path += f"/link{index}"
        joints.append(prim(joint, f"joint{index}", f"rel physics:body1 = <{path}>"))
    for index in range(links, -1, -1):
        tree = rigid(f"link{index}", cube(f"mesh{index}"), tree)
    return tree, xform("joints", *joints)


def test_chain_of_four_turning_joints_is_one_robot(read):
    scene = read(xform("World", *arm(4), cube("box")))
    assert chosen(scene) == {"/World/link0": ROBOT, "/World/box": OWNER}
    # link1-4 and mesh0-4 are parts, the four joints physics.
    assert scene.left_out == {"grouping of objects": 1, "no geometry": 1, "part of an object": 9, "physics": 4}


@pytest.mark.parametrize(("links", "joint"), [(3, "PhysicsRevoluteJoint"), (4, "PhysicsPrismaticJoint")])
def test_short_or_sliding_chains_are_furniture(read, links, joint):
    scene = read(xform("World", *arm(links, joint), cube("box")))
    assert len(scene.objects) == links + 2


# --- asset boundaries --------------------------------------------------------------------------------


@pytest.mark.parametrize("arc", ["references", "payload", "instanceable = true\nreferences"])
def test_what_brings_in_an_asset_is_an_object(read, write_asset, arc):
    asset = write_asset("Cup", cube("body"), cube("handle"))
    cups = [prim("", name, meta=[f"{arc} = @{asset}@"]) for name in ("Cup1", "Cup2")]
    scene = read(xform("World", xform("Crockery", *cups)))
    assert chosen(scene) == {"/World/Crockery/Cup1": ASSET, "/World/Crockery/Cup2": ASSET}
    shared = {obj.instance_of for obj in scene.objects}
    assert len(shared) == 1
    assert (shared == {None}) == ("instanceable" not in arc)


def test_asset_within_an_asset_is_a_part(read, write_asset):
    write_asset("Handle", cube("bar"))
    door = write_asset("Door", cube("panel"), reference("Grip", "handle.usda"))
    scene = read(xform("World", reference("Door1", door), cube("box")))
    assert list(chosen(scene)) == ["/World/Door1", "/World/box"]


def test_referenced_set_of_several_assets_is_structure(read, write_asset):
    cup = write_asset("Cup", cube("body"))
    tray = write_asset("Tray", reference("A", cup), reference("B", cup))
    scene = read(xform("World", reference("Breakfast", tray), cube("box")))
    assert chosen(scene) == {"/World/Breakfast/A": ASSET, "/World/Breakfast/B": ASSET, "/World/box": OWNER}


def test_referenced_group_is_structure(read, write_asset):
    room = write_asset("Room", cube("floor"), cube("wall"), kind="group")
    assert list(chosen(read(xform("World", reference("R", room))))) == ["/World/R/floor", "/World/R/wall"]


def test_referenced_mesh_is_not_an_asset_boundary(read, write_stage):
    write_stage('(\n    defaultPrim = "Leg"\n)\n' + cube("Leg"), "leg.usda")
    legs = [prim("Cube", name, meta=["references = @leg.usda@"]) for name in ("leg1", "leg2")]
    assert chosen(read(xform("World", xform("Stool", *legs), cube("box")))) == {
        "/World/Stool": OWNER,
        "/World/box": OWNER,
    }


def test_reference_without_geometry_is_not_an_object(read, write_stage):
    write_stage('(\n    defaultPrim = "Rig"\n)\n' + xform("Rig", prim("SphereLight", "key")), "rig.usda")
    assert list(chosen(read(xform("World", reference("Lights", "rig.usda"), cube("a"), cube("b"))))) == [
        "/World/a",
        "/World/b",
    ]


# --- geometry that no model covers -------------------------------------------------------------------


def test_bare_meshes_below_the_root_are_objects(read):
    scene = read(xform("World", cube("Floor"), cube("Wall")))
    assert chosen(scene) == {"/World/Floor": OWNER, "/World/Wall": OWNER}


def test_bare_meshes_below_a_scope_are_objects(read):
    scene = read(xform("World", prim("Scope", "Things", cube("Cup"), cube("Pot"))))
    assert list(chosen(scene)) == ["/World/Things/Cup", "/World/Things/Pot"]


@pytest.mark.parametrize(
    ("name", "is_grouping"),
    [
        ("Props_Group", True),
        ("PropsGroup", True),
        ("Furniture", True),
        ("GRP", True),
        ("Group_Therapy_Chair", False),
        ("Offset", False),  # ends in "set" and is not a set
    ],
)
def test_an_xform_named_as_a_grouping_is_one(read, name, is_grouping):
    scene = read(xform("World", xform(name, cube("cup"), cube("pot")), cube("box")))
    both = [f"/World/{name}/cup", f"/World/{name}/pot"]
    assert list(chosen(scene)) == [*(both if is_grouping else [f"/World/{name}"]), "/World/box"]


def test_an_xform_of_several_meshes_is_one_object(read):
    scene = read(xform("World", xform("Chair", cube("seat"), cube("leg")), xform("Table", cube("top"))))
    assert chosen(scene) == {"/World/Chair": OWNER, "/World/Table": OWNER}


def test_xforms_around_one_mesh_are_one_object_at_the_outermost(read):
    scene = read(xform("World", xform("Chair", xform("visual", cube("mesh"))), cube("box")))
    assert list(chosen(scene)) == ["/World/Chair", "/World/box"]


def test_an_xform_that_holds_a_model_groups_the_meshes_beside_it(read):
    scene = read(xform("World", xform("Corner", component("Lamp", cube("bulb")), cube("Rug"))))
    assert chosen(scene) == {"/World/Corner/Lamp": KIND, "/World/Corner/Rug": OWNER}


def test_file_of_a_single_asset_is_one_object(read):
    assert chosen(read(xform("Teapot", cube("body")))) == {"/Teapot": OWNER}


def test_mesh_as_root_prim_is_an_object(read):
    assert list(chosen(read(cube("Teapot"), cube("Cup")))) == ["/Teapot", "/Cup"]


def test_deep_nesting_is_read(read):
    # Deeper than Python's default limit of 1000 calls.
    tree = cube("mesh")
    for index in range(1100):
        tree = xform(f"n{index}", tree)
    scene = read(tree + cube("box"))
    assert len(scene.objects) == 2


# --- point instancers --------------------------------------------------------------------------------


def instancer(name, *lines, where="/World"):
    return prim("PointInstancer", name, *lines, f"rel prototypes = [<{where}/{name}/Blade>, <{where}/{name}/Stone>]",
                cube("Blade"), cube("Stone"))  # fmt: skip


FIVE = ["int[] protoIndices = [0, 1, 0, 0, 0]", "point3f[] positions = [(0,0,0), (1,0,0), (2,0,0), (3,0,0), (9,0,0)]"]


def test_point_instancer_is_one_object_with_count_and_prototypes(read):
    scene = read(xform("World", instancer("Grass", *FIVE), cube("box")))
    grass = scene.by_path["/World/Grass"]
    assert grass.selected_by == "point instancer"
    assert (grass.instances.count, grass.instances.prototypes) == (5, ("Blade", "Stone"))
    # Cubes of 1 m from x = 0 to x = 9: from -0.5 to 9.5.
    assert grass.box.size == pytest.approx((10, 1, 1))
    assert grass.own_box == grass.box
    assert scene.prim_count == 3  # the prototypes are not visited
    assert scene.by_path["/World/box"].instances is None


def test_copies_that_are_not_drawn_do_not_count(read):
    hidden = [*FIVE, "int64[] ids = [0, 1, 2, 3, 4]", "int64[] invisibleIds = [4]"]
    grass = read(xform("World", instancer("Grass", *hidden), cube("box"))).by_path["/World/Grass"]
    assert grass.box.size == pytest.approx((4, 1, 1))  # -0.5 to 3.5
    assert grass.instances.count == 4


def test_copies_that_move_are_counted_at_the_time_that_is_read(read):
    moving = [line.replace(" = ", ".timeSamples = {1: ") + "}" for line in FIVE]
    layer = METRES.replace("(\n", "(\n    startTimeCode = 1\n    endTimeCode = 2\n", 1)
    scene = read(xform("World", instancer("Grass", *moving), cube("box")), layer=layer)
    assert scene.by_path["/World/Grass"].instances.count == 5


def test_component_that_wraps_an_instancer_keeps_the_count(read):
    meadow = component("Meadow", instancer("Grass", *FIVE, where="/World/Meadow"))
    scene = read(xform("World", meadow, cube("box")))
    assert [obj.instances.count for obj in scene.objects if obj.instances] == [5]


# --- requested paths ----------------------------------------------------------------------------


def test_requested_paths_are_added_in_traversal_order(read):
    chair = component("Chair", cube("leg"), cube("seat"))
    scene = read(xform("World", chair, cube("box")), paths=["/World/Chair/seat", "/World", "/World/box"])
    assert chosen(scene) == {
        "/World": "asked for by path",
        "/World/Chair": KIND,
        "/World/Chair/seat": "asked for by path",
        "/World/box": OWNER,
    }
    assert parents(scene) == {"World": None, "Chair": "World", "seat": "Chair", "box": "World"}
    assert scene.missing_paths == ()


def test_missing_paths_are_listed_in_the_requested_order(read):
    scene = read(xform("World", cube("box")), paths=["/World/Z", "/World/box", "no path", "/", "/World/A"])
    assert scene.missing_paths == ("/World/Z", "no path", "/", "/World/A")
    assert "/World/box" in scene.by_path


def test_requested_paths_are_not_counted_as_left_out(read):
    tree = xform("World", component("Chair", cube("leg"), cube("seat")), cube("box"))
    without, asked = read(tree), read(tree, paths=["/World/Chair/seat"])
    assert without.left_out["part of an object"] == 2
    assert asked.left_out["part of an object"] == 1


def test_requests_a_prim_on_a_stage_without_geometry(read):
    scene = read(xform("World", xform("Anchor")), paths=["/World/Anchor"])
    assert [obj.name for obj in scene.objects] == ["Anchor"]


# --- fixtures of bodies ------------------------------------------------------------------------------


def frame(name):
    return xform(name)


def test_fixtures_built_into_a_body_are_objects(read):
    scene = read(xform("World", rigid("counter", cube("top"), cube("faucet")), cube("box")))
    fixture = "/World/counter/faucet"
    assert chosen(scene) == {"/World/counter": BODY, fixture: "fixture of counter", "/World/box": OWNER}
    assert parents(scene)["faucet"] == "counter"
    assert scene.by_path["/World/counter"].parts == ("top",)


def test_fixtures_below_the_frames_of_a_body_are_objects(read):
    visuals = xform("visuals", xform("SM_Faucet_01", cube("spout"), cube("lever")))
    scene = read(xform("World", rigid("unit", cube("top"), visuals), cube("box")))
    assert list(chosen(scene)) == ["/World/unit", "/World/unit/visuals/SM_Faucet_01", "/World/box"]
    assert scene.by_path["/World/unit/visuals/SM_Faucet_01"].parts == ("spout", "lever")


def test_fixtures_may_be_frames_whose_mesh_is_part_of_the_body(read):
    scene = read(xform("World", rigid("stove", cube("top"), frame("hotplate1"), frame("hotplate2")), cube("box")))
    assert [name for name, above in parents(scene).items() if above == "stove"] == ["hotplate1", "hotplate2"]
    assert scene.by_path["/World/stove/hotplate1"].box is None


@pytest.mark.parametrize(
    ("body", "part", "is_fixture"),
    [
        ("sink", "sink_basin", True),
        ("sink", "sink_visual", False),  # the body itself by its own name
        ("kitchen_sink", "sink", False),
        ("sink", "basin_sink", False),
        ("unit", "faucet_handle", False),  # the last word decides
        ("unit", "Faucet_LOD0", True),
        ("unit", "board", False),
    ],
)
def test_the_last_word_of_a_name_decides_on_fixtures(read, body, part, is_fixture):
    scene = read(xform("World", rigid(body, cube("mesh"), cube(part)), cube("box")))
    assert (f"/World/{body}/{part}" in scene.by_path) == is_fixture


def test_fixtures_of_authored_components_are_parts(read):
    scene = read(xform("World", component("counter", cube("top"), cube("faucet")), rigid("cup", cube("a"))))
    assert chosen(scene) == {"/World/counter": KIND, "/World/cup": BODY}


def test_fixtures_that_only_collide_are_parts(read):
    counter = rigid("counter", cube("top"), cube("faucet", purpose="guide"))
    assert list(chosen(read(xform("World", counter, cube("box"))))) == ["/World/counter", "/World/box"]


def test_fixtures_of_a_body_within_a_body_belong_to_the_inner_one(read):
    drawer = rigid("drawer", cube("front"), cube("burner"))
    scene = read(xform("World", rigid("unit", cube("top"), drawer), cube("box")))
    assert parents(scene) == {"unit": None, "drawer": "unit", "burner": "drawer", "box": None}


# --- unnamed pieces ------------------------------------------------------------------------


@pytest.mark.parametrize("piece", ["mesh_{}", "part{}_obj", "Object_{}", "solid{}_LOD0", "n{}"])
def test_a_named_prim_with_unnamed_pieces_is_one_object(read, piece):
    pieces = [xform(f"group_{index}", cube(piece.format(index))) for index in (1, 2, 3)]
    scene = read(xform("World", xform("Chair", *pieces), xform("Table", cube("top"))))
    assert chosen(scene) == {"/World/Chair": OWNER, "/World/Table": OWNER}


def test_pieces_named_by_maya_are_unnamed(read):
    pieces = [xform(f"group_{index}", cube(f"polySurface{index}")) for index in (1, 2, 3)]
    assert list(chosen(read(xform("World", xform("Chair", *pieces), cube("box"))))) == ["/World/Chair", "/World/box"]


def test_unnamed_pieces_deeper_down_are_still_pieces(read):
    pieces = [xform(f"group_{i}", *(xform(f"node_{j}", cube(f"mesh_{j}")) for j in (1, 2))) for i in (1, 2)]
    assert list(chosen(read(xform("World", xform("Chair", *pieces), cube("box"))))) == ["/World/Chair", "/World/box"]


def test_one_named_piece_keeps_all_pieces_separate(read):
    pieces = xform("n1", cube("mesh_1")) + xform("Cushion", cube("mesh_2"))
    scene = read(xform("World", xform("Chair", pieces), cube("box")))
    assert list(chosen(scene)) == ["/World/Chair/n1", "/World/Chair/Cushion", "/World/box"]


@pytest.mark.parametrize("name", ["Furniture", "Chair_grp"])
def test_a_grouping_does_not_merge_unnamed_pieces(read, name):
    pieces = [xform(f"n{index}", cube(f"mesh_{index}")) for index in (1, 2)]
    scene = read(xform("World", xform("Corner", component("Lamp", cube("bulb")), xform(name, *pieces)), cube("box")))
    assert f"/World/Corner/{name}" not in scene.by_path
    assert [path for path in chosen(scene) if "/n" in path] == [f"/World/Corner/{name}/n{index}" for index in (1, 2)]


def test_the_root_of_the_stage_does_not_merge_unnamed_pieces(read):
    pieces = [xform(f"n{index}", cube(f"mesh_{index}")) for index in (1, 2)]
    assert list(chosen(read(xform("Kitchen", *pieces)))) == ["/Kitchen/n1", "/Kitchen/n2"]


# --- robots whose links lie side by side -------------------------------------------------------------


def joint(index, body0, body1, type_name="PhysicsRevoluteJoint", holder="/World/Arm"):
    sides = [f"rel physics:body{side} = <{holder}/{body}>" for side, body in ((0, body0), (1, body1)) if body]
    return prim(type_name, f"joint{index}", *sides)


def links(*more, count=5, holder="/World/Arm", world=False):
    """Return an Xform of bodies side by side that turning joints make a chain."""
    bodies = [rigid(f"link{index}", cube(f"mesh{index}")) for index in range(count)]
    chain = [joint(i, f"link{i - 1}", f"link{i}", holder=holder) for i in range(1, count)]
    base = [joint(0, None, "link0", "PhysicsFixedJoint", holder=holder)] if world else []
    return xform(holder.rpartition("/")[2], *bodies, *base, *chain, *more)


@pytest.mark.parametrize("world", [False, True])
def test_five_sibling_links_are_one_robot(read, world):
    scene = read(xform("World", links(world=world), cube("box")))
    assert chosen(scene) == {"/World/Arm": ROBOT, "/World/box": OWNER}
    assert scene.by_path["/World/Arm"].parts[:2] == ("link0", "mesh0")


def test_sibling_links_within_an_instance_are_one_robot(read, write_stage):
    write_stage('(\n    defaultPrim = "Arm"\n)\n' + links(holder="/Arm"), "arm.usda")
    arms = [reference(f"Arm{index}", "arm.usda", meta=["instanceable = true"]) for index in (1, 2)]
    assert chosen(read(xform("World", *arms, cube("box")))) == {
        "/World/Arm1": ROBOT,
        "/World/Arm2": ROBOT,
        "/World/box": OWNER,
    }


def test_four_links_have_too_few_joints_for_a_robot(read):
    scene = read(xform("World", links(count=4), cube("box")))
    assert [obj.selected_by for obj in scene.objects] == [BODY] * 4 + [OWNER]


@pytest.mark.parametrize("other", [rigid("Cup", cube("a")), component("Cup", cube("a"))], ids=["body", "component"])
def test_links_beside_another_object_are_not_merged(read, other):
    scene = read(xform("World", links(other), cube("box")))
    assert ROBOT not in chosen(scene).values()
    assert len(scene.objects) == 7


def test_links_below_the_root_beside_other_objects_are_not_merged(read):
    scene = read(links(cube("Table"), rigid("Cup", cube("a")), holder="/World"))
    assert ROBOT not in chosen(scene).values()
    assert len(scene.objects) == 7


def test_wheels_on_one_base_are_not_an_arm(read):
    wheels = [rigid(f"wheel{index}", cube(f"tyre{index}")) for index in range(6)]
    joints = [joint(index, "chassis", f"wheel{index}") for index in range(6)]
    cart = xform("Arm", rigid("chassis", cube("deck")), *wheels, *joints)
    scene = read(xform("World", cart, cube("box")))
    assert [obj.selected_by for obj in scene.objects] == [BODY] * 7 + [OWNER]


@pytest.mark.parametrize("closing", [("link4", "link0"), ("link4", "link1"), ("link2", "link2")])
def test_cyclic_joints_terminate(read, closing):
    # Which of the two joints at the closing body counts is undefined.
    scene = read(xform("World", links(joint(9, *closing)), cube("box")))
    assert "/World/box" in scene.by_path
    assert len(scene.objects) in {2, 6}


def test_a_robot_beside_furniture_with_joints(read):
    drawers = [rigid(f"Drawer{index}", cube(f"front{index}")) for index in range(6)]
    slides = [joint(i, "Case", f"Drawer{i}", "PhysicsPrismaticJoint", "/World/Cabinet") for i in range(5)]
    door = joint(5, "Case", "Drawer5", holder="/World/Cabinet")
    cabinet = xform("Cabinet", rigid("Case", cube("carcass")), *drawers, *slides, door)
    found = chosen(read(xform("World", links(), cabinet, cube("box"))))
    assert found.pop("/World/Arm") == ROBOT
    assert found == {
        "/World/Cabinet/Case": BODY,
        **{f"/World/Cabinet/Drawer{index}": BODY for index in range(6)},
        "/World/box": OWNER,
    }


def test_two_robots_are_two(read):
    scene = read(xform("World", links(), links(holder="/World/Arm2", count=7), cube("box")))
    assert chosen(scene) == {"/World/Arm": ROBOT, "/World/Arm2": ROBOT, "/World/box": OWNER}


def test_a_robot_fixed_to_a_table_does_not_merge_the_room(read):
    bodies = [f"rel physics:body{side} = <{path}>" for side, path in ((0, "/World/Table"), (1, "/World/Arm/link0"))]
    bolt = prim("PhysicsFixedJoint", "bolt", *bodies)
    found = chosen(read(xform("World", links(bolt), rigid("Table", cube("top")), xform("Sofa", cube("a"), cube("b")))))
    assert found["/World/Table"] == BODY
    assert found["/World/Sofa"] == OWNER


@pytest.mark.parametrize("holder", ["/World", "/World/Corner"])
def test_a_robot_does_not_merge_the_objects_beside_it(read, holder):
    arm = links(xform("Sofa", cube("seat"), cube("back")), holder=holder)
    scene = read(arm if holder == "/World" else xform("World", arm, cube("box")))
    assert f"{holder}/Sofa" in scene.by_path
