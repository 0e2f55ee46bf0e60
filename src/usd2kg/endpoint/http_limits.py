"""HttpServerLimits: time limits for a client, and the memory budget for unsent answers of all clients."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = ["HTTP_LIMITS", "HttpServerLimits"]


@dataclass(frozen=True)
class HttpServerLimits:
    """Limits on connections, of the endpoint and of the studio."""

    head_s: float
    body_s: float
    write_s: float
    write_bytes: int
    connections: int
    spare_files: int
    backlog: int
    held_bytes: int
    log_lines: int
    log_period_s: float


HTTP_LIMITS = read_settings("endpoint", "http", HttpServerLimits)
