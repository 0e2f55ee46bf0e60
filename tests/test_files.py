"""Results are written whole or not at all."""

import errno
import os
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

import pytest

from usd2kg.errors import OutputError
from usd2kg.files import check_apart, check_writable, write_whole


def test_a_new_file_holds_the_bytes_and_nothing_else_is_left(tmp_path: Path):
    write_whole(tmp_path / "graph.ttl", b"\x00\r\n\xff")
    assert (tmp_path / "graph.ttl").read_bytes() == b"\x00\r\n\xff"
    assert [path.name for path in tmp_path.iterdir()] == ["graph.ttl"]


def test_an_old_file_is_replaced(tmp_path: Path):
    path = tmp_path / "graph.ttl"
    path.write_bytes(b"old and longer")
    write_whole(path, b"new")
    assert path.read_bytes() == b"new"


def test_pieces_are_written_one_after_the_other(tmp_path: Path):
    write_whole(tmp_path / "graph.ttl", (piece for piece in (b"one ", memoryview(b"and two")[4:], b"!")))
    assert (tmp_path / "graph.ttl").read_bytes() == b"one two!"


def test_a_piece_that_fails_leaves_the_old_file(tmp_path: Path):
    def pieces():
        yield b"half"
        raise ValueError("no more")

    path = tmp_path / "graph.ttl"
    path.write_bytes(b"old")
    with pytest.raises(ValueError, match="no more"):
        write_whole(path, pieces())
    assert path.read_bytes() == b"old"
    assert [found.name for found in tmp_path.iterdir()] == ["graph.ttl"]


def test_it_is_as_readable_as_any_other_file(tmp_path: Path):
    mask = os.umask(0o027)
    try:
        write_whole(tmp_path / "graph.ttl", b"x")
        (tmp_path / "other").write_bytes(b"x")
        assert os.umask(0o027) == 0o027, "the process keeps its mask"
    finally:
        os.umask(mask)
    modes = {stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("graph.ttl", "other")}
    assert modes == {0o640}


@pytest.mark.parametrize("moment", ["mkstemp", "write", "replace"])
def test_a_full_disk_leaves_the_old_file_and_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, moment: str):
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


def test_an_interruption_leaves_the_old_file_and_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    path = tmp_path / "graph.ttl"
    path.write_bytes(b"old")
    monkeypatch.setattr(Path, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_whole(path, b"new")
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["graph.ttl"]


def test_a_link_stays_a_link_and_what_it_leads_to_is_replaced(tmp_path: Path):
    target, link = tmp_path / "runs" / "graph.ttl", tmp_path / "latest.ttl"
    target.parent.mkdir()
    target.write_bytes(b"old")
    link.symlink_to(target)
    write_whole(link, b"new")
    assert link.is_symlink()
    assert target.read_bytes() == b"new"


def test_what_is_no_regular_file_is_never_replaced_by_one(tmp_path: Path):
    # A pipe stands for devices too: a result sent to the null device must leave the device where it is.
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
    def test_a_new_and_an_old_file_pass_and_are_not_touched(self, tmp_path: Path):
        old = tmp_path / "old.ttl"
        old.write_bytes(b"old")
        check_writable(old)
        check_writable(tmp_path / "new.ttl")
        assert old.read_bytes() == b"old"
        assert [p.name for p in tmp_path.iterdir()] == ["old.ttl"]

    def test_a_bare_name_lies_in_the_current_folder(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.chdir(tmp_path)
        check_writable(Path("graph.ttl"))

    def test_a_folder_is_no_file(self, tmp_path: Path):
        with pytest.raises(OutputError, match="is a folder, expected a file name"):
            check_writable(tmp_path)

    def test_the_folder_must_exist(self, tmp_path: Path):
        with pytest.raises(OutputError, match="does not exist; create it"):
            check_writable(tmp_path / "none" / "graph.ttl")
        (tmp_path / "file").write_bytes(b"")
        with pytest.raises(OutputError, match="does not exist"):
            check_writable(tmp_path / "file" / "graph.ttl")

    @pytest.mark.parametrize("locked", ["folder", "graph.ttl"])
    def test_permissions_are_looked_at(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, locked: str):
        # Asked of the system and not tried with chmod: whoever may do everything would pass.
        folder = tmp_path / "folder"
        folder.mkdir()
        path = folder / "graph.ttl"
        path.write_bytes(b"")
        monkeypatch.setattr(os, "access", lambda asked, mode: Path(asked).name != locked)
        with pytest.raises(OutputError, match="is not writable"):
            check_writable(path)


@pytest.mark.parametrize("name", ["in.csv", "./in.csv", "sub/../in.csv", "soft.csv", "hard.csv"])
def test_an_output_that_is_an_input_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str):
    monkeypatch.chdir(tmp_path)
    Path("sub").mkdir()
    Path("in.csv").write_text("kept")
    Path("soft.csv").symlink_to("in.csv")
    os.link("in.csv", "hard.csv")
    with pytest.raises(OutputError) as error:
        check_apart([None, Path("out.csv"), Path(name)], ["http://localhost/sparql", None, Path("in.csv")])
    assert str(error.value) == f"{Path(name)}: is an input, too, and would be overwritten; choose another output"


def test_two_outputs_to_one_file_are_refused(tmp_path: Path):
    with pytest.raises(OutputError, match=r"a\.csv: is named for two outputs; choose another output"):
        check_apart([tmp_path / "a.csv", tmp_path / "b.csv", tmp_path / "x" / ".." / "a.csv"], [])
    check_apart([Path(os.devnull), Path(os.devnull)], [Path(os.devnull)])
