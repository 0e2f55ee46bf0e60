"""Project folders: made, opened again, moved, locked."""

import shutil
from pathlib import Path

import pytest

from usd2kg.errors import GroundingError, OutputError, StoreError
from usd2kg.scene import ReadOptions, SelectionOverrides
from usd2kg.studio import ProjectSources, open_project


def test_a_project_is_opened_with_its_sources(tmp_path: Path):
    reading = ReadOptions(metres_per_unit=0.01, selection=SelectionOverrides(include=("/A/**",)))
    sources = ProjectSources(tmp_path / "a.usda", tmp_path / "o.ttl", base="https://my.lab/", reading=reading)
    with open_project(tmp_path / "a.studio", sources):
        pass
    with open_project(tmp_path / "a.studio") as project:
        assert project.sources == sources


def test_a_project_moves_with_its_scene(tmp_path: Path):
    (tmp_path / "one").mkdir()
    with open_project(tmp_path / "one" / "a.studio", ProjectSources(tmp_path / "one" / "a.usda")):
        pass
    shutil.move(tmp_path / "one", tmp_path / "two")
    with open_project(tmp_path / "two" / "a.studio") as project:
        assert project.sources.scene == tmp_path / "two" / "a.usda"


def test_one_process_has_a_project_open(tmp_path: Path):
    with (
        open_project(tmp_path / "p", ProjectSources(tmp_path / "a.usda")),
        pytest.raises(StoreError, match="a studio may be open on it"),
        open_project(tmp_path / "p"),
    ):
        pass


def test_other_folders_and_other_sources_are_refused(tmp_path: Path):
    with pytest.raises(GroundingError, match=r"has no project\.json"), open_project(tmp_path):
        pass
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.tex").touch()
    sources = ProjectSources(tmp_path / "a.usda")
    with pytest.raises(OutputError, match="is not empty and no project"), open_project(tmp_path / "full", sources):
        pass
    with open_project(tmp_path / "p", sources):
        pass
    other = ProjectSources(tmp_path / "b.usda")
    with pytest.raises(GroundingError, match=r"is about the scene .*a\.usda, not .*b\.usda"):
        open_project(tmp_path / "p", other).__enter__()
    (tmp_path / "p" / "project.json").write_text('{"format": "usd2kg-studio/9"}')
    with pytest.raises(GroundingError, match=r"cannot be read \(another format\)"), open_project(tmp_path / "p"):
        pass
