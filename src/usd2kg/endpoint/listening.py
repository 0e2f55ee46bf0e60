"""Addresses to listen on: bind a port before the graph is copied."""

import ipaddress
import socket
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from usd2kg.errors import OutputError

__all__ = ["Address", "open_socket", "url_of"]


@dataclass(frozen=True)
class Address:
    """Address and host names of a server."""

    host: str = "127.0.0.1"
    """Name or address of this machine; 127.0.0.1 accepts local connections only."""
    port: int = 0
    """0 selects a free port."""
    names: Sequence[str] = ()
    """Host names to accept in addition to localhost, IP addresses and `host`."""

    @property
    def is_local(self) -> bool:
        """Whether only this machine can connect."""
        return _is_loopback(self.host)

    @property
    def served_names(self) -> tuple[str, ...]:
        """All host names that requests may be addressed to, for `Guard`."""
        return (*self.names, self.host)


@contextmanager
def open_socket(address: Address) -> Iterator[socket.socket]:
    """Yield a bound socket, closed at the end of the block.

    Raises:
        OutputError: the port is in use, or the host is not this machine.
    """
    try:
        family, kind, _, _, place = socket.getaddrinfo(address.host, address.port, type=socket.SOCK_STREAM)[0]
        bound = socket.socket(family, kind)
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind(place)
    except (OSError, OverflowError) as error:
        where = f"{address.host}:{address.port}"
        raise OutputError(f"{where}: cannot be bound ({error}); choose another --port or --host") from error
    with bound:
        yield bound


def url_of(bound: socket.socket) -> str:
    """Return the URL of the server on a bound socket, with a final slash."""
    host, port = bound.getsockname()[:2]
    return f"http://{f'[{host}]' if ':' in host else host}:{port}/"


def _is_loopback(host: str) -> bool:
    """Return whether only this machine can connect to a host name or address that a server listens on.

    >>> _is_loopback("127.0.0.2"), _is_loopback("::1"), _is_loopback("0.0.0.0"), _is_loopback("my.lab")
    (True, True, False, False)
    """
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
