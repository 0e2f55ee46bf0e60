"""EndpointLimits: the resources that one query and one server may use."""

from dataclasses import dataclass

__all__ = ["EndpointLimits"]


@dataclass(frozen=True)
class EndpointLimits:
    """Operational limits of the endpoint; `usd2kg serve` has options for the first five."""

    seconds: float = 10.0
    """Running time of one query."""
    rows: int = 10_000
    """Rows or triples of one answer; further ones are cut off."""
    body_bytes: int = 1 << 20
    """Size of one request."""
    memory_mib: int = 1024
    """Memory of one query, in addition to that of an idle worker; Linux only."""
    workers: int = 2
    """Queries that run at the same time."""
    queued_per_worker: int = 32
    """Waiting queries per worker; further ones are rejected."""
    answer_bytes: int = 64 << 20
    """Size of one SELECT result; the rest is cut off."""
    orphan_grace_s: float = 5.0
    """Seconds beyond `seconds` after which a worker terminates itself, in case the server has died."""
    shutdown_s: int = 3
    """Seconds that running requests have to finish when the server stops."""
