"""Operational limits of stores: timeouts, retries and sizes."""

from dataclasses import dataclass
from datetime import timedelta

__all__ = ["RESERVE_BYTES", "FolderLimits", "HttpLimits", "UploadLimits"]


@dataclass(frozen=True)
class HttpLimits:
    """Limits of requests to a server."""

    timeout_s: float = 120.0
    """Longest time without any data from the server."""
    attempts: int = 5
    """Attempts for a request whose failure may be transient."""
    first_pause_s: float = 0.5
    """Longest pause after the first failure; doubles with each further failure."""
    max_pause_s: float = 30.0
    """Longest pause that a server can request by Retry-After."""
    max_response_bytes: int = 1 << 30
    """Size of a response after decompression: about 7 million triples."""


@dataclass(frozen=True)
class UploadLimits:
    """Limits of uploads to a server."""

    chunk_triples: int = 10_000
    """Triples of one request: about 2 MB."""
    attempts: int = 3
    """Attempts for a chunk, for the final move, and for the whole upload."""
    stale_after: timedelta = timedelta(days=1)
    """Age at which an unfinished upload is considered dead and removed."""


@dataclass(frozen=True)
class FolderLimits:
    """Limits of a store folder."""

    lock_wait_s: float = 10.0
    """Time to wait for another process."""


RESERVE_BYTES = 4 << 20
"""Space reserved for removing graphs on a full disk; the engine writes 1 to 2 MiB (measured)."""
