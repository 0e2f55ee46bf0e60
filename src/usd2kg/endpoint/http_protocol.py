"""BoundedProtocol: uvicorn's HTTP/1.1 with time limits for the request head, the body and the response."""

import asyncio
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol

from usd2kg.endpoint.http_limits import HttpServerLimits
from usd2kg.endpoint.open_connections import Connections

__all__ = ["BoundedProtocol"]


class BoundedProtocol(H11Protocol):
    """One connection; uvicorn itself would wait for a client indefinitely."""

    def __init__(self, connections: Connections, limits: HttpServerLimits, **options: Any) -> None:
        super().__init__(**options)
        self._all = connections
        self._limits = limits
        self._reading: asyncio.TimerHandle | None = None
        self._writing: asyncio.TimerHandle | None = None
        self._is_in_body = False
        self._unsent = 0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Start waiting for a request; reject the connection if there are too many."""
        super().connection_made(transport)
        if not self._all.add(transport):
            transport.abort()
            return
        self._wait_for_request()

    def connection_lost(self, exc: Exception | None) -> None:
        """Remove the connection from the open ones."""
        self._all.discard(self.transport)
        self._stop_reading()
        self._stop_writing()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Process a chunk of a request."""
        super().data_received(data)
        self._wait_for_request()

    def on_response_complete(self) -> None:
        """Wait for the next request of a connection that is kept alive."""
        self._is_in_body = False
        self._stop_reading()
        super().on_response_complete()

    def pause_writing(self) -> None:
        """Start checking that the client reads its response."""
        super().pause_writing()
        self._unsent = self.transport.get_write_buffer_size()
        self._stop_writing()
        self._writing = self.loop.call_later(self._limits.write_s, self._check_progress)

    def resume_writing(self) -> None:
        """Stop checking; the client has read the response."""
        self._stop_writing()
        super().resume_writing()

    def _wait_for_request(self) -> None:
        """Set the time limit for the missing part of the request: its head, then its body."""
        is_answering = self.cycle is not None and not self.cycle.response_complete
        if is_answering and not self.cycle.more_body:
            self._stop_reading()
        elif is_answering and not self._is_in_body:
            self._is_in_body = True
            self._limit_reading(self._limits.body_s)
        elif not is_answering and self._reading is None:
            self._is_in_body = False
            self._limit_reading(self._limits.head_s)

    def _limit_reading(self, seconds: float) -> None:
        self._stop_reading()
        self._reading = self.loop.call_later(seconds, self._give_up)

    def _give_up(self) -> None:
        self.transport.abort()

    def _stop_reading(self) -> None:
        if self._reading is not None:
            self._reading.cancel()
            self._reading = None

    def _check_progress(self) -> None:
        unsent = self.transport.get_write_buffer_size()
        if self._unsent - unsent < self._limits.write_bytes:
            self._give_up()
            return
        self._unsent = unsent
        self._writing = self.loop.call_later(self._limits.write_s, self._check_progress)

    def _stop_writing(self) -> None:
        if self._writing is not None:
            self._writing.cancel()
            self._writing = None
