"""Addresses of servers and credentials for them: checked before they are used, and never shown with a secret."""

import base64
import os
import re
import unicodedata
from collections.abc import Mapping
from urllib.parse import urlsplit

from usd2kg.errors import StoreError

__all__ = ["check_address", "read_credentials", "shown_address"]

_LONGEST_SHOWN = 300
_CONTROL = frozenset({"Cc", "Cs"})
"""Unicode's categories of what no header can carry: control characters, and halves of characters."""


def check_address(url: str) -> str:
    """Return the address of a server if it can be one.

    Raises:
        StoreError: it is none, or holds a password, which is not repeated in the message.
    """
    shown = shown_address(url)
    # Where a password begins and ends in a broken address is anyone's guess, so any @ counts.
    if "@" in url:
        raise StoreError(
            f"store {shown}: its address holds a user or password before an @, which ends up in logs; give them by the "
            "environment variables USD2KG_STORE_USER and USD2KG_STORE_PASSWORD, and write %40 for an @ in a path"
        )
    try:
        parts = urlsplit(url)
        is_one = parts.scheme in {"http", "https"} and bool(parts.hostname) and parts.port != 0
    except ValueError:
        is_one = False
    if not is_one or not url.isascii() or not url.isprintable() or " " in url:
        raise StoreError(f"store '{shown}': is no address of a server; expected one like http://localhost:7878")
    return url


def shown_address(url: str) -> str:
    """Return an address as a message may hold it: nothing before an @, and no query string, which may be secrets.

    >>> shown_address("https://robot:s3cret@my.lab/ds?key=s3cret")
    'https://…@my.lab/ds'
    >>> shown_address("https://my.lab/ds?mail=s3cret@my.lab")
    'https://…'
    """
    scheme = url.partition("://")[0]
    start = f"{scheme}://" if "://" in url and scheme.isalnum() else ""
    before, is_hidden, after = url.rpartition("@")
    place = url.removeprefix(start)
    if is_hidden:
        place = "…" if re.search(r"[?#]", before) else f"…@{after}"
    place = re.split(r"[?#]", place, maxsplit=1)[0]
    return "".join(char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in start + place)[
        :_LONGEST_SHOWN
    ]


def read_credentials(environment: Mapping[str, str] | None = None) -> str | None:
    """Return the Authorization header for stores from the environment, None if it names no credentials.

    Raises:
        StoreError: only one of user and password is there, or a token besides them; or one holds what no header may.
    """
    given = os.environ if environment is None else environment
    names = [f"USD2KG_STORE_{name}" for name in ("USER", "PASSWORD", "TOKEN")]
    user, password, token = (given.get(name) or "" for name in names)
    if bool(user) != bool(password) or (token and user):
        raise StoreError(
            "credentials of the store: expected USD2KG_STORE_USER with USD2KG_STORE_PASSWORD, or USD2KG_STORE_TOKEN"
        )
    for name, value in zip(names, (user, password, token), strict=True):
        if any(unicodedata.category(char) in _CONTROL for char in value):
            raise StoreError(f"{name}: holds a control character, like the end of a line; give it again without")
    if ":" in user:
        raise StoreError("USD2KG_STORE_USER: holds a colon, which no user of HTTP may (RFC 7617); check the name")
    if re.search(r"[^!-~]", token):
        raise StoreError("USD2KG_STORE_TOKEN: holds a space or a letter beyond ASCII, as no token does; give it again")
    if token:
        return f"Bearer {token}"
    return "Basic " + base64.b64encode(f"{user}:{password}".encode()).decode() if user else None
