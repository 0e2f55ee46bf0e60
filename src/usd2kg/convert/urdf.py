"""URDF → prims, by the program urdf_usd_converter."""

import re
from pathlib import Path

from usd2kg.convert.converted import Converted
from usd2kg.convert.converter_program import run_converter

__all__ = ["read_prims"]

_PACKAGE = re.compile(r"package://([^/\"'<>]+)/")
_MAX_ANCESTORS = 4
"""Folders above a URDF file in which packages are searched: package, source folder and workspace, one to spare."""


def read_prims(path: Path) -> Converted:
    """Return the stage of a URDF file.

    Raises:
        SceneError: the converter is not installed, or refuses the file.
    """
    text = path.read_text("utf-8", errors="replace")
    arguments = [f"--package={name}={folder}" for name, folder in _find_packages(text, path.resolve().parent)]
    return run_converter("urdf_usd_converter", path, "a URDF file (expand .xacro files first)", arguments)


def _find_packages(text: str, folder: Path) -> list[tuple[str, Path]]:
    """Return (package, folder) of the ROS packages that a file names, for those beside one of the folders above it."""
    above = (folder, *folder.parents)[: _MAX_ANCESTORS + 1]
    names = sorted(set(_PACKAGE.findall(text)))
    found = ((name, next((place / name for place in above if (place / name).is_dir()), None)) for name in names)
    return [(name, place) for name, place in found if place is not None and name not in {".", ".."}]
