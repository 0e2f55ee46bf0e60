"""Files of arrays and texts beside the index of a large graph, so that what is computed from it is computed once."""

import json
import logging
import os
import tempfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["Columns", "keep_columns", "pack_texts", "unpack_texts"]

logger = logging.getLogger(__name__)

Columns = Mapping[str, NDArray[Any]]
"""Name → array."""
_Table = TypeVar("_Table")


def keep_columns(
    path: Path | None,
    read: Callable[[Columns], _Table],
    make: Callable[[], _Table],
    write: Callable[[_Table], Columns],
) -> _Table:
    """Return a table from its file; if that is missing or damaged, make the table and write the file.

    Args:
        path: the file; None to make the table each time.
        read: table from its columns; raises KeyError or ValueError if they do not fit.
        make: computes the table.
        write: columns of a table; none if it is not worth a file.
    """
    if path is None:
        return make()
    if path.is_file():
        try:
            with np.load(path, allow_pickle=False) as file:
                return read({name: file[name] for name in file.files})
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
            logger.warning("%s: is damaged and is made again (%s)", path, error)
    table = make()
    if columns := write(table):
        with suppress(OSError):
            _save(path, columns)
    return table


def pack_texts(texts: Sequence[str]) -> NDArray[np.uint8]:
    """Return texts as an array of bytes."""
    return np.frombuffer(json.dumps(texts).encode(), dtype=np.uint8)


def unpack_texts(packed: NDArray[np.uint8]) -> list[str]:
    """Return the texts of `pack_texts`."""
    texts: list[str] = json.loads(packed.tobytes())
    return texts


def _save(path: Path, columns: Columns) -> None:
    # Two processes may write at the same time, and each can be killed.
    handle, name = tempfile.mkstemp(suffix=".npz", dir=path.parent)
    os.close(handle)
    try:
        np.savez(name, allow_pickle=False, **columns)
        Path(name).replace(path)
    finally:
        Path(name).unlink(missing_ok=True)
