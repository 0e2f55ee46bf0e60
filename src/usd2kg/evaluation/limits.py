"""Limits on the files that `eval fetch` downloads."""

from dataclasses import dataclass

__all__ = ["FETCH", "FetchLimits"]


@dataclass(frozen=True, slots=True)
class FetchLimits:
    """Download of one file."""

    timeout_s: float = 60.0
    """Longest time without a response."""
    file_bytes: int = 10_000_000_000


FETCH = FetchLimits()
