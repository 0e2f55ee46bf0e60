"""Shape descriptors of scene objects."""

import pytest

from tests.scene.usda import METRES, component, cube, header, ops, prim, xform
from tests.shapes.meshes import CUP, CUP_CAPACITY, TETRAHEDRON, moved, rotation
from usd2kg.scene import ReadOptions, describe_shapes, read_scene, shape_descriptors
from usd2kg.scene.stage import open_stage


def mesh_prim(name, mesh, *lines):
    points, triangles = mesh
    return prim(
        "Mesh",
        name,
        f"point3f[] points = [{', '.join(str(tuple(point)) for point in points.tolist())}]",
        f"int[] faceVertexCounts = [{', '.join(['3'] * len(triangles))}]",
        f"int[] faceVertexIndices = [{', '.join(map(str, triangles.reshape(-1).tolist()))}]",
        *lines,
    )


class TestDescribeShapes:
    @pytest.fixture
    def shapes(self, write_stage):
        def run(*prims, layer=METRES, options=None, **arguments):
            path = write_stage(layer + "\n".join(prims))
            return describe_shapes(path, read_scene(path, options=options), **arguments)

        return run

    def test_converts_units_and_up_axis(self, shapes):
        turned_up = moved(CUP, rotation(0, -90) * 100)
        found = shapes(component("Cup", mesh_prim("M", turned_up)), layer=header(metersPerUnit=0.01, upAxis="Y"))
        assert found["/Cup"].capacity_m3 == pytest.approx(CUP_CAPACITY, rel=0.03)

    def test_leaves_out_nested_objects(self, shapes):
        inner = component("Box", cube("C", size=1, at=(0, 0, 5)))
        found = shapes(xform("Group", component("Shelf", cube("A", size=2), inner)))
        assert {path: shape.volume_m3 for path, shape in found.items()} == pytest.approx(
            {"/Group/Shelf": 8, "/Group/Shelf/Box": 1}
        )

    def test_describes_only_the_given_paths(self, shapes):
        prims = component("A", cube("C")), component("B", cube("C"))
        assert list(shapes(*prims, paths=["/B", "/Nowhere"])) == ["/B"]
        assert list(shapes(*prims)) == ["/A", "/B"]

    def test_leaves_out_objects_without_geometry(self, shapes):
        broken = prim(
            "Mesh",
            "M",
            "point3f[] points = [(0, 0, 0)]",
            "int[] faceVertexCounts = [3]",
            "int[] faceVertexIndices = [0, 1, 2]",
        )
        notes = []
        assert list(shapes(component("A", cube("C")), component("B", broken), diagnostics=notes)) == ["/A"]
        assert [note.prim_path for note in notes if note.code == "mesh"] == ["/B/M"]

    def test_volume_of_a_mirrored_prim_is_positive(self, shapes):
        mirror = ops(("double3", "translate", (3, 0, 0)), ("float3", "scale", (-1, 1, 1)))
        assert shapes(component("T", mesh_prim("M", TETRAHEDRON), mirror))["/T"].volume_m3 == pytest.approx(
            1 / 6, rel=1e-5
        )

    def test_accepts_an_open_stage(self, write_stage):
        path = write_stage(METRES + component("A", cube("C")))
        opened = open_stage(path, ReadOptions())
        assert describe_shapes(opened, read_scene(path)) == describe_shapes(path, read_scene(path))

    def test_copies_of_a_point_instancer_count_only_if_expanded(self, shapes):
        instancer = prim(
            "PointInstancer",
            "I",
            "int[] protoIndices = [0, 0]",
            "point3f[] positions = [(0, 0, 0), (5, 0, 0)]",
            "float3[] scales = [(1, 1, 1), (2, 2, 2)]",
            "rel prototypes = </Shelf/I/P>",
            xform("P", cube("C")),
        )
        shelf = component("Shelf", cube("Board", size=3), instancer)
        assert shapes(shelf)["/Shelf"].volume_m3 == pytest.approx(27)
        found = shapes(shelf, options=ReadOptions(expand_instancers=True))
        assert {path: shape.volume_m3 for path, shape in found.items()} == pytest.approx(
            {"/Shelf": 27, "/Shelf/I[0]": 1, "/Shelf/I[1]": 8}
        )


class TestMeasuredOnce:
    @pytest.fixture
    def measured(self, monkeypatch, write_stage):
        """A function that writes cups with transforms, and returns their shapes and one item per measurement."""
        count = []
        describe_mesh = shape_descriptors.describe_mesh
        monkeypatch.setattr(shape_descriptors, "describe_mesh", lambda mesh: count.append(1) or describe_mesh(mesh))

        def run(*placements):
            source = prim("Xform", "Source", mesh_prim("M", CUP), specifier="class")
            cups = [
                component(f"Cup{i}", ops(*steps), meta=["inherits = </Source>", "instanceable = true"])
                for i, steps in enumerate(placements)
            ]
            path = write_stage(METRES + source + "".join(cups))
            count.clear()
            return describe_shapes(path, read_scene(path)), count

        return run

    def test_measures_copies_once_under_translation_and_rotation_about_z(self, measured):
        found, count = measured(
            [("double3", "translate", (0, 0, 0))],
            [("double3", "translate", (3.7, -2.1, 0.83)), ("float", "rotateZ", 71)],
            [("double3", "translate", (-9.3, 12.1, 1.9)), ("float", "rotateZ", -20)],
        )
        assert (len(found), len(count)) == (3, 1)

    def test_measures_tilted_scaled_and_mirrored_copies_again(self, measured):
        found, count = measured(
            [("double3", "translate", (0, 0, 0))],
            [("float", "rotateX", 40)],
            [("float3", "scale", (2, 2, 2))],
            [("float3", "scale", (-1, 1, 1))],
        )
        assert len(count) == 4
        assert found["/Cup1"].openness < found["/Cup0"].openness
        assert found["/Cup2"].volume_m3 == pytest.approx(8 * found["/Cup0"].volume_m3, rel=1e-5)
        assert found["/Cup3"].volume_m3 == pytest.approx(found["/Cup0"].volume_m3, rel=1e-5)
