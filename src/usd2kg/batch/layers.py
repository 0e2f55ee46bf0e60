"""The files that a scene refers to, recorded with its graph and compared with the disk when a batch resumes."""

import os
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path

from usd2kg.files import hash_file
from usd2kg.scene import StageFile

__all__ = ["ChangedFiles", "relative_files"]

_NOT_KNOWN = ""
"""Hash of a file that changed while its scene was built."""


def relative_files(files: Iterable[StageFile], source: Path, begun_ns: int) -> tuple[StageFile, ...]:
    """Return the files that a scene refers to, with paths relative to its folder.

    Args:
        files: those of the scene.
        source: the scene itself, which is left out.
        begun_ns: when the scene began to be read. OpenUSD may have read what a file contained before a later change,
            so such a file gets no hash.
    """
    root = source.resolve()
    return tuple(
        replace(
            file,
            path=_relative(file.path, root.parent),
            sha256=file.sha256 if file.modified_ns < begun_ns else _NOT_KNOWN,
        )
        for file in files
        if Path(file.path).resolve() != root
    )


class ChangedFiles:
    """Compares recorded files with those on disk; a file shared by many scenes is checked once."""

    def __init__(self) -> None:
        self._state = cache(_state)
        self._hash = cache(hash_file)

    def any_of(self, files: Iterable[StageFile], source: Path) -> bool:
        """Return whether a file of a scene has changed since it was recorded, or is missing."""
        folder = source.resolve().parent
        return any(self._has_changed(file, folder / file.path) for file in files)

    def _has_changed(self, file: StageFile, path: Path) -> bool:
        state = self._state(path)
        if state is None or not file.sha256:
            return True
        if state == (file.bytes, file.modified_ns):
            return False
        try:
            return state[0] != file.bytes or self._hash(path) != file.sha256
        except OSError:
            # Building the scene reports the problem.
            return True


def _state(path: Path) -> tuple[int, int] | None:
    """Return the size and the modification time; None for a missing file."""
    try:
        state = path.stat()
    except OSError:
        return None
    return state.st_size, state.st_mtime_ns


def _relative(path: str, folder: Path) -> str:
    try:
        return Path(os.path.relpath(path, folder)).as_posix()
    except ValueError:
        # The file is on another Windows drive.
        return path
