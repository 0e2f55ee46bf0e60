"""LiveEvents: sends each change to all open pages, as server-sent events."""

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import suppress
from typing import Any

from usd2kg.studio.settings import SERVER

__all__ = ["LiveEvents"]

_WAITING = 1000
"""Changes that may wait for a slow page; it then has to load all states again."""


class LiveEvents:
    """The pages that listen; used from one event loop."""

    def __init__(self) -> None:
        self._listeners: set[asyncio.Queue[str | None]] = set()

    def publish(self, change: dict[str, Any]) -> None:
        """Send a change to all pages."""
        text = self.format(change)
        for queue in self._listeners:
            try:
                queue.put_nowait(text)
            except asyncio.QueueFull:
                # The page reconnects and asks for what it missed.
                _end(queue)

    @staticmethod
    def format(change: dict[str, Any]) -> str:
        """Return a change as an event of the stream."""
        return f"event: change\nid: {change['version']}\ndata: {json.dumps(change)}\n\n"

    async def listen(self, first: str = "") -> AsyncIterator[str]:
        """Yield the text of the stream: `first`, then each change, with comments in between as signs of life."""
        queue: asyncio.Queue[str | None] = asyncio.Queue(_WAITING)
        self._listeners.add(queue)
        try:
            yield first or ": connected\n\n"
            while True:
                try:
                    text = await asyncio.wait_for(queue.get(), SERVER.heartbeat_s)
                except TimeoutError:
                    text = ": alive\n\n"
                if text is None:
                    return
                yield text
        finally:
            self._listeners.discard(queue)

    def close(self) -> None:
        """End all streams."""
        for queue in self._listeners:
            _end(queue)


def _end(queue: "asyncio.Queue[str | None]") -> None:
    with suppress(asyncio.QueueEmpty):
        while True:
            queue.get_nowait()
    queue.put_nowait(None)
