"""StudioServer: the server of the endpoint, which ends the streams of changes before it waits for open requests."""

import socket

from starlette.applications import Starlette

from usd2kg.endpoint.bounded_server import BoundedServer
from usd2kg.endpoint.open_connections import Connections

__all__ = ["StudioServer"]

_SHUTDOWN_S = 3
"""Seconds that requests have to finish when the server stops."""


class StudioServer(BoundedServer):
    """An HTTP server of the application that `make_app` returns."""

    def __init__(self, app: Starlette) -> None:
        super().__init__(app, Connections(), _SHUTDOWN_S)
        self._end_streams = app.state.end_streams

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop; open pages would otherwise keep their streams until they are cancelled with an error."""
        self._end_streams()
        await super().shutdown(sockets)
