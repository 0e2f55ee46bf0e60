"""Output files are checked in advance and written atomically."""

import errno
import os
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

import pytest

from usd2kg.errors import OutputError
from usd2kg.files import check_apart, check_writable, write_whole


def test_writes_a_new_file_without_leftovers(tmp_path: Path):
    write_whole(tmp_path / "graph.ttl", b"\x00\r\n\xff")
    assert (tmp_path / "graph.ttl").read_bytes() == b"\x00\r\n\xff"
    assert [path.name for path in tmp_path.iterdir()] == ["graph.ttl"]


def test_replaces_an_existing_file(tmp_path: Path):
    path = tmp_path / "graph.ttl"
    path.write_bytes(b"old and longer")
    write_whole(path, b"new")
    assert path.read_bytes() == b"new"


def test_writes_chunks_in_order(tmp_path: Path):
    write_whole(tmp_path / "graph.ttl", (piece for piece in (b"one ", memoryview(b"and two")[4:], b"!")))
    assert (tmp_path / "graph.ttl").read_bytes() == b"one two!"


def test_keeps_the_old_file_if_a_chunk_fails(tmp_path: Path):
    def chunks():
        yield b"half"
        raise ValueError("no more")

    path = tmp_path / "graph.ttl"
    path.write_bytes(b"old")
    with pytest.raises(ValueError, match="no more"):
        write_whole(path, chunks())
    assert path.read_bytes() == b"old"
    assert [found.name for found in tmp_path.iterdir()] == ["graph.ttl"]


def test_new_files_have_default_permissions(tmp_path: Path):
    mask = os.umask(0o027)
    try:
        write_whole(tmp_path / "graph.ttl", b"x")
        (tmp_path / "other").write_bytes(b"x")
        assert os.umask(0o027) == 0o027, "the umask is unchanged"
    finally:
        os.umask(mask)
    modes = {stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("graph.ttl", "other")}
    assert modes == {0o640}


@pytest.mark.parametrize("moment", ["mkstemp", "write", "replace"])
def test_keeps_the_old_file_if_the_disk_is_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, moment: str):
    path = tmp_path / "graph.ttl"
    path.write_bytes(b"old")

    def fail(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    owner, name = {"mkstemp": (tempfile, "mkstemp"), "write": (Path, "chmod"), "replace": (Path, "replace")}[moment]
    monkeypatch.setattr(owner, name, fail)
    with pytest.raises(OutputError) as error:
        write_whole(path, b"new")
    assert str(error.value) == f"{path}: could not be written (No space left on device); choose another output"
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["graph.ttl"]


def test_keeps_the_old_file_on_interruption(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    path = tmp_path / "graph.ttl"
    path.write_bytes(b"old")
    monkeypatch.setattr(Path, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_whole(path, b"new")
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["graph.ttl"]


def test_replaces_the_target_of_a_link(tmp_path: Path):
    target, link = tmp_path / "runs" / "graph.ttl", tmp_path / "latest.ttl"
    target.parent.mkdir()
    target.write_bytes(b"old")
    link.symlink_to(target)
    write_whole(link, b"new")
    assert link.is_symlink()
    assert target.read_bytes() == b"new"


def test_writes_into_pipes_and_devices(tmp_path: Path):
    # Writing to /dev/null must not replace the device; a pipe serves as an example.
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    try:
        with suppress(OutputError):
            write_whole(pipe, b"new")
            assert os.read(reader, 10) == b"new"
    finally:
        os.close(reader)
    assert stat.S_ISFIFO(pipe.stat().st_mode)


class TestChecks:
    def test_accepts_new_and_existing_files_without_touching_them(self, tmp_path: Path):
        old = tmp_path / "old.ttl"
        old.write_bytes(b"old")
        check_writable(old)
        check_writable(tmp_path / "new.ttl")
        assert old.read_bytes() == b"old"
        assert [p.name for p in tmp_path.iterdir()] == ["old.ttl"]

    def test_accepts_a_name_in_the_current_folder(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.chdir(tmp_path)
        check_writable(Path("graph.ttl"))

    def test_rejects_a_folder(self, tmp_path: Path):
        with pytest.raises(OutputError, match="is a folder, expected a file name"):
            check_writable(tmp_path)

    def test_rejects_a_missing_parent_folder(self, tmp_path: Path):
        with pytest.raises(OutputError, match="does not exist; create it"):
            check_writable(tmp_path / "none" / "graph.ttl")
        (tmp_path / "file").write_bytes(b"")
        with pytest.raises(OutputError, match="does not exist"):
            check_writable(tmp_path / "file" / "graph.ttl")

    @pytest.mark.parametrize("locked", ["folder", "graph.ttl"])
    def test_rejects_paths_without_write_permission(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, locked: str):
        # os.access is patched because chmod does not restrict root.
        folder = tmp_path / "folder"
        folder.mkdir()
        path = folder / "graph.ttl"
        path.write_bytes(b"")
        monkeypatch.setattr(os, "access", lambda asked, mode: Path(asked).name != locked)
        with pytest.raises(OutputError, match="is not writable"):
            check_writable(path)


@pytest.mark.parametrize("name", ["in.csv", "./in.csv", "sub/../in.csv", "soft.csv", "hard.csv"])
def test_rejects_an_output_that_is_an_input(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str):
    monkeypatch.chdir(tmp_path)
    Path("sub").mkdir()
    Path("in.csv").write_text("kept")
    Path("soft.csv").symlink_to("in.csv")
    os.link("in.csv", "hard.csv")
    with pytest.raises(OutputError) as error:
        check_apart([None, Path("out.csv"), Path(name)], ["http://localhost/sparql", None, Path("in.csv")])
    assert str(error.value) == f"{Path(name)}: is an input, too, and would be overwritten; choose another output"


def test_rejects_two_outputs_to_the_same_file(tmp_path: Path):
    with pytest.raises(OutputError, match=r"a\.csv: is named for two outputs; choose another output"):
        check_apart([tmp_path / "a.csv", tmp_path / "b.csv", tmp_path / "x" / ".." / "a.csv"], [])
    check_apart([Path(os.devnull), Path(os.devnull)], [Path(os.devnull)])


def test_a_write_removes_what_a_killed_write_of_the_file_left(tmp_path):
    abandoned, recent, other = (
        tmp_path / name for name in (".a.ttl.abcdefgh.tmp", ".a.ttl.12345678.tmp", ".a.ttl.mine.tmp")
    )
    for path in (abandoned, recent, other):
        path.write_text("half")
    for path in (abandoned, other):
        os.utime(path, (0, 0))
    write_whole(tmp_path / "a.ttl", b"whole")
    assert {path.name for path in tmp_path.iterdir()} == {"a.ttl", recent.name, other.name}
