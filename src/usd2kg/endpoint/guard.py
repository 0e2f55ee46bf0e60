"""Guard: what a browser could be tricked into is turned away before a query is read."""

import ipaddress
from collections.abc import Iterable
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

__all__ = ["Guard", "host_of"]

_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cache-Control": "no-store",
}
_STRICT = "default-src 'none'; frame-ancestors 'none'"
"""Content-Security-Policy of all that brings none of its own."""


class Guard:
    """Checks Host and Origin of each request, and adds the headers that keep a browser careful.

    A page of another site may have a name of its own point to this machine and then ask as if it were from here (DNS
    rebinding): so only names that are known are served. Addresses in digits need no name, and so cannot be rebound.
    """

    def __init__(self, app: ASGIApp, hosts: Iterable[str], origins: Iterable[str]) -> None:
        self._app = app
        self._hosts = frozenset({"localhost", *(host.lower() for host in hosts)})
        self._origins = frozenset(origins)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request, or turn it away."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        fault = self._fault(headers)
        origin = headers.get("origin")
        is_shared = origin in self._origins or "*" in self._origins

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                added = MutableHeaders(scope=message)
                for name, value in _HEADERS.items():
                    added[name] = value
                added.setdefault("Content-Security-Policy", _STRICT)
                added["Cross-Origin-Resource-Policy"] = "cross-origin" if self._origins else "same-origin"
                if origin is not None and is_shared:
                    added["Access-Control-Allow-Origin"] = "*" if "*" in self._origins else origin
                    added["Access-Control-Expose-Headers"] = "X-SPARQL-MaxRows, Usd2kg-Rows"
                    added["Access-Control-Allow-Headers"] = "Content-Type, Accept"
                    added["Access-Control-Allow-Methods"] = "GET, POST"
                    added.add_vary_header("Origin")
            await send(message)

        app = self._app if fault is None else PlainTextResponse(fault + "\n", 403)
        await app(scope, receive, send_guarded)

    def _fault(self, headers: Headers) -> str | None:
        host = host_of(headers.get("host", ""))
        if not (host in self._hosts or _is_address(host)):
            return "this host name is not served here; start usd2kg serve with --allow-host to add it"
        origin = headers.get("origin")
        is_own = origin is not None and urlsplit(origin).netloc.lower() == headers.get("host", "").lower()
        if origin is None or is_own or origin in self._origins or "*" in self._origins:
            return None
        return "pages of other sites may not ask here; start usd2kg serve with --cors to let them"


def host_of(netloc: str) -> str:
    """Return the host in a Host header, without its port and brackets.

    >>> host_of("LOCALHOST:7878"), host_of("[::1]:80"), host_of("::1:x")
    ('localhost', '::1', '')
    """
    try:
        return urlsplit(f"//{netloc}").hostname or ""
    except ValueError:
        return ""


def _is_address(host: str) -> bool:
    try:
        ipaddress.ip_address(host)
    except ValueError:
        return False
    return True
