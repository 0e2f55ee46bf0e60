"""glTF files are converted at reading: names, hierarchy, units, colours, materials and extras are kept."""

import hashlib
import json
import struct
import sys
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from tests.graph.records import open_store
from usd2kg import build
from usd2kg.convert.write import convert_file
from usd2kg.errors import SceneError
from usd2kg.scene import ReadOptions, read_scene

trimesh = pytest.importorskip("trimesh", reason="needs the extra convert")


def at(x: float, y: float, z: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def box(size, color=None, name="wood"):
    mesh = trimesh.creation.box(size)
    if color is not None:
        material = trimesh.visual.material.PBRMaterial(name=name, baseColorFactor=color, roughnessFactor=0.5)
        mesh.visual = trimesh.visual.TextureVisuals(material=material)
    return mesh


@pytest.fixture
def kitchen(tmp_path: Path) -> Path:
    """A table of 1.2 × 0.75 × 0.8 m (y up) with a red cup on it, and a lamp whose name is not a prim name."""
    scene = trimesh.Scene()
    scene.add_geometry(
        box((1.2, 0.75, 0.8), [128, 51, 0, 255]),
        node_name="Table",
        geom_name="TableTop",
        transform=at(0, 0.375, 0),
        metadata={"maker": "Oak and Sons", "articleNumber": 12},
    )
    scene.add_geometry(
        box((0.08, 0.1, 0.08), [255, 0, 0, 255], "ceramic"),
        node_name="Cup",
        geom_name="CupBody",
        transform=at(0.2, 0.8, 0.1),
    )
    scene.add_geometry(box((0.3, 0.5, 0.3)), node_name="Lampe 2/über", geom_name="Lamp", transform=at(2, 0.25, 0))
    path = tmp_path / "kitchen.glb"
    path.write_bytes(scene.export(file_type="glb"))
    return path


def test_keeps_names_hierarchy_and_units(kitchen: Path):
    scene = read_scene(kitchen)
    assert [obj.prim_path for obj in scene.objects] == ["/kitchen/Table", "/kitchen/Cup", "/kitchen/Lampe_2_über"]
    assert scene.objects[2].display_name == "Lampe 2/über"
    assert scene.frame.up_axis == "Y"
    assert scene.frame.metres_per_unit == 1
    table = scene.objects[0].box
    assert table is not None
    # z-up: the height of glTF's y is the third size.
    assert table.size == pytest.approx((1.2, 0.8, 0.75))
    assert [note for note in scene.diagnostics if note.code == "units"] == []


def test_keeps_colours_materials_and_extras(kitchen: Path):
    table, cup, lamp = read_scene(kitchen).objects
    assert table.materials == ("wood",)
    assert table.material_details[0].roughness == pytest.approx(0.5)
    assert cup.display_color == pytest.approx((1, 0, 0))
    assert (lamp.display_color, lamp.materials) == (None, ())
    assert ("customData:gltf:maker", "Oak and Sons") in table.texts


def test_a_kitchen_becomes_a_graph_that_answers(kitchen: Path):
    found = open_store(build(kitchen).graph).sparql(
        "SELECT ?cup ?table WHERE { ?cup u2k:primPath '/kitchen/Cup' . ?table u2k:primPath '/kitchen/Table' . "
        "?cup soma:isOntopOf ?table }"
    )
    assert len(found.rows) == 1


def test_states_what_the_stage_was_converted_from(kitchen: Path, tmp_path: Path):
    origin = read_scene(kitchen).origin
    assert origin is not None
    assert origin.source == "kitchen.glb"
    assert origin.hash == "sha256:" + hashlib.sha256(kitchen.read_bytes()).hexdigest()
    assert origin.format == "glTF"
    assert origin.converter == f"trimesh {trimesh.__version__}"
    convert_file(kitchen, tmp_path / "kitchen.usdc")
    assert read_scene(tmp_path / "kitchen.usdc").origin == origin


def test_the_graph_names_source_and_converter(kitchen: Path):
    found = open_store(build(kitchen).graph).sparql(
        "SELECT ?name ?hash ?converter WHERE { ?stage u2k:converter ?converter ; prov:wasDerivedFrom ?file . "
        "?file a prov:Entity ; rdfs:label ?name ; u2k:contentHash ?hash }"
    )
    digest = hashlib.sha256(kitchen.read_bytes()).hexdigest()
    assert found.rows == (("kitchen.glb", f"sha256:{digest}", f"trimesh {trimesh.__version__}"),)


def test_a_converted_file_reads_like_the_original(kitchen: Path, tmp_path: Path):
    convert_file(kitchen, tmp_path / "kitchen.usdc")
    assert read_scene(tmp_path / "kitchen.usdc").objects == read_scene(kitchen).objects
    assert read_scene(kitchen).content_hash == read_scene(kitchen).content_hash
    stage = Usd.Stage.Open(str(tmp_path / "kitchen.usdc"))
    assert stage.GetDefaultPrim().GetPath() == "/kitchen"
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert stage.GetPrimAtPath("/kitchen/Table").GetCustomDataByKey("gltf:articleNumber") == 12


def test_overrides_units_of_a_converted_file(kitchen: Path):
    table = read_scene(kitchen, options=ReadOptions(metres_per_unit=0.1)).objects[0].box
    assert table is not None
    assert table.size == pytest.approx((0.12, 0.08, 0.075))


TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()


def write_gltf(path: Path, nodes: list[dict], meshes: list[dict], roots: list[int], **more) -> Path:
    """Write a glTF file whose accessor 0 is a triangle in the plane z = 0."""
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": roots}],
        "nodes": nodes,
        "meshes": meshes,
        "buffers": [{"byteLength": len(TRIANGLE), "uri": "triangle.bin"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(TRIANGLE)}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}
        ],
        **more,
    }
    (path.parent / "triangle.bin").write_bytes(TRIANGLE)
    path.write_text(json.dumps(tree))
    return path


def stage_of(path: Path) -> Usd.Stage:
    """Convert a file and open the result."""
    convert_file(path, path.with_suffix(".usda"))
    return Usd.Stage.Open(str(path.with_suffix(".usda")))


ONE = {"attributes": {"POSITION": 0}}


def test_a_single_root_node_is_the_default_prim(tmp_path: Path):
    nodes = [{"name": "Room", "children": [1, 2]}, {"name": "Shelf", "mesh": 0}, {"mesh": 0}]
    stage = stage_of(write_gltf(tmp_path / "file.gltf", nodes, [{"name": "Board", "primitives": [ONE]}], [0]))
    assert [str(prim.GetPath()) for prim in stage.Traverse()] == [
        "/Room",
        "/Room/Shelf",
        "/Room/Shelf/Board",
        "/Room/node_2",
        "/Room/node_2/Board",
    ]
    assert stage.GetDefaultPrim().GetName() == "Room"


def test_primitives_are_meshes_of_one_node(tmp_path: Path):
    materials = [{"name": "oak", "pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.4, 0.2, 1]}}, {"name": "steel"}]
    primitives = [{**ONE, "material": 0}, {**ONE, "material": 1}, ONE]
    path = write_gltf(
        tmp_path / "file.gltf",
        [{"name": "Chair", "mesh": 0}],
        [{"name": "Seat", "primitives": primitives}],
        [0],
        materials=materials,
    )
    first, second = stage_of(path), stage_of(path)
    assert first.ExportToString() == second.ExportToString()
    prims = [str(prim.GetPath()) for prim in first.Traverse() if prim.IsA(UsdGeom.Mesh)]
    assert prims == ["/Chair/Seat", "/Chair/Seat_1", "/Chair/Seat_2"]
    (chair,) = read_scene(path).objects
    assert (chair.prim_path, chair.materials) == ("/Chair", ("oak", "steel"))


def test_transforms_of_nodes_add_up(tmp_path: Path):
    half = 0.5**0.5
    nodes = [
        {"name": "Arm", "translation": [1, 0, 0], "rotation": [0, 0, half, half], "children": [1]},
        {"name": "Hand", "translation": [2, 0, 0], "scale": [3, 3, 3], "mesh": 0},
    ]
    stage = stage_of(write_gltf(tmp_path / "file.gltf", nodes, [{"primitives": [ONE]}], [0]))
    place = UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath("/Arm/Hand"))
    # A quarter turn about z takes x to y: (1, 0, 0) + 2 y; a corner at x = 1 is scaled by 3.
    assert list(place.Transform((0, 0, 0))) == pytest.approx([1, 2, 0])
    assert list(place.Transform((1, 0, 0))) == pytest.approx([1, 5, 0])


def test_points_and_lines_are_left_out_with_a_note(tmp_path: Path):
    nodes = [{"name": "Cloud", "mesh": 0}, {"name": "Wall", "mesh": 1}]
    meshes = [{"name": "Dots", "primitives": [{**ONE, "mode": 0}]}, {"name": "Bricks", "primitives": [ONE]}]
    scene = read_scene(write_gltf(tmp_path / "file.gltf", nodes, meshes, [0, 1]))
    notes = [note.message for note in scene.diagnostics if note.code == "conversion"]
    assert notes == ["/file/Cloud: Dots consists of points or lines, which have no surface; it is left out"]
    assert [obj.name for obj in scene.objects] == ["file"]


def test_awkward_names_and_extras_are_kept(tmp_path: Path):
    extras = {"text": "a\ud800b", "none": None, "big": 2**70, "list": ["x", "y"], "deep": {"of": {"n": [1, 2.5]}}}
    nodes = [{"name": name, "mesh": 0, "extras": extras} for name in ("a/b", "a b", "", "7", "\ud83d\ude00", "x\ud800")]
    path = write_gltf(tmp_path / "3 things.gltf", nodes, [{"primitives": [ONE]}], list(range(len(nodes))))
    stage = stage_of(path)
    named = [(prim.GetName(), prim.GetDisplayName()) for prim in stage.GetDefaultPrim().GetChildren()]
    assert named[:2] == [("a_b", "a/b"), ("a_b_1", "a b")]
    data = stage.GetDefaultPrim().GetChildren()[0].GetCustomDataByKey("gltf")
    assert data["text"] == "a?b"
    assert data["big"] == str(2**70)
    assert list(data["list"]) == ["x", "y"]
    assert list(data["deep"]["of"]["n"]) == [1, 2.5]
    assert "none" not in data


def glb(text: bytes) -> bytes:
    return struct.pack("<III", 0x46546C67, 2, 20 + len(text)) + struct.pack("<II", len(text), 0x4E4F534A) + text


BROKEN = {
    "text.glb": b"a shopping list, long enough for a header",
    "short.glb": b"glTF",
    "json.glb": glb(b"{not json"),
    "list.glb": glb(b"[1,2]"),
    "old.glb": struct.pack("<IIIII", 0x46546C67, 1, 20, 0, 0),
    "nothing.gltf": b'{"asset": {"version": "2.0"}}',
    "buffer.gltf": b'{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 8, "uri": "missing.bin"}]}',
    "deep.gltf": b"[" * 100_000,
    "faces.obj": b"v 0 0 0\nf 1 2 3\n",
    "words.obj": b"hello\n",
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_file_is_one_clear_error(tmp_path: Path, name: str):
    path = tmp_path / name
    path.write_bytes(BROKEN[name])
    with pytest.raises(
        SceneError, match=r"cannot be converted \(.+\), expected .+; correct it or export it again"
    ) as caught:
        read_scene(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_missing_library_names_its_extra(kitchen: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(SceneError, match=r"glTF needs trimesh.*pip install 'usd2kg\[convert\]'"):
        read_scene(kitchen)


def test_colours_of_the_points_of_a_tetrahedron(tmp_path: Path):
    # It has as many faces as points.
    mesh = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    mesh.visual.vertex_colors = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [0, 0, 0, 255]]
    path = tmp_path / "thing.glb"
    path.write_bytes(trimesh.Scene({"Thing": mesh}).export(file_type="glb"))
    stage = stage_of(path)
    (prim,) = (prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh))
    color = UsdGeom.Mesh(prim).GetDisplayColorPrimvar()
    assert color.GetInterpolation() == UsdGeom.Tokens.vertex
    assert [tuple(value) for value in color.Get()] == [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)]


def test_the_colour_of_a_texture_is_its_mean(tmp_path: Path):
    image = pytest.importorskip("PIL.Image", reason="needs the extra convert")
    material = trimesh.visual.material.PBRMaterial(
        name="cloth", baseColorTexture=image.new("RGB", (4, 4), (188, 0, 255))
    )
    mesh = trimesh.creation.box((1, 1, 1))
    mesh.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=material)
    path = tmp_path / "thing.glb"
    path.write_bytes(trimesh.Scene({"Thing": mesh}).export(file_type="glb"))
    (thing,) = read_scene(path).objects
    # sRGB 188 is linear 0.503.
    assert thing.display_color == pytest.approx((0.503, 0, 1), abs=0.002)
    assert thing.material_details[0].base_color is None


@pytest.mark.parametrize(("mode", "opacity"), [("BLEND", 51 / 255), ("OPAQUE", None)])
def test_alpha_counts_where_the_material_blends(tmp_path: Path, mode: str, opacity: float | None):
    material = trimesh.visual.material.PBRMaterial(
        name="glass", baseColorFactor=np.array([255, 255, 255, 51], np.uint8), alphaMode=mode
    )
    mesh = trimesh.creation.box((1, 1, 1))
    mesh.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=material)
    path = tmp_path / "thing.glb"
    path.write_bytes(trimesh.Scene({"Thing": mesh}).export(file_type="glb"))
    (thing,) = read_scene(path).objects
    assert thing.material_details[0].opacity == (None if opacity is None else pytest.approx(opacity))


def test_nodes_in_a_circle_end(tmp_path: Path):
    nodes = [{"name": "A", "mesh": 0, "children": [1]}, {"name": "B", "mesh": 0, "children": [0]}]
    path = write_gltf(tmp_path / "file.gltf", nodes, [{"primitives": [ONE]}], [0])
    with pytest.raises(SceneError, match="no object among 1 prims"):
        read_scene(path)
