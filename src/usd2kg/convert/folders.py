"""The scene files of a folder: OBJ files, which form one scene, and files of other formats."""

import hashlib
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from usd2kg.errors import SceneError
from usd2kg.files import hash_file

__all__ = ["OBJ_ENDING", "FolderFiles", "hash_files", "holds_obj_files", "list_folder"]

OBJ_ENDING = ".obj"
_MAX_DEPTH = 32
"""Maximum nesting of folders."""
_MAX_ENTRIES = 200_000
"""Maximum number of files and folders to inspect; a larger folder is not a scene."""
_NOT_CONTENT = frozenset({"__MACOSX"})
"""Folders that archivers add."""


class FolderFiles(NamedTuple):
    """Files in a folder and the folders below it, sorted by path."""

    obj: tuple[Path, ...]
    others: tuple[Path, ...]
    """Files with a requested extension."""


def list_folder(folder: Path, endings: Iterable[str]) -> FolderFiles:
    """Return the OBJ files of a folder, and its files with one of `endings`; what starts with a dot is left out.

    Raises:
        SceneError: it has more than 200,000 files and folders, or folders that are nested more than 32 deep.
    """
    wanted = {*endings} - {OBJ_ENDING}
    files = list(_files_below(folder))
    return FolderFiles(
        tuple(file for file in files if file.suffix.lower() == OBJ_ENDING),
        tuple(file for file in files if file.suffix.lower() in wanted),
    )


def holds_obj_files(folder: Path) -> bool:
    """Return whether an OBJ file is in a folder or below it.

    Raises:
        SceneError: as `list_folder`, if no OBJ file comes before.
    """
    return any(file.suffix.lower() == OBJ_ENDING for file in _files_below(folder))


def hash_files(folder: Path, files: Iterable[Path]) -> str:
    """Return the SHA-256 of the lines that the program sha256sum prints for files, named relative to the folder."""
    digest = hashlib.sha256()
    for name, file in sorted((file.relative_to(folder).as_posix(), file) for file in files):
        digest.update(f"{hash_file(file)}  {name}\n".encode("utf-8", "surrogateescape"))
    return digest.hexdigest()


def _files_below(folder: Path) -> Iterator[Path]:
    """Yield files in the order of their paths within each folder, those of the folder itself first."""
    count = 0
    for parent, folders, files in os.walk(folder):
        count += len(folders) + len(files)
        if count > _MAX_ENTRIES:
            raise SceneError(
                f"{folder}: has more than {_MAX_ENTRIES:,} files and folders, expected those of one scene; "
                "name the folder with the scene"
            )
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name not in _NOT_CONTENT)
        if folders and len(Path(parent).relative_to(folder).parts) >= _MAX_DEPTH:
            raise SceneError(f"{parent}: its folders are nested more than {_MAX_DEPTH} deep, expected those of a scene")
        yield from (Path(parent, name) for name in sorted(files) if not name.startswith("."))
