"""Budget: how much a world may have, with all that it includes and repeats."""

from pathlib import Path

from usd2kg.convert.converted import parse_error
from usd2kg.convert.sdf.xml_tree import XmlElement
from usd2kg.errors import SceneError

__all__ = ["Budget"]

_MAX_ELEMENTS = 500_000
"""Models, links, visuals, joints, frames, includes and parts of meshes.

Few lines can include or repeat without end. Each kB of an included file counts as one, too, whatever is in it.
"""
_MAX_TRIANGLES = 100_000_000
"""Triangles of meshes, as often as visuals repeat them; worlds of whole buildings have a few millions."""


class Budget:
    """Counts what is read of a world."""

    def __init__(self, path: Path) -> None:
        """Count for the file `path`, about which the errors are."""
        self._path = path
        self._elements = 0
        self._triangles = 0

    def count_elements(self, element: XmlElement, path: Path, count: int = 1) -> None:
        """Count elements; `element` in the file `path` is where there are too many.

        Raises:
            SceneError: there are more than 500,000.
        """
        self._elements += count
        if self._elements > _MAX_ELEMENTS:
            kinds = "models, links, visuals, joints, frames and parts of meshes"
            raise self.too_much(element, path, f"more than {_MAX_ELEMENTS:,} {kinds}, with those that it includes")

    def count_mesh(self, element: XmlElement, path: Path, parts: int, triangles: int) -> None:
        """Count a mesh that a visual shows, before its prims are made.

        Raises:
            SceneError: there are more than 500,000 elements, or 100 million triangles.
        """
        self.count_elements(element, path, parts)
        self._triangles += triangles
        if self._triangles > _MAX_TRIANGLES:
            raise self.too_much(element, path, f"more than {_MAX_TRIANGLES:,} triangles, with repeated meshes")

    def too_much(self, element: XmlElement, path: Path, found: str) -> SceneError:
        """Return the error of a world that has too much of something."""
        return parse_error(self._path, f"{path.name}, line {element.line}: it has {found}", "fewer of them")
