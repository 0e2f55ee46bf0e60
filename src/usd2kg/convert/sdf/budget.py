"""SdfBudget: size limits of a world, counting included and repeated content."""

from pathlib import Path

from usd2kg.convert.converted import parse_error
from usd2kg.convert.sdf.xml_tree import XmlElement
from usd2kg.errors import SceneError

__all__ = ["SdfBudget"]

_MAX_ELEMENTS = 500_000
"""Models, links, visuals, joints, frames, includes and parts of meshes.

A short file can include or repeat content without bound. Each kilobyte of an included file also counts as one
element.
"""
_MAX_TRIANGLES = 100_000_000
"""Mesh triangles, counted once per visual; worlds of whole buildings have a few million."""


class SdfBudget:
    """Counts elements and triangles while a world is read."""

    def __init__(self, path: Path) -> None:
        """Start counting; `path` is the file named in errors."""
        self._path = path
        self._elements = 0
        self._triangles = 0

    def count_elements(self, element: XmlElement, path: Path, count: int = 1) -> None:
        """Count elements; `element` in the file `path` is the location for an error.

        Raises:
            SceneError: there are more than 500,000.
        """
        self._elements += count
        if self._elements > _MAX_ELEMENTS:
            kinds = "models, links, visuals, joints, frames and parts of meshes"
            raise self.too_much(element, path, f"more than {_MAX_ELEMENTS:,} {kinds}, with those that it includes")

    def count_mesh(self, element: XmlElement, path: Path, parts: int, triangles: int) -> None:
        """Count the mesh of a visual, before its prims are created.

        Raises:
            SceneError: there are more than 500,000 elements, or 100 million triangles.
        """
        self.count_elements(element, path, parts)
        self._triangles += triangles
        if self._triangles > _MAX_TRIANGLES:
            raise self.too_much(element, path, f"more than {_MAX_TRIANGLES:,} triangles, with repeated meshes")

    def too_much(self, element: XmlElement, path: Path, found: str) -> SceneError:
        """Return the error for a world beyond a limit."""
        return parse_error(self._path, f"{path.name}, line {element.line}: it has {found}", "fewer of them")
