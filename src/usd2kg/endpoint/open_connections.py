"""Connections: the open connections of a server, and the bytes of unsent answers."""

import asyncio

from usd2kg.endpoint.http_limits import HTTP_LIMITS, HttpServerLimits

__all__ = ["Connections"]


class Connections:
    """The transports of all open connections; used from one event loop."""

    def __init__(self, limits: HttpServerLimits = HTTP_LIMITS) -> None:
        self._limits = limits
        self._open: set[asyncio.Transport] = set()
        self._most = min(limits.connections, max(1, _open_files() - limits.spare_files))

    def add(self, transport: asyncio.Transport) -> bool:
        """Add a connection; return False if there are too many."""
        if len(self._open) >= self._most:
            return False
        self._open.add(transport)
        return True

    def discard(self, transport: asyncio.Transport) -> None:
        """Remove a connection that is closed."""
        self._open.discard(transport)

    def can_hold(self, count: int) -> bool:
        """Return whether an answer of `count` bytes fits the budget, together with the unsent answers."""
        held = sum(transport.get_write_buffer_size() for transport in self._open)
        return held == 0 or held + count <= self._limits.held_bytes

    def abort_all(self) -> None:
        """Close all connections and drop unsent answers."""
        for transport in list(self._open):
            transport.abort()


def _open_files() -> int:
    """Return the open-file limit of this process; a large number on systems without such a limit."""
    try:
        import resource  # noqa: PLC0415 - not on every system
    except ModuleNotFoundError:
        return 1 << 20
    soft, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    return 1 << 20 if soft == resource.RLIM_INFINITY else soft
