"""download: the bytes of a document on the web, for commands that are asked to fetch one."""

import re
import urllib.error
import urllib.request
from collections.abc import Iterator
from http.client import HTTPException, InvalidURL
from typing import Any
from urllib.parse import urlsplit

from usd2kg.errors import Usd2kgError

__all__ = ["download", "shown_address"]

_SCHEMES = {"http", "https"}
_CHUNK_BYTES = 1 << 20


def download(
    address: str, *, max_bytes: int, timeout_s: float, error: type[Usd2kgError], accept: str = "*/*"
) -> Iterator[bytes]:
    """Yield the bytes of a document in chunks of up to 1 MiB.

    Args:
        address: an https or http URL; redirects to other schemes are refused.
        max_bytes: a longer document is an error.
        timeout_s: longest time in seconds without a response.
        error: the type of the errors.
        accept: the media types to ask for.

    Raises:
        Usd2kgError: of the type `error`: the address is invalid or cannot be reached, the server refuses, or the
            document is too long or ends early. Chunks may have been yielded before.
    """
    shown = shown_address(address)
    # Plain http is accepted because some documents are not served otherwise; a hash protects the content.
    if address.partition(":")[0].lower() not in _SCHEMES:
        raise error(f"{shown}: is not a web address; expected https://… or http://…")
    try:
        request = urllib.request.Request(address, headers={"Accept": accept, "User-Agent": "usd2kg"})
        with _opener().open(request, timeout=timeout_s) as answer:
            yield from _read(answer, shown, max_bytes, error)
    except urllib.error.HTTPError as refusal:
        refusal.close()
        raise error(f"{shown}: the server answered {refusal.code}; expected 200") from refusal
    except (ValueError, InvalidURL) as invalid:
        raise error(f"{shown}: is not a valid address; correct it") from invalid
    except HTTPException as broken:
        raise error(f"{shown}: the server did not answer in HTTP ({type(broken).__name__}); try again") from broken
    except OSError as failure:
        reason = getattr(failure, "reason", failure)
        raise error(f"{shown}: cannot be reached ({reason}); is this machine online?") from failure


def _read(answer: Any, shown: str, max_bytes: int, error: type[Usd2kgError]) -> Iterator[bytes]:
    promised = answer.headers.get("Content-Length", "")
    count = 0
    while chunk := answer.read(_CHUNK_BYTES):
        count += len(chunk)
        if count > max_bytes:
            raise error(f"{shown}: is longer than {max_bytes:,} bytes; expected at most that")
        yield chunk
    # A sized read does not report a connection that ended early.
    if promised.isascii() and promised.isdigit() and count < int(promised):
        raise error(f"{shown}: ended after {count:,} of {int(promised):,} bytes; try again")


class _WebOnly(urllib.request.HTTPRedirectHandler):
    """Follows redirects to http and https only."""

    def redirect_request(self, *args: Any) -> urllib.request.Request | None:
        address = args[-1]
        if urlsplit(address).scheme not in _SCHEMES:
            raise urllib.error.URLError(f"it redirects to {shown_address(address)}, which is not a web address")
        return super().redirect_request(*args)


def _opener() -> urllib.request.OpenerDirector:
    opener = urllib.request.OpenerDirector()
    for handler in (
        urllib.request.ProxyHandler(),
        urllib.request.HTTPHandler(),
        urllib.request.HTTPSHandler(),
        urllib.request.HTTPDefaultErrorHandler(),
        urllib.request.HTTPErrorProcessor(),
        _WebOnly(),
    ):
        opener.add_handler(handler)
    return opener


def shown_address(address: str) -> str:
    """Return a web address without user, password, query and fragment, which may be secret, for printing.

    >>> shown_address("https://me:secret@lab.example/onto.ttl?key=1")
    'https://lab.example/onto.ttl'
    """
    place = re.split(r"[?#]", address, maxsplit=1)[0]
    return re.sub(r"^([^/]*//)[^/]*@", r"\1", place)
