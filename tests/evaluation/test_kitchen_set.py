"""Checking a download of the Kitchen Set."""

from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from tests.scene.usda import component, cube, xform
from usd2kg.errors import EvaluationError
from usd2kg.evaluation.kitchen_set import check_kitchen_set, crate_version, kitchen_scene, study_objects
from usd2kg.scene import read_scene


def _crate(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.Cube.Define(stage, "/Cube")
    stage.GetRootLayer().Save()
    return path


def test_reads_the_crate_version_from_the_header(tmp_path: Path) -> None:
    path = _crate(tmp_path / "a.usdc")
    version = crate_version(path)
    assert version is not None
    assert version >= (0, 4, 0)
    text = tmp_path / "a.usda"
    text.write_text("#usda 1.0\n")
    assert crate_version(text) is None


def test_rejects_obsolete_crates_with_a_conversion_command(tmp_path: Path) -> None:
    root = tmp_path / "Kitchen_set" / "Kitchen_set.usd"
    root.parent.mkdir()
    root.write_text("#usda 1.0\n")
    old = _crate(root.parent / "assets" / "Cup.usdc")
    data = bytearray(old.read_bytes())
    # Version 0.0.1, as in the Kitchen Set.
    data[8:11] = bytes((0, 0, 1))
    old.write_bytes(bytes(data))
    with pytest.raises(EvaluationError, match=r"1 of 2 layers are crate files of version 0\.0\.1.*usd-core==24\.11"):
        check_kitchen_set(tmp_path)


def test_rejects_a_folder_without_the_kitchen_set(tmp_path: Path) -> None:
    with pytest.raises(EvaluationError, match=r"no Kitchen_set\.usd"):
        check_kitchen_set(tmp_path)


def test_is_the_scene_of_a_matrix_if_it_is_readable(tmp_path: Path) -> None:
    root = tmp_path / "Kitchen_set" / "Kitchen_set.usd"
    _crate(root.parent / "asset.usdc")
    root.write_text("#usda 1.0\n")
    found = check_kitchen_set(tmp_path)
    assert (found.root, found.layer_count) == (root, 2)
    scene = kitchen_scene(found, tmp_path / "gold.csv", None)
    assert (scene.path, scene.gold, scene.missing) == (root, tmp_path / "gold.csv", tmp_path / "gold.csv")


def test_the_studys_objects_have_geometry_and_are_not_inside_another(write_stage: Callable[..., Path]) -> None:
    drawer = component("Drawer", cube("front", size=0.2))
    path = write_stage(
        xform("Kitchen", component("Cabinet", cube("body"), drawer), component("Empty"), component("Cup", cube("cup")))
    )
    scene = read_scene(path)
    assert {obj.name for obj in scene.objects} >= {"Cabinet", "Drawer", "Cup"}
    assert [obj.name for obj in study_objects(scene)] == ["Cabinet", "Cup"]
