"""HttpServerLimits: how long a client may take, and how much all clients may hold."""

from dataclasses import dataclass

__all__ = ["HTTP_LIMITS", "HttpServerLimits"]


@dataclass(frozen=True)
class HttpServerLimits:
    """Limits on connections, of the endpoint and of the studio."""

    head_s: float = 10.0
    """Seconds until the head of a request is complete, from the connection or from its first byte."""
    body_s: float = 60.0
    """Seconds until the body of a request is complete."""
    write_s: float = 10.0
    """Seconds in which a client has to take `write_bytes` of an answer that waits for it."""
    write_bytes: int = 64 << 10
    connections: int = 512
    """Open connections; further ones are closed."""
    spare_files: int = 256
    """Files that a process may open in addition to its connections: workers, the store, connections to be refused."""
    backlog: int = 64
    """Connections that are accepted at a time."""
    held_bytes: int = 256 << 20
    """Bytes of all answers that wait for their clients; further answers are refused."""
    log_lines: int = 20
    """Messages about clients in each `log_period_s`; the rest is counted."""
    log_period_s: float = 60.0


HTTP_LIMITS = HttpServerLimits()
