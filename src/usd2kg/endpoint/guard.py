"""Guard: ASGI middleware against DNS rebinding and cross-site requests."""

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
    "Content-Security-Policy": "default-src 'none'; frame-ancestors 'none'",
}
"""Default security headers of responses."""


class Guard:
    """Checks Host, Origin and Sec-Fetch-Site of each request, and adds security headers to each response.

    In DNS rebinding, another site makes its own host name resolve to this machine, so that browsers treat its requests
    as same-origin. Therefore only known host names are served. IP addresses are not resolved and cannot be rebound.
    """

    def __init__(self, app: ASGIApp, hosts: Iterable[str], origins: Iterable[str]) -> None:
        self._app = app
        self._hosts = frozenset({"localhost", *(host.lower() for host in hosts)})
        self._origins = frozenset(origins)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or reject it with status 403."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        refusal = self._refusal(headers, scope["path"])
        origin = headers.get("origin")
        is_shared = origin in self._origins or "*" in self._origins

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                added = MutableHeaders(scope=message)
                for name, value in _HEADERS.items():
                    added.setdefault(name, value)
                added["Cross-Origin-Resource-Policy"] = "cross-origin" if self._origins else "same-origin"
                if origin is not None and is_shared:
                    added["Access-Control-Allow-Origin"] = "*" if "*" in self._origins else origin
                    added["Access-Control-Expose-Headers"] = "X-SPARQL-MaxRows, Usd2kg-Rows"
                    added["Access-Control-Allow-Headers"] = "Content-Type, Accept"
                    added["Access-Control-Allow-Methods"] = "GET, POST"
                    added.add_vary_header("Origin")
            await send(message)

        app = self._app if refusal is None else PlainTextResponse(refusal + "\n", 403)
        await app(scope, receive, send_guarded)

    def _refusal(self, headers: Headers, path: str) -> str | None:
        """Return why a request is rejected; None if it is allowed."""
        host = host_of(headers.get("host", ""))
        if not (host in self._hosts or _is_address(host)):
            return "this host name is not served; add it with --allow-host"
        origin = headers.get("origin")
        is_own = origin is not None and urlsplit(origin).netloc.lower() == headers.get("host", "").lower()
        if is_own or "*" in self._origins or (origin is not None and origin in self._origins):
            return None
        # Browsers send no Origin for images, scripts and links of other sites. A link to the page itself does no harm.
        is_link = path == "/" and headers.get("sec-fetch-mode") == "navigate"
        if origin is None and (headers.get("sec-fetch-site") != "cross-site" or is_link):
            return None
        return "cross-site requests are not allowed; usd2kg serve --cors allows an origin to query"


def host_of(netloc: str) -> str:
    """Return the host of a Host header, without port and brackets.

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
