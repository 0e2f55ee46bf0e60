"""Files: hashed, checked before work starts, and written atomically."""

import hashlib
import os
import tempfile
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from usd2kg.errors import OutputError

__all__ = ["check_apart", "check_writable", "hash_file", "is_same_file", "name_of", "stem_of", "write_whole"]

_TEMPORARY = ".tmp"
"""Ending of temporary files."""
_RANDOM = 8
"""Random characters in the names that `mkstemp` makes."""
_ABANDONED_S = 3600
"""Age in seconds after which a temporary file is that of a killed process; no write pauses for so long."""


def check_apart(outputs: Iterable[Path | None], inputs: Iterable[Path | str | None]) -> None:
    """Raise OutputError if an output would overwrite an input or another output.

    None is ignored, as are inputs that are not files, such as the URL of a store.
    """
    read = [Path(path) for path in inputs if path is not None]
    written: list[Path] = []
    for output in outputs:
        # Several outputs may share a device such as /dev/null.
        if output is None or (output.exists() and not output.is_file()):
            continue
        if any(is_same_file(output, other) for other in read):
            raise OutputError(f"{output}: is an input, too, and would be overwritten; choose another output")
        if any(is_same_file(output, other) for other in written):
            raise OutputError(f"{output}: is named for two outputs; choose another output")
        written.append(output)


def is_same_file(path: Path, other: Path) -> bool:
    """Return whether two paths lead to the same file; links are followed, and the files need not exist."""
    if path.exists() and other.exists():
        return path.samefile(other)
    return path.resolve() == other.resolve()


def check_writable(path: Path) -> None:
    """Raise OutputError if `path` cannot be written, before time is spent on its content."""
    if path.is_dir():
        raise OutputError(f"{path}: is a folder, expected a file name to write to")
    folder = path.parent
    if not folder.is_dir():
        raise OutputError(f"{path}: the folder {folder} does not exist; create it or choose another output")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise OutputError(f"{path}: is not writable; choose another output or change its permissions")


def name_of(path: Path) -> str:
    """Return the name of a file or folder as the user named it, also of `.` and `..`; links are not followed.

    >>> name_of(Path("scenes/rooms/.."))
    'scenes'
    """
    return Path(os.path.abspath(path)).name  # noqa: PTH100 - `Path.absolute` keeps `..`, `resolve` follows links


def stem_of(path: Path) -> str:
    """Return the name of a scene: that of a file without its ending, of a folder the whole name."""
    return name_of(path) if path.is_dir() else path.stem


def hash_file(path: Path) -> str:
    """Return the SHA-256 of a file as hexadecimal digits."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def write_whole(path: Path, data: bytes | Iterable[bytes | memoryview]) -> None:
    """Write bytes, or chunks of bytes, atomically: readers see the old file or the complete new one.

    The target of a symbolic link is replaced, not the link. Devices and pipes are written in place.

    Raises:
        OutputError: the file cannot be written; an existing file is unchanged.
    """
    check_writable(path)
    path = path.resolve()
    chunks = (data,) if isinstance(data, bytes) else data
    try:
        if path.exists() and not path.is_file():
            with path.open("wb") as device:
                device.writelines(chunks)
        else:
            _replace(path, chunks)
    except OSError as error:
        raise OutputError(f"{path}: could not be written ({error.strerror}); choose another output") from error


def _replace(path: Path, chunks: Iterable[bytes | memoryview]) -> None:
    prefix = f".{path.name}."
    _remove_abandoned(path.parent, prefix)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=prefix, suffix=_TEMPORARY)
    try:
        with os.fdopen(handle, "wb") as file:
            file.writelines(chunks)
        Path(temporary).chmod(_default_mode())
        Path(temporary).replace(path)
    finally:
        # Exists only if an error occurred.
        Path(temporary).unlink(missing_ok=True)


def _remove_abandoned(folder: Path, prefix: str) -> None:
    """Remove the temporary files of killed writes of the same file."""
    with suppress(OSError):
        for entry in os.scandir(folder):
            is_temporary = entry.name.startswith(prefix) and entry.name.endswith(_TEMPORARY)
            is_temporary &= len(entry.name) == len(prefix) + _RANDOM + len(_TEMPORARY)
            # Another process may be writing.
            if is_temporary and time.time() - entry.stat().st_mtime > _ABANDONED_S:
                Path(entry.path).unlink()


def _default_mode() -> int:
    # mkstemp restricts files to the owner; a result has the permissions of an ordinary new file.
    umask = os.umask(0)
    os.umask(umask)
    return 0o666 & ~umask
