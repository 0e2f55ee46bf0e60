"""Which scenes paths, folders and patterns name."""

from pathlib import Path

import pytest

from usd2kg.batch.scene_files import find_scene_files, output_names
from usd2kg.errors import SceneError


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    for name in (
        "a/x.usda",
        "a/x.usdc",
        "a/b/y.USD",
        "c/x.usd",
        "c/robot.urdf",
        "c/notes.txt",
        ".git/z.usd",
        "c/.tmp.usd",
    ):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    return tmp_path


def names(*places: str, **options: list[str]) -> list[str]:
    return [scene.name for scene in find_scene_files(places, **options)]


def test_a_folder_stands_for_its_stages(tree: Path):
    assert names(str(tree)) == ["a/b/y.USD", "a/x.usda", "a/x.usdc", "c/x.usd"]
    assert names(str(tree / "a" / "b"), str(tree / "a" / "b" / "y.USD")) == ["y.USD"]


def test_patterns_find_other_formats_and_nothing_else(tree: Path):
    assert names(f"{tree}/**/*") == ["a/b/y.USD", "a/x.usda", "a/x.usdc", "c/robot.urdf", "c/x.usd"]
    assert names(f"{tree}/**/*", exclude=[f"{tree}/a/**", f"{tree}/c/*.urdf"]) == ["x.usd"]


def test_a_named_file_is_taken_whatever_its_ending(tree: Path):
    assert names(str(tree / "c" / "notes.txt")) == ["notes.txt"]


@pytest.mark.parametrize("place", ["missing.usd", "**/*.nothing"])
def test_a_place_without_a_scene_is_an_error(tree: Path, place: str):
    with pytest.raises(
        SceneError, match="no scene found; expected a file, a folder with stages, or a pattern in quotes"
    ):
        find_scene_files([str(tree), place])


def test_outputs_never_clash(tree: Path):
    scenes = find_scene_files([str(tree)])
    assert output_names(scenes) == {
        "a/b/y.USD": "a/b/y",
        "a/x.usda": "a/x.usda",
        "a/x.usdc": "a/x.usdc",
        "c/x.usd": "c/x",
    }
