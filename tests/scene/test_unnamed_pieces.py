"""Unnamed pieces that are connected are merged into one object."""

import pytest

from tests.scene.usda import component, cube, move, rigid, xform

PIECES = "connected unnamed pieces"
OWNER = "geometry without a model above it"


def chosen(scene):
    """Return prim path → why it is an object, in order."""
    return {obj.prim_path: obj.selected_by for obj in scene.objects}


def sketched_chair(name, x):
    """Return a chair as modelling tools export it: a group of groups of one mesh, 1 m high."""
    legs = [
        xform(f"Group_{i}", cube(f"Mesh_{i}", size=0.1, at=(0.4 * (i % 2), 0.4 * (i // 2), 0.05))) for i in range(4)
    ]
    seat = xform("Group_4", cube("Mesh_4", size=0.5, at=(0.2, 0.2, 0.35)))
    back = xform("Group_5", cube("Mesh_5", size=0.4, at=(0.2, 0.2, 0.8)))
    return xform(name, move(x, 0, 0), *legs, seat, back)


def test_each_group_of_unnamed_pieces_is_one_object(read):
    scene = read(xform("World", *(sketched_chair(f"Group_{10 + i}", 3 * i) for i in range(4))))
    assert chosen(scene) == {f"/World/Group_{10 + i}": PIECES for i in range(4)}
    assert scene.objects[0].box.size == pytest.approx((0.5, 0.5, 1.0))
    assert scene.objects[0].parts == (
        *(f"{kind}_{i}" for i in range(4) for kind in ("Group", "Mesh")),
        *("Group_4", "Mesh_4", "Group_5", "Mesh_5"),
    )


def test_a_group_of_several_merged_objects_is_not_an_object(read):
    """3 m apart they do not touch: the outer group is a grouping."""
    chairs = [sketched_chair(f"Group_{10 + i}", 3 * i) for i in range(2)]
    scene = read(xform("World", xform("Group_1", *chairs), cube("floor", size=9, at=(0, 0, -4.5))))
    assert chosen(scene) == {
        "/World/Group_1/Group_10": PIECES,
        "/World/Group_1/Group_11": PIECES,
        "/World/floor": OWNER,
    }


def test_the_outermost_group_with_the_same_pieces_is_the_object(read):
    scene = read(xform("World", xform("Node_1", sketched_chair("Group_10", 0)), cube("floor", size=9)))
    assert PIECES in chosen(scene)["/World/Node_1"]


@pytest.mark.parametrize(
    ("gap", "is_one"), [pytest.param(0.02, True, id="the gap that is bridged"), pytest.param(0.03, False, id="beyond")]
)
def test_pieces_are_connected_across_two_centimetres(read, gap, is_one):
    pieces = [xform(f"Group_{i}", cube(f"Mesh_{i}", size=0.5, at=((0.5 + gap - 1e-6) * i, 0, 0))) for i in range(3)]
    scene = read(xform("World", xform("Group_9", *pieces), cube("floor", size=9, at=(0, 0, -9))))
    assert ("/World/Group_9" in chosen(scene)) is is_one
    assert len(scene.objects) == (2 if is_one else 4)


def test_pieces_larger_than_furniture_are_not_merged(read):
    pieces = [xform(f"Group_{i}", cube(f"Mesh_{i}", at=(i, 0, 0))) for i in range(4)]
    scene = read(xform("World", xform("Group_9", *pieces), cube("floor", size=9, at=(0, 0, -9))))
    assert len(scene.objects) == 5


def test_named_pieces_are_not_merged(read):
    pieces = [xform("Cup", cube("Mesh_1", size=0.1)), xform("Group_2", cube("Mesh_2", size=0.1))]
    scene = read(xform("World", xform("Group_9", *pieces), cube("floor", size=9, at=(0, 0, -9))))
    assert set(chosen(scene)) == {"/World/Group_9/Cup", "/World/Group_9/Group_2/Mesh_2", "/World/floor"}


def test_pieces_of_several_meshes_are_not_merged(read):
    """Two touching unnamed objects of two meshes each, like a table with a chair pushed under it."""
    things = [
        xform(
            f"part{i}_obj", cube("Mesh_1", size=0.4, at=(0.4 * i, 0, 0)), cube("Mesh_2", size=0.4, at=(0.4 * i, 0, 0.4))
        )
        for i in range(2)
    ]
    scene = read(xform("World", xform("Node_9", *things), cube("floor", size=9, at=(0, 0, -9))))
    assert set(chosen(scene)) == {"/World/Node_9/part0_obj", "/World/Node_9/part1_obj", "/World/floor"}


@pytest.mark.parametrize("make", [component, rigid])
def test_models_and_bodies_are_not_merged(read, make):
    models = [make(f"part{i}_obj", cube(f"Mesh_{i}", size=0.5, at=(0.5 * i, 0, 0))) for i in range(3)]
    scene = read(xform("World", xform("Group_9", *models), cube("floor", size=9, at=(0, 0, -9))))
    assert len(scene.objects) == 4


def test_disconnected_meshes_in_a_room_are_objects(read):
    lamps = [cube(f"Mesh_{i}", size=0.2, at=(2 * i, 0, 0)) for i in range(4)]
    scene = read(xform("World", xform("Node_1", *lamps), cube("floor", size=9, at=(0, 0, -9))))
    assert set(chosen(scene)) == {*(f"/World/Node_1/Mesh_{i}" for i in range(4)), "/World/floor"}


def test_connected_meshes_of_a_large_object_stay_one_object(read):
    wall = [cube(f"Mesh_{i}", at=(i, 0, 0)) for i in range(5)]
    scene = read(xform("World", xform("Node_1", *wall), cube("floor", size=9, at=(0, 0, -9))))
    assert set(chosen(scene)) == {"/World/Node_1", "/World/floor"}


def test_a_room_of_thousands_of_pieces(read):
    """A hundred chairs of 50 bits each, 2 m apart: a person counts a hundred."""

    def bits(chair):
        x, y = 2 * (chair % 10), 2 * (chair // 10)
        for i in range(50):
            yield xform(f"Group_{i}", cube(f"Mesh_{i}", size=0.1, at=(x + 0.1 * (i % 5), y, 0.1 * (i // 5))))

    scene = read(xform("Model", *(xform(f"Component_{chair}", *bits(chair)) for chair in range(100))))
    assert chosen(scene) == {f"/Model/Component_{chair}": PIECES for chair in range(100)}


def test_many_unnamed_objects_are_reported(read):
    pieces = [cube(f"Mesh_{i}", size=0.1, at=(0.5 * i, 0, 0)) for i in range(30)]
    scene = read(xform("World", *pieces))
    [note] = [note for note in scene.diagnostics if note.code == "unnamed"]
    assert note.message.startswith("30 of 30 objects have no descriptive name (Mesh_0, Mesh_1, Mesh_2, …)")


def test_few_unnamed_objects_are_not_reported(read):
    named = [cube(f"cup_{i}", size=0.1, at=(0.5 * i, 0, 0)) for i in range(30)]
    scene = read(xform("World", *named, cube("Mesh_1", at=(0, 3, 0))))
    assert not [note for note in scene.diagnostics if note.code == "unnamed"]
