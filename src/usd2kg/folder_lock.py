"""Lock on a folder: one writer or many readers, on every platform, released when a process dies."""

import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from weakref import finalize

from usd2kg.errors import StoreError

__all__ = ["LOCK_NAME", "lock_exclusive", "lock_shared", "release_when_unused"]

LOCK_NAME = "usd2kg.lock"
"""An empty SQLite database, whose file locks are shared or exclusive on every platform."""


class _Keeper:
    """An object that can be referred to weakly."""


def release_when_unused(locks: ExitStack) -> object:
    """Return an object; the locks are released when nothing refers to it any more."""
    keeper = _Keeper()
    finalize(keeper, locks.close)
    return keeper


@contextmanager
def lock_exclusive(folder: Path, seconds: float) -> Iterator[None]:
    """Lock a folder exclusively; wait up to `seconds` for other processes.

    Raises:
        StoreError: another process still uses the folder, or it is not writable.
    """
    try:
        lock = sqlite3.connect(folder / LOCK_NAME, timeout=seconds, isolation_level=None)
    except sqlite3.OperationalError as error:
        raise StoreError(f"{folder}: is not writable ({error}); change its permissions") from error
    with closing(lock):
        # Without a journal file, a folder on a full disk can be locked.
        _take(lock, "PRAGMA journal_mode = MEMORY", folder, seconds)
        _take(lock, "BEGIN EXCLUSIVE", folder, seconds)
        yield


@contextmanager
def lock_shared(folder: Path, seconds: float) -> Iterator[None]:
    """Lock a folder against writers; wait up to `seconds` for a writer.

    Raises:
        StoreError: a writer still uses the folder.
    """
    path = folder / LOCK_NAME
    if not path.exists():
        # Without a lock file, usd2kg has never written to the folder, which may be read-only.
        yield
        return
    uri = f"{path.resolve().as_uri()}?mode=ro"
    # The garbage collector may release the lock in any thread, see `release_when_unused`.
    with closing(sqlite3.connect(uri, uri=True, timeout=seconds, check_same_thread=False)) as lock:
        lock.isolation_level = None
        _take(lock, "BEGIN", folder, seconds)
        # SQLite acquires the shared lock at the first read of a transaction.
        _take(lock, "SELECT name FROM sqlite_master", folder, seconds)
        yield


def _take(lock: sqlite3.Connection, statement: str, folder: Path, seconds: float) -> None:
    try:
        lock.execute(statement).fetchall()
    except sqlite3.OperationalError as error:
        if error.sqlite_errorcode & 0xFF == sqlite3.SQLITE_BUSY:
            raise StoreError(
                f"{folder}: another process still uses it after {seconds:g} s; wait for it, then try again"
            ) from error
        raise StoreError(f"{folder}: cannot be locked ({error}); expected a writable folder") from error
    except sqlite3.DatabaseError as error:
        raise StoreError(f"{folder / LOCK_NAME}: is not a usd2kg lock ({error}); remove that file") from error
