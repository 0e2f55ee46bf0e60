"""open_socket: the port to serve on, taken before any work is spent."""

import socket
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from usd2kg.errors import OutputError

__all__ = ["Address", "open_socket"]


class Address(Protocol):
    """A host and a port."""

    @property
    def host(self) -> str:
        """Name or address of this machine."""
        ...

    @property
    def port(self) -> int:
        """0 for one that is free."""
        ...


@contextmanager
def open_socket(address: Address) -> Iterator[socket.socket]:
    """Return a socket that is bound to an address.

    Raises:
        OutputError: the port is taken, or the host is not this machine.
    """
    try:
        family, kind, _, _, place = socket.getaddrinfo(address.host, address.port, type=socket.SOCK_STREAM)[0]
        bound = socket.socket(family, kind)
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind(place)
    except (OSError, OverflowError) as error:
        raise OutputError(
            f"{address.host}:{address.port}: cannot be served on ({error}); choose another --port or --host"
        ) from error
    with bound:
        yield bound
