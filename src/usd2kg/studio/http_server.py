"""StudioServer: uvicorn, which ends the streams of changes before it waits for open requests."""

import socket

import uvicorn
from starlette.applications import Starlette

__all__ = ["StudioServer"]

_SHUTDOWN_S = 3
"""Seconds that requests have to finish when the server stops."""


class StudioServer(uvicorn.Server):
    """An HTTP server of the application that `make_app` returns."""

    def __init__(self, app: Starlette) -> None:
        config = uvicorn.Config(app, log_level="warning", server_header=False, timeout_graceful_shutdown=_SHUTDOWN_S)
        super().__init__(config)
        self._end_streams = app.state.end_streams

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop; open pages would otherwise keep their streams until they are cancelled with an error."""
        self._end_streams()
        await super().shutdown(sockets)
