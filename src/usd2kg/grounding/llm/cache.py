"""CompletionCache: completions on disk, so that no prompt is paid for twice and runs can be replayed without keys.

The cache is a SQLite file in WAL mode. While it is open, `-wal` and `-shm` files lie beside it; move them with it.
A completion is committed before `put` returns, so it survives if the process is killed. WAL requires a local disk: if
the home folder is on a network drive, set USD2KG_CACHE to a local file.

System prompts and schemas are shared by the requests of a run and stored once.

Opening a file of format 1 upgrades it to format 2. Completions are kept without the mean log-probability that format 1
stored instead of token log-probabilities. Versions of usd2kg that know only format 1 then reject the file.
"""

import gzip
import json
import os
import sqlite3
import time
import zlib
from collections.abc import Collection, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from threading import Lock, RLock
from types import TracebackType
from typing import Self

from usd2kg.cache_folder import cache_folder
from usd2kg.errors import GroundingError, OutputError
from usd2kg.files import write_whole
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.limits import LIMITS
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
_COMPRESSED = ".gz"
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
    """Return the default path of the cache: `$USD2KG_CACHE`, otherwise a file in the `cache_folder`.

    Raises:
        GroundingError: the home folder cannot be determined.
    """
    if chosen := os.environ.get("USD2KG_CACHE"):
        return Path(chosen)
    try:
        return cache_folder() / "completions.sqlite"
    except RuntimeError as error:
        raise GroundingError(f"cache of completions: {error}; set USD2KG_CACHE to a file to keep them in") from error


class CompletionCache:
    """The completions of all runs, by `request_key`.

    Threads can share an instance; each process opens its own on the same path. All methods raise GroundingError if the
    file is damaged, belongs to another program, or stays locked for `LIMITS.cache_busy_s`.
    """

    path: Path
    """The file, with symbolic links resolved."""

    def __init__(self, path: Path, *, creates: bool = True) -> None:
        """Open the cache.

        Args:
            path: the file.
            creates: create the file, readable only by the user, and its parent folders if it does not exist; otherwise
                that is a GroundingError.
        """
        self.path = path.resolve()
        self._lock = RLock()
        if creates:
            _create_file(self.path)
        elif not self.path.exists():
            raise GroundingError(f"{path}: no such cache of completions; correct --completions or USD2KG_CACHE")
        with self._translated(), ExitStack() as unless_ready:
            self._connection = sqlite3.connect(
                self.path, timeout=LIMITS.cache_busy_s, isolation_level=None, check_same_thread=False
            )
            unless_ready.callback(self._connection.close)
            self._prepare()
            unless_ready.pop_all()

    def get(self, model: str, request: Request) -> Completion | None:
        """Return the cached completion of a request; None if there is none."""
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
        """Store a completion, even if it is degenerate or truncated: it was paid for.

        An existing completion is kept unless `replace`. Text is preserved, except that two halves of a surrogate pair
        become the character they encode.
        """
        row = make_entry(model, request_fields(request), completion)
        with self.transaction():
            self.insert(row, replace=replace)

    def export_recording(self, path: Path, keys: Collection[str] | None = None) -> int:
        """Write completions with their requests as JSON Lines in UTF-8, sorted by key, and return their number.

        Caches with equal content produce equal bytes. A file that ends in `.gz` is compressed.

        Args:
            path: the recording.
            keys: keys of the completions to write, ignoring keys that are not in the cache; None for all.

        Raises:
            OutputError: the file cannot be written.
        """
        if path.resolve() == self.path:
            raise OutputError(f"{path}: is the cache itself; choose another file for the recording")
        with self._lock, self._translated():
            rows = self._connection.execute(_EXPORT)
            lines = [format_line(*row) for row in rows if keys is None or row[0] in keys]
        recording = b"".join(lines)
        # Without a time stamp, so that the bytes are reproducible.
        write_whole(path, gzip.compress(recording, mtime=0) if path.suffix == _COMPRESSED else recording)
        return len(lines)

    def import_recording(self, path: Path) -> int:
        """Add the completions of a recording that are not in the cache, and return their number.

        Raises:
            GroundingError: the file or one of its lines cannot be read; nothing is added.
        """
        read = gzip.open if path.suffix == _COMPRESSED else open
        try:
            with read(path, "rb") as file, self.transaction():
                before = len(self)
                for number, line in enumerate(file, start=1):
                    self.insert(read_line(path, number, line))
                return len(self) - before
        except (OSError, EOFError, zlib.error) as error:
            reason = getattr(error, "strerror", None) or error
            raise GroundingError(
                f"{path}: cannot be read as a recording of completions ({reason}); check its name"
            ) from error

    def close(self) -> None:
        """Close the file."""
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
        with self.transaction("BEGIN"):
            (tables,) = self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
            (application,) = self._connection.execute("PRAGMA application_id").fetchone()
            (version,) = self._connection.execute("PRAGMA user_version").fetchone()
        is_new = (tables, application, version) == (0, 0, 0)
        if not is_new and application != _APPLICATION_ID:
            raise GroundingError(f"{self.path}: is the database of another program; {_remedy()}")
        if not is_new and version not in (1, _FILE_VERSION):
            raise GroundingError(f"{self.path}: has format {version}, expected {_FILE_VERSION}; {_remedy()}")
        self._switch_to_wal()
        # Safe if the process is killed. A power failure may lose the last completions but does not damage the file.
        self._connection.execute("PRAGMA synchronous = NORMAL")
        if is_new:
            with self.transaction():
                for statement in _SCHEMA:
                    self._connection.execute(statement)
        elif version == 1:
            self._upgrade()

    def _upgrade(self) -> None:
        self._connection.create_function("upgraded", 1, _upgrade_text, deterministic=True)
        with self.transaction():
            # Another process may have upgraded the file in the meantime; upgraded completions stay unchanged.
            self._connection.execute("UPDATE completions SET completion = upgraded(completion)")
            self._connection.execute(f"PRAGMA user_version = {_FILE_VERSION}")

    def _switch_to_wal(self) -> None:
        # When several processes open a new file, this statement fails without waiting for the busy timeout.
        deadline = time.monotonic() + LIMITS.cache_busy_s
        while True:
            try:
                self._connection.execute("PRAGMA journal_mode = WAL")
                return
            except sqlite3.OperationalError as error:
                if error.sqlite_errorcode & 0xFF != sqlite3.SQLITE_BUSY or time.monotonic() > deadline:
                    raise
                time.sleep(LIMITS.cache_poll_s)

    def insert(self, row: CacheEntry, *, replace: bool = False) -> None:
        """Add an entry in a transaction; an existing one is kept unless `replace`."""
        conflict = "REPLACE" if replace else "IGNORE"
        self._connection.executemany("INSERT OR IGNORE INTO shared VALUES (?, ?)", row.shared)
        self._connection.execute(f"INSERT OR {conflict} INTO completions VALUES (?, ?, ?, ?, ?)", row.values)

    @contextmanager
    def transaction(self, begin: str = "BEGIN IMMEDIATE") -> Iterator[sqlite3.Connection]:
        """Begin a transaction, which is committed unless the block raises."""
        with self._lock, self._translated():
            try:
                self._connection.execute(begin)
                yield self._connection
                self._connection.execute("COMMIT")
            finally:
                # A transaction is still open only after an error.
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
                f"{self.path}: the cache of completions cannot be used ({error}); end other programs that use it, check"
                " its permissions and the free space, or set USD2KG_CACHE to another file"
            ) from error
        except sqlite3.DatabaseError as error:
            raise GroundingError(f"{self.path}: is damaged or is not a cache ({error}); {_remedy()}") from error


def _create_file(path: Path) -> None:
    # `touch` must not open an existing file: closing it would release the POSIX locks of other connections.
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with _creating, suppress(FileExistsError):
            path.touch(mode=0o600, exist_ok=False)
    except OSError as error:
        raise GroundingError(
            f"{path}: the cache of completions cannot be created ({error}); set USD2KG_CACHE to another file"
        ) from error


def _upgrade_text(text: str) -> str:
    try:
        return to_json(upgrade_completion(json.loads(text)))
    except UNREADABLE:
        # `get` reports a damaged completion.
        return text


def _remedy() -> str:
    return "move it away to start an empty cache, or set USD2KG_CACHE to another file"
