"""Declare the namespace prefixes of an XML file that uses them without a declaration.

ROS and Drake read such files, since their parsers know no namespaces; other parsers refuse them.
"""

from xml.parsers import expat

__all__ = ["declare_prefixes"]

_KNOWN = frozenset({"xml", "xmlns"})
_BYTES_OF_ASCII = frozenset({None, "utf-8", "us-ascii", "iso-8859-1"})
"""Encodings, in lower case, in which the name of the root element is as long as in ASCII; None if none is declared."""


def declare_prefixes(data: bytes) -> bytes | None:
    """Return an XML file with a declaration of each prefix that has none; None if there is nothing to declare.

    Also None for a file that is no XML, declares entities, or is in an encoding such as UTF-16.

    >>> declare_prefixes(b'<robot><drake:member/></robot>')
    b'<robot xmlns:drake="urn:undeclared:drake"><drake:member/></robot>'
    """
    found = _Prefixes()
    if not found.read(data) or found.encoding not in _BYTES_OF_ASCII:
        return None
    missing = sorted(found.used - found.declared - _KNOWN)
    if not missing:
        return None
    declarations = "".join(f' xmlns:{name}="urn:undeclared:{name}"' for name in missing)
    return data[: found.end_of_root_tag] + declarations.encode() + data[found.end_of_root_tag :]


class _Prefixes:
    """The prefixes of the names of elements and attributes."""

    def __init__(self) -> None:
        self.used: set[str] = set()
        self.declared: set[str] = set()
        self.encoding: str | None = None
        self.end_of_root_tag = 0
        """Position after the name of the root element, in bytes."""

    def read(self, data: bytes) -> bool:
        """Return whether the prefixes were read."""
        parser = expat.ParserCreate()
        parser.XmlDeclHandler = self._declare
        parser.EntityDeclHandler = self._refuse
        parser.StartElementHandler = lambda tag, attributes: self._start(tag, attributes, parser.CurrentByteIndex)
        try:
            parser.Parse(data, True)
        except (expat.ExpatError, LookupError, ValueError):
            return False
        return not data.startswith((b"\xff\xfe", b"\xfe\xff"))

    def _declare(self, _: str, encoding: str | None, __: int) -> None:
        self.encoding = None if encoding is None else encoding.lower()

    def _refuse(self, *_: object) -> None:
        raise ValueError("entities can blow up")

    def _start(self, tag: str, attributes: dict[str, str], position: int) -> None:
        if not self.end_of_root_tag:
            self.end_of_root_tag = position + len(f"<{tag}".encode())
        for name in (tag, *attributes):
            prefix, colon, rest = name.partition(":")
            if colon and prefix == "xmlns":
                self.declared.add(rest)
            elif colon:
                self.used.add(prefix)
