"""What was assumed or left out of a file, with the line."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from usd2kg.convert.sdf.xml_tree import XmlElement

__all__ = ["Notes"]

_MAX_NOTES = 50
"""Notes that are kept; a world without its meshes has one for each."""


@dataclass
class Notes:
    """Notes on files, each once."""

    _found: dict[str, None] = field(default_factory=dict)
    _more: int = 0

    def add(self, path: Path, element: XmlElement | None, text: str) -> None:
        """Keep a note on an element of a file, or on the whole file."""
        place = path.name if element is None or not element.line else f"{path.name}, line {element.line}"
        note = f"{place}: {text}"
        if len(self._found) < _MAX_NOTES:
            self._found[note] = None
        elif note not in self._found:
            self._more += 1

    def __iter__(self) -> Iterator[str]:
        yield from self._found
        if self._more:
            yield f"{self._more} more notes are not listed"
