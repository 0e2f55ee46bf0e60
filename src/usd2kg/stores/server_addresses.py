"""Addresses of servers, and credentials for them; messages never contain secrets."""

import base64
import os
import re
import unicodedata
from collections.abc import Mapping
from urllib.parse import urlsplit

from usd2kg.errors import StoreError

__all__ = ["CREDENTIAL_VARIABLES", "check_address", "read_credentials", "redact_address"]

CREDENTIAL_VARIABLES = ("USD2KG_STORE_USER", "USD2KG_STORE_PASSWORD", "USD2KG_STORE_TOKEN")
"""Environment variables with credentials for stores."""
_MAX_SHOWN = 300
"""Characters of an address in a message."""
_NOT_IN_HEADERS = frozenset({"Cc", "Cs"})
"""Unicode categories that an HTTP header cannot contain: control characters and surrogates."""


def check_address(url: str) -> str:
    """Return the address of a server if it is valid.

    Raises:
        StoreError: the address is invalid, or contains a password; the message does not contain the password.
    """
    shown = redact_address(url)
    # Where a password begins and ends in a malformed address is ambiguous, so reject every @.
    if "@" in url:
        raise StoreError(
            f"store {shown}: its address contains a user or password before an @, which would appear in logs; set "
            "USD2KG_STORE_USER and USD2KG_STORE_PASSWORD in the environment, and write %40 for an @ in a path"
        )
    try:
        parts = urlsplit(url)
        is_valid = parts.scheme in {"http", "https"} and bool(parts.hostname) and parts.port != 0
    except ValueError:
        is_valid = False
    if not is_valid or not url.isascii() or not url.isprintable() or " " in url:
        raise StoreError(f"store '{shown}': is not a server address; expected one like http://localhost:7878")
    return url


def redact_address(url: str) -> str:
    """Return an address for messages, without user, password and query string, which may contain secrets.

    >>> redact_address("https://robot:s3cret@my.lab/ds?key=s3cret")
    'https://…@my.lab/ds'
    >>> redact_address("https://my.lab/ds?mail=s3cret@my.lab")
    'https://…'
    """
    scheme = url.partition("://")[0]
    start = f"{scheme}://" if "://" in url and scheme.isalnum() else ""
    before, has_user, after = url.rpartition("@")
    rest = url.removeprefix(start)
    if has_user:
        rest = "…" if re.search(r"[?#]", before) else f"…@{after}"
    rest = re.split(r"[?#]", rest, maxsplit=1)[0]
    shown = "".join(char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in start + rest)
    return shown[:_MAX_SHOWN]


def read_credentials(environment: Mapping[str, str] | None = None) -> str | None:
    """Return the Authorization header for stores from the environment; None without credentials.

    Raises:
        StoreError: the variables are incomplete or conflicting, or a value cannot be part of a header.
    """
    given = os.environ if environment is None else environment
    user, password, token = (given.get(name) or "" for name in CREDENTIAL_VARIABLES)
    if bool(user) != bool(password) or (token and user):
        raise StoreError(
            "credentials of the store: expected USD2KG_STORE_USER with USD2KG_STORE_PASSWORD, or USD2KG_STORE_TOKEN"
        )
    for name, value in zip(CREDENTIAL_VARIABLES, (user, password, token), strict=True):
        if any(unicodedata.category(char) in _NOT_IN_HEADERS for char in value):
            raise StoreError(f"{name}: contains a control character, such as a line break; remove it")
    if ":" in user:
        raise StoreError("USD2KG_STORE_USER: contains a colon, which HTTP does not allow (RFC 7617); check the name")
    if re.search(r"[^!-~]", token):
        raise StoreError("USD2KG_STORE_TOKEN: contains a space or a non-ASCII character; check the token")
    if token:
        return f"Bearer {token}"
    return "Basic " + base64.b64encode(f"{user}:{password}".encode()).decode() if user else None
