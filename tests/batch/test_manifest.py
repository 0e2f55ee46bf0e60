"""The manifest survives a crash."""

from dataclasses import replace
from pathlib import Path

import pytest

from usd2kg.batch import JobStatus, Manifest, Record
from usd2kg.batch.manifest import SourceState
from usd2kg.errors import OutputError
from usd2kg.scene import StageFile

LAYER = StageFile("../assets/cup.usd", 30, 40, "def")
DONE = Record(
    "a/b.usd", JobStatus.DONE, "f00", SourceState(10, 20), "a/b.ttl", "abc", layers=(LAYER,), summary={"objects": 3}
)
FAILED = replace(DONE, scene="ü\u2028c.usd", status=JobStatus.FAILED, output="", sha256="", error="broken", summary={})


def test_records_are_read_back_and_the_last_counts(tmp_path: Path):
    path = tmp_path / "m.jsonl"
    with Manifest(path) as manifest:
        for record in (replace(DONE, status=JobStatus.FAILED, error="first"), FAILED, DONE):
            manifest.add(record)
    with Manifest(path) as manifest:
        assert manifest.get("a/b.usd") == DONE
        assert manifest.get("ü\u2028c.usd") == FAILED
        assert manifest.get("other.usd") is None
    assert len(path.read_text().splitlines()) == 3


@pytest.mark.parametrize("cut", [1, 5, 60])
def test_a_torn_last_line_is_dropped(tmp_path: Path, cut: int):
    path = tmp_path / "m.jsonl"
    with Manifest(path) as manifest:
        manifest.add(DONE)
        manifest.add(FAILED)
    path.write_bytes(path.read_bytes()[:-cut])
    with Manifest(path) as manifest:
        assert (manifest.get(DONE.scene), manifest.get(FAILED.scene)) == (DONE, None)
        manifest.add(FAILED)
    with Manifest(path) as manifest:
        assert manifest.get(FAILED.scene) == FAILED


@pytest.mark.parametrize("line", ["[]", "{}", "no JSON", '{"scene": 1, "source": {"bytes": 1}}'])
def test_another_file_is_refused(tmp_path: Path, line: str):
    path = tmp_path / "m.jsonl"
    path.write_text(f"{line}\n")
    with pytest.raises(OutputError, match=r"m\.jsonl: line 1 is not a record of a batch"):
        Manifest(path)
    assert path.read_text() == f"{line}\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    with Manifest(tmp_path / "m.jsonl") as manifest, Path("/dev/full").open("ab", buffering=0) as full:
        manifest.add(DONE)
        with monkeypatch.context() as patch:
            patch.setattr(manifest._file, "_file", full)
            with pytest.raises(OutputError, match="free space and run it again"):
                manifest.add(FAILED)
        assert manifest.get(FAILED.scene) is None


def test_a_device_is_refused(tmp_path: Path):
    (tmp_path / "m.jsonl").symlink_to("/dev/zero")
    with pytest.raises(OutputError, match="is not a file"):
        Manifest(tmp_path / "m.jsonl")
