"""A folder of OBJ files is one scene: an object for each file, a group for each folder."""

import hashlib
import os
from pathlib import Path

import pytest
from pxr import Kind, Usd

import usd2kg
from tests.convert.test_obj import tetrahedron
from usd2kg.batch.manifest import SourceState
from usd2kg.batch.scene_files import find_scene_files
from usd2kg.convert import find_format, is_stage
from usd2kg.convert.write import convert_file
from usd2kg.errors import SceneError
from usd2kg.scene import ReadOptions, Scene, read_scene

pytest.importorskip("trimesh", reason="needs the extra convert")
PIL = pytest.importorskip("PIL.Image", reason="needs the extra convert")

TEXTURED = """mtllib lamp.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vt 1 0
vt 0 1
usemtl shade
f 1/1 3/2 2/3
f 1/1 2/2 4/3
f 1/1 4/2 3/3
f 2/1 3/2 4/3
"""


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def flat(tmp_path: Path) -> Path:
    """Return a folder with a floor, and two rooms with things in them."""
    folder = tmp_path / "my flat"
    write(folder / "floor.obj", tetrahedron(1, 0))
    write(folder / "kitchen" / "wood.mtl", "newmtl oak\nKd 0.6 0.4 0.2\n")
    write(folder / "kitchen" / "Kitchen Table.obj", f"mtllib wood.mtl\nusemtl oak\n{tetrahedron(1, 2)}")
    write(folder / "kitchen" / "00017.obj", f"mtllib wood.mtl\no coffee mug\nusemtl oak\n{tetrahedron(1, 4)}")
    write(folder / "living room" / "lamp.obj", TEXTURED)
    write(folder / "living room" / "lamp.mtl", "newmtl shade\nKd 1 1 1\nmap_Kd textures/red.png\n")
    (folder / "living room" / "textures").mkdir()
    PIL.new("RGB", (4, 4), (255, 0, 0)).save(folder / "living room" / "textures" / "red.png")
    write(folder / ".trash" / "old.obj", tetrahedron(1, 0))
    return folder


def notes_of(scene: Scene) -> list[str]:
    return [note.message for note in scene.diagnostics if note.code == "conversion"]


def test_files_are_objects_in_the_groups_of_their_folders(flat: Path):
    scene = read_scene(flat)
    found = {obj.prim_path: obj for obj in scene.objects}
    assert sorted(found) == [
        "/my_flat/floor",
        "/my_flat/kitchen/Kitchen_Table",
        "/my_flat/kitchen/_00017",
        "/my_flat/living_room/lamp",
    ]
    table = found["/my_flat/kitchen/Kitchen_Table"]
    assert table.display_name == "Kitchen Table"
    assert table.materials == ("oak",)
    assert table.source_id == "kitchen/Kitchen Table.obj"
    assert table.box is not None
    assert (table.box.lower, table.box.upper) == (pytest.approx((2, -1, 0)), pytest.approx((3, 0, 1)))
    assert found["/my_flat/living_room/lamp"].display_color == pytest.approx((1, 0, 0))
    (note,) = notes_of(scene)
    assert note.startswith("OBJ states neither units nor an up axis; metres and y-up are assumed")


def test_the_name_of_the_object_in_a_file_is_kept(flat: Path):
    (mug,) = (obj for obj in read_scene(flat).objects if obj.prim_path.endswith("_00017"))
    assert mug.display_name == "00017"
    assert dict(mug.texts)["customData:obj:object"] == "coffee mug"


def test_kinds_and_display_names_of_the_stage(flat: Path, tmp_path: Path):
    output = tmp_path / "flat.usda"
    convert_file(flat, output, metres_per_unit=0.01, up_axis="Z")
    stage = Usd.Stage.Open(str(output))
    kinds = {str(prim.GetPath()): Usd.ModelAPI(prim).GetKind() for prim in stage.Traverse()}
    assert stage.GetDefaultPrim().GetPath() == "/my_flat"
    assert kinds["/my_flat"] == Kind.Tokens.assembly
    assert kinds["/my_flat/living_room"] == Kind.Tokens.group
    assert kinds["/my_flat/living_room/lamp"] == Kind.Tokens.component
    assert stage.GetPrimAtPath("/my_flat/living_room").GetDisplayName() == "living room"
    (table,) = (obj for obj in read_scene(output).objects if obj.name == "Kitchen_Table")
    assert table.box is not None
    assert table.box.size == pytest.approx((0.01, 0.01, 0.01))


def test_the_same_material_of_two_files_is_one_prim(flat: Path):
    scene = read_scene(flat)
    paths = {detail.prim_path for obj in scene.objects for detail in obj.material_details if detail.name == "oak"}
    assert paths == {"/my_flat/Materials/oak"}


def test_units_can_be_given(flat: Path):
    scene = read_scene(flat, options=ReadOptions(metres_per_unit=0.01, up_axis="Z"))
    assert all(obj.box is not None and obj.box.size == pytest.approx((0.01, 0.01, 0.01)) for obj in scene.objects)


def test_the_origin_names_the_folder_and_hashes_its_files(flat: Path):
    origin = read_scene(flat).origin
    assert origin is not None
    assert (origin.source, origin.format) == ("my flat", "OBJ folder")
    names = ["floor.obj", "kitchen/00017.obj", "kitchen/Kitchen Table.obj", "living room/lamp.obj"]
    lines = [f"{hashlib.sha256((flat / name).read_bytes()).hexdigest()}  {name}\n" for name in names]
    assert origin.hash == f"sha256:{hashlib.sha256(''.join(lines).encode()).hexdigest()}"


def test_the_stage_is_the_same_each_time(flat: Path):
    assert read_scene(flat).content_hash == read_scene(flat).content_hash


def test_names_that_differ_only_in_odd_characters_stay_apart(tmp_path: Path):
    folder = tmp_path / "room"
    for name in ("cup 1", "cup_1", "cup-1"):
        write(folder / f"{name}.obj", tetrahedron(1, 0))
    write(folder / "cup_1" / "spoon.obj", tetrahedron(1, 0))
    found = {obj.prim_path: obj.display_name or obj.name for obj in read_scene(folder).objects}
    assert found == {
        "/room/cup_1": "cup 1",
        "/room/cup_1_1": "cup-1",
        "/room/cup_1_2": "cup_1",
        "/room/cup_1_3/spoon": "spoon",
    }


class TestSeveralObjectsInAFile:
    TWO = f"o seat\n{tetrahedron(1, 0)}o back\n{tetrahedron(5, 3)}"

    def test_they_are_parts_of_the_object(self, tmp_path: Path):
        write(tmp_path / "room" / "chair.obj", self.TWO)
        write(tmp_path / "room" / "lamp.obj", tetrahedron(1, 9))
        scene = read_scene(tmp_path / "room")
        found = {obj.prim_path: obj for obj in scene.objects}
        assert sorted(found) == ["/room/chair", "/room/lamp"]
        assert {"back", "seat"} <= {*found["/room/chair"].parts}
        assert (
            "the objects (o) of a file are its parts (chair.obj); --kind subcomponent makes them objects"
            in notes_of(scene)
        )

    def test_the_only_file_of_a_folder_is_a_scene(self, tmp_path: Path):
        write(tmp_path / "room" / "export.obj", self.TWO)
        assert sorted(obj.prim_path for obj in read_scene(tmp_path / "room").objects) == ["/room/back", "/room/seat"]


class TestBrokenFiles:
    def test_others_are_read(self, flat: Path):
        write(flat / "kitchen" / "broken.obj", "f 1 2 nothing\n")
        write(flat / "kitchen" / "empty.obj", "")
        scene = read_scene(flat)
        assert len(scene.objects) == 4
        broken, empty = (note for note in notes_of(scene) if "its object is left out" in note)
        assert broken.startswith("kitchen/broken.obj: cannot be converted (")
        assert empty.startswith("kitchen/empty.obj: cannot be converted (")

    def test_a_broken_texture_leaves_out_one_object(self, flat: Path):
        texture = flat / "living room" / "textures" / "red.png"
        texture.write_bytes(texture.read_bytes()[:45])
        scene = read_scene(flat)
        assert {"/my_flat/floor", "/my_flat/kitchen/Kitchen_Table"} <= {obj.prim_path for obj in scene.objects}

    @pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root reads all files")
    def test_a_file_without_permission_is_left_out(self, flat: Path):
        (flat / "floor.obj").chmod(0)
        assert any(note.startswith("floor.obj: ") for note in notes_of(read_scene(flat)))

    def test_many_are_counted(self, tmp_path: Path):
        write(tmp_path / "room" / "cup.obj", tetrahedron(1, 0))
        for number in range(25):
            write(tmp_path / "room" / f"{number}.obj", "nothing")
        notes = notes_of(read_scene(tmp_path / "room"))
        assert len(notes) == 22
        assert notes[-1] == "5 more files cannot be read"

    def test_a_folder_of_nothing_else_is_refused(self, tmp_path: Path):
        write(tmp_path / "room" / "a.obj", "nothing")
        with pytest.raises(SceneError, match=r"no OBJ file of 1 is readable: a\.obj: cannot be converted"):
            read_scene(tmp_path / "room")


class TestOtherContent:
    def test_an_empty_folder_is_refused(self, tmp_path: Path):
        (tmp_path / "room").mkdir()
        with pytest.raises(SceneError, match="is a folder without OBJ files, expected a USD stage"):
            read_scene(tmp_path / "room")
        with pytest.raises(SceneError, match="is a folder without OBJ files; name the file to convert"):
            convert_file(tmp_path / "room", tmp_path / "room.usdc")

    def test_files_of_other_formats_are_named(self, flat: Path):
        for name in ("a.glb", "b.fbx", "c.stl", "d.ply"):
            write(flat / name, "")
        assert (
            "files of other formats are left out (a.glb, b.fbx, c.stl and 1 more); only OBJ files are read"
            in notes_of(read_scene(flat))
        )

    def test_beside_a_stage_only_convert_reads_the_files(self, flat: Path, tmp_path: Path):
        write(flat / "kitchen" / "scene.usda", "#usda 1.0\n")
        with pytest.raises(
            SceneError, match=r"with OBJ files and USD stages such as kitchen/scene\.usda; name the stage"
        ):
            read_scene(flat)
        converted = convert_file(flat, tmp_path / "flat.usdc")
        assert converted.notes[-1].startswith("files of other formats are left out (kitchen/scene.usda)")

    def test_deep_folders_are_refused(self, tmp_path: Path):
        write(tmp_path.joinpath("room", *["a"] * 40) / "cup.obj", tetrahedron(1, 0))
        with pytest.raises(SceneError, match="nested more than 32 deep"):
            read_scene(tmp_path / "room")

    def test_folders_that_links_lead_to_are_not_entered(self, flat: Path):
        try:
            (flat / "again").symlink_to(flat, target_is_directory=True)
        except OSError:
            pytest.skip("needs symbolic links")
        assert len(read_scene(flat).objects) == 4


class TestPlacesThatTakeScenes:
    def test_a_folder_with_obj_files_is_a_stage(self, flat: Path):
        assert is_stage(flat)
        assert not is_stage(flat / "living room" / "textures")
        assert find_format(flat) is not None

    def test_open_builds_the_graph_of_a_folder(self, flat: Path):
        world = usd2kg.open(flat)
        assert world.built is not None
        assert len(world.built.scene.objects) == 4

    def test_a_batch_takes_the_folder_as_one_scene(self, flat: Path):
        (scene,) = find_scene_files([str(flat)])
        assert (scene.name, scene.path) == ("my flat", flat)
        write(flat / "other.glb", "")
        with pytest.raises(SceneError, match="no scene found"):
            find_scene_files([str(flat)])

    def test_a_batch_sees_that_a_file_in_the_folder_has_changed(self, flat: Path):
        before = SourceState.of(flat)
        write(flat / "kitchen" / "00017.obj", tetrahedron(1, 50))
        assert SourceState.of(flat) != before

    def test_the_folder_of_the_shell_has_its_name(self, flat: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.chdir(flat)
        result = usd2kg.build(Path())
        assert {obj.prim_path.split("/")[1] for obj in result.scene.objects} == {"my_flat"}
        assert "https://example.org/my%20flat/" in {str(triple.subject.value)[:30] for triple in result.graph.triples}
