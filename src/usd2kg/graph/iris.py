"""IRIs of individuals from prim paths: stable, unique and reversible."""

import re
from functools import lru_cache
from pathlib import Path
from urllib.parse import quote, unquote

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.files import stem_of

__all__ = ["check_base", "default_base", "individual_iri", "prim_path_of"]

_SEPARATOR = "."
"""Replaces the slash between prim names; percent-encoded in prim names."""
_PART = "-"
"""Precedes the name of an aspect; percent-encoded in prim names."""


def default_base(source: str) -> str:
    """Return the default namespace of a scene's individuals.

    >>> default_base("scenes/my kitchen.usda")
    'https://example.org/my%20kitchen/'
    """
    return f"https://example.org/{quote(stem_of(Path(source)), safe='')}/"


def check_base(base: str) -> str:
    """Return `base` unchanged.

    Raises:
        GraphError: the base is not an absolute IRI that ends in `/`, `#` or `:`.
    """
    try:
        is_valid = base.endswith(("/", "#", ":")) and base.isprintable() and bool(re.match(r"[A-Za-z][\w+.-]*:", base))
        # The Turtle parser decides whether the IRI is valid.
        next(iter(ox.parse(f"<{base}x> <{base}x> <{base}x> .", format=ox.RdfFormat.TURTLE)))
    except SyntaxError:
        is_valid = False
    if not is_valid:
        raise GraphError(f"base {base!r}: expected an absolute IRI that ends in / or #, like https://my.lab/kitchen/")
    return base


def individual_iri(base: str, prim_path: str, part: str = "") -> str:
    """Return the IRI of the individual of a prim, or of an aspect of it (`part`: shape, box, pose…).

    The mapping is injective: characters other than ASCII letters, digits, `_` and `~` are percent-encoded as UTF-8,
    and a hyphen precedes the part. Nodes of the whole stage are parts of the path `/`.

    >>> individual_iri("https://my.lab/k/", "/World/Table_1/Cup_3", "box")
    'https://my.lab/k/World.Table_1.Cup_3-box'
    >>> individual_iri("https://my.lab/k/", "/World/Books[7]")
    'https://my.lab/k/World.Books%5B7%5D'
    """
    name = _SEPARATOR.join(map(_encode, prim_path.removeprefix("/").split("/")))
    return f"{base}{name}{_PART}{part}" if part else base + name


@lru_cache(maxsize=10_000)
def _encode(name: str) -> str:
    if name.isascii() and name.isidentifier():
        return name
    # Records from other sources may contain lone surrogates.
    encoded = quote(name, safe="", errors="surrogatepass")
    return encoded.replace(_SEPARATOR, "%2E").replace(_PART, "%2D")


def prim_path_of(base: str, iri: str) -> str:
    """Return the prim path of an individual.

    >>> prim_path_of("https://my.lab/k/", "https://my.lab/k/World.Table_1.Cup_3")
    '/World/Table_1/Cup_3'
    """
    name = iri.removeprefix(base).partition(_PART)[0]
    return "/" + "/".join(unquote(step, errors="surrogatepass") for step in name.split(_SEPARATOR))
