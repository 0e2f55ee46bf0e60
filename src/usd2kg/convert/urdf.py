"""URDF → prims, by the program urdf_usd_converter."""

import re
from pathlib import Path
from xml.sax.saxutils import escape

from usd2kg.convert.converted import Converted
from usd2kg.convert.converter_program import run_converter
from usd2kg.convert.xml_prefixes import declare_prefixes

__all__ = ["read_prims"]

_PACKAGE = re.compile(r"package://([^/\"'<>]+)/")
_RELATIVE = re.compile(rb"""(\sfilename\s*=\s*["'])(?![A-Za-z][A-Za-z0-9+.-]*:)([^/\\"'][^"']*)""")
"""A file name that is neither absolute nor an address."""
_MAX_ANCESTORS = 4
"""Folders above a URDF file in which packages are searched: package, source folder and workspace, one to spare."""


def read_prims(path: Path) -> Converted:
    """Return the stage of a URDF file.

    Raises:
        SceneError: the converter is not installed, or refuses the file.
    """
    data, folder = path.read_bytes(), path.resolve().parent
    text = data.decode("utf-8", errors="replace")
    arguments = [f"--package={name}={place}" for name, place in _find_packages(text, folder)]
    declared = declare_prefixes(data)
    # The program reads the corrected file in another folder.
    corrected = None if declared is None else _with_absolute_paths(declared, folder)
    expected = "a URDF file (expand .xacro files first)"
    return run_converter("urdf_usd_converter", path, expected, arguments, corrected=corrected)


def _with_absolute_paths(data: bytes, folder: Path) -> bytes:
    """Return a URDF file with the absolute paths of the files that it names relative to its folder."""
    beginning = escape(f"{folder.as_posix()}/", {'"': "&quot;", "'": "&apos;"}).encode("utf-8", "surrogateescape")
    return _RELATIVE.sub(lambda found: found[1] + beginning + found[2], data)


def _find_packages(text: str, folder: Path) -> list[tuple[str, Path]]:
    """Return (package, folder) of the ROS packages that a file names, for those beside one of the folders above it."""
    above = (folder, *folder.parents)[: _MAX_ANCESTORS + 1]
    names = sorted(set(_PACKAGE.findall(text)))
    found = ((name, next((place / name for place in above if (place / name).is_dir()), None)) for name in names)
    return [(name, place) for name, place in found if place is not None and name not in {".", ".."}]
