"""The root element of an XML file, from its beginning."""

from pathlib import Path
from xml.parsers import expat

__all__ = ["read_root_tag"]

_CHUNK = 1 << 16
_MAX_BYTES = 1 << 20
"""What comes before the root element: licences are a few kB."""


class _Found(Exception):  # noqa: N818 - ends the parser, is no error
    """The root element has started."""


def read_root_tag(path: Path) -> str | None:
    """Return the name of the root element, with its prefix.

    None if there is none in the first MiB, the file is no XML or cannot be read, or it declares entities before, which
    attributes of the root could expand.
    """
    tag: str | None = None

    def start(name: str, _: object) -> None:
        nonlocal tag
        tag = name
        raise _Found

    def refuse(*_: object) -> None:
        raise _Found

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    parser.EntityDeclHandler = refuse
    try:
        with path.open("rb") as file:
            # MuJoCo, too, reads files with white space before the XML declaration.
            parser.Parse(file.read(_CHUNK).lstrip(b" \t\r\n"), False)
            for _ in range(_MAX_BYTES // _CHUNK - 1):
                parser.Parse(file.read(_CHUNK), False)
    except (_Found, expat.ExpatError, LookupError, ValueError, OSError):
        return tag
    return None
