"""IRIs of individuals: from prim paths, stable across runs, unique, and back again."""

import re
from functools import lru_cache
from pathlib import Path
from urllib.parse import quote, unquote

import pyoxigraph as ox

from usd2kg.errors import GraphError

__all__ = ["check_base", "default_base", "individual_iri", "prim_path_of"]

_SEPARATOR = "."
"""Stands for the slash between prims. A dot in a name is encoded, so no two paths share an IRI."""
_PART = "-"
"""Stands before the name of a part; encoded in names, too."""


def default_base(source: str) -> str:
    """Return the base under which a scene's individuals lie if the user sets none.

    >>> default_base("scenes/my kitchen.usda")
    'https://example.org/my%20kitchen/'
    """
    return f"https://example.org/{quote(Path(source).stem, safe='')}/"


def check_base(base: str) -> str:
    """Return `base` if individuals can lie under it.

    Raises:
        GraphError: it is not an absolute IRI that ends in `/` or `#`.
    """
    try:
        is_good = base.endswith(("/", "#", ":")) and base.isprintable() and bool(re.match(r"[A-Za-z][\w+.-]*:", base))
        # Turtle's parser is what must be able to read it back.
        next(iter(ox.parse(f"<{base}x> <{base}x> <{base}x> .", format=ox.RdfFormat.TURTLE)))
    except SyntaxError:
        is_good = False
    if not is_good:
        raise GraphError(f"base {base!r}: expected an absolute IRI that ends in / or #, like https://my.lab/kitchen/")
    return base


def individual_iri(base: str, prim_path: str, part: str = "") -> str:
    """Return the IRI of the individual for a prim, or of a node that belongs to it (`part`: shape, box, pose…).

    No two paths share an IRI, whatever letters they hold: all but ASCII letters, digits, `_` and `~` are encoded, as
    UTF-8 in percent. The part follows a hyphen. What belongs to the stage as a whole is a part of the path `/`.

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
    # Names are UTF-8 on a stage; half a surrogate pair can still come from other records.
    encoded = quote(name, safe="", errors="surrogatepass")
    return encoded.replace(_SEPARATOR, "%2E").replace(_PART, "%2D")


def prim_path_of(base: str, iri: str) -> str:
    """Return the prim path behind an individual's IRI.

    >>> prim_path_of("https://my.lab/k/", "https://my.lab/k/World.Table_1.Cup_3")
    '/World/Table_1/Cup_3'
    """
    name = iri.removeprefix(base).partition(_PART)[0]
    return "/" + "/".join(unquote(step, errors="surrogatepass") for step in name.split(_SEPARATOR))
