"""The meshes that the page gets: the largest objects first, shared by copies, within a budget, in files others read."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pxr import Usd, UsdGeom

from tests.conftest import shared_file
from tests.scene.usda import METRES, component, cube, xform
from usd2kg.grounding import ground, make_grounder
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import ReadOptions, read_scene
from usd2kg.scene.object_geometry import NO_TEXTURE, GeometryReader
from usd2kg.scene.stage import open_stage, time_code
from usd2kg.studio import geometry_files
from usd2kg.studio.geometry_files import GeometryFiles
from usd2kg.studio.glb import GlbNode, write_glb
from usd2kg.studio.mesh_budget import ShadedMesh
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.settings import GEOMETRY


def open_files(path, only=None):
    """Return the files of a stage, and the prim paths of its objects."""
    options = ReadOptions()
    scene = read_scene(path, options=options)
    if only is not None:
        scene = replace(scene, objects=tuple(obj for obj in scene.objects if obj.prim_path in only))
    tbox = load_home_tbox()
    reader = GeometryReader(open_stage(path, options), scene, time_code(options.time))
    indices = PageIndices(scene, tbox, ground(scene, tbox, make_grounder("dictionary")), [])
    return GeometryFiles(reader, scene, indices), [obj.prim_path for obj in scene.objects]


def document(content):
    """Return the JSON of a GLB file."""
    length = int.from_bytes(content[12:16], "little")
    return json.loads(content[20 : 20 + length])


def objects_in(content):
    return [node["extras"]["object"] for node in document(content).get("nodes", [])]


def test_the_largest_objects_come_first(write_stage, monkeypatch):
    monkeypatch.setattr(geometry_files, "GEOMETRY", GEOMETRY._replace(first_chunk_objects=1, chunk_objects=2))
    sizes = {"Spoon": 0.1, "House": 9, "Table": 2, "Cup": 0.2, "Bed": 3}
    stage = write_stage(METRES + "".join(component(name, cube("Body", size=size)) for name, size in sizes.items()))
    files, paths = open_files(stage)
    count = len(files.manifest()["chunks"])
    assert count == 3
    found = [[paths[index] for index in objects_in(files.file(i))] for i in range(count)]
    assert found == [["/House"], ["/Bed", "/Table"], ["/Cup", "/Spoon"]]
    with pytest.raises(IndexError):
        files.file(3)


def test_what_is_outside_of_objects_comes_last(write_stage):
    parts = cube("Loose", size=1) + xform("Nothing") + component("Cup", cube("Body", size=0.1))
    files, _ = open_files(write_stage(METRES + parts), only=["/Cup"])
    assert [objects_in(files.file(i)) for i in range(len(files.manifest()["chunks"]))] == [[0], [-1]]


def test_copies_share_one_mesh(write_stage):
    cups = "".join(component(f"Cup_{i}", cube("Body", size=0.1), meta=()) for i in range(5))
    content = open_files(write_stage(METRES + cups))[0].file(0)
    assert len(document(content)["nodes"]) == 5
    assert len(document(content)["meshes"]) == 1


def test_hidden_objects_are_left_out(write_stage):
    hidden = component("Ghost", 'token visibility = "invisible"', cube("Body", size=1))
    files, paths = open_files(write_stage(METRES + hidden + component("Cup", cube("Body", size=0.1))))
    found = [index for i in range(len(files.manifest()["chunks"])) for index in objects_in(files.file(i))]
    assert [paths[index] for index in found] == ["/Cup"]


def test_a_scene_without_meshes_has_no_files(write_stage):
    files, _ = open_files(write_stage(METRES + xform("Empty", kind="component")))
    assert sum(len(objects_in(files.file(i))) for i in range(len(files.manifest()["chunks"]))) == 0


def test_many_triangles_are_decimated(tmp_path, monkeypatch):
    stage = Usd.Stage.CreateNew(str(tmp_path / "ball.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    Usd.ModelAPI(UsdGeom.Xform.Define(stage, "/Ball")).SetKind("component")
    ball = trimesh.creation.icosphere(subdivisions=4)
    mesh = UsdGeom.Mesh.Define(stage, "/Ball/Body")
    mesh.CreatePointsAttr(ball.vertices.astype(np.float32))
    mesh.CreateFaceVertexCountsAttr([3] * len(ball.faces))
    mesh.CreateFaceVertexIndicesAttr(ball.faces.reshape(-1))
    stage.Save()
    monkeypatch.setattr(geometry_files, "GEOMETRY", GEOMETRY._replace(max_triangles=1000))
    files, _ = open_files(tmp_path / "ball.usda")
    manifest = files.manifest()
    assert (manifest["source_triangles"], manifest["triangles"]) == (len(ball.faces), 1000)
    read = trimesh.load(trimesh.util.wrap_as_stream(files.file(0)), file_type="glb").to_geometry()
    assert 800 < len(read.faces) < 1200
    assert read.volume == pytest.approx(ball.volume, rel=0.03)


def test_files_are_read_by_another_library():
    rng = np.random.default_rng(1)
    points = rng.random((70000, 3), np.float32)
    triangles = rng.integers(0, 70000, (100, 3), np.int32)
    mesh = ShadedMesh(
        points,
        np.tile(np.float32([0, 0, 1]), (70000, 1)),
        np.full((70000, 4), 128, np.uint8),
        np.zeros((70000, 2), np.float32),
        triangles,
        np.full(100, NO_TEXTURE),
    )
    matrix = np.eye(4)
    matrix[3, :3] = 1, 2, 3
    content = write_glb({7: mesh}, [GlbNode(7, np.eye(4), {"object": 3}), GlbNode(7, matrix, {"object": 4})])
    scene = trimesh.load(trimesh.util.wrap_as_stream(content), file_type="glb", process=False)
    ((_, read),) = scene.geometry.items()
    # More points than 16-bit indices can name.
    assert np.array_equal(read.faces, triangles)
    assert np.allclose(read.vertices, points)
    transform, _ = scene.graph["n1"]
    assert transform[:3, 3].tolist() == [1, 2, 3]


def test_a_file_without_meshes_is_valid():
    assert document(write_glb({}, [])) == {
        "asset": {"version": "2.0", "generator": "usd2kg"},
        "scene": 0,
        "scenes": [{}],
    }


@pytest.mark.parametrize("name", ["aws_robomaker/small_warehouse.usdc", "franka_kitchen/franka_kitchen.usdc"])
def test_meshes_of_real_scenes_fill_the_boxes_of_their_objects(name):
    path = shared_file(f"scenes/{name}")
    files, paths = open_files(Path(path))
    boxes = {obj.prim_path: obj.box for obj in read_scene(path).objects}
    checked = 0
    for i in range(len(files.manifest()["chunks"])):
        content = files.file(i)
        scene = trimesh.load(trimesh.util.wrap_as_stream(content), file_type="glb")
        for node in document(content).get("nodes", []):
            box = boxes[paths[node["extras"]["object"]]] if node["extras"]["object"] >= 0 else None
            if box is None:
                continue
            matrix, geometry = scene.graph[node["name"]]
            bounds = trimesh.transform_points(scene.geometry[geometry].vertices, matrix)
            assert (bounds.min(axis=0) >= np.array(box.lower) - 0.01).all()
            assert (bounds.max(axis=0) <= np.array(box.upper) + 0.01).all()
            checked += 1
    assert checked > 20
