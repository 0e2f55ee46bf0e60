"""Cache of parsed graph files: a large file is parsed once, and later questions open its index on disk."""

import hashlib
import logging
import os
import shutil
import sqlite3
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path

import pyoxigraph as ox

from usd2kg.cache_folder import chosen_cache_folder
from usd2kg.errors import StoreError
from usd2kg.folder_lock import LOCK_NAME, lock_exclusive, lock_shared, release_when_unused
from usd2kg.query.dataset import INDEX_NAME
from usd2kg.query.settings import CACHE

__all__ = ["GRAPH_CACHE_VARIABLE", "open_cached", "open_tables"]

logger = logging.getLogger(__name__)

GRAPH_CACHE_VARIABLE = "USD2KG_GRAPH_CACHE"
"""Environment variable: a folder for the cache, or `off`."""
_NEW = ".new-"
"""Beginning of the name of an entry that is being written."""
_MIB = 1 << 20
_FAILURES = (OSError, RuntimeError, StoreError, sqlite3.Error)
"""What an unusable cache raises; the file is then read without it."""


def open_cached(path: Path, load: Callable[[ox.Store], None]) -> tuple[ox.Store, Path, object] | None:
    """Return the read-only index of a graph file, made by `load` if it is missing; its folder; and what keeps it.

    An entry belongs to a path, size and times of change, as in a build tool. It is made aside and renamed, so that
    processes never see half of one, and readers lock it against removal as long as the object that keeps it exists.
    The least recently used entries are removed beyond `CACHE.max_mib`.

    Returns:
        None for small files, which are parsed faster than they are indexed, and where the cache is off or unusable.

    Raises:
        SyntaxError: the file does not parse; so do other errors of `load`, except those of the disk.
    """
    folder = chosen_cache_folder(GRAPH_CACHE_VARIABLE, "graphs")
    if folder is None or path.stat().st_size < CACHE.min_mib * _MIB:
        return None
    entry = folder / _key(path)
    try:
        found = _open(entry)
        if found is None:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            logger.warning("%s: is indexed for this and later questions", path)
    except _FAILURES as error:
        logger.info("%s: not cached (%s)", path, error)
        return None
    return found or _make(entry, path, load)


def open_tables(state: Sequence[object]) -> Path | None:
    """Return a folder for tables that are computed from a graph elsewhere; None where the cache is off or unusable.

    Args:
        state: what the tables depend on; equal states share a folder.
    """
    folder = chosen_cache_folder(GRAPH_CACHE_VARIABLE, "graphs")
    if folder is None:
        return None
    entry = folder / _digest(state)
    try:
        entry.mkdir(parents=True, exist_ok=True, mode=0o700)
        if not (entry / LOCK_NAME).exists():
            with lock_exclusive(entry, CACHE.lock_wait_s):
                pass
            _remove_old(entry)
        os.utime(entry)
    except _FAILURES as error:
        logger.info("%s: tables are not cached (%s)", folder, error)
        return None
    return entry


def _key(path: Path) -> str:
    """Return the name of the entry of a file as it is now."""
    state = path.stat()
    # A program can set the time of modification back, but not that of the last change of the file.
    times = (state.st_mtime_ns, state.st_ctime_ns)
    return _digest((str(path.resolve()), state.st_size, *times, state.st_ino))


def _digest(state: Sequence[object]) -> str:
    return hashlib.blake2b(repr((*state, ox.__version__)).encode(), digest_size=16).hexdigest()


def _open(entry: Path) -> tuple[ox.Store, Path, object] | None:
    """Return an entry that is complete, after marking it as used now."""
    if not entry.is_dir():
        return None
    with ExitStack() as stack:
        stack.enter_context(lock_shared(entry, CACHE.lock_wait_s))
        try:
            store = ox.Store.read_only(str(entry / INDEX_NAME))
        except (OSError, RuntimeError) as error:
            logger.warning("%s: is damaged and is made again (%s)", entry, error)
            stack.close()
            shutil.rmtree(entry, ignore_errors=True)
            return None
        with suppress(OSError):
            os.utime(entry)
        return store, entry, release_when_unused(stack.pop_all())


def _make(entry: Path, path: Path, load: Callable[[ox.Store], None]) -> tuple[ox.Store, Path, object] | None:
    try:
        new = Path(tempfile.mkdtemp(prefix=_NEW, dir=entry.parent))
    except OSError as error:
        logger.info("%s: not cached (%s)", path, error)
        return None
    try:
        store = ox.Store(str(new / INDEX_NAME))
        load(store)
        store.flush()
        # The engine writes once more when it closes.
        del store
        with lock_exclusive(new, 0):
            pass
        if _key(path) == entry.name:
            with suppress(OSError):
                # Another process may have been faster.
                new.rename(entry)
            _remove_old(entry)
        return _open(entry)
    except _FAILURES as error:
        logger.warning("%s: cannot be indexed (%s)", path, error)
        return None
    finally:
        shutil.rmtree(new, ignore_errors=True)


def _remove_old(kept: Path) -> None:
    """Remove the least recently used entries beyond the size limit, and what killed processes left."""
    with suppress(*_FAILURES):
        abandoned = time.time() - CACHE.abandoned_h * 3600
        entries = []
        for entry in kept.parent.iterdir():
            used = entry.stat().st_mtime
            if entry.name.startswith(_NEW):
                if used < abandoned:
                    shutil.rmtree(entry, ignore_errors=True)
            elif entry != kept and (entry / LOCK_NAME).is_file():
                entries.append((used, entry))
        total = _size(kept)
        for _, entry in sorted(entries, reverse=True):
            total += _size(entry)
            if total > CACHE.max_mib * _MIB:
                _remove_unused(entry)


def _remove_unused(entry: Path) -> None:
    with suppress(*_FAILURES):
        with lock_exclusive(entry, 0):
            # Without its index, the entry is no longer opened.
            shutil.rmtree(entry / INDEX_NAME, ignore_errors=True)
        shutil.rmtree(entry)


def _size(entry: Path) -> int:
    return sum(file.stat().st_size for file in entry.rglob("*") if file.is_file())
