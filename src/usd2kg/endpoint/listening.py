"""Addresses to listen on: bind a port before the graph is copied."""

import ipaddress
import socket
from collections.abc import Iterator
from contextlib import contextmanager

from usd2kg.errors import OutputError

__all__ = ["is_loopback", "open_socket"]


@contextmanager
def open_socket(host: str, port: int) -> Iterator[socket.socket]:
    """Yield a bound socket, closed at the end of the block.

    Args:
        host: name or address of this machine.
        port: 0 selects a free port.

    Raises:
        OutputError: the port is in use, or the host is not this machine.
    """
    try:
        family, kind, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        bound = socket.socket(family, kind)
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind(address)
    except (OSError, OverflowError) as error:
        raise OutputError(f"{host}:{port}: cannot be bound ({error}); choose another --port or --host") from error
    with bound:
        yield bound


def is_loopback(host: str) -> bool:
    """Return whether only this machine can connect to a host name or address that a server listens on.

    >>> is_loopback("127.0.0.2"), is_loopback("::1"), is_loopback("0.0.0.0"), is_loopback("my.lab")
    (True, True, False, False)
    """
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
