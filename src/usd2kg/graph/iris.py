"""IRIs of individuals: from prim paths, stable across runs, unique, and back again."""

import re
from pathlib import Path
from urllib.parse import quote, unquote

import pyoxigraph as ox

from usd2kg.errors import GraphError

__all__ = ["check_base", "default_base", "individual_iri", "prim_path_of"]

_SEPARATOR = "."
"""Stands for the slash between prims. Prim names cannot hold a dot, so no two paths share an IRI."""


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

    The part follows a hyphen, which no prim name can hold.

    >>> individual_iri("https://my.lab/k/", "/World/Table_1/Cup_3", "box")
    'https://my.lab/k/World.Table_1.Cup_3-box'
    """
    name = _SEPARATOR.join(quote(step, safe="") for step in prim_path.strip("/").split("/"))
    return f"{base}{name}-{part}" if part else base + name


def prim_path_of(base: str, iri: str) -> str:
    """Return the prim path behind an individual's IRI.

    >>> prim_path_of("https://my.lab/k/", "https://my.lab/k/World.Table_1.Cup_3")
    '/World/Table_1/Cup_3'
    """
    name = iri.removeprefix(base).partition("-")[0]
    return "/" + "/".join(unquote(step) for step in name.split(_SEPARATOR))
