"""JobJournal: a record of submitted batch jobs in the cache file, so that no completion is lost or paid for twice.

A job is recorded with its requests before it is submitted, and its id once the service returns it. If the process is
killed in between, the job has no id, and `BatchQueue.submit` looks for it at the service. The completions of a job are
stored and the job is closed in one transaction.
"""

import json
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from usd2kg.errors import GroundingError, StoreError
from usd2kg.folder_lock import lock_exclusive
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.serialization import (
    CacheEntry,
    make_entry,
    order_request_fields,
    read_request,
    request_fields,
    to_json,
)

__all__ = ["JobJournal", "JobRecord"]

_SCHEMA = (
    "CREATE TABLE IF NOT EXISTS jobs (number INTEGER PRIMARY KEY, model TEXT NOT NULL, id TEXT, handle TEXT NOT NULL,"
    " recorded REAL NOT NULL, is_open INTEGER NOT NULL)",
    "CREATE TABLE IF NOT EXISTS job_requests (job INTEGER NOT NULL REFERENCES jobs, key TEXT NOT NULL,"
    " system TEXT NOT NULL REFERENCES shared, schema TEXT NOT NULL REFERENCES shared, rest TEXT NOT NULL,"
    " PRIMARY KEY (job, key)) WITHOUT ROWID",
)
_JOBS = "SELECT number, model, id, handle, recorded FROM jobs WHERE is_open"
_REQUESTS = (
    "SELECT key, system.text, schema.text, rest FROM job_requests"
    " JOIN shared AS system ON system.digest = job_requests.system"
    " JOIN shared AS schema ON schema.digest = job_requests.schema WHERE job = ?"
)


@dataclass(frozen=True, slots=True)
class JobRecord:
    """An open job."""

    number: int
    """Number of the job in the journal."""
    model: str
    """The model string."""
    id: str | None
    """Id given by the service; None if it is unknown whether the service received the job."""
    handle: Mapping[str, Any]
    """JSON that the client library needs to poll the job, without credentials."""
    recorded_s: float
    """Unix time just before the submission."""
    keys: frozenset[str]
    """Cache keys of the requests."""


class JobJournal:
    """The jobs in the file of a cache, shared by processes. All methods raise GroundingError as the cache does."""

    def __init__(self, cache: CompletionCache) -> None:
        """Open the journal in the file of `cache`."""
        self._cache = cache
        with cache.transaction() as connection:
            for statement in _SCHEMA:
                connection.execute(statement)

    @contextmanager
    def submitting(self) -> Iterator[None]:
        """Exclude submissions of other processes, which might contain the same prompts.

        Raises:
            GroundingError: another process is still submitting.
        """
        try:
            with lock_exclusive(self._cache.path.parent, LIMITS.submission_lock_s):
                yield
        except StoreError as error:
            raise GroundingError(f"batch jobs: {error}") from error

    def open_jobs(self, model: str | None = None) -> list[JobRecord]:
        """Return the jobs of a model, or of all models, that are not closed, oldest first."""
        with self._cache.transaction() as connection:
            rows = connection.execute(f"{_JOBS} ORDER BY number").fetchall()
            keys = {
                row[0]: connection.execute("SELECT key FROM job_requests WHERE job = ?", row[:1]).fetchall()
                for row in rows
            }
        return [
            JobRecord(number, name, identifier, json.loads(handle), recorded, frozenset(key for (key,) in keys[number]))
            for number, name, identifier, handle, recorded in rows
            if model in (None, name)
        ]

    def known_ids(self) -> frozenset[str]:
        """Return the ids of all jobs, closed ones included."""
        with self._cache.transaction() as connection:
            rows = connection.execute("SELECT id FROM jobs WHERE id IS NOT NULL").fetchall()
        return frozenset(identifier for (identifier,) in rows)

    def begin(self, model: str, requests: Iterable[Request], handle: Mapping[str, Any]) -> JobRecord:
        """Record a job before it is submitted."""
        # The empty completion is a placeholder; only the request columns are stored.
        entries = [make_entry(model, request_fields(request), Completion("")) for request in requests]
        now = time.time()
        with self._cache.transaction() as connection:
            cursor = connection.execute(
                "INSERT INTO jobs (model, handle, recorded, is_open) VALUES (?, ?, ?, 1)", (model, to_json(handle), now)
            )
            number = cursor.lastrowid
            assert number is not None
            connection.executemany(
                "INSERT OR IGNORE INTO shared VALUES (?, ?)", (pair for entry in entries for pair in entry.shared)
            )
            connection.executemany(
                "INSERT INTO job_requests VALUES (?, ?, ?, ?, ?)", ((number, *entry.values[:4]) for entry in entries)
            )
        return JobRecord(number, model, None, dict(handle), now, frozenset(entry.values[0] for entry in entries))

    def confirm(self, job: JobRecord, identifier: str, handle: Mapping[str, Any]) -> JobRecord:
        """Record the id that the service gave a job."""
        with self._cache.transaction() as connection:
            connection.execute(
                "UPDATE jobs SET id = ?, handle = ? WHERE number = ?", (identifier, to_json(handle), job.number)
            )
        return JobRecord(job.number, job.model, identifier, dict(handle), job.recorded_s, job.keys)

    def read_requests(self, job: JobRecord) -> dict[str, Request]:
        """Return the requests of a job by cache key, without their images."""
        with self._cache.transaction() as connection:
            rows = connection.execute(_REQUESTS, (job.number,)).fetchall()
        return {key: read_request(_fields(*texts)) for key, *texts in rows}

    def close(self, job: JobRecord, completions: Mapping[str, Completion]) -> None:
        """Store the completions of a job by cache key, and close it; completions of unknown keys are ignored."""
        with self._cache.transaction() as connection:
            rows = connection.execute(_REQUESTS, (job.number,)).fetchall()
            for key, *texts in rows:
                if key in completions:
                    self._cache.insert(_entry(job.model, texts, completions[key]))
            connection.execute("DELETE FROM job_requests WHERE job = ?", (job.number,))
            # Keep the id: `known_ids` must not mistake this job for one that was submitted without an id.
            connection.execute("UPDATE jobs SET is_open = 0 WHERE number = ?", (job.number,))


def _fields(system: str, schema: str, rest: str) -> dict[str, Any]:
    # The cache key depends on the order.
    return order_request_fields({"system": json.loads(system), "schema": json.loads(schema), **json.loads(rest)})


def _entry(model: str, texts: list[str], completion: Completion) -> CacheEntry:
    return make_entry(model, _fields(*texts), completion)
