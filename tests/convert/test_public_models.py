"""Public models of the Debian package assimp-testmodels (BSD): an IFC house, glTF samples, OBJ files of many programs.

`USD2KG_ASSIMP_MODELS` names another folder with them.
"""

import os
import shutil
from collections import Counter
from importlib.util import find_spec
from pathlib import Path

import pytest

from usd2kg.errors import SceneError
from usd2kg.scene import read_scene

MODELS = Path(os.environ.get("USD2KG_ASSIMP_MODELS", "/usr/share/assimp/models"))

pytestmark = [
    pytest.mark.skipif(not MODELS.is_dir(), reason="needs the Debian package assimp-testmodels"),
    pytest.mark.skipif(find_spec("trimesh") is None, reason="needs the extra convert"),
]


def notes_of(path: Path) -> list[str]:
    return [note.message for note in read_scene(path).diagnostics if note.code == "conversion"]


@pytest.mark.skipif(find_spec("ifcopenshell") is None, reason="needs the extra ifc")
def test_the_fzk_house():
    scene = read_scene(MODELS / "IFC" / "AC14-FZK-Haus.ifc")
    assert len(scene.objects) == 117
    kinds = Counter(label.value for obj in scene.objects for label in obj.labels.own)
    assert kinds["room"] == 7
    assert kinds["window"] == 11
    assert kinds["door"] == 5


class TestGlTF:
    @pytest.mark.parametrize(
        "name",
        [
            "BoxTextured-glTF/BoxTextured.gltf",
            "BoxTextured-glTF-Binary/BoxTextured.glb",
            "BoxTextured-glTF-Embedded/BoxTextured.gltf",
            "BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf",
        ],
    )
    def test_a_textured_box_in_four_encodings(self, name: str):
        (box,) = read_scene(MODELS / "glTF2" / name).objects
        assert box.box is not None
        assert box.box.size == pytest.approx((1, 1, 1))

    @pytest.mark.skipif(find_spec("DracoPy") is not None, reason="DracoPy decodes the file")
    def test_compressed_meshes_are_not_read_as_zeros(self):
        with pytest.raises(SceneError, match="compressed with Draco, which needs DracoPy; run: pip install DracoPy"):
            read_scene(MODELS / "glTF2" / "draco" / "2CylinderEngine.gltf")

    @pytest.mark.parametrize(
        ("name", "found"),
        [
            ("MissingBin/BoxTextured.gltf", "BoxTextured0.bin"),
            ("RecursiveNodes/RecursiveNodes.gltf", "it holds no triangles"),
            ("wrongTypes/badArray.gltf", "no attribute"),
            ("../glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", "only GLTF 2 is supported"),
        ],
    )
    def test_broken_files_are_one_clear_error(self, name: str, found: str):
        with pytest.raises(
            SceneError, match=rf"cannot be converted \(.*{found}.*\), expected a glTF 2\.0 file"
        ) as caught:
            read_scene(MODELS / "glTF2" / name)
        assert len(str(caught.value).splitlines()) == 1


class TestOBJ:
    def test_a_folder_of_files_by_many_programs(self, tmp_path: Path):
        folder = tmp_path / "models"
        shutil.copytree(MODELS / "OBJ", folder)
        (folder / "WusonOBJ.obj").unlink()
        scene = read_scene(folder)
        files = {path.stem for path in folder.glob("*.obj")}
        # Files of points and lines have no surface.
        lost = {"point_cloud", "testline", "testpoints"}
        assert {obj.name for obj in scene.objects} == files - lost
        notes = notes_of(folder)
        assert sum("its object is left out" in note for note in notes) == len(lost)

    def test_a_spider_of_19_groups(self):
        assert len(read_scene(MODELS / "OBJ" / "spider.obj").objects) == 19
