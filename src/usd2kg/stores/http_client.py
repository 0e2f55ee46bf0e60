"""SparqlClient: HTTP requests to a SPARQL server, with retries; messages never contain secrets.

It uses the standard library, which covers the SPARQL protocols, so that the core install needs no HTTP package.
"""

import email.utils
import gzip
import http.client
import logging
import random
import time
import urllib.error
import urllib.request
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from urllib.parse import urlsplit

from usd2kg.errors import StoreError
from usd2kg.stores.server_addresses import redact_address
from usd2kg.stores.store_limits import HttpLimits

__all__ = ["HttpRequest", "HttpResponse", "OutcomeUnknownError", "SparqlClient"]

logger = logging.getLogger(__name__)

_TRANSIENT = frozenset({429, 500, 502, 503, 504})
"""Status codes of failures that may be transient."""
_NOT_PROCESSED = frozenset({429, 503})
"""Status codes of a server that rejected the request before processing it."""
_BLOCK_BYTES = 1 << 20
"""Bytes that are read and decompressed at a time."""
_MAX_SHOWN = 500
"""Characters of a response in a message."""
_LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})


class OutcomeUnknownError(StoreError):
    """The connection broke after sending a request that must not be repeated; the server may have processed it."""


@dataclass(frozen=True)
class HttpRequest:
    """A request to a server."""

    method: str
    url: str
    body: bytes | None = None
    headers: Mapping[str, str] | None = None
    is_idempotent: bool = True
    """Whether repeating the request has no further effect."""

    @property
    def shown_url(self) -> str:
        """The address without secrets, for messages."""
        return redact_address(self.url)


@dataclass(frozen=True)
class HttpResponse:
    """The response of a server."""

    status: int
    content_type: str
    body: bytes


class _TransientError(Exception):
    """A failure that may be transient."""

    def __init__(self, reason: str, *, may_be_processed: bool, pause_s: float | None = None) -> None:
        super().__init__(reason)
        self.may_be_processed = may_be_processed
        """Whether the server may have processed the request."""
        self.pause_s = pause_s
        """Pause in seconds that the server requests; None if it requests none."""


class _NoRedirects(urllib.request.HTTPRedirectHandler):
    """Does not follow redirects: credentials and scenes must not go to a server that the user did not name."""

    # `redirect_request` is too late: the base class parses the new address first, and fails if it is malformed.
    def http_error_302(self, req: object, fp: object, code: object, msg: object, headers: object) -> None:
        return None

    http_error_301 = http_error_303 = http_error_307 = http_error_308 = http_error_302


class SparqlClient:
    """Sends requests to one server; TLS certificates are verified, redirects are not followed."""

    def __init__(
        self,
        authorization: str | None = None,
        *,
        limits: HttpLimits | None = None,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._authorization = authorization
        self._limits = limits or HttpLimits()
        self._sleep = sleep
        self._opener = urllib.request.build_opener(_NoRedirects)
        self._loopback_opener = urllib.request.build_opener(_NoRedirects, urllib.request.ProxyHandler({}))
        self._has_warned = False

    def send(self, request: HttpRequest, accepted: frozenset[int] = frozenset()) -> HttpResponse:
        """Return the response to a request, with a status of 200 to 299 or in `accepted`.

        Raises:
            OutcomeUnknownError: the connection broke, and the request is not idempotent.
            StoreError: the server is unreachable, keeps failing, or refuses the request.
        """
        attempts = self._limits.attempts
        for attempt in range(attempts):
            try:
                return self._send_once(request, accepted)
            except _TransientError as error:
                if error.may_be_processed and not request.is_idempotent:
                    raise OutcomeUnknownError(f"{request.shown_url}: {error}; the outcome is unknown") from error
                if attempt == attempts - 1:
                    raise StoreError(f"{request.shown_url}: {error}, {attempts} times; try again later") from error
                pause = self._pause(attempt, error.pause_s)
                logger.info("%s: %s; retry in %.1f s", request.shown_url, error, pause)
                self._sleep(pause)
        raise AssertionError("the last attempt returns or raises")

    def _send_once(self, request: HttpRequest, accepted: frozenset[int]) -> HttpResponse:
        message = urllib.request.Request(request.url, request.body, dict(request.headers or {}), method=request.method)
        message.add_header("Accept-Encoding", "gzip")
        message.add_header("User-Agent", "usd2kg")
        is_loopback = urlsplit(request.url).hostname in _LOOPBACK
        if self._authorization is not None:
            if request.url.startswith("http:") and not is_loopback:
                self._warn_unencrypted(request)
            message.add_unredirected_header("Authorization", self._authorization)
        opener = self._loopback_opener if is_loopback else self._opener
        try:
            with opener.open(message, timeout=self._limits.timeout_s) as response:
                return self._read(request, response.status, response)
        except urllib.error.HTTPError as error:
            with error:
                return self._read_error(request, error, accepted)
        except urllib.error.URLError as error:
            raise _connection_error(request, error.reason) from error
        except (OSError, http.client.HTTPException, EOFError, zlib.error) as error:
            raise _connection_error(request, error) from error

    def _warn_unencrypted(self, request: HttpRequest) -> None:
        if not self._has_warned:
            logger.warning("%s: credentials are sent unencrypted; use https", request.shown_url)
            self._has_warned = True

    def _pause(self, attempt: int, requested_s: float | None) -> float:
        """Return the pause in seconds: what the server requests, at most `max_pause_s`, else backoff with jitter."""
        if requested_s is not None:
            return min(requested_s, self._limits.max_pause_s)
        longest: float = self._limits.first_pause_s * 2**attempt
        return random.uniform(longest / 2, longest)

    def _read(
        self, request: HttpRequest, status: int, response: http.client.HTTPResponse | urllib.error.HTTPError
    ) -> HttpResponse:
        """Return a response, decompressed block by block, since a small body can expand beyond available memory."""
        is_gzip = response.headers.get("Content-Encoding", "").lower() == "gzip"
        source = gzip.GzipFile(fileobj=response) if is_gzip else response
        body = bytearray()
        while block := source.read(_BLOCK_BYTES):
            body += block
            if len(body) > self._limits.max_response_bytes:
                size = self._limits.max_response_bytes >> 20
                raise StoreError(f"{request.shown_url}: the response is larger than {size} MiB; select fewer triples")
        # Reading in blocks does not detect a truncated body by itself.
        if missing := getattr(response, "length", None):
            raise http.client.IncompleteRead(b"", missing)
        return HttpResponse(status, response.headers.get_content_type(), bytes(body))

    def _read_error(
        self, request: HttpRequest, error: urllib.error.HTTPError, accepted: frozenset[int]
    ) -> HttpResponse:
        """Return a response with an error status if that is accepted; otherwise raise."""
        status = error.code
        if status in accepted:
            return self._read(request, status, error)
        if status in _TRANSIENT:
            raise _TransientError(
                f"the server answers {status} {error.reason}",
                may_be_processed=status not in _NOT_PROCESSED,
                pause_s=_parse_retry_after(error.headers.get("Retry-After")),
            )
        if status in {401, 403}:
            raise StoreError(
                f"{request.shown_url}: the server denies access ({status}); set USD2KG_STORE_USER and "
                "USD2KG_STORE_PASSWORD, or USD2KG_STORE_TOKEN, to credentials with this permission"
            )
        if 300 <= status < 400:
            target = redact_address(error.headers.get("Location", "nowhere"))
            raise StoreError(f"{request.shown_url}: redirects to {target}, which is not followed; use that address")
        try:
            body = self._read(request, status, error).body
        except (OSError, http.client.HTTPException, EOFError, zlib.error):
            body = b""
        text = " ".join(body.decode("utf-8", "replace").split())
        reason = _redact(text, self._authorization)[:_MAX_SHOWN] or error.reason
        raise StoreError(
            f"{request.shown_url}: the server answers {status} ({reason}); check the address and the request"
        )


def _redact(text: str, authorization: str | None) -> str:
    """Return a text without the credentials, which a server may echo."""
    return text.replace(authorization.partition(" ")[2], "…") if authorization else text


def _connection_error(request: HttpRequest, reason: object) -> Exception:
    """Return the error for a failed connection."""
    if isinstance(reason, ConnectionRefusedError) or type(reason).__name__ == "gaierror":
        return _TransientError(f"is unreachable ({_text(reason)})", may_be_processed=False)
    if type(reason).__name__ == "SSLCertVerificationError":
        return StoreError(f"{request.shown_url}: its certificate is not trusted ({_text(reason)}); nothing was sent")
    return _TransientError(f"the connection broke ({_text(reason)})", may_be_processed=True)


def _text(reason: object) -> str:
    return " ".join(str(reason).split()) or type(reason).__name__


def _parse_retry_after(value: str | None) -> float | None:
    """Return the seconds of a Retry-After header (RFC 9110, section 10.2.3); None if missing or malformed."""
    if value is None:
        return None
    try:
        if value.strip().isdecimal():
            return float(value)
        return max(0.0, email.utils.parsedate_to_datetime(value).timestamp() - time.time())
    except (ValueError, OverflowError):
        return None
