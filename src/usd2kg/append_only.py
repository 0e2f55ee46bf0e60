"""AppendOnlyFile: a file of lines that only grows and survives a crash."""

import errno
import os
from contextlib import suppress
from pathlib import Path

__all__ = ["AppendOnlyFile", "whole_lines"]


class AppendOnlyFile:
    """A file that is open for lines at its end. Only one process may have it open."""

    def __init__(self, path: Path, size: int) -> None:
        """Open a file, or start it.

        Args:
            path: the file.
            size: bytes to keep, see `whole_lines`; the rest is removed.

        Raises:
            OSError: it cannot be opened or cut.
        """
        # Unbuffered, so that a failed write leaves nothing to be written later.
        self._path = path
        self._file = path.open("ab", buffering=0)
        if size < os.fstat(self._file.fileno()).st_size:
            self._file.truncate(size)

    def append(self, lines: bytes) -> None:
        """Write lines to disk.

        Raises:
            OSError: the disk is full or the file is gone; what was written of the lines is removed.
        """
        opened = os.fstat(self._file.fileno())
        size = opened.st_size
        # Unix writes on to a file that was moved or deleted.
        if not self._path.exists() or not os.path.samestat(opened, self._path.stat()):
            raise FileNotFoundError(errno.ENOENT, "the file was moved or deleted while it was open", str(self._path))
        try:
            rest = memoryview(lines)
            while rest:
                # An unbuffered write may write fewer bytes.
                rest = rest[self._file.write(rest) :]
            os.fsync(self._file.fileno())
        except OSError:
            with suppress(OSError):
                self._file.truncate(size)
            raise

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def whole_lines(data: bytes) -> bytes:
    r"""Return the content of a file without a last line that a crash cut short.

    >>> whole_lines(b"one\ntwo\nth")
    b'one\ntwo\n'
    """
    return data[: data.rfind(b"\n") + 1]
