"""Every prim is an object, or is counted once with the reason."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pxr import Usd

from tests.scene.usda import METRES, component, cube, prim, rigid, xform
from usd2kg.errors import SceneError
from usd2kg.scene import read_scene

TWO = cube("a") + cube("b")
"""Two objects below /World, so that /World is a grouping."""


def left_out(read, *body):
    """Return the counts without the grouping /World, and check the sum."""
    scene = read(xform("World", *body, TWO))
    assert [obj.name for obj in scene.objects] == ["a", "b"]
    assert scene.prim_count == len(scene.objects) + sum(scene.left_out.values())
    counts = dict(scene.left_out)
    assert counts.pop("grouping of objects") == 1
    return counts


@pytest.mark.parametrize(
    ("type_name", "reason"),
    [
        ("Camera", "camera"),
        ("SphereLight", "light"),
        ("DomeLight", "light"),
        ("DistantLight", "light"),
        ("Material", "material"),
        ("Shader", "material"),
        ("NodeGraph", "material"),
        ("Skeleton", "skeleton rig"),
        ("SkelAnimation", "skeleton rig"),
        ("PhysicsScene", "physics"),
        ("PhysicsCollisionGroup", "physics"),
        ("PhysicsFixedJoint", "physics"),
        ("RenderSettings", "render settings"),
        ("Xform", "no geometry"),
        ("Scope", "no geometry"),
        ("", "no geometry"),
    ],
)
def test_counts_pruned_prims_by_reason(read, type_name, reason):
    assert left_out(read, prim(type_name, "Odd")) == {reason: 1}


def test_what_is_below_a_left_out_prim_is_not_visited(read):
    # Shader networks are counted as their material.
    network = prim("Material", "Oak", prim("Shader", "surface"), prim("Shader", "texture"))
    assert left_out(read, network) == {"material": 1}


@pytest.mark.parametrize(
    ("meta", "lines", "reason"),
    [
        (["active = false"], [], "inactive"),
        ([], ['token visibility = "invisible"'], "invisible"),
    ],
)
def test_switched_off_geometry_is_left_out_and_switched_on_is_not(read, meta, lines, reason):
    assert left_out(read, cube("Ghost", *lines, meta=meta)) == {reason: 1}
    on = read(xform("World", cube("Ghost", 'token visibility = "inherited"', meta=["active = true"]), TWO))
    assert "/World/Ghost" in on.by_path


def test_classes_are_abstract(read):
    scene = read(prim("Xform", "_chair", cube("seat"), specifier="class"), xform("World", TWO))
    assert scene.left_out == {"abstract": 1, "grouping of objects": 1}


def test_what_inherits_a_class_is_an_object(read):
    base = prim("Xform", "_chair", cube("seat"), specifier="class")
    scene = read(base, xform("World", prim("Xform", "Chair", meta=["inherits = </_chair>"]), TWO))
    assert "/World/Chair" in scene.by_path


def test_overs_alone_define_nothing(read):
    assert left_out(read, prim("Cube", "Ghost", specifier="over")) == {"over without definition": 1}


@pytest.mark.parametrize("purpose", ["guide", "proxy"])
def test_counts_prims_that_contain_only_guides_and_proxies(read, purpose):
    assert left_out(read, xform("Colliders", cube("hull", purpose=purpose))) == {"guide or proxy geometry": 2}


def test_purpose_is_inherited_from_above(read):
    colliders = xform("Colliders", 'uniform token purpose = "guide"', xform("deep", cube("hull")))
    assert left_out(read, colliders) == {"guide or proxy geometry": 3}


def test_distinguishes_parts_and_groupings(read):
    chair = component("Chair", xform("frame", cube("leg")), cube("hull", purpose="guide"), xform("empty"))
    scene = read(xform("World", prim("Scope", "Row", chair), TWO))
    assert scene.left_out == {
        "grouping of objects": 2,  # World, Row
        "part of an object": 2,  # frame, leg
        "guide or proxy geometry": 1,  # hull
        "no geometry": 1,  # empty
    }


def test_reasons_are_sorted(read):
    odd = [prim("Camera", "C"), prim("Shader", "S"), prim("SphereLight", "L")]
    reasons = list(read(xform("World", *odd, TWO)).left_out)
    assert reasons == sorted(reasons)
    assert len(reasons) == 4


# --- any tree ----------------------------------------------------------------------------------------

names = st.sampled_from("Chair Group Mesh_01 Door furniture Lamp".split())
leaves = st.sampled_from(
    [
        cube,
        lambda name: cube(name, purpose="guide"),
        lambda name: cube(name, 'token visibility = "invisible"'),
        lambda name: prim("Camera", name),
        lambda name: prim("Material", name, prim("Shader", "s")),
        lambda name: prim("", name, meta=["references = @gone.usd@"]),
        lambda name: prim("Cube", name, specifier="over"),
        xform,
    ]
)
branches = st.sampled_from(
    [
        xform,
        component,
        rigid,
        lambda name, *body: prim("Scope", name, *body),
        lambda name, *body: xform(name, *body, kind="group"),
        lambda name, *body: xform(name, *body, kind="subcomponent"),
        lambda name, *body: xform(name, *body, meta=["active = false"]),
    ]
)


@st.composite
def trees(draw, depth=3):
    """Return the text of a few sibling prims with different names."""
    found = []
    for name in draw(st.lists(names, unique=True, max_size=3)):
        if depth == 0 or draw(st.booleans()):
            found.append(draw(leaves)(name))
        else:
            found.append(draw(branches)(name, draw(trees(depth=depth - 1))))
    return "\n".join(found)


def check(path, tree, asked=()):
    """Read World with `tree` below; check that objects and counts cover all prims, and return the scene or None."""
    path.write_text("#usda 1.0\n" + METRES + xform("World", tree))
    try:
        scene = read_scene(path, paths=asked)
    except SceneError as error:
        assert "no object" in str(error)
        return None
    paths = [obj.prim_path for obj in scene.objects]
    assert len(set(paths)) == len(paths)
    assert scene.prim_count == len(paths) + sum(scene.left_out.values())

    stage = Usd.Stage.Open(str(path))
    order = [str(prim.GetPath()) for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.PrimAllPrimsPredicate)]
    assert [path for path in order if path in set(paths)] == paths
    for obj in scene.objects:
        above = [path for path in paths if obj.prim_path.startswith(path + "/")]
        assert obj.parent_path == max(above, key=len, default=None)
    return scene


@settings(max_examples=80, deadline=None)
@given(trees())
def test_every_prim_is_an_object_or_counted_once(tmp_path_factory, tree):
    check(tmp_path_factory.getbasetemp() / "any_tree.usda", tree)


@settings(max_examples=40, deadline=None)
@given(trees(), st.lists(st.sampled_from(["/World", "/World/Chair", "/World/Lamp/Door", "/Nowhere"]), max_size=2))
def test_counts_are_complete_with_requested_paths(tmp_path_factory, tree, asked):
    scene = check(tmp_path_factory.getbasetemp() / "asked_tree.usda", tree, asked)
    for path in asked if scene else ():
        assert (path in scene.missing_paths) != (path in scene.by_path)
