"""Completions kept on disk, so that no prompt is paid for twice and a run can be replayed without keys.

The cache is one SQLite file in WAL mode, with `-wal` and `-shm` beside it while it is in use (move them with it).
A completion is committed before `put` returns: it outlives the process, even one that is killed.
WAL needs a local disk: where the home folder is a network drive, set USD2KG_CACHE to a file on a local one.

Instructions with the TBox, and schemas, are shared by the requests of a run; the cache holds each once.

A file of format 1 is brought to format 2 when it is opened: all completions stay, without the mean log-probability that
stood in place of the tokens'. Versions of usd2kg that only know format 1 refuse the file from then on.
"""

import json
import os
import sqlite3
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from threading import Lock, RLock
from types import TracebackType
from typing import Self

from usd2kg.errors import GroundingError, OutputError
from usd2kg.files import write_whole
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.recordings import format_line, read_line
from usd2kg.grounding.llm.serialization import (
    UNREADABLE,
    CacheEntry,
    make_entry,
    read_completion,
    request_fields,
    request_key,
    to_json,
    upgrade_completion,
)

__all__ = ["CompletionCache", "default_cache_path"]

_APPLICATION_ID = int.from_bytes(b"u2kg")
_FILE_VERSION = 2
_BUSY_SECONDS = 60.0
_SCHEMA = (
    "CREATE TABLE IF NOT EXISTS shared (digest TEXT PRIMARY KEY, text TEXT NOT NULL)",
    "CREATE TABLE IF NOT EXISTS completions (key TEXT PRIMARY KEY, system TEXT NOT NULL REFERENCES shared,"
    " schema TEXT NOT NULL REFERENCES shared, rest TEXT NOT NULL, completion TEXT NOT NULL)",
    f"PRAGMA application_id = {_APPLICATION_ID}",
    f"PRAGMA user_version = {_FILE_VERSION}",
)
_EXPORT = (
    "SELECT key, system.text, schema.text, rest, completion FROM completions"
    " JOIN shared AS system ON system.digest = completions.system"
    " JOIN shared AS schema ON schema.digest = completions.schema ORDER BY key"
)
_creating = Lock()


def default_cache_path() -> Path:
    """Return where completions are kept unless the user says otherwise.

    That is `$USD2KG_CACHE` where it is set, else `usd2kg/completions.sqlite` in the user's cache folder:
    `%LOCALAPPDATA%` on Windows, elsewhere `$XDG_CACHE_HOME` or `~/.cache` (XDG Base Directory Specification 0.8,
    by which a relative `$XDG_CACHE_HOME` counts for nothing).

    Raises:
        GroundingError: the user has no home folder.
    """
    if chosen := os.environ.get("USD2KG_CACHE"):
        return Path(chosen)
    is_windows = sys.platform == "win32"
    folder = Path(os.environ.get("LOCALAPPDATA" if is_windows else "XDG_CACHE_HOME", ""))
    if not folder.is_absolute():
        try:
            folder = Path.home() / ("AppData/Local" if is_windows else ".cache")
        except RuntimeError as error:
            raise GroundingError(
                f"cache of completions: {error}; set USD2KG_CACHE to a file to keep them in"
            ) from error
    return folder / "usd2kg" / "completions.sqlite"


class CompletionCache:
    """The completions of all runs, by `request_key`.

    Threads may share one; processes open one each on the same path. All methods raise GroundingError where the file
    is damaged, foreign, or held by another program for longer than a minute.
    """

    path: Path
    """The file, with links resolved."""

    def __init__(self, path: Path) -> None:
        """Open the cache, with its folders where they are missing, readable by the user alone."""
        self.path = path.resolve()
        self._lock = RLock()
        _create_file(self.path)
        with self._translated(), ExitStack() as unless_ready:
            self._connection = sqlite3.connect(
                self.path, timeout=_BUSY_SECONDS, isolation_level=None, check_same_thread=False
            )
            unless_ready.callback(self._connection.close)
            self._prepare()
            unless_ready.pop_all()

    def get(self, model: str, request: Request) -> Completion | None:
        """Return what the model said to this request, None where it was never asked."""
        key = request_key(model, request)
        with self._lock, self._translated():
            row = self._connection.execute("SELECT completion FROM completions WHERE key = ?", (key,)).fetchone()
        if row is None:
            return None
        try:
            return read_completion(json.loads(row[0]))
        except UNREADABLE as error:
            raise GroundingError(f"{self.path}: completion {key} is damaged ({error}); {_remedy()}") from error

    def put(self, model: str, request: Request, completion: Completion, *, replace: bool = False) -> None:
        """Keep a completion, degenerate and cut-off ones too: they were paid for.

        A completion that is there already stays, unless `replace`. Two halves of a surrogate pair come back as the
        character that they make; all other text comes back as it is.
        """
        row = make_entry(model, request_fields(request), completion)
        with self._transaction("BEGIN IMMEDIATE"):
            self._insert(row, replace=replace)

    def export_recording(self, path: Path) -> int:
        """Write all completions with their requests as JSON Lines in UTF-8, sorted by key, and return how many.

        Two caches with the same content give the same bytes.

        Raises:
            OutputError: the file cannot be written.
        """
        if path.resolve() == self.path:
            raise OutputError(f"{path}: is the cache itself; choose another file for the recording")
        with self._lock, self._translated():
            lines = [format_line(*row) for row in self._connection.execute(_EXPORT)]
        write_whole(path, b"".join(lines))
        return len(lines)

    def import_recording(self, path: Path) -> int:
        """Add the completions of a recording, and return how many were new; those that are there already stay.

        Raises:
            GroundingError: the file or one of its lines cannot be read; then nothing is added.
        """
        try:
            with path.open("rb") as file, self._transaction("BEGIN IMMEDIATE"):
                before = len(self)
                for number, line in enumerate(file, start=1):
                    self._insert(read_line(path, number, line))
                return len(self) - before
        except OSError as error:
            raise GroundingError(
                f"{path}: cannot be read as a recording of completions ({error.strerror}); check its name"
            ) from error

    def close(self) -> None:
        """Close the file; the cache can no longer be used."""
        with self._lock:
            self._connection.close()

    def __len__(self) -> int:
        with self._lock, self._translated():
            (count,) = self._connection.execute("SELECT count(*) FROM completions").fetchone()
        return int(count)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def _prepare(self) -> None:
        with self._transaction("BEGIN"):
            (tables,) = self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
            (application,) = self._connection.execute("PRAGMA application_id").fetchone()
            (version,) = self._connection.execute("PRAGMA user_version").fetchone()
        is_new = (tables, application, version) == (0, 0, 0)
        if not is_new and application != _APPLICATION_ID:
            raise GroundingError(f"{self.path}: is the database of another program; {_remedy()}")
        if not is_new and version not in (1, _FILE_VERSION):
            raise GroundingError(f"{self.path}: has format {version}, expected {_FILE_VERSION}; {_remedy()}")
        self._switch_to_wal()
        # A killed process loses nothing by this; a power cut may lose the last completions, never the file.
        self._connection.execute("PRAGMA synchronous = NORMAL")
        if is_new:
            with self._transaction("BEGIN IMMEDIATE"):
                for statement in _SCHEMA:
                    self._connection.execute(statement)
        elif version == 1:
            self._upgrade()

    def _upgrade(self) -> None:
        self._connection.create_function("upgraded", 1, _upgraded, deterministic=True)
        with self._transaction("BEGIN IMMEDIATE"):
            # Another process may have been first; what it has brought up to date comes through unchanged.
            self._connection.execute("UPDATE completions SET completion = upgraded(completion)")
            self._connection.execute(f"PRAGMA user_version = {_FILE_VERSION}")

    def _switch_to_wal(self) -> None:
        # SQLite does not wait here where several processes open a new file at once: it gives up at once.
        deadline = time.monotonic() + _BUSY_SECONDS
        while True:
            try:
                self._connection.execute("PRAGMA journal_mode = WAL")
                return
            except sqlite3.OperationalError as error:
                if error.sqlite_errorcode & 0xFF != sqlite3.SQLITE_BUSY or time.monotonic() > deadline:
                    raise
                time.sleep(0.01)

    def _insert(self, row: CacheEntry, *, replace: bool = False) -> None:
        how = "REPLACE" if replace else "IGNORE"
        self._connection.executemany("INSERT OR IGNORE INTO shared VALUES (?, ?)", row.shared)
        self._connection.execute(f"INSERT OR {how} INTO completions VALUES (?, ?, ?, ?, ?)", row.values)

    @contextmanager
    def _transaction(self, begin: str) -> Iterator[None]:
        with self._lock, self._translated():
            try:
                self._connection.execute(begin)
                yield
                self._connection.execute("COMMIT")
            finally:
                # Still open only where something went wrong.
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")

    @contextmanager
    def _translated(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.ProgrammingError:
            raise
        except sqlite3.OperationalError as error:
            raise GroundingError(
                f"{self.path}: the cache of completions cannot be used ({error}); end what else holds it, check its"
                " permissions and the free space, or set USD2KG_CACHE to another file"
            ) from error
        except sqlite3.DatabaseError as error:
            raise GroundingError(f"{self.path}: is damaged or no cache ({error}); {_remedy()}") from error


def _create_file(path: Path) -> None:
    # Never opened where it exists: closing it would drop the locks that this process's other connections hold on it.
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with _creating, suppress(FileExistsError):
            path.touch(mode=0o600, exist_ok=False)
    except OSError as error:
        raise GroundingError(
            f"{path}: the cache of completions cannot be created ({error}); set USD2KG_CACHE to another file"
        ) from error


def _upgraded(text: str) -> str:
    try:
        return to_json(upgrade_completion(json.loads(text)))
    except UNREADABLE:
        # A damaged one is told of when it is asked for.
        return text


def _remedy() -> str:
    return "move it away to start an empty cache, or set USD2KG_CACHE to another file"
