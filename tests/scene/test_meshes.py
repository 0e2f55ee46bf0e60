"""Visible triangles of a stage: position, colour, and diagnostics of what is left out."""

import numpy as np
import pytest
from pxr import Usd

from tests.scene.usda import METRES, cube, header, move, ops, prim, xform
from usd2kg.errors import SceneError
from usd2kg.scene.meshes import NEUTRAL_GREY, iterate_meshes
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import open_stage

SQUARE = (
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]",
    "int[] faceVertexCounts = [4]",
    "int[] faceVertexIndices = [0, 1, 2, 3]",
)


def color(red, green, blue, interpolation="constant"):
    return f'color3f[] primvars:displayColor = [({red}, {green}, {blue})] (interpolation = "{interpolation}")'


def preview_material(name, *lines):
    surface = prim("Shader", "S", 'uniform token info:id = "UsdPreviewSurface"', "token outputs:surface", *lines)
    return prim("Material", name, f"token outputs:surface.connect = </{name}/S.outputs:surface>", surface)


@pytest.fixture
def meshes(write_stage):
    """A function that writes prims as a stage and returns (meshes, diagnostics)."""

    def run(*prims, layer=METRES, roots=("/",)):
        opened = open_stage(write_stage(layer + "\n".join(prims)), ReadOptions())
        notes = []
        return list(iterate_meshes(opened, roots, diagnostics=notes)), notes

    return run


def signed_volume(mesh):
    """Return the enclosed volume: positive if the faces look outward."""
    a, b, c = np.moveaxis(mesh.points[mesh.triangles].astype(float), 1, 0)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def areas(mesh):
    a, b, c = np.moveaxis(mesh.points[mesh.triangles].astype(float), 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def normal(mesh):
    a, b, c = mesh.points[mesh.triangles[0]].astype(float)
    return tuple(np.cross(b - a, c - a))


def bounds(mesh):
    return mesh.points.min(axis=0).tolist(), mesh.points.max(axis=0).tolist()


def test_a_polygon_is_cut_into_a_fan(meshes):
    pentagon = prim(
        "Mesh",
        "P",
        "point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (9, 9, 9)]",
        "int[] faceVertexCounts = [5, 3]",
        "int[] faceVertexIndices = [0, 1, 2, 3, 4, 4, 2, 3]",
    )
    (mesh,), notes = meshes(pentagon)
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 4], [4, 2, 3]]
    assert (mesh.points.dtype, mesh.triangles.dtype, notes) == (np.float32, np.int32, [])


def test_faces_of_one_or_two_corners_have_no_triangles(meshes):
    lines = (SQUARE[0], "int[] faceVertexCounts = [2, 3, 1]", "int[] faceVertexIndices = [0, 1, 0, 1, 2, 3]")
    (mesh,), _ = meshes(prim("Mesh", "M", *lines))
    assert mesh.triangles.tolist() == [[0, 1, 2]]


def test_left_handed_and_mirrored_meshes_are_turned_to_face_outward(meshes):
    left = 'uniform token orientation = "leftHanded"'
    mirror = ops(("double3", "scale", (-1, 1, 1)))
    plain, reversed_, mirrored, both = meshes(
        prim("Mesh", "A", *SQUARE),
        prim("Mesh", "B", *SQUARE, left),
        prim("Mesh", "C", *SQUARE, mirror),
        prim("Mesh", "D", *SQUARE, left, mirror),
    )[0]
    assert normal(plain) == normal(mirrored) == (0, 0, 1)
    assert normal(reversed_) == normal(both) == (0, 0, -1)


def test_y_up_centimetres_become_z_up_metres(meshes):
    layer = header(metersPerUnit=0.01, upAxis="Y")
    (mesh,), _ = meshes(cube("Box", size=100, at=(200, 300, 400)), layer=layer)
    assert bounds(mesh) == (pytest.approx([1.5, -4.5, 2.5]), pytest.approx([2.5, -3.5, 3.5]))
    assert signed_volume(mesh) == pytest.approx(1)


@pytest.mark.parametrize(
    ("type_name", "lines", "volume", "size"),
    [
        ("Cube", ["double size = 2"], 8, (2, 2, 2)),
        ("Sphere", ["double radius = 0.5"], np.pi / 6, (1, 1, 1)),
        ("Cylinder", ["double radius = 0.5", "double height = 3"], 3 * np.pi / 4, (1, 1, 3)),
        (
            "Cylinder",
            ["double radius = 0.5", "double height = 3", 'uniform token axis = "X"'],
            3 * np.pi / 4,
            (3, 1, 1),
        ),
        ("Cone", ["double radius = 0.5", "double height = 3"], np.pi / 4, (1, 1, 3)),
        ("Cone", ["double radius = 0.5", "double height = 3", 'uniform token axis = "Y"'], np.pi / 4, (1, 3, 1)),
        ("Capsule", ["double radius = 0.5", "double height = 2"], np.pi / 2 + np.pi / 6, (1, 1, 3)),
        ("Cylinder_1", ["double radiusTop = 0.5", "double radiusBottom = 0.5"], np.pi / 2, (1, 1, 2)),
    ],
)
def test_solids_have_their_size_and_face_outward(meshes, type_name, lines, volume, size):
    (mesh,), notes = meshes(prim(type_name, "Solid", *lines))
    assert notes == []
    assert np.ptp(mesh.points, axis=0) == pytest.approx(size, rel=0.01)
    assert signed_volume(mesh) == pytest.approx(volume, rel=0.03)
    assert (areas(mesh) > 0).all()


def test_a_plane_is_a_rectangle(meshes):
    (mesh,), _ = meshes(prim("Plane", "P", "double width = 2", "double length = 3", 'uniform token axis = "Z"'))
    assert bounds(mesh) == ([-1, -1.5, 0], [1, 1.5, 0])
    assert normal(mesh) == pytest.approx((0, 0, 6))


def test_only_visible_default_and_render_prims_are_drawn(meshes):
    hidden = 'token visibility = "invisible"'
    found, _ = meshes(
        cube("Plain"),
        cube("Render", purpose="render"),
        cube("Guide", purpose="guide"),
        xform("Proxies", cube("Inherits"), 'uniform token purpose = "proxy"'),
        cube("Hidden", hidden),
        xform("HiddenAbove", cube("Below"), hidden),
        cube("Off", meta=["active = false"]),
        prim("Cube", "Abstract", specifier="class"),
    )
    assert [mesh.prim_path for mesh in found] == ["/Plain", "/Render"]


def test_nothing_is_drawn_below_an_invisible_prim_when_asked_by_path(meshes):
    scene = xform("Room", 'token visibility = "invisible"', xform("Shelf", cube("Box")))
    assert meshes(scene, roots=["/Room/Shelf"]) == ([], [])


def test_roots_inside_each_other_are_drawn_once(meshes):
    scene = xform("A", cube("One"), cube("Two"))
    found, _ = meshes(scene, cube("Other"), roots=["/A/Two", "/A"])
    assert [mesh.prim_path for mesh in found] == ["/A/One", "/A/Two"]


@pytest.mark.parametrize("path", ["/Nowhere", "Box", "no path", "/Nowhere[3]", ""])
def test_a_path_that_is_not_there(meshes, path):
    with pytest.raises(SceneError, match="there is no prim"):
        meshes(cube("Box"), roots=[path])


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ((SQUARE[0], "int[] faceVertexCounts = [4]", "int[] faceVertexIndices = [0, 1, 2, 4]"), "outside 0 … 3"),
        ((SQUARE[0], "int[] faceVertexCounts = [4]", "int[] faceVertexIndices = [0, 1, 2, -1]"), "outside 0 … 3"),
        (
            (SQUARE[0], "int[] faceVertexCounts = [4]", "int[] faceVertexIndices = [0, 1, 2]"),
            "add up to 4, but faceVertexIndices has 3",
        ),
        ((SQUARE[0], "int[] faceVertexCounts = [-4, 8]", "int[] faceVertexIndices = [0, 1, 2, 3]"), "add up to 4, but"),
        (("float[] points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]", *SQUARE[1:]), "not of the type"),
        (("point3f[] points = [(nan, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]", *SQUARE[1:]), "not all finite"),
        (("point3f[] points = [(inf, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]", *SQUARE[1:]), "not all finite"),
    ],
)
def test_broken_meshes_are_skipped_with_a_note(meshes, lines, message):
    found, notes = meshes(prim("Mesh", "Bad", *lines), cube("Good"))
    assert [mesh.prim_path for mesh in found] == ["/Good"]
    assert [(note.code, note.prim_path) for note in notes] == [("mesh", "/Bad")]
    assert message in notes[0].message
    assert "not in pictures" in notes[0].message


def test_empty_meshes_and_curves_and_bad_transforms(meshes):
    found, notes = meshes(
        prim("Mesh", "Empty"),
        prim("BasisCurves", "Rope"),
        cube("Lost", ops(("double3", "translate", "(nan, 0, 0)"))),
        prim("Sphere", "Nowhere", "double radius = nan"),
    )
    assert found == []
    assert [note.prim_path for note in notes] == ["/Rope", "/Lost", "/Nowhere"]
    assert "BasisCurves has no triangles" in notes[0].message


def test_attributes_that_hold_no_numbers_count_as_absent(meshes):
    found, _ = meshes(
        prim("Mesh", "Words", 'string points = "none"', *SQUARE[1:]),
        prim("Mesh", "Painted", *SQUARE, 'string primvars:displayColor = "red"'),
    )
    assert [(mesh.prim_path, mesh.color) for mesh in found] == [("/Painted", NEUTRAL_GREY)]


def test_color_is_grey_unless_authored(meshes):
    found, _ = meshes(cube("Bare"), cube("Red", color(1, 0, 0)), xform("Group", color(0, 0, 1), cube("Inherits")))
    assert [mesh.color for mesh in found] == [NEUTRAL_GREY, (1, 0, 0), (0, 0, 1)]
    assert {mesh.opacity for mesh in found} == {1.0}


def test_a_material_color_wins_over_the_display_color(meshes):
    bound = "rel material:binding = </Glass>"
    api = ['prepend apiSchemas = ["MaterialBindingAPI"]']
    glass = preview_material("Glass", "color3f inputs:diffuseColor = (0, 0.5, 0)", "float inputs:opacity = 0.25")
    plain = preview_material("Plain", "float inputs:roughness = 0.5")
    (a, b), _ = meshes(
        glass,
        plain,
        cube("A", color(1, 0, 0), bound, meta=api),
        cube("B", color(1, 0, 0), "rel material:binding = </Plain>", meta=api),
    )
    assert (a.color, a.opacity) == ((0, 0.5, 0), 0.25)
    assert (b.color, b.opacity) == ((1, 0, 0), 1)


def test_a_material_input_may_be_connected_or_textured(meshes):
    material = prim(
        "Material",
        "M",
        "color3f inputs:tint = (0, 0, 1)",
        "token outputs:surface.connect = </M/S.outputs:surface>",
        prim(
            "Shader",
            "S",
            'uniform token info:id = "UsdPreviewSurface"',
            "color3f inputs:diffuseColor.connect = </M.inputs:tint>",
            "token outputs:surface",
        ),
    )
    textured = prim(
        "Material",
        "T",
        "token outputs:surface.connect = </T/S.outputs:surface>",
        prim("Shader", "Image", 'uniform token info:id = "UsdUVTexture"', "float3 outputs:rgb"),
        prim(
            "Shader",
            "S",
            'uniform token info:id = "UsdPreviewSurface"',
            "color3f inputs:diffuseColor.connect = </T/Image.outputs:rgb>",
            "token outputs:surface",
        ),
    )
    api = ['prepend apiSchemas = ["MaterialBindingAPI"]']
    (a, b), _ = meshes(
        material,
        textured,
        cube("A", "rel material:binding = </M>", meta=api),
        cube("B", "rel material:binding = </T>", color(0, 1, 0), meta=api),
    )
    assert (a.color, b.color) == ((0, 0, 1), (0, 1, 0))


TWO_FACES = (
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]",
    "int[] faceVertexCounts = [3, 3]",
    "int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]",
)


def test_faces_of_several_materials_come_as_several_meshes(meshes):
    subset = prim(
        "GeomSubset",
        "Top",
        'uniform token elementType = "face"',
        'uniform token familyName = "materialBind"',
        "int[] indices = [1]",
        "rel material:binding = </Red>",
        meta=['prepend apiSchemas = ["MaterialBindingAPI"]'],
    )
    red = preview_material("Red", "color3f inputs:diffuseColor = (1, 0, 0)")
    found, _ = meshes(red, prim("Mesh", "M", *TWO_FACES, color(0, 1, 0), subset))
    assert [(mesh.color, mesh.triangles.tolist()) for mesh in found] == [
        ((1, 0, 0), [[0, 2, 3]]),
        ((0, 1, 0), [[0, 1, 2]]),
    ]


def test_colors_by_face_and_by_point(meshes):
    by_face = 'color3f[] primvars:displayColor = [(1, 0, 0), (0, 0, 1)] (interpolation = "uniform")'
    by_point = (
        'color3f[] primvars:displayColor = [(1, 0, 0), (1, 0, 0), (0, 0, 0), (0, 0, 0)] (interpolation = "vertex")'
    )
    first, second, third = meshes(prim("Mesh", "A", *TWO_FACES, by_face), prim("Mesh", "B", *TWO_FACES, by_point))[0]
    assert (first.color, second.color) == ((0, 0, 1), (1, 0, 0))
    assert (first.triangles.tolist(), second.triangles.tolist()) == ([[0, 2, 3]], [[0, 1, 2]])
    assert third.color == (0.5, 0, 0)


def test_instances_are_drawn_at_their_positions(meshes):
    asset = prim("Xform", "Asset", cube("Body", color(1, 0, 0)), specifier="class")
    found, _ = meshes(
        asset,
        xform("A", move(2, 0, 0), meta=["instanceable = true", "references = </Asset>"]),
        xform("B", move(0, 5, 0), meta=["instanceable = true", "references = </Asset>"]),
    )
    assert [mesh.prim_path for mesh in found] == ["/A/Body", "/B/Body"]
    assert [mesh.points.mean(axis=0).tolist() for mesh in found] == [[2, 0, 0], [0, 5, 0]]
    assert meshes(
        asset,
        xform("A", meta=["instanceable = true", "references = </Asset>"]),
        roots=["/A/Body"],
    )[0]


def instancer(positions, indices, *lines, prototypes=("Small",)):
    places = ", ".join(str(p) for p in positions)
    targets = ", ".join(f"</Many/{name}>" for name in prototypes)
    sizes = {"Small": 1, "Big": 2}
    return prim(
        "PointInstancer",
        "Many",
        move(0, 0, 10),
        f"point3f[] positions = [{places}]",
        f"int[] protoIndices = {indices}",
        f"rel prototypes = [{targets}]",
        *lines,
        *(xform(name, move(0, 0, 1), cube("Box", size=sizes[name])) for name in prototypes),
    )


def test_copies_of_a_point_instancer(meshes):
    places = [(0, 0, 0), (5, 0, 0), (9, 0, 0)]
    found, notes = meshes(instancer(places, [0, 1, 0], prototypes=("Small", "Big")))
    # The instancer's frame and the prototype's own transform both count.
    assert [mesh.prim_path for mesh in found] == ["/Many", "/Many"]
    assert bounds(found[0]) == ([-0.5, -0.5, 10.5], [9.5, 0.5, 11.5])
    assert bounds(found[1]) == ([4, -1, 10], [6, 1, 12])
    assert [len(mesh.triangles) for mesh in found] == [24, 12]
    assert notes == []


def test_one_copy_by_its_number_and_hidden_copies(meshes):
    places = [(0, 0, 0), (5, 0, 0), (9, 0, 0)]
    one, _ = meshes(instancer(places, [0, 0, 0]), roots=["/Many[2]"])
    assert one[0].points.mean(axis=0).tolist() == [9, 0, 11]
    by_id, _ = meshes(instancer(places, [0, 0, 0], "int64[] ids = [7, 8, 9]"), roots=["/Many[8]"])
    assert by_id[0].points.mean(axis=0).tolist() == [5, 0, 11]
    shown, _ = meshes(instancer(places, [0, 0, 0], "int64[] invisibleIds = [0, 1]"))
    assert shown[0].points.mean(axis=0).tolist() == [9, 0, 11]


def test_too_many_copies_are_thinned_out_evenly(meshes):
    places = [(i, 0, 0) for i in range(5000)]
    (mesh,), notes = meshes(instancer(places, [0] * 5000))
    assert len(mesh.triangles) == 12 * 4000
    assert bounds(mesh)[1][0] == 4999.5
    assert "4000 of 5000 copies are drawn" in notes[0].message


def test_a_broken_point_instancer_is_skipped_with_a_note(meshes):
    found, notes = meshes(instancer([(0, 0, 0)], [0, 0]), cube("Good"))
    assert [mesh.prim_path for mesh in found] == ["/Good"]
    assert notes[0].prim_path == "/Many"


def test_a_live_stage():
    stage = Usd.Stage.CreateInMemory()
    stage.DefinePrim("/Box", "Cube")
    (mesh,) = iterate_meshes(open_stage(stage, ReadOptions(metres_per_unit=1, up_axis="Z")))
    assert bounds(mesh) == ([-1, -1, -1], [1, 1, 1])
