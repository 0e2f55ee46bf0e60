"""The formats of scenes by the ending of the file: USD, and those that are converted at reading."""

from dataclasses import dataclass
from pathlib import Path

__all__ = ["FORMATS", "LAYER_ENDINGS", "STAGE_ENDINGS", "SourceFormat", "find_format", "is_stage"]

LAYER_ENDINGS = (".usda", ".usdc", ".usd")
"""USD files that hold one layer."""
STAGE_ENDINGS = (".usd", ".usda", ".usdc", ".usdz")
"""USD files that open as a stage."""


@dataclass(frozen=True)
class SourceFormat:
    """A file format with its converter."""

    name: str
    endings: tuple[str, ...]
    """In lower case, with the dot."""
    module: str
    """Module of this package with a function `read_prims`; imported only for files of this format."""
    install: str
    """Command that installs the converter."""


_EXTRA = "pip install 'usd2kg[convert]'"
FORMATS = (
    SourceFormat("glTF", (".glb", ".gltf"), "gltf", _EXTRA),
    SourceFormat("OBJ", (".obj",), "obj", _EXTRA),
    SourceFormat("URDF", (".urdf",), "urdf", "pipx install urdf-usd-converter"),
    SourceFormat("MJCF", (".xml",), "mjcf", "pipx install mujoco-usd-converter"),
    SourceFormat("IFC", (".ifc", ".ifczip"), "ifc", "pip install 'usd2kg[ifc]'"),
    SourceFormat("SDFormat", (".sdf", ".world"), "sdf", "pip install 'usd2kg[sdf]'"),
)


def find_format(path: Path) -> SourceFormat | None:
    """Return the format of a file that needs conversion, by its ending; None for USD files and unknown endings."""
    ending = path.suffix.lower()
    return next((entry for entry in FORMATS if ending in entry.endings), None)


def is_stage(path: Path) -> bool:
    """Return whether a file is a USD stage or is converted to one, by its ending."""
    return path.suffix.lower() in STAGE_ENDINGS or find_format(path) is not None
