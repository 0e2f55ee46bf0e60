"""Writing results: whole or not at all."""

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

from usd2kg.errors import OutputError

__all__ = ["check_apart", "check_writable", "is_same_file", "write_whole"]


def check_apart(outputs: Iterable[Path | None], inputs: Iterable[Path | str | None]) -> None:
    """Raise OutputError now if an output is the file of an input, or of another output; None stands for no file.

    Inputs may be texts that name no file, such as the address of a store.
    """
    read = [Path(path) for path in inputs if path is not None]
    written: list[Path] = []
    for output in outputs:
        # Devices take whatever is written.
        if output is None or (output.exists() and not output.is_file()):
            continue
        if any(is_same_file(output, other) for other in read):
            raise OutputError(f"{output}: is an input, too, and would be overwritten; choose another output")
        if any(is_same_file(output, other) for other in written):
            raise OutputError(f"{output}: is named for two outputs; choose another output")
        written.append(output)


def is_same_file(path: Path, other: Path) -> bool:
    """Return whether two paths lead to one file, through links too; where there is none yet, whether they are alike."""
    if path.exists() and other.exists():
        return path.samefile(other)
    return path.resolve() == other.resolve()


def check_writable(path: Path) -> None:
    """Raise OutputError now if `path` could not be written later, before any work is spent."""
    if path.is_dir():
        raise OutputError(f"{path}: is a folder, expected a file name to write to")
    folder = path.parent
    if not folder.is_dir():
        raise OutputError(f"{path}: the folder {folder} does not exist; create it or choose another output")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise OutputError(f"{path}: is not writable; choose another output or change its permissions")


def write_whole(path: Path, data: bytes | Iterable[bytes | memoryview]) -> None:
    """Write `data`, maybe in pieces, to `path`, so that a reader sees the old file or the whole new one, never a part.

    A link stays a link: what it points to is written. Devices and pipes are written to as they are.
    """
    check_writable(path)
    path = path.resolve()
    pieces = (data,) if isinstance(data, bytes) else data
    try:
        if path.exists() and not path.is_file():
            with path.open("wb") as device:
                device.writelines(pieces)
            return
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        try:
            with os.fdopen(handle, "wb") as file:
                file.writelines(pieces)
            Path(temporary).chmod(_usual_mode())
            Path(temporary).replace(path)
        finally:
            # Still there only where something went wrong.
            Path(temporary).unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"{path}: could not be written ({error.strerror}); choose another output") from error


def _usual_mode() -> int:
    # mkstemp makes files for the owner alone; a result should be as readable as any other file.
    umask = os.umask(0)
    os.umask(umask)
    return 0o666 & ~umask
