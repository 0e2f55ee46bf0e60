"""Meshes whose authored extent is not that of their points."""

import pytest

from tests.scene.usda import METRES, component, cube, header, move, ops, prim, xform
from usd2kg.scene import read_scene

CORNERS = [(x, y, z) for z in (0, 0.3) for y in (0, 0.3) for x in (0, 0.3)]
FACES = "0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5"
EXTENT = "float3[] extent = [(0.14, 0.14, 0.14), (0.16, 0.16, 0.16)]"
MESSAGE = (
    "its extent is 0.02 × 0.02 × 0.02 stage units about (0.15, 0.15, 0.15), but its points are 0.3 × 0.3 × 0.3 about "
    "(0.15, 0.15, 0.15); the points are measured; author the extent again"
)


def block(name, *lines, extent=EXTENT):
    """Return a cube of 30 cm with an extent of 2 cm."""
    faces = [f"int[] faceVertexCounts = {[4] * 6}", f"int[] faceVertexIndices = [{FACES}]"]
    return prim("Mesh", name, f"point3f[] points = {CORNERS}", *faces, extent, *lines)


def stale(scene):
    return [(note.prim_path, note.message) for note in scene.diagnostics if note.code == "extent"]


@pytest.mark.parametrize("spacing", [0.01, 1.0])
def test_points_are_measured_where_the_extent_is_stale(read, spacing):
    """Objects near each other have surfaces; of those that seem to be alone, some are compared."""
    blocks = [component(name, block("mesh", move(place * (0.3 + spacing), 0, 0))) for place, name in enumerate("AB")]
    scene = read(xform("World", *blocks))
    for obj in scene.objects:
        assert obj.box.size == pytest.approx((0.3, 0.3, 0.3))
    assert stale(scene) == [("/World/A/mesh", MESSAGE), ("/World/B/mesh", MESSAGE)]


def test_the_box_of_the_object_above_contains_the_points(read):
    inner = component("Drawer", block("mesh"))
    desk = read(component("Desk", inner, cube("top", size=0.1))).by_path["/Desk"]
    assert desk.box.upper == pytest.approx((0.3, 0.3, 0.3))


def test_what_only_seemed_to_be_apart_has_surfaces_after_measuring_points(read):
    round_table = prim("Cylinder", "Table", "double radius = 0.5", "double height = 0.2", move(0.15, 0.15, -0.1))
    table = component("Table", round_table)
    scene = read(xform("World", table, component("Block", block("mesh"))))
    assert scene.by_path["/World/Block"].box.lower[2] == 0
    assert set(scene.surfaces) == {"/World/Table"}


@pytest.mark.parametrize("turn", [0, 45])
def test_instances_of_a_stale_mesh_are_reported_once(write_stage, turn):
    write_stage(METRES + xform("Box", block("mesh")), "box.usda")
    meta = ["references = @box.usda@</Box>", "instanceable = true", 'kind = "component"']
    places = [ops(("double3", "translate", (i, 0, 0)), ("double", "rotateZ", turn)) for i in range(3)]
    boxes = [prim("Xform", f"Box_{number}", place, meta=meta) for number, place in enumerate(places)]
    scene = read_scene(write_stage(METRES + xform("World", *boxes)))
    # A turned square of 0.3 is 0.3 * sqrt(2) wide.
    side = {0: 0.3, 45: 0.4242641}[turn]
    assert [obj.box.size for obj in scene.objects] == [pytest.approx((side, side, 0.3), abs=1e-6)] * 3
    assert stale(scene) == [("/World/Box_0/mesh", MESSAGE)]


def test_a_shifted_extent_and_other_units(read):
    shifted = "float3[] extent = [(1, 0, 0), (1.3, 0.3, 0.3)]"
    scene = read(component("A", block("mesh", extent=shifted)), layer=header(metersPerUnit=100, upAxis="Z"))
    assert scene.objects[0].box.lower == pytest.approx((0, 0, 0))
    (note,) = stale(scene)
    assert "0.3 × 0.3 × 0.3 stage units about (1.15, 0.15, 0.15), but its points are 0.3 × 0.3 × 0.3 about" in note[1]


@pytest.mark.parametrize(
    "lines",
    [["int[] primvars:skel:jointIndices = [0]"], ["rel skel:skeleton = </Rig>"]],
)
def test_extents_of_skinned_meshes_are_not_compared(read, lines):
    """The skeleton moves the points."""
    assert stale(read(component("A", block("mesh", *lines)))) == []


@pytest.mark.parametrize(
    "extent",
    [
        "float3[] extent = [(0, 0, 0), (0.3, 0.3, 0.3)]",
        "float3[] extent = [(1, 1, 1), (-1, -1, -1)]",
        "float3[] extent = [(-inf, 0, 0), (inf, 1, 1)]",
        "float3[] extent = []",
        "",
    ],
)
def test_right_and_unusable_extents_are_no_stale_ones(read, extent):
    scene = read(component("A", block("mesh", extent=extent)))
    assert (stale(scene), scene.objects[0].box.size) == ([], pytest.approx((0.3, 0.3, 0.3)))
