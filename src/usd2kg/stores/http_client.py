"""HttpClient: requests to a server of graphs, sent again where that can help, and never with a secret in a message.

The standard library speaks all that SPARQL's protocols need, so the core install has no HTTP package.
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
from usd2kg.stores.addresses import shown_address

__all__ = ["HttpClient", "HttpRequest", "HttpResponse", "OutcomeUnknownError"]

logger = logging.getLogger(__name__)

_TRIES = 5
_FIRST_PAUSE_S = 0.5
_LONGEST_PAUSE_S = 30.0
_PASSING = frozenset({429, 500, 502, 503, 504})
"""Statuses that may be gone the next time."""
_LARGEST = 1 << 30
"""Bytes of an unpacked answer: about 7 million triples."""
_PIECE = 1 << 20
_NOT_DONE = frozenset({429, 503})
"""Statuses of a server that turned the request away before it began."""
_LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})


class OutcomeUnknownError(StoreError):
    """The connection broke after a request was sent that must not be done twice: it may be done or not."""


@dataclass(frozen=True)
class HttpRequest:
    """A request."""

    method: str
    url: str
    body: bytes | None = None
    headers: Mapping[str, str] | None = None
    is_idempotent: bool = True
    """Whether doing it twice is the same as doing it once."""

    @property
    def place(self) -> str:
        """The address as a message may hold it."""
        return shown_address(self.url)


@dataclass(frozen=True)
class HttpResponse:
    """What the server answered."""

    status: int
    content_type: str
    body: bytes


class _PassingError(Exception):
    """A fault that may be gone the next time."""

    def __init__(self, reason: str, *, is_done: bool, pause_s: float | None = None) -> None:
        super().__init__(reason)
        self.is_done = is_done
        """Whether the server may have done what was asked."""
        self.pause_s = pause_s


class _NoRedirects(urllib.request.HTTPRedirectHandler):
    """Follows no redirect: neither credentials nor a scene shall go to a server that the user did not name."""

    # Before it asks whether to follow, the library reads the new address, and fails where that is none.
    def http_error_302(self, req: object, fp: object, code: object, msg: object, headers: object) -> None:
        return None

    http_error_301 = http_error_303 = http_error_307 = http_error_308 = http_error_302


class HttpClient:
    """Sends requests to one server; TLS certificates are verified, redirects are not followed."""

    def __init__(
        self,
        authorization: str | None = None,
        *,
        timeout_s: float = 120.0,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._authorization = authorization
        self._timeout_s = timeout_s
        self._sleep = sleep
        self._openers = {
            is_near: urllib.request.build_opener(_NoRedirects, *([urllib.request.ProxyHandler({})] if is_near else []))
            for is_near in (True, False)
        }
        self._has_warned = False

    def send(self, call: HttpRequest, accepted: frozenset[int] = frozenset()) -> HttpResponse:
        """Return the answer to a request; one of 200 to 299, or of `accepted`.

        Raises:
            OutcomeUnknownError: the connection broke, and the request may not be repeated.
            StoreError: the server is out of reach, keeps failing, or refuses.
        """
        for attempt in range(_TRIES):
            try:
                return self._send_once(call, accepted)
            except _PassingError as fault:
                if fault.is_done and not call.is_idempotent:
                    raise OutcomeUnknownError(f"{call.place}: {fault}; it is not known what was done") from fault
                if attempt == _TRIES - 1:
                    raise StoreError(f"{call.place}: {fault}, {_TRIES} times; try again later") from fault
                pause = _pause(attempt, fault.pause_s)
                logger.info("%s: %s; tries again in %.1f s", call.place, fault, pause)
                self._sleep(pause)
        raise AssertionError("the last attempt returns or raises")

    def _send_once(self, call: HttpRequest, accepted: frozenset[int]) -> HttpResponse:
        request = urllib.request.Request(call.url, call.body, dict(call.headers or {}), method=call.method)
        request.add_header("Accept-Encoding", "gzip")
        request.add_header("User-Agent", "usd2kg")
        host = urlsplit(call.url).hostname
        if self._authorization is not None:
            self._warn(call.url, host)
            request.add_unredirected_header("Authorization", self._authorization)
        try:
            with self._openers[host in _LOOPBACK].open(request, timeout=self._timeout_s) as response:
                return _read(call, response.status, response)
        except urllib.error.HTTPError as error:
            with error:
                return _judge(call, error, accepted, self._authorization)
        except urllib.error.URLError as error:
            raise _fault(call, error.reason) from error
        except (OSError, http.client.HTTPException, EOFError, zlib.error) as error:
            raise _fault(call, error) from error

    def _warn(self, url: str, host: str | None) -> None:
        if url.startswith("http:") and host not in _LOOPBACK and not self._has_warned:
            logger.warning("%s: the credentials travel unencrypted; use https", shown_address(url))
            self._has_warned = True


def _read(call: HttpRequest, status: int, response: http.client.HTTPResponse | urllib.error.HTTPError) -> HttpResponse:
    """Return an answer, unpacked piece by piece: a small one may unpack to more than the memory holds."""
    is_packed = response.headers.get("Content-Encoding", "").lower() == "gzip"
    source = gzip.GzipFile(fileobj=response) if is_packed else response
    body = bytearray()
    while piece := source.read(_PIECE):
        body += piece
        if len(body) > _LARGEST:
            raise StoreError(f"{call.place}: the server's answer is over {_LARGEST >> 20} MiB; ask for less of it")
    # What is read by pieces and cut off is else taken for whole.
    if missing := getattr(response, "length", None):
        raise http.client.IncompleteRead(b"", missing)
    return HttpResponse(status, response.headers.get_content_type(), bytes(body))


def _judge(
    call: HttpRequest, error: urllib.error.HTTPError, accepted: frozenset[int], secret: str | None
) -> HttpResponse:
    """Return the answer with an error status if it is accepted, else raise what it means."""
    status = error.code
    if status in accepted:
        return _read(call, status, error)
    if status in _PASSING:
        pause = _retry_after(error.headers.get("Retry-After"))
        raise _PassingError(
            f"the server answers {status} {error.reason}", is_done=status not in _NOT_DONE, pause_s=pause
        )
    if status in {401, 403}:
        raise StoreError(
            f"{call.place}: the server refuses ({status}); give credentials that may do this by USD2KG_STORE_USER and "
            "USD2KG_STORE_PASSWORD, or by USD2KG_STORE_TOKEN"
        )
    if 300 <= status < 400:
        place = shown_address(error.headers.get("Location", "nowhere"))
        raise StoreError(f"{call.place}: the server redirects to {place}, which is not followed; name that address")
    try:
        told = _read(call, status, error).body
    except (OSError, http.client.HTTPException, EOFError, zlib.error):
        told = b""
    reason = _without(secret, " ".join(told.decode("utf-8", "replace").split()))[:500] or error.reason
    raise StoreError(f"{call.place}: the server answers {status} ({reason}); check the address and what was asked")


def _without(secret: str | None, text: str) -> str:
    """Return a text without the credentials that a server may have sent back."""
    return text.replace(secret.partition(" ")[2], "…") if secret else text


def _fault(call: HttpRequest, reason: object) -> Exception:
    """Return what a broken connection means."""
    if isinstance(reason, ConnectionRefusedError) or type(reason).__name__ == "gaierror":
        return _PassingError(f"cannot be reached ({_text(reason)})", is_done=False)
    if type(reason).__name__ == "SSLCertVerificationError":
        return StoreError(
            f"{call.place}: its certificate is not trusted ({_text(reason)}); the connection was not made"
        )
    return _PassingError(f"the connection broke ({_text(reason)})", is_done=True)


def _text(reason: object) -> str:
    return " ".join(str(reason).split()) or type(reason).__name__


def _pause(attempt: int, asked_s: float | None) -> float:
    """Return seconds to wait: what the server asked for, else twice as long each time, more or less."""
    if asked_s is not None:
        return min(asked_s, _LONGEST_PAUSE_S)
    longest: float = _FIRST_PAUSE_S * 2**attempt
    return random.uniform(longest / 2, longest)


def _retry_after(value: str | None) -> float | None:
    """Return the seconds of a Retry-After header (RFC 9110, section 10.2.3); None where it is not understood."""
    if value is None:
        return None
    try:
        if value.strip().isdecimal():
            return float(value)
        return max(0.0, email.utils.parsedate_to_datetime(value).timestamp() - time.time())
    except (ValueError, OverflowError):
        return None
