"""Files that a scene refers to, and their changes."""

import os
from pathlib import Path

from usd2kg.batch.layers import ChangedFiles, relative_files
from usd2kg.files import hash_file
from usd2kg.scene import StageFile


def state_of(path: Path) -> StageFile:
    state = path.stat()
    return StageFile(str(path), state.st_size, state.st_mtime_ns, hash_file(path))


def test_a_file_that_changed_during_the_build_has_no_hash_and_counts_as_changed(tmp_path: Path):
    scene, early, late = (tmp_path / name for name in ("scene.usda", "early.usda", "late.usda"))
    for path, time in ((scene, 10), (early, 10), (late, 30)):
        path.write_text(path.name)
        os.utime(path, ns=(time, time))
    files = relative_files([state_of(path) for path in (early, late, scene)], scene, begun_ns=20)
    assert [(file.path, bool(file.sha256)) for file in files] == [("early.usda", True), ("late.usda", False)]
    assert [ChangedFiles().any_of([file], scene) for file in files] == [False, True]


def test_a_link_to_a_scene_leads_to_the_folder_of_its_files(tmp_path: Path):
    for name in ("real/scene.usda", "real/cup.usda"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(name)
    link = tmp_path / "link.usda"
    link.symlink_to("real/scene.usda")
    files = relative_files([state_of(tmp_path / name) for name in ("real/scene.usda", "real/cup.usda")], link, 1 << 63)
    assert [file.path for file in files] == ["cup.usda"]
    assert not ChangedFiles().any_of(files, link)
