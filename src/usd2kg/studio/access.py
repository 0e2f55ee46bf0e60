"""KeyGate: ASGI middleware that asks for the access key on all requests for data."""

import asyncio
import hmac
import os
import secrets

from starlette.datastructures import Headers
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from usd2kg.errors import OutputError
from usd2kg.studio.settings import PASSWORD_VARIABLE, SERVER

__all__ = ["KeyGate", "choose_key", "has_password"]

_SCHEME = "Bearer "
_FAILURE_DELAY_S = 1.0
"""Slows down guessing of passwords."""


def has_password() -> bool:
    """Return whether the environment has a password, for which the page asks."""
    return bool(os.environ.get(PASSWORD_VARIABLE))


def choose_key(*, is_local: bool) -> str:
    """Return the access key: the password of the environment, or a random one for this machine alone.

    Raises:
        OutputError: other machines can connect, and there is no password, or a short one.
    """
    if is_local and not has_password():
        return secrets.token_urlsafe(24)
    password = os.environ.get(PASSWORD_VARIABLE, "")
    if len(password) < SERVER.min_password:
        why = "" if is_local else ", because other machines can connect"
        raise OutputError(
            f"{PASSWORD_VARIABLE} has {len(password)} characters; expected at least {SERVER.min_password}{why}"
        )
    return password


class KeyGate:
    """Refuses requests below /api/ that do not carry the key in the header Authorization.

    Browsers send that header only from pages that know the key, so other sites cannot forge requests.
    """

    def __init__(self, app: ASGIApp, key: str) -> None:
        self._app = app
        self._key = key.encode()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it with 401."""
        if scope["type"] == "http" and scope["path"].startswith("/api/") and not self._is_allowed(Headers(scope=scope)):
            await asyncio.sleep(_FAILURE_DELAY_S)
            refusal = JSONResponse({"error": "the access key is missing or wrong"}, 401)
            await refusal(scope, receive, send)
            return
        await self._app(scope, receive, send)

    def _is_allowed(self, headers: Headers) -> bool:
        given = headers.get("authorization", "")
        return given.startswith(_SCHEME) and hmac.compare_digest(given.removeprefix(_SCHEME).encode(), self._key)
