"""BoundedServer: uvicorn with protection against slow or numerous clients."""

import asyncio
import logging
import socket
import time
from collections.abc import Callable

import uvicorn
from starlette.applications import Starlette

from usd2kg.endpoint.http_limits import HTTP_LIMITS, HttpServerLimits
from usd2kg.endpoint.http_protocol import BoundedProtocol
from usd2kg.endpoint.open_connections import Connections

__all__ = ["BoundedServer"]


class BoundedServer(uvicorn.Server):
    """An HTTP server with limits on connections, times and unsent answers, which stops within `shutdown_s`."""

    def __init__(
        self, app: Starlette, connections: Connections, shutdown_s: int, limits: HttpServerLimits = HTTP_LIMITS
    ) -> None:
        def make_protocol(**options: object) -> BoundedProtocol:
            return BoundedProtocol(connections, limits, **options)

        config = uvicorn.Config(
            app,
            http=make_protocol,  # type: ignore[arg-type]
            ws="none",
            log_level="warning",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=shutdown_s,
            backlog=limits.backlog,
        )
        super().__init__(config)
        self._connections = connections
        self._shutdown_s = shutdown_s
        for name in ("uvicorn.error", "asyncio"):
            logging.getLogger(name).addFilter(_RateFilter(limits.log_lines, limits.log_period_s))

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop; answers that clients have not read in time are dropped."""
        timer = asyncio.get_running_loop().call_later(self._shutdown_s, self._connections.abort_all)
        try:
            await super().shutdown(sockets)
        finally:
            timer.cancel()
            self._connections.abort_all()


class _RateFilter(logging.Filter):
    """Rate-limits the records of a logger, and reports how many were dropped."""

    def __init__(self, most: int, period_s: float, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._most, self._period_s, self._clock = most, period_s, clock
        self._start = -period_s
        self._count = 0

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a record is logged."""
        now = self._clock()
        if now - self._start >= self._period_s:
            dropped = self._count - self._most
            self._start, self._count = now, 0
            if dropped > 0:
                record.msg, record.args = f"{record.getMessage()} ({dropped} earlier messages suppressed)", ()
        self._count += 1
        return self._count <= self._most
