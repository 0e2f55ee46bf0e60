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

Listener = asyncio.Queue[str | None]
"""Texts for one page; None ends its stream."""


class LiveEvents:
    """The pages that listen; used from one event loop, except `publish_soon`."""

    def __init__(self) -> None:
        self._listeners: set[Listener] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        """That of the listeners; None before the first."""

    def publish(self, name: str, data: dict[str, Any]) -> None:
        """Send an event to all pages."""
        text = self.format(name, data)
        for listener in list(self._listeners):
            try:
                listener.put_nowait(text)
            except asyncio.QueueFull:
                # The page reconnects and asks for what it missed.
                _end(listener)
                self._listeners.discard(listener)

    def publish_soon(self, name: str, data: dict[str, Any]) -> None:
        """Send an event to all pages, from another thread than that of the event loop, which must still run."""
        if self._loop is not None:
            self._loop.call_soon_threadsafe(self.publish, name, data)

    @staticmethod
    def format(name: str, data: dict[str, Any]) -> str:
        """Return an event as text of the stream."""
        return f"event: {name}\ndata: {json.dumps(data)}\n\n"

    def subscribe(self) -> Listener:
        """Return a listener that receives all events from now on; `listen` reads it."""
        self._loop = asyncio.get_running_loop()
        listener: Listener = asyncio.Queue(_WAITING)
        self._listeners.add(listener)
        return listener

    async def listen(self, listener: Listener, first: str = "") -> AsyncIterator[str]:
        """Yield the text of the stream: `first`, then each event, with comments in between as signs of life."""
        try:
            yield first or ": connected\n\n"
            while True:
                try:
                    text = await asyncio.wait_for(listener.get(), SERVER.heartbeat_s)
                except TimeoutError:
                    text = ": alive\n\n"
                if text is None:
                    return
                yield text
        finally:
            self._listeners.discard(listener)

    def close(self) -> None:
        """End all streams."""
        for listener in self._listeners:
            _end(listener)


def _end(listener: Listener) -> None:
    with suppress(asyncio.QueueEmpty):
        while True:
            listener.get_nowait()
    listener.put_nowait(None)
