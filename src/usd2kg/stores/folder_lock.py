"""One writer or many readers of a folder, on every system, and free again when a process dies."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from usd2kg.errors import StoreError

__all__ = ["LOCK_NAME", "lock_exclusive", "lock_shared"]

LOCK_NAME = "usd2kg.lock"
"""An empty SQLite database: its locks are those of the file, shared or exclusive, on every system."""


@contextmanager
def lock_exclusive(folder: Path, seconds: float) -> Iterator[None]:
    """Keep all other processes out of a folder; wait so long for those that are in it.

    Raises:
        StoreError: another process is still in it, or the folder cannot be written to.
    """
    try:
        lock = sqlite3.connect(folder / LOCK_NAME, timeout=seconds, isolation_level=None)
    except sqlite3.OperationalError as error:
        raise StoreError(f"{folder}: cannot be written to ({error}); change its permissions") from error
    with closing(lock):
        _take(lock, "BEGIN EXCLUSIVE", folder, seconds)
        yield


@contextmanager
def lock_shared(folder: Path, seconds: float) -> Iterator[None]:
    """Keep writers out of a folder; wait so long for one that is in it.

    Raises:
        StoreError: a writer is still in it.
    """
    path = folder / LOCK_NAME
    if not path.exists():
        # No writer of ours was ever here, and a folder that is only read need not become writable.
        yield
        return
    with closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True, timeout=seconds)) as lock:
        lock.isolation_level = None
        _take(lock, "BEGIN", folder, seconds)
        # A transaction takes its lock when it first reads.
        _take(lock, "SELECT name FROM sqlite_master", folder, seconds)
        yield


def _take(lock: sqlite3.Connection, statement: str, folder: Path, seconds: float) -> None:
    try:
        lock.execute(statement).fetchall()
    except sqlite3.OperationalError as error:
        if error.sqlite_errorcode & 0xFF == sqlite3.SQLITE_BUSY:
            raise StoreError(
                f"{folder}: another process is still using it after {seconds:g} s; wait for it, then try again"
            ) from error
        raise StoreError(f"{folder}: cannot be locked ({error}); expected a folder that can be written to") from error
    except sqlite3.DatabaseError as error:
        raise StoreError(f"{folder / LOCK_NAME}: is no lock of ours ({error}); remove that file") from error
