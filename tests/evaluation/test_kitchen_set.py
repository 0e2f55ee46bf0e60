"""The user's own Kitchen Set: found, refused with a way out, or run."""

from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.kitchen_set import check_kitchen_set, crate_version, kitchen_matrix


def _crate(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.Cube.Define(stage, "/Cube")
    stage.GetRootLayer().Save()
    return path


def test_version_is_read_from_the_header(tmp_path: Path) -> None:
    path = _crate(tmp_path / "a.usdc")
    version = crate_version(path)
    assert version is not None
    assert version >= (0, 4, 0)
    text = tmp_path / "a.usda"
    text.write_text("#usda 1.0\n")
    assert crate_version(text) is None


def test_obsolete_crates_are_named_with_the_way_to_convert_them(tmp_path: Path) -> None:
    root = tmp_path / "Kitchen_set" / "Kitchen_set.usd"
    root.parent.mkdir()
    root.write_text("#usda 1.0\n")
    old = _crate(root.parent / "assets" / "Cup.usdc")
    data = bytearray(old.read_bytes())
    # The version of the Kitchen Set's own layers: 0.0.1.
    data[8:11] = bytes((0, 0, 1))
    old.write_bytes(bytes(data))
    with pytest.raises(EvaluationError, match=r"1 of 2 layers are crates of version 0\.0\.1.*usd-core==24\.11"):
        check_kitchen_set(tmp_path)


def test_a_folder_without_it_is_refused(tmp_path: Path) -> None:
    with pytest.raises(EvaluationError, match=r"no Kitchen_set\.usd in it"):
        check_kitchen_set(tmp_path)


def test_a_readable_download_gives_the_study_s_matrix(tmp_path: Path) -> None:
    root = tmp_path / "Kitchen_set" / "Kitchen_set.usd"
    _crate(root.parent / "asset.usdc")
    root.write_text("#usda 1.0\n")
    found = check_kitchen_set(tmp_path)
    assert (found.root, found.layer_count) == (root, 2)
    plan = kitchen_matrix(found, tmp_path / "gold.csv", None)
    assert {cell.condition for cell in plan.cells()} >= {"semantic", "opaque", "geometry only"}
