"""Surfaces that are kept for the relations, read back in metres and z-up."""

import numpy as np
import pytest

from tests.scene.usda import component, cube, move, prim, xform
from usd2kg.scene.settings import SURFACES

WEDGE = "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]"
FACES = "int[] faceVertexCounts = [3, 3, 3, 3]\nint[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]"


def wedge(name: str, *more: str) -> str:
    return prim("Mesh", name, WEDGE, FACES, *more)


def beside(*things: str) -> str:
    """Return a world of things and a box near all of them."""
    return xform("World", *things, component("Box", cube("m", at=(0.5, 0.5, 0.5))))


def bounds(scene, path="/World/Wedge"):
    surface = scene.surfaces[path]
    return surface.lower.min(axis=0).tolist(), surface.upper.max(axis=0).tolist()


def test_of_a_mesh_near_another_object(read):
    scene = read(beside(component("Wedge", wedge("m"))))
    assert bounds(scene) == ([0, 0, 0], [1, 1, 1])
    assert scene.surfaces["/World/Wedge"].orientation == 1


def test_an_upright_box_needs_none(read):
    assert "/World/Box" not in read(beside(component("Wedge", wedge("m")))).surfaces


def test_a_turned_box_has_one(read):
    turned = 'float xformOp:rotateZ = 30\nuniform token[] xformOpOrder = ["xformOp:rotateZ"]'
    scene = read(beside(component("Wedge", cube("m", at=(0, 0, 0)), turned)))
    assert len(scene.surfaces["/World/Wedge"].corners) == 12


@pytest.mark.parametrize(("gap", "has_one"), [(SURFACES.reach - 1e-3, True), (SURFACES.reach + 1e-3, False)])
def test_far_from_all_others_there_is_none(read, gap: float, has_one: bool):
    # The box is one metre long.
    scene = read(xform("World", component("Wedge", wedge("m")), component("Box", cube("m", at=(1.5 + gap, 0.5, 0.5)))))
    assert ("/World/Wedge" in scene.surfaces) is has_one


def test_in_metres_and_z_up(read):
    layer = '(\n    metersPerUnit = 0.01\n    upAxis = "Y"\n)\n'
    scene = read(xform("World", component("Wedge", wedge("m")), component("Box", cube("m"))), layer=layer)
    # (x, y, z) of the stage is (x, -z, y).
    low, high = bounds(scene)
    assert low == pytest.approx([0, -0.01, 0])
    assert high == pytest.approx([0.01, 0, 0.01])


def test_of_a_moved_and_mirrored_mesh(read):
    mirrored = (
        "double3 xformOp:translate = (1, 0, 0)\nfloat3 xformOp:scale = (-1, 1, 1)\n"
        'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]'
    )
    scene = read(beside(component("Wedge", mirrored, wedge("m"))))
    assert bounds(scene) == ([0, 0, 0], [1, 1, 1])
    assert scene.surfaces["/World/Wedge"].orientation == 1


def test_several_gprims_are_joined_where_they_are(read):
    far = 1e6
    placed = component("Wedge", wedge("a"), wedge("b", move(0, 0, 1)), move(far, 0, 0))
    scene = read(xform("World", placed, component("Box", cube("m", at=(far, 0, 0)))))
    surface = scene.surfaces["/World/Wedge"]
    assert len(surface.pieces) == 1
    # Single precision would be off by 3 cm here.
    assert bounds(scene) == (pytest.approx([far, 0, 0], abs=1e-6), pytest.approx([far + 1, 1, 2], abs=1e-6))


def test_instances_share_their_points(read):
    proto = prim("Xform", "Proto", wedge("m"), specifier="class")
    meta = ["inherits = </Proto>", "instanceable = true", 'kind = "component"']
    scene = read(proto, xform("World", *(prim("Xform", f"W{x}", move(0.5 * x, 0, 0), meta=meta) for x in range(3))))
    first, second, third = (scene.surfaces[f"/World/W{x}"].pieces[0] for x in range(3))
    assert second.points is third.points
    assert np.array_equal(first.points, second.points)
    assert bounds(scene, "/World/W2") == ([1, 0, 0], [2, 1, 1])


def test_a_broken_mesh_has_none(read):
    broken = prim("Mesh", "m", WEDGE, "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 99]")
    scene = read(beside(component("Wedge", broken)))
    assert scene.surfaces == {}


def test_shells_are_those_of_large_objects_around_others(read):
    walls = [cube(f"w{i}", size=1, at=at) for i, at in enumerate([(0, -2, 0), (0, 2, 0), (-2, 0, 0), (2, 0, 0)])]
    ball = component("Ball", prim("Sphere", "m", "double radius = 0.2"))
    scene = read(xform("World", component("Walls", *walls), ball))
    shell = scene.by_path["/World/Walls"].shell_boxes
    # The nearest faces are 1.5 m from the middle, where the ball is.
    nearest = [np.linalg.norm(np.clip(0, box.lower, box.upper)) for box in shell]
    assert min(nearest) == pytest.approx(1.5)
    assert scene.by_path["/World/Ball"].shell_boxes == ()
    assert read(xform("World", component("Walls", *walls))).by_path["/World/Walls"].shell_boxes == ()
