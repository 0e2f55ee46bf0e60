"""XML files that a world includes, each parsed once."""

from pathlib import Path

from usd2kg.convert.sdf.xml_tree import XmlElement, XmlError, read_xml

__all__ = ["XmlFiles"]


class XmlFiles:
    """The XML files of a world."""

    def __init__(self) -> None:
        self._roots: dict[Path, XmlElement | XmlError] = {}

    def read(self, path: Path) -> XmlElement:
        """Return the root element of a file, the same for each call.

        Raises:
            XmlError, OSError: as `read_xml`.
        """
        found = self._roots.get(path)
        if found is None:
            try:
                found = read_xml(path)
            except XmlError as error:
                found = error
            self._roots[path] = found
        if isinstance(found, XmlError):
            # Re-raising the same exception would keep the stack frames of each attempt alive.
            raise found.with_traceback(None)
        return found
