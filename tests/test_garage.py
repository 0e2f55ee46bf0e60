"""The garage: models of a library become the objects of its layout."""

import csv
import zipfile
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

import usd2kg
from benchmarks.relations.judged import SCENES, read_judged
from benchmarks.scenes.garage import build as garage
from benchmarks.scenes.garage.build import build, read_layout
from benchmarks.scenes.sweet_home import Library, ModelError, parse_obj
from tests.judged_scenes import judged_stage

CABINET = """
v 9 9 9
v 0 0 0
v 2 0 0
v 2 4 0
v 0 4 0
v 0 0 1
o body
usemtl oak
f 2/1/1 3/2/2 4//3 5
f 2 -1
o door
f -5 -4 -1
o
usemtl brass
f 5 3 6
"""
CATALOGUE = r"""
name#1=Cabinet
model#1=/lib/cabinet/cabinet.obj
width#1=100
height#1=200
depth#1=50
model#2=/lib/turned/cabinet_2.obj
modelRotation#2=0 0 1 0 1 0 -1 0 0
width#2=25
height#2=200
depth#2=100
name#3=Not a model
"""
LAYOUT = {
    "objects.csv": [
        ("prim_path", "model", "rotation", "position"),
        ("/Shed/Cabinet", "Lib/cabinet", "1 0 0 0 1 0 0 0 1", "3 0 0.5"),
        ("/Shed/Corner/Cabinet_2", "Lib/cabinet", "0 -1 0 1 0 0 0 0 1", "0 4 0"),
        ("/Shed/Unit/Body", "Lib/cabinet", "1 0 0 0 1 0 0 0 1", "0 0 0"),
    ],
    "parts.csv": [
        ("prim_path", "whole", "faces"),
        ("/Shed/Unit/Door", "/Shed/Unit/Body", "^door"),
        ("/Shed/Unit/Handle", "/Shed/Unit/Body", r"\|brass$"),
    ],
    "boxes.csv": [
        ("prim_path", "x0", "x1", "y0", "y1", "z0", "z1"),
        ("/Shed/Wall", "0", "4", "5", "5.1", "0", "1"),
        ("/Shed/Wall", "0", "1", "5", "5.1", "1", "3"),
    ],
}


@pytest.fixture
def models(tmp_path: Path) -> Path:
    """A folder with one library of two models."""
    with zipfile.ZipFile(tmp_path / "Lib.sh3f", "w") as archive:
        archive.writestr("PluginFurnitureCatalog.properties", CATALOGUE)
        archive.writestr("lib/cabinet/cabinet.obj", CABINET)
        archive.writestr("lib/turned/cabinet_2.obj", CABINET)
    return tmp_path


@pytest.fixture
def layout(tmp_path: Path) -> Path:
    """A folder with a layout."""
    for name, rows in LAYOUT.items():
        with (tmp_path / name).open("w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows(rows)
    return tmp_path


@pytest.fixture
def stage(models, layout, tmp_path) -> Usd.Stage:
    out = tmp_path / "shed.usda"
    assert build(out, models, read_layout(layout)) == 6
    return Usd.Stage.Open(str(out))


def points(stage: Usd.Stage, path: str) -> np.ndarray:
    """Return the points of an object's mesh, in the world frame."""
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath(f"{path}/mesh"))
    matrix = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(mesh.GetPrim()))
    local = np.array(mesh.GetPointsAttr().Get())
    return local @ matrix[:3, :3] + matrix[3, :3]


def test_faces_have_the_group_and_the_points_of_the_file():
    model = parse_obj(CABINET)
    # The first point is used by no face; two corners are no face.
    assert model.points.tolist() == [[0, 0, 0], [2, 0, 0], [2, 4, 0], [0, 4, 0], [0, 0, 1]]
    assert model.faces == [[0, 1, 2, 3], [0, 1, 4], [3, 1, 4]]
    assert model.groups == ["body|oak", "door|oak", "|brass"]


def test_a_model_has_the_size_and_the_orientation_of_its_catalogue(models: Path):
    cabinet = Library(models / "Lib.sh3f").read("cabinet")
    assert cabinet.points.min(axis=0).tolist() == [-0.5, -0.25, 0]
    assert cabinet.points.max(axis=0).tolist() == [0.5, 0.25, 2]
    # The only point in front, at z = 1 of the file, is left and down.
    assert cabinet.points[cabinet.points[:, 1] < 0].tolist() == [[-0.5, -0.25, 0]]
    turned = Library(models / "Lib.sh3f").read("cabinet_2")
    assert np.ptp(turned.points, axis=0).tolist() == [0.25, 1, 2]
    # The matrix brings the front of the file to the right, and its left to the front.
    assert turned.points[turned.points[:, 0] > 0].tolist() == [[0.125, -0.5, 0]]


def test_equal_points_are_one_and_faces_without_area_are_left_out(tmp_path: Path):
    with zipfile.ZipFile(tmp_path / "Lib.sh3f", "w") as archive:
        archive.writestr("PluginFurnitureCatalog.properties", CATALOGUE)
        seam = CABINET + "v 0.000001 0 0\ng seam\nf 2 3 7\nf 3 4 7\n"
        archive.writestr("lib/cabinet/cabinet.obj", seam)
    cabinet = Library(tmp_path / "Lib.sh3f").read("cabinet")
    assert len(cabinet.points) == 5
    assert cabinet.groups == ["body|oak", "door|oak", "|brass", "seam|brass"]


def test_objects_are_components_at_their_poses(stage: Usd.Stage):
    assert stage.GetDefaultPrim().GetPath() == "/Shed"
    kinds = {
        str(prim.GetPath()): Usd.ModelAPI(prim).GetKind() for prim in stage.Traverse() if not prim.IsA(UsdGeom.Mesh)
    }
    assert kinds == {
        "/Shed": "assembly",
        "/Shed/Wall": "component",
        "/Shed/Cabinet": "component",
        "/Shed/Corner": "group",
        "/Shed/Corner/Cabinet_2": "component",
        "/Shed/Unit": "group",
        "/Shed/Unit/Body": "component",
        "/Shed/Unit/Door": "component",
        "/Shed/Unit/Handle": "component",
    }
    wall = points(stage, "/Shed/Wall")
    assert wall.min(axis=0) == pytest.approx([0, 5, 0])
    assert wall.max(axis=0) == pytest.approx([4, 5.1, 3])
    assert points(stage, "/Shed/Cabinet").min(axis=0) == pytest.approx([2.5, -0.25, 0.5])
    # A quarter turn: the front, towards -Y, looks along X.
    turned = points(stage, "/Shed/Corner/Cabinet_2")
    assert turned.max(axis=0) == pytest.approx([0.25, 4.5, 2])
    assert turned[turned[:, 0] > 0.2] == pytest.approx(np.array([[0.25, 3.5, 0]]))


def test_copies_share_a_mesh_and_parts_have_their_own_faces(stage: Usd.Stage):
    assert stage.GetPrimAtPath("/_models").IsAbstract()
    for path in ("/Shed/Cabinet", "/Shed/Corner/Cabinet_2"):
        references = stage.GetPrimAtPath(path).GetMetadata("references").GetAddedOrExplicitItems()
        assert [reference.primPath for reference in references] == [Sdf.Path("/_models/m_cabinet")]
    counts = {
        name: list(UsdGeom.Mesh(stage.GetPrimAtPath(f"/Shed/Unit/{name}/mesh")).GetFaceVertexCountsAttr().Get())
        for name in ("Body", "Door", "Handle")
    }
    assert counts == {"Body": [4], "Door": [3], "Handle": [3]}
    assert points(stage, "/Shed/Unit/Door").max(axis=0) == pytest.approx([0.5, 0.25, 0])


def test_a_stage_is_the_same_each_time(models, layout, tmp_path):
    for name in ("a.usdc", "b.usdc"):
        build(tmp_path / name, models, read_layout(layout))
    assert (tmp_path / "a.usdc").read_bytes() == (tmp_path / "b.usdc").read_bytes()


@pytest.mark.parametrize(
    ("file", "row", "message"),
    [
        (
            "objects.csv",
            "/Shed/Bed,Lib/bed,1 0 0 0 1 0 0 0 1,0 0 0\n",
            r"Lib\.sh3f: has no model 'bed'; expected that of",
        ),
        (
            "objects.csv",
            "/Shed/Bed,Beds/bed,1 0 0 0 1 0 0 0 1,0 0 0\n",
            r"Beds\.sh3f: no such library; install the Deb",
        ),
        (
            "parts.csv",
            "/Shed/Unit/Lock,/Shed/Unit/Body,lock\n",
            "/Shed/Unit/Lock: no face of the model Lib/cabinet bel",
        ),
    ],
)
def test_what_is_missing_is_named(models, layout, tmp_path, file, row, message):
    with (layout / file).open("a", encoding="utf-8") as stream:
        stream.write(row)
    with pytest.raises(ModelError, match=message):
        build(tmp_path / "shed.usda", models, read_layout(layout))
    assert not (tmp_path / "shed.usda").exists()


def test_the_command_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.argv", ["build.py", "-o", str(tmp_path / "a.usdc"), "--models", str(tmp_path)])
    with pytest.raises(SystemExit, match=r"BlendSwap-CC-0\.sh3f: no such library; install the Debian package sweeth"):
        garage.main()


def test_the_layout_has_the_judged_objects():
    layout = read_layout()
    models = [placed.prim_path for placed in layout.models]
    parts = [part.prim_path for parts in layout.parts.values() for part in parts]
    objects = [str(path) for path in (*layout.boxes, *models, *parts)]
    assert sorted(objects) == sorted({fact.subject for path in SCENES["garage"].judged for fact in read_judged(path)})
    assert layout.parts.keys() <= set(models)


def test_rotations_of_the_layout_keep_shapes_and_models_have_names_of_their_own():
    models = read_layout().models
    for placed in models:
        assert placed.rotation @ placed.rotation.T == pytest.approx(np.eye(3), abs=3e-6)
        assert np.linalg.det(placed.rotation) == pytest.approx(1, abs=3e-6)
    keys = {placed.model for placed in models}
    # The prim of a shared mesh is named by the model alone.
    assert len({key.split("/")[1] for key in keys}) == len(keys)


def test_the_built_garage_has_the_objects_of_the_layout():
    scene = usd2kg.read_scene(judged_stage("garage"))
    layout = read_layout()
    parts = [part.prim_path for parts in layout.parts.values() for part in parts]
    paths = [*layout.boxes, *(placed.prim_path for placed in layout.models), *parts]
    assert {obj.prim_path for obj in scene.objects} == set(map(str, paths))
